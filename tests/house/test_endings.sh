#!/bin/sh
# The tool and Python refuse to write a picture to a file whose name ends as that of another format. Truth: the list in
# cli/base/outputs.c, which the tool reads; Python's is that without "svg".
set -u
sources=$OVOID_SOURCE_DIR
passed=0 failed=0

# check NAME A B: two texts that must be the same.
check() {
    if [ -n "$2" ] && [ "$2" = "$3" ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        printf 'FAILED %s:\n%s\nbut\n%s\n' "$1" "$2" "$3"
    fi
}

tool=$(awk '/known\[\] = \{/ { inside = 1; sub(/.*\{/, "") } inside { print } /\};/ { inside = 0 }' "$sources/cli/base/outputs.c" |
    grep -o '"[a-z0-9]*"' | tr -d '"' | sort)
python=$(sed -n 's/^_OTHERS = frozenset("\([a-z0-9 ]*\)".split())$/\1/p' "$sources/python/ovoid/_draw.py" | tr ' ' '\n' | sort)
check "the tool's list has svg once" svg "$(echo "$tool" | grep -x svg)"
check "endings of other formats" "$(echo "$tool" | grep -vx svg)" "$python"
echo "$passed passed, $failed failed, 0 skipped"
[ $failed -eq 0 ]
