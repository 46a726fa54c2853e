#!/bin/sh
# setup.sh WHAT...: installs the Debian packages that are missing for WHAT: build, check, coverage, deb, deb-root, demo, engines, bench, fuzz, ports, wasm, page, python, cluster, docs or site.
# Nothing missing: nothing is called. Nowhere to install from or no right to: a sentence that names the packages.
set -eu
# shellcheck source=scripts/help.sh
. "$(dirname "$0")/help.sh"

# The packages that each job needs.
packages_of() {
    for job in "$@"; do
        case $job in
        build) echo build-essential cmake pkgconf libjansson-dev libassimp-dev libexpat1-dev libyaml-dev libgmp-dev ;;
        check) packages_of build deb python page site && echo libqhull-dev libcgal-demo libeigen3-dev libglm-dev libompl-dev libbullet-dev libmujoco-dev clang libclang-rt-14-dev clang-format clang-tidy shellcheck mandoc doxygen locales musl-tools gcc-aarch64-linux-gnu libc6-dev-arm64-cross qemu-user parallel abigail-tools ;;
        coverage) packages_of check && echo gcovr ;;
        deb) packages_of build && echo dpkg-dev lintian libompl-dev libbullet-dev libmujoco-dev ;;
        deb-root) packages_of deb && echo debootstrap ;;
        demo) packages_of build && echo libcgal-demo ;;
        engines) packages_of build && echo libbullet-dev libmujoco-dev libdart-dev libfcl-dev libeigen3-dev ;;
        bench) packages_of build && echo libccd-dev libfcl-dev libbullet-dev libode-dev libqhull-dev ;;
        fuzz) packages_of build && echo clang libclang-rt-14-dev assimp-testmodels ;;
        ports) packages_of check && echo gcc-i686-linux-gnu libc6-dev-i386-cross gcc-mingw-w64-x86-64-win32 wine64 ;;
        wasm) packages_of build && echo clang lld binaryen zopfli wasi-libc libclang-rt-14-dev-wasm32 && { command -v node >/dev/null || echo nodejs; } ;;
        page) packages_of wasm && echo chromium firefox-esr && { command -v npm >/dev/null || echo npm; } ;;
        python) packages_of build && echo python3 python3-dev python3-numpy python3-setuptools python3-wheel python3-pip python3-venv python3-hypothesis mypy python3-matplotlib python3-nbconvert python3-ipykernel ;;
        cluster) packages_of python && echo parallel slurmctld slurmd slurm-client munge python3-distributed python3-mpi4py openmpi-bin ;;
        docs) echo cmake build-essential doxygen ;;
        site) packages_of docs demo wasm && echo python3 python3-sphinx python3-myst-parser furo && { command -v npm >/dev/null || echo npm; } ;;
        *) echo "setup: no such job: $job" >&2 && return 1 ;;
        esac
    done | tr ' ' '\n' | sort -u | tr '\n' ' '
}

if ! command -v dpkg-query >/dev/null; then
    echo "setup: this is not Debian; make sure that these packages' like are here: $(packages_of "$@")" >&2
    exit 0
fi

missing=
for package in $(packages_of "$@"); do
    status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null) || status=absent
    if [ "$status" != installed ]; then missing="$missing $package"; fi
done
if [ -z "$missing" ]; then exit 0; fi

say_and_stop() {
    echo "setup: $1. Please install:$missing" >&2
    exit 1
}
as_root=
if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || say_and_stop "not root, and there is no sudo"
    as_root=sudo
fi
command -v apt-get >/dev/null || say_and_stop "there is no apt-get"

echo "setup: installing$missing" >&2
# Another apt may be at work (unattended upgrades, a second job): it is waited for.
wait_for_lock="-o DPkg::Lock::Timeout=${OVOID_APT_TIMEOUT:-300}"
# The lists of a fresh machine may be empty or old; where they cannot be had, what is there may do.
# shellcheck disable=SC2086 # an option and its value
$as_root apt-get -qq $wait_for_lock update >&2 || echo "setup: could not refresh the package lists" >&2
# shellcheck disable=SC2086 # a list of package names
$as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -y $wait_for_lock --no-install-recommends install $missing >&2 ||
    say_and_stop "apt-get could not install them"
