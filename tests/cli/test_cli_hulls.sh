#!/bin/sh
# Real game hulls in pairs near contact, through the tool: `ovoid batch` answers, `ovoid verify` checks every proof.
# Truth: exact arithmetic, where the judge is built in. OVOID_PAIRS: how many pairs (default 2000, and then only two of
# the queries). Skipped without data.
set -u
make_pairs=$OVOID_BUILD_DIR/tests/test_game_hulls
work=$OVOID_BUILD_DIR/test_cli_hulls
rm -rf "$work" && mkdir -p "$work"
[ ! -x "$make_pairs" ] || "$make_pairs" --pairs "${OVOID_PAIRS:-2000}" --export "$work" >"$work/log" 2>&1
if [ ! -x "$OVOID_TOOL" ] || [ ! -f "$work/PAIRS.csv" ]; then
    echo "skipped: the tool, the judge or the game hulls are absent"
    echo "0 passed, 0 failed, 1 skipped"
    exit 0
fi
cd "$work" || exit 1
passed=0 failed=0
if [ -n "${OVOID_PAIRS:-}" ]; then set -- collide; else set --; fi
for query in "$@" 'within --margin 0.01' distance; do
    # shellcheck disable=SC2086 # a query and its margin
    "$OVOID_TOOL" batch --shapes LIST --pairs PAIRS.csv --json --query $query -o results.jsonl 2>note
    code=$?
    "$OVOID_TOOL" verify results.jsonl --shapes LIST --pairs PAIRS.csv --query "${query%% *}" >verdict 2>&1
    holds=$?
    echo "$query: $(cat note verdict | tr '\n' ' ')"
    if [ $code -eq 1 ] && [ $holds -eq 0 ] && grep -Eq '(undecided|not proven): 0$' note; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED $query: exit codes $code and $holds"
    fi
done
echo "$passed passed, $failed failed, 0 skipped"
[ $failed -eq 0 ]
