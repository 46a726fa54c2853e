#!/bin/sh
# Each source file that prefetches memory has as many prefetch instructions in its object file, at least, as it has calls:
# gcc 12 removes calls of functions that only prefetch, and a frame of many bodies then takes a third longer. Truth: the
# instructions as objdump shows them. Not under sanitizers, whose builds do not inline.
set -u
source=$(cd "$(dirname "$0")/../.." && pwd)/src
passed=0 failed=0

skip() {
    echo "skipped: $1"
    echo "0 passed, 0 failed, 1 skipped"
    exit 0
}

objects=$OVOID_BUILD_DIR/src/CMakeFiles/ovoid_objects.dir
command -v objdump >/dev/null || skip "no objdump"
[ -d "$objects" ] || skip "no objects of the core"
if objdump -t "$objects/base/error.c.o" 2>/dev/null | grep -qE '__(asan|ubsan|tsan)_'; then skip "built with sanitizers"; fi
case $(uname -m) in
x86_64 | aarch64) ;;
*) skip "prefetch instructions of $(uname -m) are not known here" ;;
esac

for file in "$source"/*/*.c "$source"/*/*/*.c; do
    grep -q 'compiler_prefetch(' "$file" || continue
    calls=$(grep -c 'compiler_prefetch(' "$file")
    found=$(objdump -d --no-show-raw-insn "$objects/${file#"$source"/}.o" | grep -cE '\s(prefetch|prfm)')
    if [ "$found" -ge "$calls" ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED $(basename "$file"): $found prefetch instructions, $calls calls"
    fi
done
[ "$passed" -gt 0 ] || failed=$((failed + 1))
echo "$passed passed, $failed failed, 0 skipped"
[ "$failed" -eq 0 ]
