#!/bin/sh
# page.sh: the template of the page of one scene, build/page/page.html and build/release/page.html, where the tool's --html
# finds it: three.js and the package of scripts/wasm.sh in one file. Then its tests in Chromium and Firefox, where these are installed; not with --template.
# --picture: no tests, but docs/page.png, the page of scripts/demo.sh as Chromium shows it.
# Exit 1 where something is missing or wrong; without npm's packages it says so and tests nothing.
set -eu
options="--check --template --picture"
# shellcheck source=scripts/help.sh
. "$(dirname "$0")/help.sh"
cd "$(dirname "$0")/.."
most=1500000
out=build/page

for tool in node npm; do
    command -v $tool >/dev/null || { echo "page: $tool is not here: scripts/setup.sh page" >&2 && exit 1; }
done
case ${1:-} in --check) scripts/wasm.sh --check ;; *) scripts/wasm.sh ;; esac
# In a copy, so that nothing is installed among the sources.
mkdir -p $out/web
rm -rf $out/web/page/src
cp -R web/package web/page $out/web/
if ! cmp -s web/page/package-lock.json $out/installed || [ ! -d $out/web/page/node_modules/three ]; then
    rm -f $out/installed
    if ! (cd $out/web/page && npm ci --no-audit --no-fund --ignore-scripts) >$out/npm.log 2>&1; then
        cat $out/npm.log >&2
        echo "page: npm could not install three.js and esbuild; the page is not built" >&2
        [ "${1:-}" = --check ] && echo "0 passed, 0 failed, 1 skipped" && exit 0
        exit 1
    fi
    cp web/page/package-lock.json $out/installed
fi
node $out/web/page/build.mjs build/wasm/package/ovoid.wasm $out/page.html
size=$(stat -c %s $out/page.html)
[ "$size" -le $most ] || { echo "page: $size bytes; at most $most" >&2 && exit 1; }
cp $out/page.html build/release/page.html
[ "${1:-}" = --template ] && exit 0
PLAYWRIGHT=$PWD/$out/web/page/node_modules/playwright-core/index.mjs && export PLAYWRIGHT
if [ "${1:-}" = --picture ]; then
    scripts/demo.sh >$out/demo.log
    node web/page/picture.mjs build/demo/demo.html docs/page.png
    size=$(stat -c %s docs/page.png)
    echo "docs/page.png: $size bytes"
    [ "$size" -le 200000 ] || { echo "page: more than 200000 bytes" >&2 && exit 1; }
    exit 0
fi

OVOID=$PWD/build/release/ovoid node --test web/page/test/*.test.mjs >$out/test.log 2>&1 || { cat $out/test.log >&2 && exit 1; }
grep -E '^# (pass|fail|skipped) ' $out/test.log | awk '{ n[$2] = $3 } END { printf "%d passed, %d failed, %d skipped\n", n["pass"], n["fail"], n["skipped"] }'
