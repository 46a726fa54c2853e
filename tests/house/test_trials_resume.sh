#!/bin/sh
# The soak and the long run stop and go on: two runs with a state file make the very counts of one run of the same length.
# Truth: each round and each block is a function of the seed and its number. Times are left out of the comparison.
set -u
# shellcheck source=tests/common/steps.sh
. "$(dirname "$0")/../common/steps.sh"
bin=$OVOID_BUILD_DIR/tests
if [ ! -x "$bin/long_run" ]; then
    echo "0 passed, 0 failed, 1 skipped: the judge is absent"
    exit 0
fi
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT

quiet() { "$@" >>"$work/log" 2>&1; }
# The table of a soak: everything but the progress lines.
table() { grep -v ' min, seed' "$1" | grep -v 'going on' | grep -v 'passed'; }

soak() { "$bin/test_query_trials" --seed 3 "$@"; }
check "soak, first half" quiet soak --rounds 1 --state "$work/soak"
soak --rounds 2 --state "$work/soak" >"$work/halves"
check "soak, second half" [ $? -eq 0 ]
soak --rounds 2 >"$work/whole"
check "soak, whole" [ $? -eq 0 ]
table "$work/halves" >"$work/a"
table "$work/whole" >"$work/b"
check "soak: the same counts" cmp "$work/a" "$work/b"
check "soak: a failure list only where something failed" [ ! -e "$work/soak.failures" ]
echo "not a state" >"$work/bad"
soak --rounds 2 --state "$work/bad" >>"$work/log" 2>&1
check "soak: a file that is no state is refused" [ $? -eq 2 ]

# The ninth number of a family's line is a time.
long() { "$bin/long_run" --seed 3 "$@"; }
check "long run, first half" quiet long --queries 2e5 --state "$work/long"
check "long run, second half" quiet long --queries 4e5 --state "$work/long"
check "long run, two threads" quiet long --queries 4e5 --threads 2 --state "$work/threads"
for state in long threads; do awk '/^ [0-9]/ { $9 = "-" } { print }' "$work/$state" >"$work/$state.counts"; done
check "long run: the same counts" cmp "$work/long.counts" "$work/threads.counts"
long --queries 4e5 --state "$work/bad" >>"$work/log" 2>&1
check "long run: a file that is no state is refused" [ $? -eq 2 ]

[ $failed -eq 0 ] || cat "$work/log"
echo "$passed passed, $failed failed, 0 skipped"
[ $failed -eq 0 ]
