# shellcheck shell=sh
# Sourced by the tests of the tool: where it, its sources and its build are, from the environment or from where the test
# lies; a test is skipped where the tool is not built.
: "${OVOID_SOURCE_DIR:=$(cd "$(dirname "$0")/../.." && pwd)}" "${OVOID_BUILD_DIR:=$OVOID_SOURCE_DIR/build/release}"
: "${OVOID_TOOL:=$OVOID_BUILD_DIR/ovoid}"
if [ ! -x "$OVOID_TOOL" ]; then
    echo "skipped: the tool is not built"
    echo "0 passed, 0 failed, 1 skipped"
    exit 0
fi
