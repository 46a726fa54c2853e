#!/bin/sh
# abi.sh [--record]: does the binary interface of the shared libraries still fit programs that were linked with the release before?
# Compares the libraries of the build "check" (which have debug information) with packaging/abi/NAME.abi, by abidiff of Debian's
# abigail-tools. What is new is allowed; what is gone or changed is refused while the minor version is that of the record.
# --record writes the record anew, as the last step of a release (docs/releasing.md). Each run also alters a copy of the record in two
# ways, a function that is gone and a structure of another size, and fails where abidiff takes it.
set -eu
# shellcheck disable=SC2034 # help.sh reads it
options=--record
# shellcheck source=scripts/help.sh
. "$(dirname "$0")/help.sh"
cd "$(dirname "$0")/.."
command -v abidiff >/dev/null || { echo "abi: abidiff is missing; it is in Debian's package abigail-tools" >&2 && exit 1; }
folder=packaging/abi
minor=$(sed -n 's/^#define OVOID_VERSION_\(MAJOR\|MINOR\) \([0-9]*\)$/\2/p' include/ovoid/base.h | paste -sd.)
cmake --preset check >/dev/null
cmake --build build/check -j"${JOBS:-$(nproc)}" --target ovoid_shared ovoid_io_shared ovoid_robot_shared >build/abi.log ||
    { tail -20 build/abi.log && exit 1; }

# dump LIBRARY FILE: its public functions and types, without anything that depends on where or by whom it was built.
dump() {
    abidw --headers-dir include/ovoid --exported-interfaces-only --drop-private-types --no-corpus-path --no-comp-dir-path \
        --no-show-locs --no-architecture --no-elf-needed --out-file "$2" "build/check/src/$1.so"
    sed -i "s#path='$PWD/#path='#" "$2"
}

# fits OLD NEW: exit 0 where a program that was linked with OLD works with NEW: nothing is gone and no type is another. abidiff says so
# by its exit code, but for a record that is no XML, of which it only complains.
fits() {
    code=0
    abidiff --no-added-syms "$1" "$2" >build/abi.report 2>&1 || code=$?
    [ $code -eq 0 ] && ! grep -q 'parser error' build/abi.report
}

# refuse_altered RECORD EXPRESSION: this change of the record, made by sed, is noticed.
refuse_altered() {
    sed "$2" "$1" >build/altered.abi
    if cmp -s "$1" build/altered.abi; then echo "abi: nothing in $1 to alter by $2" && return 1; fi
    if fits build/altered.abi "$1"; then echo "abi: a record altered by $2 was taken" && return 1; fi
}

failed=0
for library in libovoid libovoid_io libovoid_robot; do
    record=$folder/$library.abi
    if [ "${1:-}" = --record ]; then
        dump $library "$record" && echo "$minor" >$folder/version && echo "recorded: $record" && continue
    fi
    dump $library build/$library.abi
    if fits "$record" build/$library.abi; then
        echo "$library: fits programs linked with the record of $(cat $folder/version)"
    elif [ "$minor" = "$(cat $folder/version)" ]; then
        cat build/abi.report
        echo "$library: a program linked with the record breaks. Raise OVOID_VERSION_MINOR in include/ovoid/base.h, or undo the change"
        failed=1
    else
        echo "$library: differs from the record of $(cat $folder/version), which a new minor version may"
    fi
    function=$(sed -n "s/.*<elf-symbol name='\(ovoid_[a-z_]*_create[a-z_]*\)'.*/\1/p" "$record" | head -1)
    refuse_altered "$record" "s/'$function'/'${function}_gone'/g" || failed=1
    refuse_altered "$record" "/class-decl name='ovoid_[a-z_]*' size-in-bits=/s/layout-offset-in-bits='64'/layout-offset-in-bits='96'/;
        s/\(<class-decl name='ovoid_[a-z_]*' size-in-bits='\)/\19/" || failed=1
done
exit $failed
