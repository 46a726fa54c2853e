#!/bin/sh
# test-floor.sh [--preset PRESET] FLOOR...: builds and runs the tests of these floors (tests/floors.txt) in build/release, or as another of
# CMakePresets.json; those that take minutes are left to make check. A floor has its tests in about 20 seconds after a change of one of its files.
set -eu
options=--preset
# shellcheck source=scripts/help.sh
. "$(dirname "$0")/help.sh"
cd "$(dirname "$0")/.."
preset=release
if [ "${1:-}" = --preset ]; then
    preset=${2:-}
    shift 2
fi
build=build/$preset
[ $# -gt 0 ] || set -- ""
for floor in "$@"; do
    if ! grep -q "^$floor " tests/floors.txt; then
        echo "test: FLOOR is one of:$(awk '!/^#/ { printf " %s", $1 }' tests/floors.txt)" >&2
        exit 2
    fi
    [ "$floor" != house ] || { echo "test: the house's tests are run by make check and make check-all" >&2 && exit 2; }
done
# Its lines of tests/floors.txt as one expression.
pattern="($(awk -v floors=" $* " 'index(floors, " " $1 " ") { printf "%s%s", or, $2; or = "|" }' tests/floors.txt))"
mkdir -p "$build"
cmake --preset "$preset" >/dev/null
# A test NAME is a program of the same name; scripts and Python's tests need the tool and the package.
programs=$(cmake --build "$build" --target help | sed -n 's/^\.\.\. //p' | grep -E "^$pattern\$" || true)
for floor in "$@"; do
    case $floor in
    cli) programs="$programs ovoid_cli $(cmake --build "$build" --target help | sed -n 's/^\.\.\. \(ovoid_floating\)$/\1/p')" ;;
    python) programs="$programs ovoid_python" ;;
    esac
done
# shellcheck disable=SC2086 # a list of targets
cmake --build "$build" -j"${JOBS:-2}" --target $programs >"$build/said.log" 2>&1 || { tail -n 30 "$build/said.log" && exit 1; }
# By their names: ctest allows few parentheses in an expression.
tests=$(ctest --test-dir "$build" -N | sed -n 's/^ *Test *#[0-9]*: //p' | grep -E "^$pattern\$" | tr '\n' '|')
ctest --test-dir "$build" -R "^(${tests%|})\$" -LE long -j"${JOBS:-2}" --output-on-failure --no-tests=error
