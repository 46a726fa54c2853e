#!/bin/sh
# Results of `ovoid distance` about solids with one number or word changed: `ovoid verify` must refuse each of them, and
# accept what was not changed. Truth: each change claims something false, or something that its proof does not show. The
# answers are a distance, an overlap of crossing triangles, a solid inside another, and one whose faces are flush; limits, stages and counts
# of iterations claim nothing.
set -u
# shellcheck source=tests/cli/need_tool.sh
. "$(dirname "$0")/need_tool.sh"
# shellcheck source=tests/cli/altered.sh
. "$(dirname "$0")/altered.sh"
work=$OVOID_BUILD_DIR/test_cli_altered_solids
rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 1
printf 'v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 1\nv 2 0 1\nv 2 1 1\nv 1 1 1\nv 1 2 1\nv 0 2 1\n' >l.obj
printf 'f 4 3 2 1\nf 6 5 4 1\nf 7 8 9 10\nf 7 10 11 12\nf 1 2 8 7\nf 2 3 9 8\nf 3 4 10 9\nf 4 5 11 10\nf 5 6 12 11\nf 6 1 7 12\n' >>l.obj
printf 'v 0 0 0\nv 0.5 0 0\nv 0 0.5 0\nv 0 0 0.5\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' >tet.obj

# hold CODE NAME: what verify must say of altered.jsonl, of the two solids.
hold() { expect "$1" "$2" altered.jsonl l.obj tet.obj --solid --pose-b "$pose"; }

# vary CODE NAME PROGRAM: of line.jsonl after a sed program.
vary() { alter "$1" "$2" "$3" line.jsonl l.obj tet.obj --solid --pose-b "$pose"; }

n='[-+0-9.e]+'
# ask POSE NAME: the answer with the second body there, unaltered, and altered where all answers have something.
ask() {
    pose=$1
    "$OVOID_TOOL" distance l.obj tet.obj --solid --pose-b "$pose" --json -o line.jsonl
    cp line.jsonl altered.jsonl
    hold 0 "$2"
    vary 4 "$2, lower" "s/(\"lower\":)$n(,\"upper\":)($n)(,\"point)/\\1\\3\\2\\3\\4/"
    vary 4 "$2, upper" "s/(\"lower\":)($n)(,\"upper\":)$n(,\"point)/\\1\\2\\3\\2\\4/"
    vary 4 "$2, status" 's/"status":"separated","limit":"none"/"status":"overlapping","limit":"none"/; t; s/"overlapping"/"separated"/'
    vary 4 "$2, touching" 's/"status":"[a-z]+"/"status":"touching"/'
    vary 4 "$2, point of a" "s/\"point_a\":\\[$n,/\"point_a\":[0.0625,/"
    vary 4 "$2, point of b" "s/(\"point_b\":\\[$n,)$n,/\\10.0625,/"
    vary 4 "$2, normal" 's/"normal":\[[^]]*\]/"normal":[0.6,0.48,0.64]/'
    vary 4 "$2, proof" 's/"proof":\{"normal":\[[^]]*\]/"proof":{"normal":[0.6,0.48,0.64]/'
    vary 4 "$2, proof of points" 's/"kind":"[a-z_ ]+"/"kind":"none"/'
    vary 4 "$2, triangle of a" 's/"triangle_a":[0-9]+/"triangle_a":13/'
    vary 4 "$2, no such triangle" 's/"triangle_b":[0-9]+/"triangle_b":4/'
    vary 4 "$2, other bodies" 's/"b":"tet.obj"/"b":"l.obj"/'
    vary 4 "$2, kind" 's/"kind_a":"solid"/"kind_a":"surface"/'
    vary 3 "$2, hull" 's/"kind_a":"solid"/"kind_a":"hull"/'
    vary 4 "$2, volume" 's/"mesh_volume_a":3,/"mesh_volume_a":3.000000000000001,/'
    vary 4 "$2, volume of the hull" 's/"hull_volume_a":3[.][0-9]*/"hull_volume_a":3/'
    vary 4 "$2, no volume" 's/"mesh_volume_b":[0-9.]+/"mesh_volume_b":null/'
    vary 4 "$2, surfaces' lower" "s/(\"surfaces\":.*\"lower\":)$n,\"upper\":($n)/\\1\\2,\"upper\":\\2/"
    vary 4 "$2, surfaces' upper" "s/(\"surfaces\":.*\"lower\":)($n),\"upper\":$n/\\1\\2,\"upper\":\\2/"
    vary 4 "$2, no exclusions" 's/,"exclusions":\[.*\],"surfaces"/,"surfaces"/'
    vary 4 "$2, an exclusion's range" 's/("exclusions":\[\{"a":\[0,)[0-9]+/\199/'
    vary 4 "$2, an empty exclusion" 's/("exclusions":\[\{"a":\[)[0-9]+,[0-9]+/\10,0/'
    vary 4 "$2, an exclusion's normal" 's/("exclusions":\[[^]]*\],[^]]*\],"normal":\[)[^]]*/\10,0,0/'
    vary 3 "$2, no surfaces" 's/,"surfaces":\{[^}]*\}//'
    vary 3 "$2, no kinds" 's/,"(kind|mesh_volume|hull_volume)_[ab]":("[a-z]+"|[0-9.]+)//g'
    vary 3 "$2, no triangle" 's/,"triangle_a":[0-9]+//'
    vary 3 "$2, surfaces' status" 's/("surfaces":\{"status":)"[a-z]+"/\1"near"/'
    vary 3 "$2, inside of what" 's/"lower"/"inside":"c in b","component":0,"lower"/; s/("inside":"b in a","component":0,)"inside":"c in b","component":0,/\1"inside":"c in b",/'
    # Some of the exclusions claim more than their normals show, or are below the answer's bound.
    count=$(grep -o '"lower":' line.jsonl | wc -l)
    i=2
    while [ $i -lt "$count" ]; do
        vary 4 "$2, exclusion $i" "s/\"lower\":$n/\"lower\":3/$i"
        vary 4 "$2, exclusion $i, low" "s/\"lower\":$n/\"lower\":-9/$i"
        i=$((i + 5))
    done
    vary 3 "$2, cut off" 's/.{20}$//'
}

