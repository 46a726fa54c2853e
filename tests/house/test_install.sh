#!/bin/sh
# The installed copy as its users meet it: an outside CMake project, pkg-config (shared and static), the names that the
# libraries export and the soname. Truth: each either builds, runs and exits 0 or does not.
set -u
# shellcheck source=tests/common/steps.sh
. "$(dirname "$0")/../common/steps.sh"
folder=$OVOID_BUILD_DIR/test_install
prefix=$folder/prefix
cc=${OVOID_CC:-cc}

rm -rf "$folder"
mkdir -p "$folder"
check install cmake --install "$OVOID_BUILD_DIR" --prefix "$prefix"
libraries=$(dirname "$(find "$prefix" -name libovoid.a)")
export LD_LIBRARY_PATH="$libraries" PKG_CONFIG_PATH="$libraries/pkgconfig"

# The CMake package, by an outside project.
check configure cmake -S "$OVOID_SOURCE_DIR/tests/house/outside" -B "$folder/outside" -DCMAKE_C_COMPILER="$cc" \
    -DCMAKE_PREFIX_PATH="$prefix"
check build cmake --build "$folder/outside"
for program in "$folder"/outside/outside_ovoid*; do check "run $program" "$program"; done

# pkg-config: shared, then the archives with the libraries that --static names.
compile() {
    flags=$(pkg-config --cflags --libs "$2")
    if [ "$3" = static ]; then flags=$(pkg-config --static --cflags --libs "$2" | sed 's/-l\(ovoid[a-z_]*\)/-l:lib\1.a/g'); fi
    # shellcheck disable=SC2086 # flags
    "$cc" -o "$folder/$2_$3" "$OVOID_SOURCE_DIR/tests/house/outside/$1" $flags && "$folder/$2_$3"
}
for kind in shared static; do
    check "pkg-config $kind" compile outside.c ovoid $kind
    if [ -f "$libraries/pkgconfig/ovoid_robot.pc" ]; then check "pkg-config robot $kind" compile outside_robot.c ovoid_robot $kind; fi
    if [ -f "$libraries/pkgconfig/ovoid_io.pc" ]; then check "pkg-config io $kind" compile outside_io.c ovoid_io $kind; fi
done

# The C++ headers, as installed, by the example.
if command -v "${CXX:-c++}" >/dev/null; then
    # shellcheck disable=SC2046 # flags
    check "C++ example" "${CXX:-c++}" -std=c++17 -o "$folder/hello" "$OVOID_SOURCE_DIR/examples/hello.cpp" \
        $(pkg-config --cflags --libs ovoid)
    check "run the C++ example" "$folder/hello"
fi

# Every exported name begins with ovoid_, every function that a header declares is exported, the soname is versioned.
# (_init and _fini are musl's, in every library.)
no_foreign_name() { ! nm -D --defined-only "$1" | awk '{ print $3 }' | grep -vE '^(ovoid_|_init$|_fini$)'; }
all_declared() {
    nm -D --defined-only "$libraries"/lib*.so | awk '{ print $3 }' | sort -u >"$folder/exported"
    # shellcheck disable=SC2086 # a list of headers
    cat $1 | tr '\n' ' ' | grep -oE 'OVOID_API [^;{(]*[ *]ovoid_[a-z0-9_]+\(' | grep -oE 'ovoid_[a-z0-9_]+\($' | tr -d '(' |
        sort -u >"$folder/declared"
    [ -s "$folder/declared" ] && ! comm -23 "$folder/declared" "$folder/exported" | grep .
}
for library in "$libraries"/lib*.so; do
    check "names of $library" no_foreign_name "$library"
    check "soname of $library" sh -c "objdump -p '$library' | grep -q 'SONAME.*\.so\.[0-9]'"
done
headers=$(ls "$prefix"/include/ovoid/*.h)
[ -f "$libraries/libovoid_io.so" ] || headers=$(echo "$headers" | grep -v '/io\.h$')
[ -f "$libraries/libovoid_robot.so" ] || headers=$(echo "$headers" | grep -v '/robot[a-z_]*\.h$')
check declared all_declared "$headers"

# Where the tool was built it runs from its new place, with its manual.
if [ -x "$prefix/bin/ovoid" ]; then
    check tool "$prefix/bin/ovoid" --version
    check manual test -s "$prefix/share/man/man1/ovoid.1"
fi
echo "$passed passed, $failed failed, 0 skipped"
[ "$failed" -eq 0 ]
