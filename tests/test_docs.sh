#!/bin/sh
# The pages: every relative link in a Markdown file leads to a file, and docs/index.md lists every page of docs/.
set -u
cd "$OVOID_SOURCE_DIR" || exit 1
passed=0 failed=0
for page in *.md docs/*.md; do
    # Links of the form ](target), without those to other hosts and to places within a page.
    # shellcheck disable=SC2013 # targets have no spaces
    for target in $(grep -o ']([^)]*)' "$page" | sed 's/^](//; s/)$//; s/#.*//' | grep -v '^[a-z]*:'); do
        if [ -e "$(dirname "$page")/$target" ]; then
            passed=$((passed + 1))
        else
            failed=$((failed + 1))
            echo "FAILED $page: no such file: $target"
        fi
    done
done
for page in docs/*.md; do
    name=$(basename "$page")
    if [ "$name" = index.md ] || grep -q "]($name)" docs/index.md; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED docs/index.md does not list $name"
    fi
done
echo "$passed passed, $failed failed, 0 skipped"
[ "$failed" -eq 0 ]
