#!/bin/sh
# Completion in bash: what it offers for a line of words. Truth: each list was written down from the manual.
set -u
if [ ! -x "$OVOID_TOOL" ] || ! command -v bash >/dev/null; then
    echo "skipped: the tool or bash is absent"
    echo "0 passed, 0 failed, 1 skipped"
    exit 0
fi
work=$OVOID_BUILD_DIR/test_completion
rm -rf "$work" && mkdir -p "$work/folder" && cd "$work" || exit 1
: >a.stl && : >b.stl
passed=0 failed=0

# expect WANTED WORD...: the words after the tool's name; the last is being typed.
expect() {
    wanted=$(printf '%s\n' "$1" | tr ' ' '\n' | sort | tr '\n' ' ')
    shift
    got=$(bash -c '
        . "$1"; shift
        COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
        _ovoid
        printf "%s\n" "${COMPREPLY[@]}" | sort | tr "\n" " "' bash "$OVOID_SOURCE_DIR/cli/ovoid.bash" "$OVOID_TOOL" "$@" 2>&1)
    if [ "$got" = "$wanted" ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        printf 'FAILED ovoid %s: offered "%s", not "%s"\n' "$*" "$got" "$wanted"
    fi
}

expect 'fit info decompose distance batch check run pack merge verify view paper robot help --help --version' ''
expect 'verify view' v
expect '--help' --h
expect 'distance' help di
expect '--check --cover --cells --csv' decompose l.obj --c
expect '--margin' check --m
expect '--pose-a --pose-b --parts --proofs' distance a.stl --p
expect '--margin --motion' run --m
expect 'collide within distance' run --query ''
expect 'collide within distance' batch --query ''
expect 'collide' batch --query = c
expect 'a.stl b.stl folder/' fit ''
expect 'b.stl' distance a.stl b
expect 'a.stl' batch --shapes a
expect '' check --margin ''
expect 'a.stl b.stl folder/' check --json ''
expect 'info check path plan matrix spheres --help' robot ''
expect 'rrtconnect biest' robot plan --planner ''
expect '--samples --states --state --scene --srdf --scale --seed' robot spheres --s
expect 'a.stl b.stl folder/' robot spheres --given ''
expect 'check' robot c
expect '--proofs --plot --padding --package --parts' robot path --p
expect '--states --state --scene --shard --srdf --scale' robot check --s
expect 'a.stl b.stl folder/' robot check --states ''
expect 'info' robot i
expect '--package --parts' robot info --pa
expect '' robot info --package ''
expect 'a.stl b.stl folder/' robot info --srdf ''
expect '' nothing --x
echo "$passed passed, $failed failed, 0 skipped"
[ $failed -eq 0 ]
