# shellcheck shell=sh
# Sourced by tests that are scripts; they print $passed and $failed.
# shellcheck disable=SC2034 # read by those tests
passed=0 failed=0

# check NAME COMMAND...: one check; what the command said, the end of it, is shown where it fails.
check() {
    check_name=$1
    shift
    if output=$("$@" 2>&1); then output=; else output="exit code $?
$output"; fi
    check_empty "$check_name" "$output"
}

# check_empty NAME WRONG: one check; WRONG, what was found to be so, is empty where it holds.
check_empty() {
    if [ -z "$2" ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        printf 'FAILED %s: %s\n' "$1" "$2" | tail -n 60
    fi
}
fails() { ! "$@" >/dev/null 2>&1; }
