#!/bin/sh
# ovoid run beside ovoid check: of random bodies that move, each frame's lines must be those of a scene with these poses,
# asked for all pairs without a broad phase. Impacts of fast bodies with thin ones, whose times are closed forms, whatever
# the number of frames. Every line's proof is checked.
set -u
# shellcheck source=tests/cli/need_tool.sh
. "$(dirname "$0")/need_tool.sh"
# shellcheck source=tests/common/steps.sh
. "$(dirname "$0")/../common/steps.sh"
work=$OVOID_BUILD_DIR/test_cli_run
rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 1
LC_ALL=C
export LC_ALL

# quiet COMMAND...: the tool, its words kept in a file.
quiet() { "$OVOID_TOOL" "$@" >said 2>&1; }

# ---- frames: 60 boxes, cones and compounds, 6 frames; of each frame a scene

awk 'BEGIN { srand(7); n = 60
    split("\"box\":[1,0.4,0.7]|\"cone\":{\"radius\":0.5,\"length\":1,\"sides\":7}|\"compound\":[{\"box\":[1,0.2,0.2]},{\"sphere\":0.3,\"pose\":{\"xyz\":[0.7,0,0]}}]", kind, "|")
    for (i = 0; i < n; i++) for (k = 0; k < 4; k++) p[i, k] = 4 * rand()
    print "time,body,x,y,z,qw,qx,qy,qz" >"moves.csv"
    for (f = 0; f < 6; f++) {
        name = "frame" f ".json"
        printf "{\"objects\":[" >name
        for (i = 0; i < n; i++) {
            # Every third body stays.
            if (i % 3 || !f) for (k = 0; k < 4; k++) p[i, k] += (rand() - 0.5) * 0.6
            if (i % 3 || !f) printf "%g,n%d,%.6f,%.6f,%.6f,1,%.6f,0.3,0\n", f / 4, i, p[i, 0], p[i, 1], p[i, 2], p[i, 3] >"moves.csv"
            printf "%s{\"name\":\"n%d\",%s,\"pose\":{\"xyz\":[%.6f,%.6f,%.6f],\"quat_wxyz\":[1,%.6f,0.3,0]}}", i ? "," : "", i, kind[i % 3 + 1], p[i, 0], p[i, 1], p[i, 2], p[i, 3] >name
        }
        print "],\"ignore\":[[\"n0\",\"n1\"],[\"n5\",\"n3\"]]}" >name
    } }'
"$OVOID_TOOL" run frame0.json --motion moves.csv --margin 0.2 --csv 2>/dev/null | tail -n +2 >run.csv
for f in 0 1 2 3 4 5; do
    time=$(awk "BEGIN { print $f / 4 }")
    awk -F, -v time="$time" '$1 == time' run.csv | cut -d, -f 2-6,10- | sort >got
    # A bracket that begins above the margin is farther. The limit is also that of the margin, and is left out.
    "$OVOID_TOOL" check frame$f.json --csv 2>/dev/null | tail -n +2 | awk -F, '$9 <= 0.2' | cut -d, -f 1-5,9- | sort >wanted
    check "frame $f has pairs" [ -s wanted ]
    check "frame $f" cmp -s got wanted
done
"$OVOID_TOOL" run frame0.json --motion moves.csv --margin 0.2 --continuous --json -o run.jsonl 2>/dev/null
check 'impacts are found' grep -q free_for run.jsonl
# None is undecided: cones are the true ones.
"$OVOID_TOOL" verify run.jsonl frame0.json --motion moves.csv --continuous --json >said 2>&1
check 'no undecided results' [ $? -eq 0 ]
check 'proofs of frames and impacts' grep -q '"fail":0,"undecided":0.*"missing":0,"beyond":[1-9][0-9]*,"impacts_missing":0' said
# One impact less, and one result.
for gone in 107 110; do
    sed "${gone}d" run.jsonl | "$OVOID_TOOL" verify - frame0.json --motion moves.csv --continuous --json >said 2>&1
    check "without impact $gone" grep -q '"missing":0,.*"impacts_missing":1' said
