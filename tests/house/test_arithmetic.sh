#!/bin/sh
# A build whose arithmetic is not that of the proofs is refused, with a sentence (src/base/arithmetic.h): fast-math, and
# registers wider than a double. Truth: the compiler's answer, for each flag; without them it takes the file.
set -u
passed=0 failed=0 skipped=0
compiler=${OVOID_CC:-cc}
header=$OVOID_SOURCE_DIR/src/base/arithmetic.h

# expect CODE PATTERN FLAGS...: what the preprocessor returns and says.
expect() {
    code=$1 pattern=$2
    shift 2
    said=$("$compiler" "$@" -std=c17 -E "$header" 2>&1 >/dev/null)
    if [ $? -eq "$code" ] && echo "$said" | grep -q "$pattern"; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED $compiler $*: $said"
    fi
}

expect 0 ''
expect 0 '' -O3
expect 1 'does not hold under -ffast-math' -ffast-math
expect 1 'does not hold under -ffast-math' -Ofast
expect 1 'does not hold under -ffast-math' -ffinite-math-only
if echo | "$compiler" -m32 -E - >/dev/null 2>&1 && [ "$(uname -m)" = x86_64 ]; then
    expect 1 'compile with -msse2 -mfpmath=sse' -m32 -march=i586
    expect 0 '' -m32 -msse2 -mfpmath=sse
else
    skipped=$((skipped + 2))
    echo "skipped: $compiler has no 32-bit x86"
fi
echo "$passed passed, $failed failed, $skipped skipped"
[ $failed -eq 0 ]
