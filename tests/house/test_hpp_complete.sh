#!/bin/sh
# Every public C function of the core is reached by the C++ headers. Truth: the declarations in include/ovoid/*.h.
set -u
cd "$OVOID_SOURCE_DIR" || exit 1
passed=0 failed=0
# io.h is a library of its own, whose records and pictures are written through C; robot_*.h read files.
names=$(find include/ovoid -name '*.h' ! -name io.h ! -name 'robot_*.h' -exec cat {} + | tr '\n' ' ' |
    grep -oE 'OVOID_API [^;{(]*[ *]ovoid_[a-z0-9_]+\(' | grep -oE 'ovoid_[a-z0-9_]+\($' | tr -d '(' | sort -u)
for name in $names; do
    if grep -qw "$name" include/ovoid/*.hpp include/ovoid/cpp/*.hpp; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED no C++ header calls $name"
    fi
done
if [ "$passed" -lt 100 ]; then
    failed=$((failed + 1))
    echo "FAILED only $passed names were found"
fi
echo "$passed passed, $failed failed, 0 skipped"
[ "$failed" -eq 0 ]
