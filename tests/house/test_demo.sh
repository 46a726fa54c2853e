#!/bin/sh
# The demo, where its meshes are (Debian's libcgal-demo): every proof holds, the picture is the one in docs/, and each
# line of the README's session is what the tool says. Truth: the proofs; the rest is what was written down before.
set -u
passed=0 failed=0
if [ ! -f /usr/share/doc/libcgal-dev/data.tar.gz ]; then
    echo "skipped: libcgal-demo is not installed"
    echo "0 passed, 0 failed, 1 skipped"
    exit 0
fi
if [ ! -x "$OVOID_TOOL" ]; then
    echo "skipped: the tool was not built"
    echo "0 passed, 0 failed, 1 skipped"
    exit 0
fi
export OVOID_DEMO="$OVOID_BUILD_DIR/test_demo"

# check NAME COMMAND...: one check.
check() {
    name=$1
    shift
    if "$@" >>"$OVOID_DEMO/said.log" 2>&1; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED $name"
        cat "$OVOID_DEMO/said.log"
    fi
}

rm -rf "$OVOID_DEMO"
mkdir -p "$OVOID_DEMO"
check demo "$OVOID_SOURCE_DIR/scripts/demo.sh"
check proofs grep -q '^proofs: 15, hold: 15, do not: 0; undecided answers: 0' "$OVOID_DEMO/said.log"
check motion [ "$(grep -c 'do not: 0; undecided answers: 0' "$OVOID_DEMO/said.log")" -eq 2 ]
check plot grep -q 'nearest 6 of 8 pairs' "$OVOID_DEMO/motion.svg"
check picture cmp "$OVOID_DEMO/scene.svg" "$OVOID_SOURCE_DIR/docs/demo.svg"

# The README's session.
cd "$OVOID_DEMO" || exit 1
"$OVOID_TOOL" check scene.json --margin 0.3 >session.txt 2>/dev/null
"$OVOID_TOOL" verify results.jsonl scene.json >>session.txt 2>/dev/null
# shellcheck disable=SC2016 # backquotes are Markdown here
sed -n '/^```console/,/^```$/p' "$OVOID_SOURCE_DIR/README.md" | grep -v '^```' | grep -v '^\$ ' >readme.txt
check readme diff readme.txt session.txt

echo "$passed passed, $failed failed, 0 skipped"
[ "$failed" -eq 0 ]
