#!/bin/sh
# Lies told to `ovoid verify`, with the exact judge and without: lies.py says what they are, and what is true.
set -u
# shellcheck source=tests/cli/need_tool.sh
. "$(dirname "$0")/need_tool.sh"
if ! command -v python3 >/dev/null; then
    echo "skipped: python3 is absent"
    echo "0 passed, 0 failed, 1 skipped"
    exit 0
fi
: "${OVOID_FLOATING:=$OVOID_BUILD_DIR/cli/ovoid_floating}"
[ -x "$OVOID_FLOATING" ] || OVOID_FLOATING=
work=$OVOID_BUILD_DIR/test_cli_lies
rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 1
python3 "$OVOID_SOURCE_DIR/tests/cli/lies.py" "$OVOID_TOOL" ${OVOID_FLOATING:+"$OVOID_FLOATING"}
