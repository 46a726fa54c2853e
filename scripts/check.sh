#!/bin/sh
# check.sh [check | rest]: what must hold before a change lands, in two parts.
# check: floors, format and shell scripts; then the optimised build, warnings as errors, with all tests but those that take minutes.
# rest: these tests, which build for themselves; clang with ASan and UBSan; gcc with these, on the floors whose code becomes vector kernels or is called by them; the same
# bits from musl, 64-bit ARM and WebAssembly; the page; the binary interface; static analysis; the manual. It stands on the build that check makes.
# Goes on after a failure; the last line sums all, exit 1 if any failed. Each line says how many minutes are left.
set -u
# shellcheck source=scripts/help.sh
. "$(dirname "$0")/help.sh"
cd "$(dirname "$0")/.." || exit 1
part=${1:-check}
jobs=${JOBS:-2}
mkdir -p build
log=build/check.log
passed=0 failed=0 skipped=0
export UBSAN_OPTIONS=print_stacktrace=1

# The seconds that the steps of a part take on two cores together; how long they take here scales what is left of them.
case $part in
check) planned=620 ;;
rest) planned=1820 ;;
*) echo "check: there is no part $part; parts are check and rest" >&2 && exit 2 ;;
esac
begin=$(date +%s)
finished=0

# How many minutes are left, after the first steps have shown how fast this machine is.
print_left() {
    elapsed=$(($(date +%s) - begin))
    if [ $finished -lt 60 ] || [ $finished -ge "$planned" ]; then
        echo
    else
        echo "about $(((planned - finished) * elapsed / finished / 60 + 1)) min left"
    fi
}

# step SECONDS NAME COMMAND...: counts one check; shows what the command said only where it fails.
step() {
    seconds=$1 name=$2
    shift 2
    printf '%-40s' "$name"
    start=$(date +%s)
    if "$@" >$log 2>&1; then
        passed=$((passed + 1)) code=0 word=ok
    else
        failed=$((failed + 1)) code=1 word=FAILED
    fi
    finished=$((finished + seconds))
    printf '%-8s%4s s   %s\n' $word $(($(date +%s) - start)) "$(print_left)"
    [ $code -eq 0 ] || tail -n 200 $log
    return $code
}

# The tests of build/$1: the sums of their last lines. A test that failed without a count of failures counts as one.
count_tests() {
    awk '/^[0-9]+ passed, [0-9]+ failed/ { p = $1; f = $3; s = $5 + 0 }
         /^Test (Passed|Failed|Timeout)|^Test.*(Failed|Passed)\.$/ {
             if (!/Passed/ && f == 0) f = 1
             if (/Passed/ && p + s == 0) p = 1
             passed += p; failed += f; skipped += s; p = f = s = 0
         }
         END { print passed + 0, failed + 0, skipped + 0 }' "build/$1/Testing/Temporary/LastTest.log"
}

# counted_step SECONDS BUILD NAME COMMAND...: a step that runs ctest in build/BUILD, and counts the tests there.
counted_step() {
    seconds=$1 build=$2 name=$3
    shift 3
    rm -f "build/$build/Testing/Temporary/LastTest.log"
    step "$seconds" "$build: $name" "$@"
    code=$?
    # shellcheck disable=SC2046 # three numbers
    set -- $(count_tests "$build")
    passed=$((passed + $1)) failed=$((failed + $2)) skipped=$((skipped + $3))
    return $code
}

# run_tests SECONDS BUILD [OPTION...]: with options of ctest.
run_tests() {
    seconds=$1 build=$2
    shift 2
    counted_step "$seconds" "$build" tests ctest --test-dir "build/$build" "$@" -j "$jobs" --output-on-failure --no-tests=error
}

configure_and_build() { cmake --preset "$1" && cmake --build "build/$1" -j "$jobs"; }

# The floors with vector kernels, and those that call these.
kernel_floors="base linear simd polytope ellipsoid shape query smooth motion paper manifold body body/manifolds compound solid world"

run_check() {
    for lint in floors format shell; do step 10 "lint: $lint" scripts/lint.sh $lint; done
    step 270 "release: build" configure_and_build release && run_tests 320 release -LE long
}

run_rest() {
    step 10 "release: build" configure_and_build release && run_tests 260 release -L long
    step 300 "check: build" configure_and_build check && run_tests 500 check -LE long
    # shellcheck disable=SC2086 # a list of floors
    counted_step 300 check-gcc "kernels, build and tests" scripts/test-floor.sh --preset check-gcc $kernel_floors
    step 60 "ports: musl, 64-bit ARM" scripts/ports.sh quick
    step 180 "wasm and the page, with their tests" scripts/page.sh --check
    step 10 "abi: the shared libraries" scripts/abi.sh
    step 180 "lint: tidy" scripts/lint.sh tidy
    step 20 "docs" scripts/docs.sh
}

"run_$part"
echo "$passed passed, $failed failed, $skipped skipped"
[ $failed -eq 0 ]
