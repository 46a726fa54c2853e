#!/bin/sh
# planned_proofs.sh [PROBLEMS]: proofs of the motions that a planner accepted. bench_planner plans that many of
# MotionBenchMaker's problems (default 7) for the Panda and for the Fetch, spread over all, by RRTConnect with ovoid's
# motions, shortens the paths, and writes every motion that was accepted on the way. `ovoid robot path --edges --proofs`
# proves each again, with steps, and `ovoid verify` checks the steps without a search. Exit 1 where a motion is not
# free or a proof does not hold. The robots are those of OVOID_DATA or ../shared/data.
set -eu
# shellcheck source=scripts/help.sh
. "$(dirname "$0")/help.sh"
build=${BUILD:-$(cd "$(dirname "$0")/.." && pwd)/build/release}
data=${OVOID_DATA:-$(cd "$(dirname "$0")/.." && pwd)/../shared/data}/robots
for program in "$build/ovoid" "$build/bench/bench_planner"; do
    [ -x "$program" ] || { echo "planned_proofs.sh: $program is not there; bench_planner needs OMPL and FCL" >&2; exit 2; }
done
[ -d "$data" ] || { echo "planned_proofs.sh: there are no robots in $data; OVOID_DATA names the folder of data" >&2; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fails=0
mkdir "$work/edges" "$work/panda" "$work/fetch"
"$build/bench/bench_planner" --alone --scenes "${1:-7}" --edges "$work/edges" --data "${data%/robots}"
tar -xjf "$data/panda/mbm_problems.tar.bz2" -C "$work/panda" --wildcards '*/scene*.yaml'
tar -xjf "$data/fetch_mbm/problems.tar.bz2" -C "$work/fetch" --wildcards '*/scene*.yaml'

# ROBOT-FAMILY-SCENE.csv holds the motions in the scene FAMILY/SCENE.yaml. bench_planner takes its obstacles alone: the
# scene's matrix of allowed pairs lists the links of another model of the Fetch.
for edges in "$work"/edges/*.csv; do
    name=$(basename "$edges" .csv)
    robot=${name%%-*}
    scene=${name#*-}
    file=$(find "$work/$robot" -path "*/${scene%-*}/${scene##*-}.yaml")
    awk '/^[^ -]/ { in_matrix = /^allowed_collision_matrix:/ } !in_matrix' "$file" >"$work/scene.yaml"
    "$build/ovoid" robot path "$data/${robot}_mbm/$robot.urdf" --srdf "$data/${robot}_mbm/$robot.srdf" -p "meshes=$data/${robot}_mbm/meshes" \
        --scene "$work/scene.yaml" --hull --states "$edges" --edges --proofs -o "$work/proofs.jsonl" 2>"$work/notes" || fails=1
    "$build/ovoid" verify "$work/proofs.jsonl" --states "$edges" --json >"$work/counts" 2>"$work/failures" || fails=1
    grep '^ovoid: error' "$work/notes" "$work/failures" >&2 || true
    printf '%s,%s,%s\n' "$robot" "$(wc -c <"$work/proofs.jsonl")" "$(cat "$work/counts")" >>"$work/table"
done

awk -F, '
    function get(key,    text) { text = $0; sub(".*\"" key "\":", "", text); sub(/[,}].*/, "", text); return text + 0 }
    { n = $1; if (!(n in paths)) order[++count] = n
      scenes[n]++; paths[n] += get("paths"); hold[n] += get("hold"); free[n] += get("free"); hit[n] += get("hit")
      open[n] += get("undecided"); steps[n] += get("steps"); bytes[n] += $2; all += get("paths"); good += get("free") }
    END {
        printf "\n%-8s %9s %9s %9s %5s %10s %9s %8s %10s\n", "robot", "problems", "motions", "free", "hit", "undecided", "hold", "steps", "bytes"
        for (i = 1; i <= count; i++) {
            n = order[i]
            printf "%-8s %9d %9d %9d %5d %10d %9d %8.1f %10.0f\n", n, scenes[n], paths[n], free[n], hit[n], open[n], hold[n], steps[n] / paths[n], bytes[n] / paths[n]
        }
        if (all == 0 || good < all) exit 1
    }' "$work/table" || fails=1
echo "all motions free, all proofs hold: $([ $fails -eq 0 ] && echo yes || echo no)"
exit $fails
