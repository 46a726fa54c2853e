#!/bin/sh
# The core keeps no state and calls nothing that does: what its object files may write to, and what they need from outside,
# is looked at. Truth: the symbols' sections as objdump shows them. Not under sanitizers, which add their own.
# - Writable data: only the assert hook, set once before other threads use the library (ovoid/base.h).
# - From outside: memory, strings, the mathematics library, and what gcc's runtime read of the processor before main
#   (__cpu_model, never written after that). No printing, no files, no environment, no exit; threads and locks in a world alone.
set -u
library=$OVOID_BUILD_DIR/src/libovoid.a
passed=0 failed=0

# expect NAME ALLOWED FOUND: nothing found but what the pattern allows.
expect() {
    rest=$(printf '%s\n' "$3" | grep -v '^$' | grep -vE "^($2)\$" | sort -u)
    if [ -z "$rest" ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED $1: $(echo "$rest" | tr '\n' ' ')"
    fi
}

if ! command -v objdump >/dev/null || ! [ -f "$library" ]; then
    echo "skipped: no objdump, or no static library"
    echo "0 passed, 0 failed, 1 skipped"
    exit 0
fi
symbols=$(objdump -t "$library" 2>/dev/null)
if echo "$symbols" | grep -qE '__(asan|ubsan|tsan)_'; then
    echo "skipped: built with sanitizers"
    echo "0 passed, 0 failed, 1 skipped"
    exit 0
fi

# Symbols in sections that stay writable (.data.rel.ro does not); section symbols themselves are no data.
writable=$(echo "$symbols" | awk '{ for (i = 2; i < NF; i++)
    if ($i ~ /^(\.data|\.bss|\.tdata|\.tbss|\.lbss|\.ldata|\*COM\*)/ && $i !~ /^\.data\.rel\.ro/ && $NF !~ /^\./) print $NF }')
expect "writable data" 'assert_hook' "$writable"

# What is undefined in one object and defined in none.
outside=$(echo "$symbols" | awk '/\*UND\*/ { needed[$NF] = 1; next }
    / (g|w)[ a-zA-Z]* / && NF >= 5 { defined[$NF] = 1 }
    END { for (s in needed) if (!(s in defined)) print s }')
memory='aligned_alloc|madvise|free|mem(cpy|move|set|cmp)|str(len|cmp|ncmp)|abort|_*(vsnprintf|mem(cpy|move|set))(_chk)?|__stack_chk_fail'
mathematics='sqrt|sin|cos|sincos|fm(in|ax)|frexp|ldexp|scalbn|floor|ceil|rint|nearbyint|nextafter|trunc|log2?|exp2?|cbrt|pow|hypot|fabs|fesetenv|fegetenv'
# The threads of a world: created and joined by it, asleep between its frames; queries know none of them. getpid tells
# whether this is still their process; signals are kept from them.
threads='getpid|sig(fill|del)set|pthread_(create|join|sigmask|mutex_(init|destroy|lock|unlock)|cond_(init|destroy|wait|broadcast)|attr_(init|destroy|setstacksize))'
expect "from outside" "$memory|$mathematics|$threads|__cpu_model|__cpu_indicator_init|_GLOBAL_OFFSET_TABLE_|qsort" "$outside"

# It can fail: a planted counter and a planted lock are found.
planted=$OVOID_BUILD_DIR/test_globals
printf 'static int count; int f(void); int f(void) { return ++count; }\n' >"$planted.c"
if "${OVOID_CC:-cc}" -O1 -c "$planted.c" -o "$planted.o" && objdump -t "$planted.o" | grep -q '\.bss.*count'; then
    passed=$((passed + 1))
else
    failed=$((failed + 1))
    echo "FAILED: a planted counter is not seen"
fi
rm -f "$planted.c" "$planted.o"
echo "$passed passed, $failed failed, 0 skipped"
[ "$failed" -eq 0 ]
