#!/bin/sh
# demo.sh: six real meshes (Debian's libcgal-demo, CC0) fitted, posed in a scene, every pair answered and proven, the
# scene drawn. Everything it writes is in build/demo.
set -eu
cd "$(dirname "$0")/.."
tool=build/release/ovoid
demo=build/demo
meshes="elephant cow camel bull mushroom knot1"
archive=usr/share/doc/libcgal-dev/data.tar.gz
mkdir -p $demo

# Images of Debian for containers leave out /usr/share/doc; then the package itself is opened here.
if [ ! -f /$archive ] && [ ! -f $demo/package/$archive ]; then
    (cd $demo && apt-get -qq download libcgal-demo && dpkg-deb -x libcgal-demo_*.deb package) ||
        { echo "demo: libcgal-demo has no /$archive here and could not be downloaded" >&2 && exit 1; }
fi
[ -f /$archive ] && archive=/$archive || archive=$demo/package/$archive
for mesh in $meshes; do echo "data/meshes/$mesh.off"; done >$demo/list
tar -xzf $archive -C $demo --strip-components=2 --files-from=$demo/list
cp examples/demo/scene.json $demo/scene.json

# title TEXT: what the next lines are.
title() { printf '\n== %s\n\n' "$1"; }

title "Fit: the smallest ellipsoid around each mesh's hull and the largest inside"
# shellcheck disable=SC2046 # a list of names
(cd $demo && "../../$tool" fit $(for mesh in $meshes; do echo "$mesh.off"; done))

title "Check: every pair of the scene, nearest first; lower <= d <= upper, and what decided"
# Exit code 1 says that some pair touches, as some do here.
$tool check $demo/scene.json || [ $? -eq 1 ]

title "Verify: the proof of every pair, without the search"
$tool check --json $demo/scene.json >$demo/results.jsonl || [ $? -eq 1 ]
$tool verify $demo/results.jsonl $demo/scene.json

$tool view $demo/scene.json -o $demo/scene.svg
title "Look"
cat <<END
the picture           $demo/scene.svg
the scene             $demo/scene.json (change a pose and run: $tool check $demo/scene.json)
the proofs            $demo/results.jsonl
the tool              $tool --help
END
