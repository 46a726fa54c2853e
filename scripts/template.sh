#!/bin/sh
# template.sh FOLDER: the template of the pages that --html writes, as FOLDER/page.html, from scripts/page.sh. It is built anew where its sources
# are newer. Where a tool for it is not here, or npm has no network, one sentence says so: the rest of ovoid works without it.
set -eu
# shellcheck source=scripts/help.sh
. "$(dirname "$0")/help.sh"
cd "$(dirname "$0")/.."
built=build/page/page.html

say() { echo "template: --html has no page yet: $1; \"make page\" installs what is missing and builds it" >&2; }
is_fresh() { [ -f $built ] && [ -z "$(find web/page/src web/package web/src src include -newer $built -type f -print -quit)" ]; }
for tool in node npm clang wasm-ld; do
    command -v $tool >/dev/null || { say "$tool is not here" && exit 0; }
done
mkdir -p build "$1"
if ! is_fresh && ! scripts/page.sh --template >build/template.log 2>&1; then
    say "it could not be built, see build/template.log"
    exit 0
fi
cmp -s $built "$1/page.html" || cp $built "$1/page.html"
