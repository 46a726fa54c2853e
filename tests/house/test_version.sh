#!/bin/sh
# The version is one: the header's, the npm package's, vcpkg's, Debian's and the newest of CHANGELOG.md. The record of
# the binary interface is of this minor version or of one before. The comparison is tried on an altered copy, too.
set -u
# shellcheck source=tests/common/steps.sh
. "$(dirname "$0")/../common/steps.sh"
cd "$OVOID_SOURCE_DIR" || exit 1
folder=$OVOID_BUILD_DIR/test_version
mkdir -p "$folder"
define() { sed -n "s/^#define OVOID_VERSION_$1 //p" include/ovoid/base.h; }
version=$(define MAJOR).$(define MINOR).$(define PATCH)
json_version() { sed -n 's/^ *"version": "\(.*\)",$/\1/p' "$1"; }
says() { [ "$(json_version "$1")" = "$version" ]; }

check "a version of three numbers" sh -c "echo '$version' | grep -qx '[0-9]*\.[0-9]*\.[0-9]*'"
check "web/package/package.json" says web/package/package.json
check "packaging/vcpkg/ovoid/vcpkg.json" says packaging/vcpkg/ovoid/vcpkg.json
sed 's/"version": "/"version": "9/' web/package/package.json >"$folder/package.json"
check "an altered copy" fails says "$folder/package.json"
check "packaging/deb/changelog" [ "$(sed -n '1s/^ovoid (\(.*\)-[0-9]*) .*/\1/p' packaging/deb/changelog)" = "$version" ]
check "CHANGELOG.md" [ "$(sed -n 's/^## \[\([0-9.]*\)\] - [0-9-]*$/\1/p' CHANGELOG.md | head -1)" = "$version" ]
check "packaging/abi/version" sh -c "printf '%s\n' '$(cat packaging/abi/version)' '$(define MAJOR).$(define MINOR)' | sort -V -C"
echo "$passed passed, $failed failed, 0 skipped"
[ "$failed" -eq 0 ]
