# shellcheck shell=sh
# Sourced by the tests that alter what the tool wrote: `ovoid verify` must refuse it, and accept what was not altered. The tests
# print $passed and $failed.
# shellcheck disable=SC2034 # read by those tests
passed=0 failed=0

# expect CODE NAME FILE [OPTION...]: what verify must say of a file.
expect() {
    wanted=$1 name=$2
    shift 2
    "$OVOID_TOOL" verify "$@" >out 2>&1
    code=$?
    if [ $code -eq "$wanted" ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        printf 'FAILED %s: exit %s, not %s\n' "$name" "$code" "$wanted"
        cat out
    fi
}

# alter CODE NAME PROGRAM FILE [OPTION...]: the file after a sed program, which must have changed something.
alter() {
    wanted=$1 name=$2 program=$3 file=$4
    shift 4
    sed -E "$program" "$file" >altered.jsonl
    if cmp -s "$file" altered.jsonl; then
        failed=$((failed + 1))
        printf 'FAILED %s: nothing was changed\n' "$name"
    else
        expect "$wanted" "$name" altered.jsonl "$@"
    fi
}
