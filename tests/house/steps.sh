# shellcheck shell=sh
# Sourced by the tests of the house that run commands one after another; they print $passed and $failed.
# shellcheck disable=SC2034 # read by those tests
passed=0 failed=0

# check NAME COMMAND...: one check; what the command said, the end of it, is shown where it fails.
check() {
    name=$1
    shift
    if output=$("$@" 2>&1); then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        printf 'FAILED %s\n%s\n' "$name" "$output" | tail -n 60
    fi
}
fails() { ! "$@" >/dev/null 2>&1; }
