#!/bin/sh
# deb.sh [FOLDER]: Debian packages of the libraries and the tool into FOLDER (build/deb): built with Debian's flags, all
# hardening on, and looked through by lintian, whose errors and warnings end it with exit 1. Prints the packages' paths.
set -eu
# shellcheck source=scripts/help.sh
. "$(dirname "$0")/help.sh"
cd "$(dirname "$0")/.."
folder=${1:-build/deb}
export DEB_BUILD_MAINT_OPTIONS=hardening=+all
SOURCE_DATE_EPOCH=$(dpkg-parsechangelog -l packaging/deb/changelog -S Timestamp)
export SOURCE_DATE_EPOCH

# No -g: what it makes would be stripped.
flags="$(dpkg-buildflags --get CPPFLAGS) $(dpkg-buildflags --get CFLAGS | sed 's/\(^\| \)-g / /')"
link=$(dpkg-buildflags --get LDFLAGS)
mkdir -p "$folder"
rm -f "$folder"/*.deb
said() { "$@" >"$folder/said.log" 2>&1 || { cat "$folder/said.log" >&2 && return 1; }; }
said cmake -S . -B "$folder" -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=/usr -DCMAKE_C_FLAGS="$flags" \
    -DCMAKE_EXE_LINKER_FLAGS="$link" -DCMAKE_SHARED_LINKER_FLAGS="$link" \
    -DOVOID_TESTS=OFF -DOVOID_BENCH=OFF -DOVOID_EXAMPLES=OFF -DOVOID_PYTHON=OFF
said cmake --build "$folder" -j "${JOBS:-2}"
# "make deb" has built the template before, where Node.js is here.
if [ -f build/release/page.html ]; then cp build/release/page.html "$folder/"; else echo "deb: without the template of --html: make page" >&2; fi
said cpack -G DEB --config "$folder/CPackConfig.cmake" -B "$folder"
if command -v lintian >/dev/null; then
    # As root it would complain of just that.
    lintian --allow-root --fail-on error,warning "$folder"/*.deb
else
    echo "lintian is not here: the packages were not looked through" >&2
fi
ls "$folder"/*.deb
