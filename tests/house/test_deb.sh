#!/bin/sh
# Debian packages: built, looked through by lintian, unpacked and configured by dpkg into a root of their own whose list of
# packages is this machine's, so that each dependency and each clash of files counts; then outside programs find the
# libraries there by pkg-config and CMake, link and run, and all is removed without a trace. Truth: lintian's and dpkg's
# exit codes; programs that run. scripts/deb-root.sh does so in a fresh Debian.
set -u
# shellcheck source=tests/common/steps.sh
. "$(dirname "$0")/../common/steps.sh"
folder=$OVOID_BUILD_DIR/test_deb
root=$folder/root
outside=$OVOID_SOURCE_DIR/tests/house/outside
cc=${OVOID_CC:-cc}
for tool in dpkg dpkg-shlibdeps lintian cpack; do
    if ! command -v $tool >/dev/null; then
        echo "skipped: $tool is not here"
        echo "0 passed, 0 failed, 1 skipped"
        exit 0
    fi
done

define() { sed -n "s/^#define OVOID_VERSION_$1 //p" "$OVOID_SOURCE_DIR/include/ovoid/base.h"; }
version=$(define MAJOR).$(define MINOR).$(define PATCH)

rm -rf "$root" "$folder"/out_*
mkdir -p "$folder"
check "build, with lintian" "$OVOID_SOURCE_DIR/scripts/deb.sh" "$folder/build"
so=$(define MAJOR).$(define MINOR)
packages="libovoid$so libovoid-dev libovoid-io$so libovoid-io-dev libovoid-robot$so libovoid-robot-dev libovoid-ompl-dev ovoid ovoid-plan"
# The headers for engines, where these are.
engines=
for engine in bullet mujoco dart; do
    dpkg-query -W "lib$engine-dev" >/dev/null 2>&1 && engines="$engines libovoid-$engine-dev"
done
dpkg-query -W libfcl-dev >/dev/null 2>&1 && engines="$engines libovoid-fcl-dev ovoid-fcl"
packages="$engines $packages"
for package in $packages; do
    file=$(find "$folder/build" -maxdepth 1 -name "${package}_$version-1_*.deb")
    check "package $package" [ -f "$file" ]
    [ "$package" = "libovoid$so" ] && core=$file
done

# The soname is what the package is named after, and the core needs the C library alone.
check "dependencies of the core" [ "$(dpkg -f "$core" Depends | sed 's/ (>= [0-9.]*)//')" = libc6 ]
check "shlibs of the core" sh -c "dpkg --ctrl-tarfile '$core' | tar -xO ./shlibs | grep -qx 'libovoid $so libovoid$so (>= $version)'"

# dpkg into a root that has this machine's list of packages.
mkdir -p "$root/var/lib/dpkg/info" "$root/var/lib/dpkg/updates" "$root/var/lib/dpkg/triggers"
touch "$root/var/lib/dpkg/triggers/File"
awk 'BEGIN { RS = ""; ORS = "\n\n" } !/^Package: (lib)?ovoid/' /var/lib/dpkg/status >"$root/var/lib/dpkg/status"
cp /var/lib/dpkg/info/*.list "$root/var/lib/dpkg/info"
in_root() { dpkg --root="$root" --force-not-root --force-script-chrootless --no-triggers "$@"; }
check "the tool's package alone" in_root -i "$(find "$folder/build" -maxdepth 1 -name 'ovoid_*.deb')"
# It can fail: the files for development without the library are not configured.
dev=$(find "$folder/build" -maxdepth 1 -name 'libovoid-dev_*.deb')
check "development without the library" fails in_root -i "$dev"
check install in_root -i "$folder"/build/*.deb

libraries=$(dirname "$(find "$root/usr/lib" -name "libovoid.so.$so")")
export LD_LIBRARY_PATH="$libraries" PKG_CONFIG_PATH="$libraries/pkgconfig"
# compile SOURCE PACKAGE KIND
compile() {
    flags=$(pkg-config --cflags --libs "$2")
    if [ "$3" = static ]; then flags=$(pkg-config --static --cflags --libs "$2" | sed 's/-l\(ovoid[a-z_]*\)/-l:lib\1.a/g'); fi
    # shellcheck disable=SC2086 # flags
    "$cc" -o "$folder/out_$2_$3" "$outside/$1" $flags && "$folder/out_$2_$3"
}
for kind in shared static; do
    check "pkg-config, $kind" compile outside.c ovoid $kind
    check "pkg-config, io, $kind" compile outside_io.c ovoid_io $kind
    check "pkg-config, robot, $kind" compile outside_robot.c ovoid_robot $kind
done
check "CMake: configure" cmake -S "$outside" -B "$folder/out_cmake" -DCMAKE_C_COMPILER="$cc" -DCMAKE_PREFIX_PATH="$root/usr" \
    -DOUTSIDE_COMPONENTS=io
check "CMake: build" cmake --build "$folder/out_cmake"
for kind in ovoid ovoid_static ovoid_io ovoid_io_static ovoid_robot ovoid_robot_static; do check "CMake: run $kind" "$folder/out_cmake/outside_$kind"; done
check "the tool runs" "$root/usr/bin/ovoid" --version
check "the tool says its version" [ "$("$root/usr/bin/ovoid" --version | head -n 1)" = "ovoid $version" ]

# Without libovoid-io-dev, and libovoid-robot-dev, which needs it, the core is still found, and its absence is said.
# shellcheck disable=SC2086 # a list of packages
in_root -r $engines libovoid-ompl-dev libovoid-robot-dev libovoid-io-dev >/dev/null 2>&1
check "CMake: the core alone" cmake -S "$outside" -B "$folder/out_core" -DCMAKE_C_COMPILER="$cc" -DCMAKE_PREFIX_PATH="$root/usr"
check "CMake: a component that is not there" fails cmake -S "$outside" -B "$folder/out_none" -DCMAKE_C_COMPILER="$cc" \
    -DCMAKE_PREFIX_PATH="$root/usr" -DOUTSIDE_COMPONENTS=io
# shellcheck disable=SC2086 # a list of packages
check "remove" in_root -P $packages
check "nothing is left" [ -z "$(find "$root" -type f -not -path '*/var/*')" ]
echo "$passed passed, $failed failed, 0 skipped"
[ "$failed" -eq 0 ]
