#!/bin/sh
# bench.sh: the package for JavaScript beside the native library, Rapier and Jolt, as a table; their packages come from npm
# into build/bench_web. Some minutes. Exit 1 where something is missing.
set -eu
# shellcheck source=scripts/help.sh
. "$(dirname "$0")/../../scripts/help.sh"
cd "$(dirname "$0")/../.."
out=build/bench_web
for tool in node npm; do
    command -v $tool >/dev/null || { echo "bench: $tool is not here: scripts/setup.sh page" >&2 && exit 1; }
done
scripts/wasm.sh >&2
cmake --build build/release --target bench_web >/dev/null
mkdir -p $out
cp bench/web/package.json $out/
(cd $out && npm install --no-audit --no-fund --ignore-scripts --no-package-lock) >$out/npm.log 2>&1 || { cat $out/npm.log >&2 && exit 1; }
BENCH_WEB=$PWD/build/release/bench/bench_web node bench/web/bench.mjs $out
