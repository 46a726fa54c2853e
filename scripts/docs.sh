#!/bin/sh
# docs.sh [FOLDER]: the manual into FOLDER/html, by default build/docs. Exit 1 where Doxygen warns: a public function, type,
# value or macro without a word, a broken link; and where a link of a page leads nowhere. Fields are excepted: a struct's
# comment may explain them together.
set -u
# shellcheck source=scripts/help.sh
. "$(dirname "$0")/help.sh"
cd "$(dirname "$0")/.." || exit 1
out=${1:-build/docs}
rm -rf "$out/html"
mkdir -p "$out"
{ cat docs/Doxyfile && echo "OUTPUT_DIRECTORY = \"$out\""; } | doxygen - 2>"$out/said.log" || { cat "$out/said.log"; exit 1; }
if grep -v '(variable) of \(struct\|union\)' "$out/said.log"; then exit 1; fi
# What the pages link to beside pages: the examples, and the figures of the paper. In the manual all lie in one folder.
cp -R examples docs/paper "$out/html/" || exit 1
for page in "$out"/html/md_*.html; do
    sed 's|href="\.\./examples/|href="examples/|g' "$page" >"$out/page" && mv "$out/page" "$page" || exit 1
done
scripts/check-links "$out/html" || exit 1
echo "$out/html/index.html"
