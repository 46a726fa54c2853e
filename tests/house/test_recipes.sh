#!/bin/sh
# The recipes of packaging/, as far as they can be tried without vcpkg and Conan: the port's manifest is read and its portfile
# run with stand-ins for vcpkg's functions, down to a real configuration; Conan's recipes compile, the options they set
# are the project's, the test program links and runs. Truth: the version in the header; CMake, which names options that
# it does not know.
set -u
# shellcheck source=tests/common/steps.sh
. "$(dirname "$0")/../common/steps.sh"
skipped=0
folder=$OVOID_BUILD_DIR/test_recipes
here=$OVOID_SOURCE_DIR/tests/house/recipes
port=$OVOID_SOURCE_DIR/packaging/vcpkg/ovoid
conan=$OVOID_SOURCE_DIR/packaging/conan
export OVOID_CC="${OVOID_CC:-cc}"

define() { sed -n "s/^#define OVOID_VERSION_$1 //p" "$OVOID_SOURCE_DIR/include/ovoid/base.h"; }
version=$(define MAJOR).$(define MINOR).$(define PATCH)
rm -rf "$folder"
mkdir -p "$folder"

# vcpkg's manifest, and one of another version.
check_manifest() { cmake -DFILE="$1" -DVERSION="$version" -P "$here/manifest.cmake"; }
check manifest check_manifest "$port/vcpkg.json"
mkdir -p "$folder/ovoid"
sed 's/"version": "/&9/' "$port/vcpkg.json" >"$folder/ovoid/vcpkg.json"
check "a manifest of another version is noticed" fails check_manifest "$folder/ovoid/vcpkg.json"

# run_port LINKAGE FEATURES [PORT]: what the options made of the project is its last line.
run_port() { cmake -DPORT="${3:-$port}" -DWORK="$folder/port" -DLINKAGE="$1" -DFEATURES="$2" -P "$here/port.cmake" | tail -n 1; }
expect_port() { [ "$(run_port "$1" "$2")" = "-- made: $3" ]; }
check "port, static" expect_port static core "shared 0, io OFF, tool OFF, tests OFF"
check "port, dynamic" expect_port dynamic core "shared 1, io OFF, tool OFF, tests OFF"
check "port, all features" expect_port static "core;io;tool" "shared 0, io ON, tool ON, tests OFF"
# It can fail: an option that the project does not know.
mkdir -p "$folder/altered/packaging/vcpkg"
cp -r "$port" "$folder/altered/packaging/vcpkg/ovoid"
sed -i "s|OVOID_TESTS|OVOID_TEST|; s|\"\${CURRENT_PORT_DIR}/../../..\"|\"$OVOID_SOURCE_DIR\"|" \
    "$folder/altered/packaging/vcpkg/ovoid/portfile.cmake"
alter() { cmake -DPORT="$folder/altered/packaging/vcpkg/ovoid" -DWORK="$folder/port" -DLINKAGE=static -DFEATURES=core -P "$here/port.cmake"; }
check "an option that is none is noticed" fails alter

# Conan's recipes: Python that compiles, options that are the project's.
if command -v python3 >/dev/null; then
    for file in "$conan/conanfile.py" "$conan/test_package/conanfile.py"; do
        check "$file compiles" python3 -c 'import sys; compile(open(sys.argv[1]).read(), sys.argv[1], "exec")' "$file"
    done
else
    echo "skipped: Conan's recipes are not compiled, python3 is not here"
    skipped=1
fi
is_option() { grep -qE "^(option|set)\($1 " "$OVOID_SOURCE_DIR/CMakeLists.txt"; }
for option in $(grep -oE '"OVOID_[A-Z_]+"' "$conan/conanfile.py" | tr -d '"'); do check "$option" is_option "$option"; done
check "an option that is none" fails is_option OVOID_TEST
# shellcheck disable=SC2016 # \n is sed's
check "the version that the recipe reads" [ "$(sed -nE 's/^#define OVOID_VERSION_(MAJOR|MINOR|PATCH) ([0-9]+)$/\2/p' \
    "$OVOID_SOURCE_DIR/include/ovoid/base.h" | paste -sd.)" = "$version" ]
# What it takes along is there.
for pattern in $(grep -oE '"[a-z]+/\*"' "$conan/conanfile.py" | tr -d '"*'); do check "folder $pattern" [ -d "$OVOID_SOURCE_DIR/$pattern" ]; done

# Its test program, with the package of this build.
check install cmake --install "$OVOID_BUILD_DIR" --prefix "$folder/prefix"
check "test program: configure" cmake -S "$conan/test_package" -B "$folder/program" -DCMAKE_C_COMPILER="$OVOID_CC" \
    -DCMAKE_PREFIX_PATH="$folder/prefix"
check "test program: build" cmake --build "$folder/program"
check "test program: run" "$folder/program/test_package"
echo "$passed passed, $failed failed, $skipped skipped"
[ "$failed" -eq 0 ]
