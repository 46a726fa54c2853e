#!/bin/sh
# The list of mutations fits the sources, and docs/mutation.md the results. Truth: each one's text is in its file exactly
# once and is changed, it says what it breaks, and its group has tests; each such test is there. What is planted, a text
# that is nowhere, a result without its mutation, a survivor without a reason, is found.
set -u
: "${OVOID_SOURCE_DIR:=$(cd "$(dirname "$0")/../.." && pwd)}" "${OVOID_BUILD_DIR:=$OVOID_SOURCE_DIR/build/release}"
work=$OVOID_BUILD_DIR/test_mutations
rm -rf "$work" && mkdir -p "$work" || exit 1
# A copy, since a listing is written beside the sources.
cp -R "$OVOID_SOURCE_DIR/scripts" "$OVOID_SOURCE_DIR/src" "$OVOID_SOURCE_DIR/python" "$OVOID_SOURCE_DIR/cli" "$OVOID_SOURCE_DIR/include" "$OVOID_SOURCE_DIR/adapters" "$OVOID_SOURCE_DIR/docs" "$work" && cd "$work" || exit 1
export OVOID_SOURCE_DIR
passed=0 failed=0
check() { # NAME RESULT
    if [ "$2" -eq 0 ]; then passed=$((passed + 1)); else failed=$((failed + 1)) && echo "FAILED $1"; fi
}

scripts/mutate.sh --check >said
check "every mutation applies: $(grep FAILED said | head -n 5)" $?
passed=$((passed + $(sed -n 's/^\([0-9]*\) passed.*/\1/p' said)))
scripts/mutate.sh --list >listed
find "$OVOID_SOURCE_DIR/tests" | sed 's|.*/||; s/\.c$//; s/\.cpp$//' >sources
for test in $(sed 's/^[^:]*://' listed | tr ' ' '\n' | sed 's/:.*//' | sort -u); do
    # A test of Python, test_python_NAME, is python/tests/test_NAME.py, one of an engine adapters/test_NAME.cpp; those of the tool are scripts.
    grep -qFx -- "$test" sources || [ -f "$OVOID_SOURCE_DIR/python/tests/$(echo "$test.py" | sed 's/_python//')" ] ||
        [ -f "$OVOID_SOURCE_DIR/tests/adapters/$(echo "$test.cpp" | sed 's/_adapter//')" ]
    check "there is no $test" $?
done
check "groups without mutations: $(grep ', 0:' listed)" "$(grep -c ', 0:' listed)"
# The page says what the results say.
tables() { OVOID_SOURCE_DIR=$work scripts/mutations.py >said; }
tables
check "the tables of docs/mutation.md: $(head -n 5 said)" $?
planted() { # NAME SENTENCE: what was planted is found; the results are as they were then.
    tables
    [ $? -eq 1 ] && grep -q -- "$2" said
    check "$1" $?
    cp "$OVOID_SOURCE_DIR"/scripts/mutations/* scripts/mutations
}
sed -i '/^sphere radius	/s/test_measures/test_world/' scripts/mutations/results.tsv
planted "another result" 'is not what the results say'
sed -i '/^sphere radius	/s/test_measures/SURVIVED/' scripts/mutations/results.tsv
planted "a survivor without a reason" '"sphere radius" survived: say why'
sed -i 's/^sphere radius	/spheres radius	/' scripts/mutations/results.tsv
planted "a result without its mutation" 'there is no fault "spheres radius" any more'
sed -i '/^survives: it has no effect. A zero/d' scripts/mutations/query.txt
planted "a reason that is gone" '"direction of nothing" survived'
sed -i '/^sign	/d' scripts/mutations/results.tsv
planted "a reason without a result" '"sign" has a line "survives:"'
sed -i 's/<!-- mutations tools -->/<!-- mutations tool -->/' docs/mutation.md
planted "a group without its table" 'has the group tools 0 times'
# Planted: a text that is nowhere, one that is there twice, a group that is none. The other mutations were checked above.
find scripts/mutations -name '*.txt' ! -name world.txt -delete
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
