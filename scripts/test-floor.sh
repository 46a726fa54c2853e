#!/bin/sh
# test-floor.sh FLOOR: builds and runs the tests of one floor (tests/floors.txt) in build/release; those that take minutes are left to
# make check. A floor has its tests in about 20 seconds after a change of one of its files.
set -eu
# shellcheck source=scripts/help.sh
. "$(dirname "$0")/help.sh"
cd "$(dirname "$0")/.."
build=build/release
pattern=$(awk -v floor="${1:-}" '$1 == floor { print $2 }' tests/floors.txt)
if [ -z "$pattern" ]; then
    echo "test: FLOOR is one of:$(awk '!/^#/ { printf " %s", $1 }' tests/floors.txt)" >&2
    exit 2
fi
cmake --preset release >/dev/null
# A test NAME is a program of the same name; scripts and Python's tests need the tool and the package.
programs=$(cmake --build $build --target help | sed -n 's/^\.\.\. //p' | grep -E "^$pattern\$" || true)
case $1 in
cli) programs="$programs ovoid_cli $(cmake --build $build --target help | sed -n 's/^\.\.\. \(ovoid_floating\)$/\1/p')" ;;
python) programs="$programs ovoid_python" ;;
house) echo "test: the house's tests are run by make check and make check-all" >&2 && exit 2 ;;
esac
# shellcheck disable=SC2086 # a list of targets
cmake --build $build -j"${JOBS:-2}" --target $programs >$build/said.log 2>&1 || { tail -n 30 $build/said.log && exit 1; }
ctest --test-dir $build -R "^$pattern\$" -LE long -j"${JOBS:-2}" --output-on-failure --no-tests=error
