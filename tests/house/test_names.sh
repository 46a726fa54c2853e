#!/bin/sh
# Each public function of C has its counterpart in C++, Python and JavaScript, or a reason. Truth: the headers, the stub, ovoid.d.ts.
set -u
cd "$OVOID_SOURCE_DIR" || exit 1
if ! command -v python3 > /dev/null; then
    echo "0 passed, 0 failed, 1 skipped"
    exit 0
fi
python3 scripts/names.py
