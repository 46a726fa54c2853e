#!/bin/sh
# libovoid_fcl: a program of FCL alone, then the same file with the library loaded before libfcl.
set -u
library=$OVOID_BUILD_DIR/fcl/libovoid_fcl.so
program=$OVOID_BUILD_DIR/tests/fcl_plain
passed=0
failed=0
if [ ! -e "$library" ] || [ ! -x "$program" ]; then
    echo "skipped: test_fcl_preload needs libfcl-dev (FCL) and a build without sanitizers"
    echo "0 passed, 0 failed, 1 skipped"
    exit 0
fi
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT

# expect NAME FILE TEXT: a line of the file.
expect() {
    if grep -qxF -e "$3" "$2"; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED $1: no line \"$3\" in:"
        cat "$2"
    fi
}

"$program" >"$work/alone" 2>"$work/alone.err" || failed=$((failed + 1))
OVOID_FCL_REPORT=1 LD_PRELOAD=$library "$program" >"$work/with" 2>"$work/with.err" || failed=$((failed + 1))
LD_PRELOAD=$library "$program" >/dev/null 2>"$work/quiet.err" || failed=$((failed + 1))
expect alone "$work/alone" "triangle and sphere not supported"
expect alone "$work/alone" "manager not supported"
expect with "$work/with" "triangle and sphere answered"
expect with "$work/with" "manager answered"
# The ball's lower side reaches the box at 1 - 2 t = 0.25 + 0.00005.
expect with "$work/with" "contact at 0.375"
# What is left to FCL is FCL's answer.
for line in planes cost; do
    expect "$line" "$work/with" "$(grep "^$line" "$work/alone")"
done
expect report "$work/with.err" "libovoid_fcl: 5 calls, of which 2 were left to FCL"
if [ -s "$work/quiet.err" ]; then
    failed=$((failed + 1))
    echo "FAILED quiet: the library writes without being asked:"
    cat "$work/quiet.err"
else
    passed=$((passed + 1))
fi
# Nothing but FCL's names is exported.
if command -v nm >/dev/null; then
    others=$(nm -D --defined-only "$library" | awk '{print $NF}' | grep -vE '^_ZN3fcl(7collide|8distance|17continuousCollide)Id')
    if [ -z "$others" ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED exports: $others"
    fi
fi
echo "$passed passed, $failed failed, 0 skipped"
[ "$failed" -eq 0 ]
