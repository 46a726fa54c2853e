#!/bin/sh
# deb-root.sh [FOLDER]: the packages in FOLDER (build/deb) in a fresh Debian 12: debootstrap, apt with all dependencies, a
# compiler; outside programs by pkg-config and CMake; the tool; and everything removed. As root, some minutes, in
# build/deb-root, which is used again. The last line counts.
set -u
# shellcheck source=scripts/help.sh
. "$(dirname "$0")/help.sh"
cd "$(dirname "$0")/.." || exit 1
packages=${1:-build/deb}
root=build/deb-root
passed=0 failed=0
check() {
    name=$1
    shift
    if "$@" >"$root.log" 2>&1; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED $name" && tail -n 30 "$root.log"
    fi
}
inside() { env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive LC_ALL=C chroot "$root" "$@"; }

[ -x "$root/usr/bin/apt-get" ] || check debootstrap debootstrap --variant=minbase bookworm "$root"
cp /etc/resolv.conf /etc/hosts "$root/etc/"
rm -rf "$root/work"
mkdir "$root/work"
cp "$packages"/*.deb "$root/work"
cp -r tests/house/outside "$root/work"

check update inside apt-get -qq update
# The libraries and the tool, before anything that could hide a dependency that is missing.
install='apt-get -qq -y --no-install-recommends install'
check "libraries and tool" inside sh -c "$install /work/libovoid[0-9]*.deb /work/libovoid-io[0-9]*.deb /work/libovoid-robot[0-9]*.deb /work/ovoid_*.deb"
check "the tool runs" inside ovoid --version
check "the linker's cache" inside sh -c 'ldconfig -p | grep -q libovoid.so.'
check "development" inside sh -c "$install /work/libovoid*-dev_*.deb gcc libc6-dev cmake make pkgconf"
for name in "" _io _robot; do
    flags=$(inside pkg-config --cflags --libs ovoid$name)
    check "pkg-config, ovoid$name" inside sh -c "cd /work && cc -o a outside/outside$name.c $flags && ./a"
done
check "CMake" inside sh -c 'cd /work && cmake -S outside -B b -DOUTSIDE_COMPONENTS=io && cmake --build b'
for kind in ovoid ovoid_static ovoid_io ovoid_io_static ovoid_robot ovoid_robot_static; do check "CMake, $kind" inside /work/b/outside_$kind; done
# shellcheck disable=SC2046 # a list of packages
check "remove" inside dpkg -P $(for file in "$packages"/*.deb; do dpkg -f "$file" Package; done)
check "the linker's cache without" inside sh -c '! ldconfig -p | grep -q libovoid'
echo "$passed passed, $failed failed, 0 skipped"
[ $failed -eq 0 ]
