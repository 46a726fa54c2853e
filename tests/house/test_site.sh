#!/bin/sh
# The site: it builds without a warning, no link of it leads nowhere, nothing of it comes from the network, every public function is in
# the index that its search reads, every page of docs/ and every example is on it, and the navigation has them all. Truth: the headers, the folders. It can fail: a
# page with a dead link, and one that is not listed, do not build.
set -u
# shellcheck source=tests/common/steps.sh
. "$(dirname "$0")/../common/steps.sh"
cd "$OVOID_SOURCE_DIR" || exit 1
site=$OVOID_BUILD_DIR/test_site
for tool in sphinx-build doxygen python3; do
    command -v $tool >/dev/null && continue
    echo "skipped: $tool is not here, so the site is not built"
    echo "0 passed, 0 failed, 1 skipped"
    exit 0
done
# The interpreter that Sphinx runs in.
if ! "$(sed -n '1s/^#! *//p' "$(command -v sphinx-build)")" -c 'import furo, myst_parser' 2>/dev/null; then
    echo "skipped: Sphinx has no MyST or no furo, so the site is not built"
    echo "0 passed, 0 failed, 1 skipped"
    exit 0
fi

check_empty 'the site builds' "$(scripts/site.sh "$site" 2>&1 | grep -v 'index.html: \|^site: without the live page')"
check_empty 'a front page' "$([ -s "$site/index.html" ] || echo 'none')"
check_empty 'nothing from the network, nor from the root of a server' "$(grep -rlE '(src|href)="(https?:)?//[^"]*\.(js|css|woff2?|png|svg)"|url\(["'\'']?(https?:)?/' "$site" --include='*.html' --include='*.css')"
# A browser loads it as a plain script, which may not import: Node.js reads files of this name as such scripts.
if command -v node >/dev/null; then
    check_empty 'the script of the theme is a plain one' "$(node --check "$site/_static/scripts/furo.js" 2>&1 && ! grep -n '^import ' "$site/_static/scripts/furo.js")"
fi

# The names of the headers' functions: what is declared with OVOID_API, and the C++ classes.
index=$site/searchindex.js
missing=
for name in $(grep -ohE 'OVOID_API [^(;]*\(' include/ovoid/*.h | grep -oE 'ovoid_[a-z0-9_]+\($' | tr -d '(' | sort -u); do
    grep -qE "[\"',{[]${name}[\"',:]" "$index" || missing="$missing $name"
    passed=$((passed + 1))
done
check_empty 'functions of C that the search does not find' "$missing"
for name in ovoid::shape::box ovoid::world::add ovoid::robot_cell distance find_hit; do
    check_empty "$name in the search" "$(grep -qE "[\"',{[]${name}[\"',:]" "$index" || echo 'is absent')"
done
for page in docs/*.md; do
    name=$(basename "$page" .md)
    check_empty "$page" "$([ -s "$site/$name.html" ] || echo 'is not on the site')"
done
for example in examples/*.c examples/*.cpp; do
    check_empty "$example" "$([ -s "$site/$example.html" ] || echo 'is not on the site')"
done

# What users ask finds the section that answers it. The rule is that of Sphinx's search, which puts a title first that holds the words and is at most
# twice as long.
if command -v node >/dev/null; then
    # shellcheck disable=SC2016 # JavaScript
    check_empty 'questions that the search does not answer' "$(node -e '
        const wanted = { license: "packaging#mit-license", deterministic: "design#deterministic-answers", "thread safe": "design#thread-safety",
            "contact points": "world#contact-points-for-an-engine", "convex hull of a point cloud": "polytope#convex-hull-of-a-point-cloud" };
        const Search = { setIndex: ({ docnames, alltitles }) => Object.entries(wanted).forEach(([words, place]) => {
            const found = Object.entries(alltitles).filter(([title]) => title.toLowerCase().includes(words) && words.length >= title.length / 2);
            if (!found.some(([, places]) => places.some(([page, anchor]) => `${docnames[page]}#${anchor}` === place))) console.log(words);
        }) };
        eval(require("fs").readFileSync(process.argv[1], "utf8"))' "$index" 2>&1)"
fi
check_empty 'an icon' "$([ -s "$site/_static/favicon.svg" ] || echo 'none')"
# Where there is a live page, the picture of the front page leads to it.
live=$OVOID_BUILD_DIR/test_site.live
rm -rf "$live"
check_empty 'the live page' "$(python3 docs/site/stage.py "$live" "$site.work/xml" demo.html 2>&1; grep -q '^<a href="demo.html">!\[' "$live/index.md" || echo 'has no link')"
rm -rf "$live"

# It can fail: a small site, which builds; then with a dead link, then with a page that is not listed.
small=$OVOID_BUILD_DIR/test_site.small
rm -rf "$small" && mkdir -p "$small/docs" "$small/include/ovoid/cpp" "$small/python/ovoid" "$small/examples"
cp -R scripts "$small/"
cp -R docs/site docs/Doxyfile docs/layout.xml docs/manual.css "$small/docs/"
cp include/ovoid/base.h "$small/include/ovoid/"
cp python/ovoid/__init__.pyi "$small/python/ovoid/"
for page in README CHANGELOG CONTRIBUTING docs/cpp docs/python; do echo "# $page" >"$small/$page.md"; done
{
    printf '# Small\n\n## Tutorials\n\n## Reference\n\n'
    for page in cpp python ../README ../CHANGELOG ../CONTRIBUTING; do echo "- [$page]($page.md)"; done
} >"$small/docs/index.md"
build_small() { (cd "$small" && scripts/site.sh out 2>&1); }
check_empty 'a small site' "$(build_small | grep -v 'index.html: \|^site: without the live page')"
echo '[nowhere](none.md)' >>"$small/docs/cpp.md"
check_empty 'a dead link' "$(build_small | grep -q 'none.md' || echo 'is not found')"
printf '# C++\n\n<a href="none.html">nowhere</a>\n' >"$small/docs/cpp.md"
check_empty 'a dead link that Sphinx does not know' "$(build_small | grep -q '^cpp.html: none.html leads nowhere' || echo 'is not found')"
echo '# C++' >"$small/docs/cpp.md"
echo '# Alone' >"$small/docs/alone.md"
check_empty 'a page that is not listed' "$(build_small | grep -q 'alone.md.*toctree' || echo 'is not found')"
rm -rf "$small"
echo "$passed passed, $failed failed, 0 skipped"
[ "$failed" -eq 0 ]
