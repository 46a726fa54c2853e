#!/bin/sh
# Every program and script of the tree that takes options: --help prints what there is and starts nothing, an option that is not
# known is refused. Truth: what a user who tries both expects; a script that began its work would take longer than is given.
set -u
cd "$OVOID_SOURCE_DIR" || exit 1
passed=0 failed=0 skipped=0

# expect CODE STREAM COMMAND...: the exit code, and words on that stream.
expect() {
    wanted=$1 stream=$2
    shift 2
    timeout 20 "$@" </dev/null >"$work/out" 2>"$work/err"
    code=$?
    if [ $code -eq "$wanted" ] && [ -s "$work/$stream" ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED $*: exit $code, not $wanted, or no word: $(head -c 200 "$work/out" "$work/err")"
    fi
}
work=$OVOID_BUILD_DIR/test_options
mkdir -p "$work"

for script in scripts/*.sh bench/web/bench.sh; do
    if [ "$script" = scripts/help.sh ]; then continue; fi
    expect 0 out sh "$script" --help
    expect 2 err sh "$script" --nonsense
done
# Tests and benches with options are those whose sources name the command line.
# shellcheck disable=SC2013 # paths without blanks
for source in $(grep -lE 'main\(int [a-z]+, char \*\*' tests/*/*.c tests/*/*/*.c bench/bench.c bench/peers/solids.cpp bench/planner/planner.cpp bench/web/native.c); do
    name=$(basename "$source" | sed 's/\.[a-z]*$//; s/^solids$/bench_solids/; s/^planner$/bench_planner/')
    if [ "$name" = native ]; then name=bench_web; fi
    program=
    for folder in tests bench; do if [ -x "$OVOID_BUILD_DIR/$folder/$name" ]; then program=$OVOID_BUILD_DIR/$folder/$name; fi; done
    if [ -z "$program" ]; then
        skipped=$((skipped + 1))
        echo "skipped: $name is not built"
        continue
    fi
    expect 0 out "$program" --help
    expect 2 err "$program" --nonsense 1
    expect 2 err "$program" --nonsense
done
echo "$passed passed, $failed failed, $skipped skipped"
[ $failed -eq 0 ]
