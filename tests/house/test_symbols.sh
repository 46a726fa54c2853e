#!/bin/sh
# The static archives and the names of their host: they define no global symbol but ovoid_..., so a program whose own
# functions are named like internal ones never has them called by the library. Truth: the symbols as nm shows them; and a
# program that defines every internal name of the core, each as a function that aborts, gets the answers of one that
# defines none. It can fail: the same program with the archive whose internal names are global does not.
set -u
archives=$OVOID_BUILD_DIR/src
folder=$OVOID_BUILD_DIR/test_symbols
cc=${OVOID_CC:-cc}
# shellcheck source=tests/common/steps.sh
. "$(dirname "$0")/../common/steps.sh"
skipped=0

if [ "${OVOID_ARCHIVES:-one}" != one ] || ! command -v nm >/dev/null || ! [ -f "$archives/libovoid.a" ]; then
    echo "skipped: no nm, no static library, or one of plain objects (OVOID_ONE_OBJECT)"
    echo "0 passed, 0 failed, 1 skipped"
    exit 0
fi
rm -rf "$folder"
mkdir -p "$folder"

# Global names of an archive that are not ours; common and weak ones count.
list_foreign() { nm -g --defined-only "$1" | awk 'NF >= 3 && $NF !~ /^ovoid_/ { print $NF }' | sort -u; }
has_no_foreign() { ! list_foreign "$1" | grep .; }

for archive in "$archives/libovoid.a" "$archives/libovoid_io.a" "$archives/libovoid_robot.a"; do
    [ -f "$archive" ] || continue
    check "names of $archive" has_no_foreign "$archive"
    check "public names of $archive" sh -c "nm -g --defined-only '$archive' | grep -q ' T ovoid_'"
done
# It can fail: a hidden name, a common one and a weak one are found in a copy.
cp "$archives/libovoid.a" "$folder/planted.a"
printf '__attribute__((visibility("hidden"))) int sort_indices;\n__attribute__((common)) int shared;\n
    __attribute__((weak)) int keys = 1;\n' >"$folder/planted.c"
check "compile what is planted" "$cc" -c "$folder/planted.c" -o "$folder/planted.o"
check "plant" ar q "$folder/planted.a" "$folder/planted.o"
check "planted names are found" [ "$(list_foreign "$folder/planted.a" | tr '\n' ' ')" = "keys shared sort_indices " ]

# A name that two libraries have is that of one source, which both were made of: in a test, which links their internal
# archives, one would else be called for the other. Truth: the objects' names.
list_shared() {
    nm -A -g --defined-only "$@" 2>/dev/null | awk 'NF >= 3 && $NF !~ /^ovoid_/ {
        object = $1; sub(/:[0-9a-f]*$/, "", object); sub(/.*:/, "", object)
        if ($NF in first && first[$NF] != object) print $NF
        first[$NF] = object }' | sort -u
}
# shellcheck disable=SC2317 # called through check
has_no_shared() { ! list_shared "$@" | grep .; }
check "names of several libraries" has_no_shared "$archives"/libovoid*_internal.a
printf 'int sort_indices(void);\nint sort_indices(void) { return 0; }\n' >"$folder/shared.c"
check "compile a shared name" "$cc" -c "$folder/shared.c" -o "$folder/shared.o"
check "a shared name is found" [ "$(list_shared "$archives/libovoid_internal.a" "$folder/shared.o")" = sort_indices ]

# The program, alone and with a function of its own for each internal name.
source=$OVOID_SOURCE_DIR/tests/house/outside/namesake.c
list_foreign "$archives/libovoid_internal.a" >"$folder/names"
check "internal names are known" [ "$(wc -l <"$folder/names")" -gt 100 ]
{
    echo '_Noreturn void abort(void);'
    sed 's/.*/void &(void); void &(void) { abort(); }/' "$folder/names"
} >"$folder/names.c"
# link PROGRAM ARCHIVE SOURCE...
link() {
    program=$1 archive=$2
    shift 2
    # -fno-builtin: an internal name may be a library function's.
    "$cc" -std=c17 -fno-builtin -I"$OVOID_SOURCE_DIR/include" -o "$folder/$program" "$@" "$archive" -lm -lpthread
}
if [ "${OVOID_SANITIZE:-}" ]; then
    echo "skipped: the program would have to know the sanitizers' flags"
    skipped=1
else
    check "link plain" link plain "$archives/libovoid.a" "$source"
    check "link namesakes" link namesakes "$archives/libovoid.a" "$source" "$folder/names.c"
    check "run plain" sh -c "'$folder/plain' >'$folder/plain.txt'"
    check "run namesakes" sh -c "'$folder/namesakes' >'$folder/namesakes.txt'"
    check "the same answers" cmp "$folder/plain.txt" "$folder/namesakes.txt"
    # shellcheck disable=SC2317 # called through check
    hijacked() { link hijacked "$archives/libovoid_internal.a" "$source" "$folder/names.c" && "$folder/hijacked"; }
    check "with global names it fails" fails hijacked
fi
echo "$passed passed, $failed failed, $skipped skipped"
[ "$failed" -eq 0 ]
