#!/bin/sh
# The list of mutations fits the sources. Truth: each one's text is in its file exactly once and is changed, it says what
# it breaks, and its group has tests; each such test is there. A planted text that is nowhere is found.
set -u
: "${OVOID_SOURCE_DIR:=$(cd "$(dirname "$0")/../.." && pwd)}" "${OVOID_BUILD_DIR:=$OVOID_SOURCE_DIR/build/release}"
work=$OVOID_BUILD_DIR/test_mutations
rm -rf "$work" && mkdir -p "$work" || exit 1
# A copy, since a listing is written beside the sources.
cp -R "$OVOID_SOURCE_DIR/scripts" "$OVOID_SOURCE_DIR/src" "$OVOID_SOURCE_DIR/python" "$OVOID_SOURCE_DIR/cli" "$OVOID_SOURCE_DIR/include" "$work" && cd "$work" || exit 1
passed=0 failed=0
check() { # NAME RESULT
    if [ "$2" -eq 0 ]; then passed=$((passed + 1)); else failed=$((failed + 1)) && echo "FAILED $1"; fi
}

scripts/mutate.sh --check >said
check "every mutation applies: $(grep FAILED said | head -n 5)" $?
passed=$((passed + $(sed -n 's/^\([0-9]*\) passed.*/\1/p' said)))
for test in $(scripts/mutate.sh --list | sed 's/^[^:]*://' | tr ' ' '\n' | sed 's/:.*//' | sort -u); do
    # A test of Python, test_python_NAME, is python/tests/test_NAME.py; those of the tool are scripts.
    [ -n "$(find "$OVOID_SOURCE_DIR/tests" -name "$test.c" -o -name "$test.cpp" -o -name "$test")" ] || [ -f "$OVOID_SOURCE_DIR/python/tests/$(echo "$test.py" | sed 's/_python//')" ]
    check "there is no $test" $?
done
for group in $(scripts/mutate.sh --list | cut -d, -f1); do
    scripts/mutate.sh --list | grep -q "^$group, [1-9]"
    check "group $group has no mutations" $?
done
# Planted: a text that is nowhere, one that is there twice, a group that is none.
printf '\nname: planted\ntests: world\nfile: src/world/move.c\nfrom: no such text\nto: x\nbreaks: x\n' >>scripts/mutations/world.txt
scripts/mutate.sh --check | grep -q 'FAILED mutation "planted": its text must be in src/world/move.c exactly once'
check "a text that is nowhere" $?
sed -i 's/from: no such text/from: double/; s/^tests: world$/tests: world/' scripts/mutations/world.txt
scripts/mutate.sh --check >/dev/null
[ $? -eq 1 ]
check "a text that is there often" $?
sed -i 's/from: double$/from: #define ROOM_LEAST 0.04/; /^name: planted/,$s/tests: world/tests: none/' scripts/mutations/world.txt
scripts/mutate.sh --check | grep -q 'no such group'
check "a group that is none" $?

echo "$passed passed, $failed failed, 0 skipped"
[ $failed -eq 0 ]