ask "1.25 1.25 0.25" apart
vary 4 "apart, points" 's/"point_a"(.*)"point_b"/"point_b"\1"point_a"/'
vary 4 "apart, one exclusion less" 's/"exclusions":\[\{[^}]*\},/"exclusions":[/'
vary 3 "apart, parting" 's/"surfaces":/"parting":[1,0,0],"surfaces":/'
vary 4 "apart, inside" 's/"none",/"none","inside":"b in a","component":0,/'
ask "1.8 0.3 0.3" crossing
vary 4 "crossing, inside" 's/"none",/"none","inside":"b in a","component":0,/'
vary 4 "crossing, parting" 's/"parting":\[[^]]*\]/"parting":[0.6,0.48,0.64]/'
vary 3 "crossing, no parting" 's/,"parting":\[[^]]*\]//'
ask "0.25 0.25 0.25" inside
vary 4 "inside, points" 's/"point_a"(.*)"point_b"/"point_b"\1"point_a"/'
vary 4 "inside, the other way" 's/b in a/a in b/'
vary 4 "inside, no such component" 's/"component":0/"component":1/'
vary 4 "inside, nothing" 's/"inside":"b in a","component":0,//'
vary 4 "inside, parting" 's/"parting":\[[^]]*\]/"parting":[0.6,0.48,0.64]/'
vary 4 "inside, one exclusion less" 's/"exclusions":\[\{[^}]*\},/"exclusions":[/'
ask "0 0 0" flush
vary 4 "flush, inside instead" 's/"common point","common":\[[^]]*\]/"b in a","component":0/'
vary 4 "flush, nothing" 's/"inside":"common point","common":\[[^]]*\],//'
vary 4 "flush, the point outside" 's/"common":\[[^]]*\]/"common":[1.5,1.5,0.5]/'
vary 4 "flush, the point on the surface" 's/"common":\[[^]]*\]/"common":[0,0.1,0.1]/'
vary 4 "flush, the point nearer to it" 's/"common":\[[^]]*\]/"common":[0.03125,0.125,0.125]/'
vary 3 "flush, no point" 's/,"common":\[[^]]*\]//'
vary 3 "flush, and a component" 's/"common":/"component":0,"common":/'
vary 3 "flush, two numbers" 's/"common":\[[^]]*\]/"common":[0.1,0.1]/'
ask "0.25 0.25 0.25" inside
# Right, and of other bodies: the hulls, the same elsewhere, scaled.
cp line.jsonl altered.jsonl
for options in "--hull" "--scale 2" "--parts"; do
    # shellcheck disable=SC2086
    "$OVOID_TOOL" verify line.jsonl l.obj tet.obj $options --pose-b "$pose" >out 2>&1
    if [ $? -eq 4 ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED $options"
        cat out
    fi
done
pose="0.25 0.3 0.25"
hold 4 "elsewhere"
echo "$passed passed, $failed failed, 0 skipped"
[ "$failed" -eq 0 ]
