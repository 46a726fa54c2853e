#!/bin/sh
# The pages: every relative link in a Markdown file leads to a file, every source file that a page names is there, every
# public function or type that it names is in a header, docs/index.md lists every page of docs/, and ten questions of users have a page. The manual made of them
# has no dead link and no two pages of one title; a page with a dead link, made here, is found.
set -u
# shellcheck source=tests/common/steps.sh
. "$(dirname "$0")/../common/steps.sh"
cd "$OVOID_SOURCE_DIR" || exit 1
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

# check_known KIND LIST: reads lines "PAGE NAME"; the name, or what ends in it after a slash, must be a line of the list.
check_known() {
    while read -r page name; do
        if grep -qE "(^|/)$name\$" "$2"; then
            passed=$((passed + 1))
        else
            failed=$((failed + 1))
            echo "FAILED $page: no such $1: $name"
        fi
    done
}
known=$OVOID_BUILD_DIR/test_docs
find . -path ./build -prune -o -type f -print >"$known.files"
grep -rohE '\bOVOID_[A-Z0-9_]+|\bovoid_[a-z0-9_]+' include cmake | sort -u >"$known.names"
# shellcheck disable=SC2016 # backquotes of Markdown
grep -HoE '`[A-Za-z0-9_/.-]+\.(c|h|hpp|sh|txt)`' docs/*.md README.md | tr -d '`' | tr : ' ' | grep -vE ' (\.|<)' >"$known.paths"
check_known "file" "$known.files" <"$known.paths"
# shellcheck disable=SC2016
grep -HoE '`ovoid_[a-z0-9_]+[(`]' docs/*.md README.md | tr -d '`(' | tr : ' ' >"$known.used"
check_known "name" "$known.names" <"$known.used"
[ -s "$known.paths" ] && [ -s "$known.used" ] && passed=$((passed + 1))

for page in docs/*.md; do
    name=$(basename "$page")
    if [ "$name" = index.md ] || grep -q "]($name)" docs/index.md; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED docs/index.md does not list $name"
    fi
done
# Ten questions of users: the page that answers each has its words in a heading, which the site's search puts first, and docs/index.md names it.
# answers HEADING PAGE: the page has a heading with these words, and the table of questions leads there.
answers() {
    if grep -qi "^#.*$1" "docs/$2" && grep -q "^|.*]($2) |\$" docs/index.md; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED docs/$2 has no heading with \"$1\", or the questions of docs/index.md do not lead there"
    fi
}
answers 'contact points for an engine' world.md
answers eigen cpp.md
answers fetchcontent packaging.md
answers 'thread safety' design.md
answers units first-steps.md
answers 'convex hull of a point cloud' polytope.md
answers 'warm start' pairs.md
answers deterministic design.md
answers coal coming-from-fcl.md
answers license packaging.md
# ---- the manual

skipped=0
if command -v doxygen >/dev/null; then
    check_empty 'the manual' "$(scripts/docs.sh "$known.manual" 2>&1 | grep -v 'index.html$')"
    check_empty 'two pages of one title' "$(grep -hoE '<li><span class="arrow">[^<]*</span>|<tr[^>]*><td class="entry">.*</td>' "$known.manual/html/pages.html" |
        sed 's/<[^>]*>//g; s/&#160;//g' | sort | uniq -d)"
else
    skipped=1
    echo "skipped: no doxygen, so the manual is not made"
fi
rm -rf "$known.dead" && mkdir -p "$known.dead/below"
echo '<a href="below/b.html#there">b</a> <a href="below/b.html">b</a> <a href="https://example.org">far</a>' >"$known.dead/a.html"
echo '<h1 id="there">b</h1> <a href="../a.html">a</a>' >"$known.dead/below/b.html"
check_empty 'good links' "$(scripts/check-links "$known.dead")"
for link in c.html below/b.html#here below/../b.html '#a'; do
    echo "<a href=\"$link\">x</a>" >"$known.dead/c0.html"
    check_empty "the dead link $link" "$(scripts/check-links "$known.dead" | grep -q "^c0.html: $link leads nowhere\$" || echo 'is not found')"
done
echo "$passed passed, $failed failed, $skipped skipped"
[ "$failed" -eq 0 ]