done
sed 17d run.jsonl | "$OVOID_TOOL" verify - frame0.json --motion moves.csv --json >said 2>&1
check 'without a result' grep -q '"fail":0,.*"missing":1,' said
# The pairs that are within the margin in a frame and were not in the one before have an impact in between.
awk -F, -v OFS=, '{ print $1, $2, $4 }' run.csv >near.txt
"$OVOID_TOOL" run frame0.json --motion moves.csv --margin 0.2 --continuous --csv 2>/dev/null | awk -F, 'NR > 1 && $2 != "" { print $2 + 0.25 "," $5 "," $7 }' >impacts.txt
awk -F, 'NR == FNR { hit[$0] = 1; next }
    { key = $2 "," $3; if ($1 > 0 && !((key "," $1 - 0.25) in near) && !($0 in hit)) { print "no impact: " $0; bad = 1 }; near[key "," $1] = 1 }
    END { exit bad }' impacts.txt near.txt
check 'each pair that comes near has its impact' [ $? -eq 0 ]

# ---- tunnels: a ball of radius 0.1 at speed 1000 through a plate 0.001 thick at x = 500: contact at (500 - 0.0005 - 0.1) / 1000

printf '{"objects":[{"name":"plate","box":[0.001,4,4],"pose":{"xyz":[500,0,0]}},{"name":"ball","sphere":0.1},
{"name":"needle","box":[40,0.01,0.01],"pose":{"xyz":[0,0,30]}},{"name":"post","box":[0.01,0.01,1],"pose":{"xyz":[0,15,30]}}]}\n' >fast.json
printf 'time,body,x,y,z,qw,qx,qy,qz\n0,ball,0,0,0,1,0,0,0\n1,ball,1000,0,0,1,0,0,0\n' >poses.csv
printf 'time,body,vx,vy,vz,wx,wy,wz\n0,ball,1000,0,0,0,0,0\n0,needle,0,0,0,0,0,62.83185307179586\n1,ball,0,0,0,0,0,0\n' >speeds.csv
# hit MOTION A B TRUTH: the bracket of the impact holds the truth, and is narrow.
hit() {
    "$OVOID_TOOL" run fast.json --motion "$1" --query collide --continuous --csv 2>/dev/null | awk -F, -v a="$2" -v b="$3" -v truth="$4" '
        $5 == a && $7 == b { found = 1; good = $3 <= truth + 1e-15 && truth <= $4 + 1e-15 && $4 - $3 < 1e-8 }
        END { if (!(found && good)) print "no impact of " a " and " b " at " truth; exit !(found && good) }'
}
check 'no contact in the frames' quiet run fast.json --motion poses.csv
check 'a ball through a plate, poses' hit poses.csv plate ball 0.4998995
check 'a ball through a plate, velocities' hit speeds.csv plate ball 0.4998995
# The needle turns ten times a second; its lower long edge, at half the width w below its middle, meets the post at an angle
# close to a quarter turn: the impact is before 1/40 by less than the width of both seen from the middle.
"$OVOID_TOOL" run fast.json --motion speeds.csv --query collide --continuous --csv 2>/dev/null | awk -F, '
    $5 == "needle" && $7 == "post" { found = $4 > 1 / 40 - 0.02 / 15 / 62.8 && $4 < 1 / 40 } END { exit !found }'
check 'a needle that spins meets a post' [ $? -eq 0 ]
"$OVOID_TOOL" run fast.json --motion speeds.csv --query collide --continuous --json -o fast.jsonl 2>/dev/null
check 'proofs of fast impacts' quiet verify fast.jsonl fast.json --motion speeds.csv --query collide --continuous

echo "$passed passed, $failed failed, 0 skipped"
[ $failed -eq 0 ]
