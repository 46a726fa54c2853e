#!/bin/sh
# No public function of C has more than four parameters, and of those of src/ at most 4 % have; and the check says so of a header in which
# one has, and of a folder in which too many have. Truth: the headers and the sources.
set -u
cd "$OVOID_SOURCE_DIR" || exit 1
if ! command -v python3 > /dev/null; then
    echo "0 passed, 0 failed, 1 skipped"
    exit 0
fi
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
sed 's/const ovoid_options \*options, const ovoid_proof \*earlier);/const ovoid_options *options, int one, int more, int of, const ovoid_proof *earlier);/' \
    include/ovoid/query.h > "$folder/query.h"
scripts/check-parameters "$folder/query.h" > "$folder/said"
if ! grep -q '^FAILED query.h: ovoid_collide has 6 parameters' "$folder/said"; then
    echo "FAILED a function with six parameters was not refused"
    echo "0 passed, 1 failed, 0 skipped"
    exit 1
fi

# write_functions COUNT WIDE: the sources of a folder, of whose COUNT functions the last WIDE have five parameters.
write_functions() {
    mkdir -p "$folder/sources"
    awk -v count="$1" -v wide="$2" 'BEGIN {
        for (i = 1; i <= count; i++) printf "static int f%d(int a%s) { return a; }\n", i, (i > count - wide ? ", int b, int c, int d, int e" : "")
    }' > "$folder/sources/functions.c"
}

write_functions 100 4
if ! scripts/check-parameters --sources "$folder/sources" > "$folder/said"; then
    echo "FAILED four of a hundred functions were refused"
    echo "0 passed, 1 failed, 0 skipped"
    exit 1
fi
write_functions 100 5
if scripts/check-parameters --sources "$folder/sources" > "$folder/said" || ! grep -q '^FAILED sources: 5 of 100 functions' "$folder/said"; then
    echo "FAILED five of a hundred functions were not refused"
    echo "0 passed, 1 failed, 0 skipped"
    exit 1
fi
scripts/check-parameters
