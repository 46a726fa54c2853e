#!/bin/sh
# No test vanishes in silence: a build that lacks GMP, Qhull, Assimp, Python or libovoid_io has every test of this one, or one that
# counts it as skipped and says what is missing. Truth: each test counts one, and a placeholder what it says it stands for.
set -u
passed=0 failed=0
work=$OVOID_BUILD_DIR/test_skipped

# count FOLDER: the tests of a build folder, with those that placeholders stand for.
count() {
    for part in adapters bench examples fuzz python tests; do
        [ -f "$1/$part/CTestTestfile.cmake" ] && cat "$1/$part/CTestTestfile.cmake"
    done | awk '/^add_test\(/ { n = 1; if (match($0, /0 failed, [0-9]+ skipped/)) n = substr($0, RSTART + 10) + 0; sum += n } END { print sum + 0 }'
}

# expect NAME OPTION...: a build with these options has as many.
expect() {
    name=$1
    shift
    rm -rf "$work" && mkdir -p "$work"
    if ! cmake -S "$OVOID_SOURCE_DIR" -B "$work" -DCMAKE_C_COMPILER="$OVOID_CC" "-DOVOID_SANITIZE=${OVOID_SANITIZE:-}" -DOVOID_TESTS=ON "$@" >"$work/log" 2>&1; then
        failed=$((failed + 1))
        echo "FAILED $name: no build folder" && tail -5 "$work/log"
        return
    fi
    found=$(count "$work")
    if [ "$found" -eq "$wanted" ] && [ "$found" -gt 100 ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED $name: $found tests are there or counted, not $wanted"
    fi
}

wanted=$(count "$OVOID_BUILD_DIR")
expect 'without GMP' -DOVOID_JUDGE=OFF
expect 'without Assimp' -DOVOID_ASSIMP=OFF
expect 'without Qhull' -DOVOID_QHULL_LIBRARY=
expect 'without libovoid_io' -DOVOID_IO=OFF
expect 'without Python' -DOVOID_PYTHON_INTERPRETER=/bin/false
expect 'without any' -DOVOID_IO=OFF -DOVOID_JUDGE=OFF -DOVOID_QHULL_LIBRARY=
rm -rf "$work"
echo "$passed passed, $failed failed, 0 skipped"
[ "$failed" -eq 0 ]
