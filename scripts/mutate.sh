#!/bin/sh
# mutate.sh [NAME...]: do the tests notice a fault? Copies the sources to build/mutate, makes one mutation of
# scripts/mutations.txt after another (or those named), builds, and runs tests until one fails. The judge is not mutated:
# it is what the rest is held against. Tests that compare hashes of bits are left out, since they notice any change.
# Prints a row of a Markdown table for each: the mutation, what noticed it, or SURVIVED; docs/mutation.md has the last
# full run. Exit 1 where a mutation does not apply (its text must be there exactly once) or does not compile. An hour or
# two on two cores.
set -u
cd "$(dirname "$0")/.." || exit 1
jobs=${JOBS:-2}
copy=build/mutate
tree=$copy/tree

# The tests of a group, fastest first; arguments after a colon.
tests_of() {
    query="test_query test_judge_check test_query_surface test_query_simplex test_judge test_query_trials:--rounds:5 test_query_trials_known"
    query="$query test_query_batch test_game_hulls test_query_refine"
    case $1 in
    query) echo "$query" ;;
    exact) echo "test_linear test_hull $query" ;;
    hull) echo "test_linear test_hull test_measures test_shape $query" ;;
    shape) echo "test_measures test_shape test_shape_file $query" ;;
    ellipsoid) echo "test_ellipsoid_contain test_ellipsoid_overlap test_ellipsoid_gap test_ellipsoid_exact test_ellipsoid_nearest test_ellipsoid_outer $query" ;;
    simd) echo "test_simd $query" ;;
    environment) echo "test_environment $query" ;;
    all) for group in exact hull shape ellipsoid simd environment; do tests_of $group; done | tr ' ' '\n' | sort -u ;;
    *) echo "mutate: no such group of tests: $1" >&2 && exit 2 ;;
    esac
}

# One line a mutation: name, group, file, from, to, breaks, between tabs.
list() {
    awk 'function flush() { if (name) printf "%s\t%s\t%s\t%s\t%s \t%s\n", name, tests, file, from, to, breaks
                            name = tests = file = from = to = breaks = "" }
         /^#/ || /^$/ { flush(); next }
         { key = $0; sub(/:.*/, "", key); value = substr($0, length(key) + 3) }
         key == "name" { name = value; tests = "query" } key == "tests" { tests = value } key == "file" { file = value }
         key == "from" { from = value } key == "to" { to = value } key == "breaks" { breaks = value }
         END { flush() }' scripts/mutations.txt
}

# apply FILE FROM TO: the one place of the text; 1 if it is not there exactly once.
apply() {
    FROM=$2 TO=$3 awk '{ text = text $0 "\n" }
        END { from = ENVIRON["FROM"]; at = index(text, from)
              if (!at || index(substr(text, at + 1), from)) exit 1
              printf "%s%s%s", substr(text, 1, at - 1), ENVIRON["TO"], substr(text, at + length(from)) }' \
        "$1" >$copy/mutated && cp $copy/mutated "$1"
}

# notice GROUP: builds and runs; prints which test noticed, or SURVIVED, or what stopped it.
notice() {
    for entry in $(tests_of "$1"); do
        test=${entry%%:*}
        arguments=$(echo "$entry" | cut -s -d: -f2- | tr : ' ')
        if ! cmake --build $copy/build -j "$jobs" --target "$test" >$copy/build.log 2>&1; then
            if grep -qE 'No rule to make target|unknown target' $copy/build.log; then continue; fi
            echo "does not compile"
            return
        fi
        # shellcheck disable=SC2086 # words of arguments
        if ! timeout 300 $copy/build/tests/"$test" $arguments >$copy/test.log 2>&1; then
            echo "$test"
            return
        fi
    done
    echo SURVIVED
}

mkdir -p $copy
rm -rf $tree
mkdir $tree
tar -cf - --exclude=./build --exclude='./.git*' . | tar -xf - -C $tree
generator=$(command -v ninja >/dev/null && echo "-G Ninja")
# shellcheck disable=SC2086 # none, or two words
cmake -S $tree -B $copy/build $generator -DCMAKE_BUILD_TYPE=None -DCMAKE_C_FLAGS=-O1 -DOVOID_IO=OFF >$copy/build.log 2>&1 || {
    cat $copy/build.log
    exit 1
}
# Without a mutation all must pass.
word=$(notice all)
if [ "$word" != SURVIVED ]; then
    echo "without a mutation: $word"
    tail -n 5 $copy/build.log $copy/test.log
    exit 1
fi

bad=0
echo "| mutation | file | what it breaks | noticed by |"
echo "|---|---|---|---|"
list >$copy/list
while IFS='	' read -r name group file from to breaks <&3; do
    if [ $# -gt 0 ]; then
        wanted=0
        for one in "$@"; do [ "$one" != "$name" ] || wanted=1; done
        [ $wanted -eq 1 ] || continue
    fi
    cp "$tree/$file" $copy/original
    if apply "$tree/$file" "$from" "${to% }"; then
        word=$(notice "$group")
    else
        word="DOES NOT APPLY"
    fi
    cp $copy/original "$tree/$file"
    case $word in "DOES NOT APPLY" | "does not compile") bad=1 ;; esac
    echo "| $name | \`${file#src/}\` | $breaks | $word |"
done 3<$copy/list
exit $bad
