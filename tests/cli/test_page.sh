#!/bin/sh
# The data of a page, read back by Python: page_check.py says what they are compared with.
set -u
# shellcheck source=tests/cli/need_tool.sh
. "$(dirname "$0")/need_tool.sh"
if ! command -v python3 >/dev/null; then
    echo "skipped: python3 is absent"
    echo "0 passed, 0 failed, 1 skipped"
    exit 0
fi
work=$OVOID_BUILD_DIR/test_page
rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 1
OVOID_PAGE=$OVOID_SOURCE_DIR/tests/cli/data/page.html python3 "$OVOID_SOURCE_DIR/tests/cli/page_check.py" "$OVOID_TOOL" \
    "$OVOID_SOURCE_DIR/tests/cli/data"
