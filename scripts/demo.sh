#!/bin/sh
# demo.sh: six real meshes (Debian's libcgal-demo, CC0) fitted, posed in a scene, every pair answered and proven, one of
# them moved through the others, the scene drawn. OVOID_TOOL: another tool than build/release/ovoid; OVOID_DEMO: another folder than build/demo.
set -eu
# shellcheck source=scripts/help.sh
. "$(dirname "$0")/help.sh"
cd "$(dirname "$0")/.."
root=$PWD
tool=${OVOID_TOOL:-build/release/ovoid}
demo=${OVOID_DEMO:-build/demo}
meshes="elephant cow camel bull mushroom knot1"
archive=usr/share/doc/libcgal-dev/data.tar.gz
mkdir -p "$demo"
cp examples/demo/scene.json "$demo"
cd "$demo"

# Images of Debian for containers leave out /usr/share/doc; then the package itself is opened here.
if [ -f /$archive ]; then
    archive=/$archive
elif [ ! -f $archive ]; then
    echo "fetching the meshes: Debian's libcgal-demo"
    { apt-get -qq download libcgal-demo && dpkg-deb -x libcgal-demo_*.deb .; } ||
        { echo "demo: libcgal-demo has no /$archive here and could not be downloaded" >&2 && exit 1; }
fi
echo "unpacking the meshes: $meshes"
files=
for mesh in $meshes; do
    tar -xOzf $archive "data/meshes/$mesh.off" >"$mesh.off"
    files="$files $mesh.off"
done

# ovoid ARGUMENT...: the tool; its code 1 says that some pair touches, as some do here.
case $tool in /*) ;; *) tool_path=$root/$tool ;; esac
ovoid() { "${tool_path:-$tool}" "$@" || [ $? -eq 1 ]; }
# Without the warnings about hulls, which the first step has shown.
warned() { grep -v '^ovoid: warning: .* is not convex'; }
title() { printf '\n== %s\n\n' "$1"; }

echo "they are not convex: closed ones are taken as they are, the others by their hulls; ellipsoids are those of the hulls"

title "Fit: the smallest ellipsoid around each mesh's hull and the largest inside"
# shellcheck disable=SC2086 # a list of names
ovoid fit --table $files

title "Check: every pair of the scene, nearest first; lower <= d <= upper, and what decided"
ovoid check scene.json 2>&1 | warned

title "Verify: the proof of every pair, in exact arithmetic, without the search"
ovoid check --json scene.json >results.jsonl 2>check.log
ovoid verify results.jsonl scene.json

title "Run: the knot tumbles through the others, all by their hulls; first contact and smallest distance, between frames too"
awk 'BEGIN { print "time,body,vx,vy,vz,wx,wy,wz"
    for (i = 0; i <= 90; i++) printf "%g,knot,-0.9,-0.75,-0.35,1,2,4\n", i / 60 }' >motion.csv
ovoid run scene.json --hull --motion motion.csv --margin 0.4 --continuous --json -o motion.jsonl --plot motion.svg 2>&1 | warned
ovoid verify motion.jsonl scene.json --hull --motion motion.csv

title "View: the scene, its ellipsoids and witness points"
ovoid view scene.json -o scene.svg && echo "scene.svg: $(wc -c <scene.svg) bytes"

page=
if [ -f "$root/build/release/page.html" ]; then
    title "Page: the same for the browser, with the proofs to be checked there"
    OVOID_PAGE=$root/build/release/page.html ovoid check scene.json --margin 0.5 --html demo.html >/dev/null 2>&1
    page="
the page              $demo/demo.html"
fi

title "Look"
cat <<END
the picture           $demo/scene.svg
the motion's plot     $demo/motion.svg
the scene             $demo/scene.json (change a pose, then: $tool check $demo/scene.json)
the proofs            $demo/results.jsonl$page
the tool              $tool --help
END
