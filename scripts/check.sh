#!/bin/sh
# check.sh: all that must hold before a change lands. Lint; then three builds, warnings as errors, each with its tests:
# gcc optimised, clang with ASan and UBSan, and gcc with these, which does not run the tool's transcripts again; and the
# same bits from musl, 64-bit ARM and WebAssembly. Goes on after a failure; the last line sums all, exit 1 if any failed.
set -u
cd "$(dirname "$0")/.." || exit 1
jobs=${JOBS:-2}
mkdir -p build
log=build/check.log
passed=0 failed=0 skipped=0
export UBSAN_OPTIONS=print_stacktrace=1

# step NAME COMMAND...: counts one check; shows what the command said only where it fails.
step() {
    name=$1
    shift
    printf '%-40s' "$name"
    start=$(date +%s)
    if "$@" >$log 2>&1; then
        passed=$((passed + 1)) code=0 word=ok
    else
        failed=$((failed + 1)) code=1 word=FAILED
    fi
    printf '%-8s%4s s\n' $word $(($(date +%s) - start))
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

# run_tests BUILD [OPTION...]: with options of ctest.
run_tests() {
    build=$1
    shift
    rm -f "build/$build/Testing/Temporary/LastTest.log"
    step "$build: tests" ctest --test-dir "build/$build" "$@" -j "$jobs" --output-on-failure --no-tests=error
    code=$?
    # shellcheck disable=SC2046 # three numbers
    set -- $(count_tests "$build")
    passed=$((passed + $1)) failed=$((failed + $2)) skipped=$((skipped + $3))
    return $code
}

configure_and_build() { cmake --preset "$1" && cmake --build "build/$1" -j "$jobs"; }

for lint in floors format shell; do step "lint: $lint" scripts/lint.sh $lint; done
for preset in release check; do
    step "$preset: build" configure_and_build $preset && run_tests $preset
done
step "check-gcc: build" configure_and_build check-gcc && run_tests check-gcc -E '^test_(cli|demo|docs|mutations|page)'
step "ports: musl, 64-bit ARM" scripts/ports.sh quick
step "wasm and the page, with their tests" scripts/page.sh --check
step "lint: tidy" scripts/lint.sh tidy
step "docs" scripts/docs.sh

echo "$passed passed, $failed failed, $skipped skipped"
[ $failed -eq 0 ]
