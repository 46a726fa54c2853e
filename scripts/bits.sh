#!/bin/sh
# bits.sh: the same bits from every build? Builds the core, tests/core/query/test_query_bits.c and tests/core/motion/test_motion_bits.c with gcc and clang, each at -O0 to
# -O3, for this machine's own instructions, with fused operations to be had, and linked as one; runs each, and compares
# what they print. No core may hold a fused multiply-add: contraction is off, but compilers have forgotten. No core may
# round two doubles to floats and back side by side: gcc 12 drops both conversions. A compiler that is not there is
# skipped. A line for each build; exit 1 where one differs, with its families. Some minutes on two cores.
set -u
# shellcheck source=scripts/help.sh
. "$(dirname "$0")/help.sh"
cd "$(dirname "$0")/.." || exit 1
folder=build/bits
mkdir -p $folder

# build NAME COMPILER FLAGS...: the test's program, with the project's own flags added.
build() {
    name=$1 compiler=$2
    shift 2
    cmake -S . -B $folder/"$name" -DCMAKE_C_COMPILER="$compiler" -DCMAKE_BUILD_TYPE=None -DCMAKE_C_FLAGS="$*" -DOVOID_IO=OFF \
        >$folder/"$name".log 2>&1 && cmake --build $folder/"$name" --target test_query_bits test_motion_bits >>$folder/"$name".log 2>&1
}

# Functions of the core that hold fused operations.
find_fused() {
    objdump -d --no-show-raw-insn "$1" | awk '/^[0-9a-f]+ </ { name = $2 } /\tvfn?m(add|sub)/ { print "fused: " name }' | sort -u
}

# Functions in which gcc's vectorizer of straight-line code has doubles rounded to floats and back, from its own dumps.
find_dropped() {
    find "$1" -name '*.slp[12]' -exec awk '
        /^;; Function/ { name = $3; split("", narrow) }
        / = \(vector\([0-9]+\) float\) / { narrow[$1] = 1 }
        / = \(vector\([0-9]+\) double\) / { from = $NF; sub(";", "", from); if (from in narrow) print "dropped: " name }
    ' {} + | sort -u
}

# check NAME: runs it; the first one sets what the others must print.
check() {
    word=ok
    [ -f $folder/first ] || word=first
    $folder/"$1"/tests/test_query_bits --print >$folder/"$1".txt 2>&1 || word=FAILED
    $folder/"$1"/tests/test_motion_bits --print >>$folder/"$1".txt 2>&1 || word=FAILED
    for file in src/libovoid_internal.a tests/test_query_bits tests/test_motion_bits; do
        find_fused $folder/"$1"/$file >>$folder/"$1".txt 2>/dev/null
    done
    find_dropped $folder/"$1" >>$folder/"$1".txt
    [ $word != first ] || cp $folder/"$1".txt $folder/first
    cmp -s $folder/first $folder/"$1".txt && ! grep -qE '^(fused|dropped)' $folder/"$1".txt || word=FAILED
    printf '%-18s %-6s %s\n' "$1" $word "$(sed -n 's/^all *//p' $folder/"$1".txt)"
    if [ $word = FAILED ]; then
        diff $folder/first $folder/"$1".txt
        failed=$((failed + 1))
    else
        passed=$((passed + 1))
    fi
}

# The builds: name, compiler, flags.
list() {
    for compiler in gcc clang; do
        command -v $compiler >/dev/null || continue
        dumps=""
        [ $compiler != gcc ] || dumps="-fdump-tree-slp1-slim -fdump-tree-slp2-slim"
        for level in 0 1 2 3; do echo "$compiler-O$level $compiler -O$level $dumps"; done
        echo "$compiler-O3-native $compiler -O3 -march=native"
        echo "$compiler-O3-fma $compiler -O3 -mavx2 -mfma"
        echo "$compiler-O2-lto $compiler -O2 -flto $dumps"
    done
}

rm -f $folder/first
passed=0 failed=0
list >$folder/list
# Two compilations at a time.
while read -r one && read -r two; do
    # shellcheck disable=SC2086 # a name, a compiler, its flags
    build $one &
    # shellcheck disable=SC2086
    build $two
    wait
    check "${one%% *}"
    check "${two%% *}"
done <<END
$(cat $folder/list)
$([ $(($(wc -l <$folder/list) % 2)) -eq 0 ] || sed -n 1p $folder/list)
END
command -v clang >/dev/null || echo "clang is not here: its builds are skipped"
echo "$passed passed, $failed failed, 0 skipped"
[ $failed -eq 0 ]
