#!/bin/sh
# site.sh [FOLDER]: the documentation as a site, into FOLDER, by default build/site: to be opened from the disk or put on a server, with a
# search, without the network. Of the pages of docs/, the examples and the headers, by Sphinx and Doxygen; and with a live
# page of the demo's scene where build/demo has it. Exit 1 where Sphinx or Doxygen warns, or a link leads nowhere.
set -u
# shellcheck source=scripts/help.sh
. "$(dirname "$0")/help.sh"
cd "$(dirname "$0")/.." || exit 1
out=${1:-build/site}
work=$out.work
for tool in sphinx-build doxygen; do
    command -v $tool >/dev/null || { echo "site: $tool is not here: scripts/setup.sh site" >&2 && exit 1; }
done
rm -rf "$out" "$work"
mkdir -p "$out" "$work/pages"

# The headers.
{
    cat docs/Doxyfile
    echo "OUTPUT_DIRECTORY = \"$work\""
    echo "INPUT = docs/site/api.md include/ovoid include/ovoid/cpp"
    echo "USE_MDFILE_AS_MAINPAGE = docs/site/api.md"
    echo "GENERATE_TREEVIEW = NO"
    echo "GENERATE_XML = YES"
} | doxygen - >"$work/said.log" 2>&1 || { cat "$work/said.log" && exit 1; }
mv "$work/html" "$out/api"

# The live page of the demo, where that and the page's template were made.
if [ -f build/demo/scene.json ] && [ -x build/release/ovoid ] && [ -f build/release/page.html ]; then
    (cd build/demo && ../release/ovoid check scene.json --margin 0.5 --html demo.html >/dev/null 2>&1)
    mv build/demo/demo.html "$out/"
else
    echo "site: without the live page; scripts/demo.sh and scripts/page.sh make what it needs"
fi

# The pages. The same bytes for the same sources: no dates.
python3 docs/site/stage.py "$work/pages" "$work/xml" "$(ls "$out/demo.html" 2>/dev/null)" || exit 1
sphinx-build -q -W --keep-going -j 2 -c docs/site -d "$work/trees" "$work/pages" "$out" 2>"$work/sphinx.log" ||
    { cat "$work/sphinx.log" && exit 1; }
rm -rf "$out/.buildinfo" "$out/objects.inv"
# Debian's furo takes a sheet of another package from the server's /javascript; here it lies beside.
styles=$out/_static/styles
if grep -q 'url(/javascript/normalize.css/' "$styles/furo.css"; then
    cp /usr/share/javascript/normalize.css/normalize.css "$styles/" || exit 1
    sed -i 's|url(/javascript/normalize.css/|url(|' "$styles/furo.css"
fi
# Debian's furo is a module that the pages load as a plain script, and browsers refuse modules from the disk: the script that it imports, a
# plain one, is put before it.
furo=$out/_static/scripts/furo.js
if grep -q '^import Gumshoe from "./gumshoe-patched.js";$' "$furo"; then
    { cat "$out/_static/scripts/gumshoe-patched.js" && sed '/^import Gumshoe from/d' "$furo"; } >"$furo.new" && mv "$furo.new" "$furo" || exit 1
fi
scripts/check-links "$out" || exit 1
echo "$out/index.html: $(find "$out" -name '*.html' | wc -l) pages, $(du -sk "$out" | cut -f1) kB"
