#!/bin/sh
# coverage.sh [--write]: which share of the libraries' and the tool's lines and branches the tests run, by folder: the build "coverage"
# (gcc, --coverage), all tests but those that take minutes, and gcovr of Debian. A branch is one way out of a condition. Lines
# that only a failed assertion or an impossible case would reach count as missed. --write puts the table into docs/coverage.md.
# Half an hour on two cores. build/coverage/html has each line.
set -eu
# shellcheck disable=SC2034 # help.sh reads it
options=--write
# shellcheck source=scripts/help.sh
. "$(dirname "$0")/help.sh"
cd "$(dirname "$0")/.."
command -v gcovr >/dev/null || { echo "coverage: gcovr is missing; it is in Debian's package gcovr" >&2 && exit 1; }
jobs=${JOBS:-$(nproc)}
cmake --preset coverage >/dev/null
cmake --build build/coverage -j"$jobs" >build/coverage.log || { tail -20 build/coverage.log && exit 1; }
find build/coverage -name '*.gcda' -delete
ctest --test-dir build/coverage -LE long -j "$jobs" --output-on-failure >build/coverage-tests.log 2>&1 ||
    { sed -n '/tests failed/,$p' build/coverage-tests.log && echo "coverage: these tests failed; what they would have run is missing"; }
mkdir -p build/coverage/html
gcovr --root . --object-directory build/coverage --filter 'src/' --filter 'cli/' --filter 'python/src/' --exclude-unreachable-branches \
    --gcov-ignore-parse-errors --json-summary build/coverage/summary.json --html-details build/coverage/html/index.html -j "$jobs" build/coverage
python3 scripts/coverage.py build/coverage/summary.json "$@"
