#!/bin/sh
# ovoid within another project, by add_subdirectory and by FetchContent from a folder: the core library alone is built,
# nothing of its settings reaches the project, the project's own flags (fast mathematics) change no answer, nothing is
# installed or tested. Truth: what CMake says of its variables and targets; programs that run; answers of one build.
set -u
# shellcheck source=tests/common/steps.sh
. "$(dirname "$0")/../common/steps.sh"
folder=$OVOID_BUILD_DIR/test_embed
cc=${OVOID_CC:-cc}
echo "with $(cmake --version | head -n 1), of which 3.22 is the oldest that will do"

# logged LOG COMMAND...: the end of the log is shown where the command fails.
logged() {
    log=$folder/$1
    shift
    "$@" >"$log" 2>&1 || { tail -n 30 "$log" && return 1; }
}
# configure WAY ARGUMENT...: what CMake says goes to WAY.log.
configure() {
    way=$1
    shift
    logged "$way.log" cmake -S "$OVOID_SOURCE_DIR/tests/house/embed" -B "$folder/$way" -DOVOID_SOURCE="$OVOID_SOURCE_DIR" \
        -DFETCHCONTENT_FULLY_DISCONNECTED=ON "$@"
}
lacks() { ! grep "$1" "$2"; }
is_empty() { [ -z "$(find "$1" -type f 2>/dev/null)" ]; }

# embed WAY TARGETS ARGUMENT...: all that must hold of one project, which has these targets of ovoid's.
embed() {
    way=$1 targets=$2
    shift 2
    check "$way: configure" configure "$way" -DWAY="$way" "$@"
    check "$way: no leak" lacks '^leak: ' "$folder/$way.log"
    check "$way: the core alone" [ "$(sed -n 's/^target: ovoid_//p' "$folder/$way.log" | sort | tr '\n' ' ')" = "$targets " ]
    check "$way: nothing of other names" [ -z "$(grep '^target: ' "$folder/$way.log" | grep -v ' ovoid_')" ]
    check "$way: build" logged "$way.build.log" cmake --build "$folder/$way" -j 2
    for kind in ovoid ovoid_static; do
        check "$way: run $kind" sh -c "'$folder/$way/embed_$kind' >'$folder/$way.$kind.txt'"
        check "$way: the answers of $kind" cmp "$folder/add.ovoid.txt" "$folder/$way.$kind.txt"
    done
    cmake --install "$folder/$way" --prefix "$folder/$way.prefix" >/dev/null 2>&1
    check "$way: installs nothing" is_empty "$folder/$way.prefix"
    check "$way: tests nothing" sh -c "ctest --test-dir '$folder/$way' -N | grep -q 'Total Tests: 0'"
}

rm -rf "$folder"
mkdir -p "$folder"
embed add "flags internal objects shared static" -DCMAKE_C_COMPILER="$cc"
# The other compiler, flags of the project that must not reach what the library computes, and the static library alone.
embed fetch "flags internal objects static" -DCMAKE_C_COMPILER="$(command -v clang || echo "$cc")" \
    -DCMAKE_C_FLAGS="-O1 -ffast-math" -DOVOID_SHARED=OFF

# Where it asks for the installation it has that of the static library, which is then ovoid::ovoid.
check "installed: configure" configure fetch -DWAY=fetch -DOVOID_INSTALL=ON
check "installed: build" logged fetch.build.log cmake --build "$folder/fetch" -j 2
check "installed: install" logged fetch.install.log cmake --install "$folder/fetch" --prefix "$folder/prefix"
check "installed: outside" logged outside.log cmake -S "$OVOID_SOURCE_DIR/tests/house/outside" -B "$folder/outside" \
    -DCMAKE_C_COMPILER="$cc" -DCMAKE_PREFIX_PATH="$folder/prefix"
check "installed: build outside" logged outside.build.log cmake --build "$folder/outside"
check "installed: run outside" "$folder/outside/outside_ovoid"

# It can fail: a project that asks for the tests has them.
check "asked for: configure" configure asked -DCMAKE_C_COMPILER="$cc" -DOVOID_TESTS=ON
check "asked for: targets are seen" grep -q '^target: test_linear' "$folder/asked.log"
echo "$passed passed, $failed failed, 0 skipped"
[ "$failed" -eq 0 ]
