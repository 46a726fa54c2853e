#!/bin/sh
# ports.sh [quick | PORT]: the same bits elsewhere? Builds the core for other C libraries, processors and systems with the tools of
# cmake/ports, runs tests/core/query/test_query_bits.c and test_motion_bits.c there and compares what they print with this
# machine's release build; then other tests of the core. A port whose tools are absent, or that nothing here can run, is
# skipped with a line. quick: musl and 64-bit ARM only, the first pairs only, for make check-all; PORT: that one. A line for each port; exit 1
# where one differs or a test fails. docs/ports.md says what was run where.
set -u
# shellcheck source=scripts/help.sh
. "$(dirname "$0")/help.sh"
cd "$(dirname "$0")/.." || exit 1
folder=$PWD/build/ports
mkdir -p "$folder"
passed=0 failed=0 skipped=0
ports="musl aarch64 i686 windows wasm32" quick=
case ${1:-} in
'') ;;
quick) ports="musl aarch64" quick=quick ;;
*) ports=$1 ;;
esac
bits="test_query_bits test_motion_bits"
export WINEPREFIX="$folder/wine" WINEDEBUG=-all

# The other tests of a port: all of these, less what its tools cannot do or would take minutes for.
tests="test_smooth_bits test_ellipsoid_bits test_refusals test_environment test_query test_compound test_compound_impact
    test_impact test_world test_world_find test_world_threads"
tests_of() {
    case $quick$1 in
    quick*) echo test_smooth_bits test_refusals ;;
    musl) echo "$tests" test_query_threads test_query_stack ;;
    aarch64) echo test_smooth_bits test_ellipsoid_bits test_refusals test_environment test_query test_world_threads ;;
    # no floating-point environment to change, and no threads, which test_world and test_world_threads start
    wasm32) echo "$tests" | tr -s ' ' '\n' | grep -v -e 'test_world$' -e test_world_threads -e test_environment ;;
    *) echo "$tests" ;;
    esac
}

# What a port needs: its compiler, then what runs its programs.
tools_of() {
    case $1 in
    musl) echo musl-gcc env ;;
    aarch64) echo aarch64-linux-gnu-gcc qemu-aarch64 ;;
    i686) echo i686-linux-gnu-gcc env ;;
    windows) echo x86_64-w64-mingw32-gcc wine64 ;;
    wasm32) echo wasm-ld node ;;
    esac
}
find_tool() { PATH=$PATH:/usr/lib/wine command -v "$1"; }

# run PORT PROGRAM ARGUMENTS...
run() {
    port=$1 program=$folder/$1/tests/$2
    shift 2
    case $port in
    aarch64) qemu-aarch64 -L /usr/aarch64-linux-gnu "$program" "$@" ;;
    windows) "$(find_tool wine64)" "$program.exe" "$@" 2>/dev/null | tr -d '\r' ;;
    wasm32) node --no-warnings --experimental-wasi-unstable-preview1 scripts/wasm-run.mjs "$program" "$@" ;;
    *) "$program" "$@" ;;
    esac
}

# What the programs print of their bits; quick: of the first pairs.
print_bits() {
    if [ "$quick" = quick ]; then
        "$@" test_query_bits --print --pairs 25
        "$@" test_motion_bits --print --cases 20
    else
        "$@" test_query_bits --print
        "$@" test_motion_bits --print
    fi | grep -v ' passed, '
}
run_host() {
    program=build/release/tests/$1
    shift
    "$program" "$@"
}

build() {
    # shellcheck disable=SC2046,SC2086 # lists of targets
    cmake -S . -B "$folder/$1" -DCMAKE_TOOLCHAIN_FILE="$PWD/cmake/ports/$1.cmake" -DCMAKE_BUILD_TYPE=Release -DOVOID_IO=OFF \
        -DOVOID_WERROR=ON && cmake --build "$folder/$1" -j2 --target ovoid_static $bits $(tests_of "$1")
}

# end PORT WORD TEXT: its line.
end() {
    case $2 in
    ok) passed=$((passed + 1)) ;;
    skipped) skipped=$((skipped + 1)) ;;
    *) failed=$((failed + 1)) ;;
    esac
    printf '%-9s %-8s %s\n' "$1" "$2" "$3"
}

check() {
    port=$1
    # shellcheck disable=SC2046 # two words
    set -- $(tools_of "$port")
    if ! find_tool "$1" >/dev/null; then
        end "$port" skipped "$1 is not here"
        return
    fi
    if ! build "$port" >"$folder/$port.log" 2>&1; then
        end "$port" FAILED "it does not build: build/ports/$port.log"
        tail -n 5 "$folder/$port.log"
        return
    fi
    case $port-$(uname -m) in
    musl-x86_64 | i686-x86_64 | aarch64-* | windows-* | wasm32-*) runner=$(find_tool "$2") ;;
    *) runner= ;;
    esac
    if [ -z "$runner" ]; then
        end "$port" skipped "built; nothing here runs it"
        return
    fi
    print_bits run "$port" >"$folder/$port.txt"
    if ! cmp -s "$folder/host.txt" "$folder/$port.txt"; then
        end "$port" FAILED "other bits"
        diff "$folder/host.txt" "$folder/$port.txt"
        return
    fi
    wrong=
    for name in $(tests_of "$port"); do
        run "$port" "$name" >"$folder/$port.out" 2>&1
        tail -n 1 "$folder/$port.out" | grep -q '[0-9] passed, 0 failed' || wrong="$wrong $name"
    done
    text="$(sed -n 's/^all *//p' "$folder/$port.txt"), $(tests_of "$port" | wc -w) more tests"
    if [ -n "$wrong" ]; then end "$port" FAILED "$text, not:$wrong"; else end "$port" ok "$text"; fi
}

# shellcheck disable=SC2086 # a list of targets
cmake --preset release >/dev/null && cmake --build build/release -j2 --target $bits >/dev/null || exit 1
print_bits run_host >"$folder/host.txt"
printf '%-9s %-8s %s\n' host first "$(sed -n 's/^all *//p' "$folder/host.txt")"
for port in $ports; do check "$port"; done
echo "$passed passed, $failed failed, $skipped skipped"
[ $failed -eq 0 ]
