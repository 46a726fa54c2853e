#!/bin/sh
# wasm.sh: the package for JavaScript, in build/wasm/package and packed as build/wasm/ovoid-VERSION.tgz, at most 385 kB; its
# tests under Node.js, which compare it with build/release/ovoid bit by bit. --check also bundles it by four bundlers and checks its types by TypeScript,
# where npm has its registry. Exit 1 where something is missing or wrong.
set -eu
options=--check
# shellcheck source=scripts/help.sh
. "$(dirname "$0")/help.sh"
cd "$(dirname "$0")/.."
jobs=${JOBS:-2} most=385000
out=build/wasm

for tool in clang wasm-ld wasm-opt zopfli node; do
    command -v $tool >/dev/null || { echo "wasm: $tool is not here: scripts/setup.sh wasm" >&2 && exit 1; }
done
build() {
    cmake -S . -B $out/cmake -DCMAKE_TOOLCHAIN_FILE="$PWD/cmake/ports/wasm32.cmake" -DCMAKE_BUILD_TYPE=MinSizeRel -DOVOID_WEB=ON \
        -DOVOID_SHARED=OFF -DOVOID_IO=OFF -DOVOID_CLI=OFF -DOVOID_JUDGE=OFF -DOVOID_TESTS=OFF -DOVOID_BENCH=OFF -DOVOID_EXAMPLES=OFF \
        -DOVOID_PYTHON=OFF -DOVOID_INSTALL=OFF -DOVOID_ONE_OBJECT=OFF -DOVOID_WERROR=ON && cmake --build $out/cmake -j"$jobs" --target ovoid_wasm
}
mkdir -p $out
build >$out/build.log 2>&1 || { cat $out/build.log >&2 && exit 1; }

rm -rf $out/package
mkdir -p $out/package
cp web/package/* LICENSE $out/package/
# Binaryen's passes keep every answer's bits: it reorders no operation on floats.
wasm-opt -Oz -Oz --enable-simd --enable-bulk-memory --enable-sign-ext --enable-mutable-globals --enable-nontrapping-float-to-int \
    $out/cmake/web/ovoid.wasm -o $out/package/ovoid.wasm
version=$(sed -n 's/^ *"version": "\(.*\)",$/\1/p' web/package/package.json)
[ "$version" = "$(build/release/ovoid --version | sed 's/^ovoid //;q')" ] || { echo "wasm: package.json says $version, the tool another version" >&2 && exit 1; }
# zopfli writes gzip's format in a twentieth less than gzip -9.
tar -C $out --sort=name --mtime=@0 --owner=0 --group=0 --numeric-owner -cf $out/package.tar package
zopfli --i5 -c $out/package.tar >"$out/ovoid-$version.tgz"
rm -f $out/package.tar
size=$(stat -c %s "$out/ovoid-$version.tgz")
printf '%s: %s bytes, ovoid.wasm in it %s\n' "$out/ovoid-$version.tgz" "$size" "$(stat -c %s $out/package/ovoid.wasm)"
[ "$size" -le $most ] || { echo "wasm: more than $most bytes" >&2 && exit 1; }

# The bundlers of its tests, in a copy, so that nothing is installed among the sources; without a registry their tests are skipped.
if [ "${1:-}" = --check ]; then
    bundlers=$out/bundlers
    mkdir -p $bundlers
    cp web/test/bundlers/* $bundlers/
    if ! cmp -s $bundlers/package-lock.json $bundlers/installed; then
        rm -f $bundlers/installed
        if (cd $bundlers && npm install --no-save --no-audit --no-fund --ignore-scripts) >$out/npm.log 2>&1; then
            cp web/test/bundlers/package-lock.json $bundlers/installed
        else
            echo "wasm: npm could not install the bundlers ($out/npm.log): their tests are skipped"
        fi
    fi
    if [ -f $bundlers/installed ]; then
        rm -rf $bundlers/node_modules/ovoid
        cp -R $out/package $bundlers/node_modules/ovoid
        BUNDLERS=$PWD/$bundlers && export BUNDLERS
    fi
fi
OVOID=$PWD/build/release/ovoid node --test web/test/*.test.mjs >$out/test.log 2>&1 || { cat $out/test.log >&2 && exit 1; }
grep -E '^# (pass|fail|skipped) ' $out/test.log | awk '{ n[$2] = $3 } END { printf "%d passed, %d failed, %d skipped\n", n["pass"], n["fail"], n["skipped"] }'
