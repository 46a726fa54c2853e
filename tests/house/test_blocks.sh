#!/bin/sh
# The code of the pages that is no whole program: each fragment of C compiles, below the declarations of blocks/fragments.h, and each of C++
# where Eigen is there; each option of a command line is one that the command has. Whole programs, sessions and Python are run elsewhere
# (examples/CMakeLists.txt, cli/test_cli.sh, python/tests/test_names.py). Truth: the compiler, the tool's own help. It can fail: a name and an option that are none are found.
set -u
# shellcheck source=tests/cli/need_tool.sh
. "$(dirname "$0")/../cli/need_tool.sh"
# shellcheck source=tests/common/steps.sh
. "$(dirname "$0")/../common/steps.sh"
cd "$OVOID_SOURCE_DIR" || exit 1
folder=$OVOID_BUILD_DIR/test_blocks
skipped=0
rm -rf "$folder"
mkdir -p "$folder"

# split PAGE LANGUAGE: the blocks of that language, but for those with a main, each into a file; the names of the files.
split() {
    awk -v language="$2" -v out="$folder/$(basename "$1" .md)" '
        $0 == "```" language { inside = 1; text = ""; next }
        /^```/ && inside { inside = 0; if (text !~ /int main/) { file = out "." ++n ".block"; printf "%s", text >file; close(file); print file }; next }
        inside { text = text $0 "\n" }' "$1"
}
# compile BLOCK PAGE: the fragment as the body of a function.
compile() {
    name=$(echo "$2" | tr - _)
    {
        echo "#define PAGE_$name"
        echo '#include "fragments.h"'
        echo "int fragment(void);"
        echo "int fragment(void) {"
        cat "$1"
        echo "return 0; }"
    } >"$folder/block.c"
    "${OVOID_CC:-cc}" -std=c17 -fsyntax-only -Wall -Werror -Wno-unused -Itests/house/blocks -Iinclude "$folder/block.c"
}
for page in docs/*.md; do
    for block in $(split "$page" c); do check "$page" compile "$block" "$(basename "$page" .md)"; done
done
check 'some fragments were there' [ $passed -ge 10 ]
echo 'ovoid_answer x = ovoid_distances(&pair, NULL, NULL);' >"$folder/none.block"
check 'a call of none is found' fails compile "$folder/none.block" none

# C++: includes stand first, the rest is the body of a function.
eigen=
for path in /usr/include/eigen3 /usr/local/include/eigen3; do [ -d $path ] && eigen=$path; done
compile_cpp() {
    { grep '^#include' "$1" && echo 'void fragment();' && echo 'void fragment() {' && grep -v '^#include' "$1" && echo '}'; } >"$folder/block.cpp"
    c++ -std=c++17 -fsyntax-only -Wall -Werror -Wno-unused -Iinclude -isystem "$eigen" "$folder/block.cpp"
}
if [ -n "$eigen" ] && command -v c++ >/dev/null; then
    for block in $(split docs/cpp.md cpp); do check docs/cpp.md compile_cpp "$block"; done
else
    skipped=1
    echo "skipped: no Eigen or no c++, so docs/cpp.md's fragment is not compiled"
fi

# Command lines: "ovoid COMMAND ..." or "ovoid robot COMMAND ..." at the beginning of a line of a block, without the prompt.
lines() {
    awk '/^```/ { inside = /console|sh/; next } inside || /^    ovoid / { sub(/^(    |\$ )/, ""); if (/^ovoid [a-z]/) print }' "$1" |
        sed 's/ #.*//; s/ *[|;>].*//'
}
# check_options COMMAND OPTION...: the command has each of them.
check_options() {
    # shellcheck disable=SC2086 # "robot path" are two words
    "$OVOID_TOOL" $1 --help >"$folder/help" || return 1
    shift
    for option; do
        grep -qE -- "(^|[ ,])$option([ ,=[]|\$)" "$folder/help" || { echo "no such option: $option" && return 1; }
    done
}
# check_line LINE: its options, long and short.
check_line() {
    # shellcheck disable=SC2086 # words of a command line
    set -- $1
    shift
    command=$1
    if [ "$1" = robot ]; then command="robot $2"; fi
    # shellcheck disable=SC2046 # options have no spaces
    check_options "$command" $(printf '%s\n' "$@" | grep -oE '^--?[a-z][a-z-]*' | sort -u)
}
before=$passed
for page in README.md docs/*.md; do
    lines "$page" >"$folder/lines"
    while IFS= read -r line; do check "$page: $line" check_line "$line"; done <"$folder/lines"
done
check 'some command lines were there' [ $((passed - before)) -ge 40 ]
check 'an option of none is found' fails check_line 'ovoid check scene.json --marging 3'
check 'a command of none is found' fails check_line 'ovoid chek scene.json'
echo "$passed passed, $failed failed, $skipped skipped"
[ "$failed" -eq 0 ]
