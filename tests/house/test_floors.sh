#!/bin/sh
# scripts/check-floors against planted faults: each must be found at its place; the repository itself must pass.
# Truth: the faults are planted here, so what must be reported is known.
set -u
passed=0 failed=0
folder=$OVOID_BUILD_DIR/test_floors
check=$OVOID_SOURCE_DIR/scripts/check-floors

# expect NAME FILE TEXT COMPLAINT: a tree with that one file gives that complaint, or none where it is empty.
expect() {
    rm -rf "$folder"
    mkdir -p "$folder/$(dirname "$2")"
    printf '%b' "$3" >"$folder/$2"
    [ "$1" != own ] || : >"$folder/cli/args.h"
    output=$("$check" "$folder" 2>&1)
    code=$?
    if [ -z "$4" ] && [ $code -eq 0 ] && [ -z "$output" ]; then
        passed=$((passed + 1))
    elif [ -n "$4" ] && [ $code -eq 1 ] && [ "$output" = "$2:$4" ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        printf 'FAILED %s: exit %s, said: %s\n' "$1" "$code" "$output"
    fi
}

expect upward src/linear/a.c '\n#include "exact/gjk.h"\n' '2: upward include: exact/gjk.h from floor linear'
expect upward_public src/shape/a.c '#include "ovoid/query.h"\n' '1: upward include: ovoid/query.h from floor shape'
expect upward_system src/shape/a.c '#include <ovoid/query.h>\n' '1: upward include: ovoid/query.h from floor shape'
expect upward_header include/ovoid/base.h '#  include "ovoid/io.h"\n' '1: upward include: ovoid/io.h from floor base'
expect upward_cpp include/ovoid/linear.h '#include "ovoid/cpp/linear.hpp"\n' \
    '1: upward include: ovoid/cpp/linear.hpp from floor linear'
expect upward_io include/ovoid/cpp/a.hpp '#include "ovoid/io.hpp"\n' '1: upward include: ovoid/io.hpp from floor world'
expect downward_cpp include/ovoid/eigen.hpp '#include "ovoid/cpp/linear.hpp"\n#include <Eigen/Core>\n' ''
expect beside src/motion/a.c '#include "smooth/smooth.h"\n' '1: upward include: smooth/smooth.h from floor motion'
expect beside_within src/io/scene/a.c '#include "io/mesh/mesh.h"\n' \
    '1: upward include: io/mesh/mesh.h from floor io/scene'
expect room_up src/io/a.c '#include "io/draw/svg.h"\n' '1: upward include: io/draw/svg.h from floor io'
expect room_down src/io/draw/a.c '#include "io/text.h"\n#include <jansson.h>\n' ''
expect downward src/query/a.c '#include "linear/vec3.h"\n#include "ovoid/query.h"\n#include "near.h"\n#include <math.h>\n' ''
expect no_floor src/query/a.c '#include "lineal/vec3.h"\n' '1: no such floor: lineal/vec3.h'
expect folder src/stuff/a.c '' '0: not on a floor'
expect intrinsics src/query/a.c '#include <immintrin.h>\n' '1: intrinsics are for src/simd only: immintrin.h'
expect intrinsics_below bench/a.c '#include <x86intrin.h>\n' '1: intrinsics are for src/simd only: x86intrin.h'
expect intrinsics_home src/simd/a.c '#include <immintrin.h>\n__attribute__((target("avx2"))) int f(void);\n' ''
expect target src/shape/a.c '__attribute__((target("avx2"))) int f(void);\n' '1: per-ISA code is for src/simd only'
expect assembly src/query/a.c '\n__asm__ volatile("nop");\n' '2: inline assembly is for src/base/environment.h and compiler.h only'
expect assembly_home src/base/environment.h '__asm__ volatile("nop");\n' ''
expect qhull src/shape/a.c '#include <libqhull_r/libqhull_r.h>\n' '1: libqhull_r is for tests only'
expect jansson src/query/a.c '#include <jansson.h>\n' '1: jansson is for src/io only'
expect program cli/a.c '#include "exact/gjk.h"\n' \
    '1: a program includes <ovoid/...> and its own headers only: exact/gjk.h'
expect program_absent bench/a.c '#include "gjk.h"\n' \
    '1: a program includes <ovoid/...> and its own headers only: gjk.h'
expect program_up cli/a.c '#include "../src/exact/gjk.h"\n' \
    '1: a program includes <ovoid/...> and its own headers only: ../src/exact/gjk.h'
expect tools bench/a.c '#include "tools/gjk.h"\n' \
    '1: a program includes <ovoid/...> and its own headers only: tools/gjk.h'
expect own cli/a.c '#include "args.h"\n#include <ovoid/ovoid.h>\n#include <ovoid/ovoid.hpp>\n' ''
expect long src/query/a.c "$(awk 'BEGIN { for (i = 0; i < 801; i++) printf "int a%d;\\n", i }')" '801: over 800 lines'

# expect_files NAME FOLDER COUNT SAID: a folder of so many files gives that complaint, or none.
expect_files() {
    rm -rf "$folder"
    mkdir -p "$folder/$2"
    for i in $(seq "$3"); do : >"$folder/$2/a$i.txt"; done
    output=$("$check" "$folder" 2>&1)
    code=$?
    if [ "$output" = "$4" ] && [ $code -eq "$([ -z "$4" ] && echo 0 || echo 1)" ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        printf 'FAILED %s: exit %s, said: %s\n' "$1" "$code" "$output"
    fi
}
expect_files crowd bench/many 31 'bench/many: over 30 files: 31'
expect_files no_crowd bench/many 30 ''
expect_files data tests/cli/data 31 ''
expect_files public include/ovoid 31 ''
rm -rf "$folder"

# Each test of a floor is one of those that `make test FLOOR=` runs.
find_floor() { awk -v name="$1" '!/^#/ && $1 != "house" && name ~ "^(" $2 ")$" { print $1; exit }' "$OVOID_SOURCE_DIR/tests/floors.txt"; }
for source in "$OVOID_SOURCE_DIR"/tests/core/*/test_*.c "$OVOID_SOURCE_DIR"/tests/io/test_*.c "$OVOID_SOURCE_DIR"/tests/robot*/test_*.c \
    "$OVOID_SOURCE_DIR"/tests/judge/test_*.c; do
    name=$(basename "$source" .c)
    if [ -n "$(find_floor "$name")" ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED: tests/floors.txt has no floor for $name"
    fi
done
if [ -n "$(find_floor test_nothing)" ]; then failed=$((failed + 1)) && echo "FAILED: test_nothing has a floor"; fi

if "$check" "$OVOID_SOURCE_DIR"; then passed=$((passed + 1)); else failed=$((failed + 1)); fi
echo "$passed passed, $failed failed, 0 skipped"
[ "$failed" -eq 0 ]
