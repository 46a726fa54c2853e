#!/bin/sh
# path_proofs.sh [EDGES [SEED]]: proofs of random edges, written by `ovoid robot path --edges --proofs` and checked by
# `ovoid verify`. The robots and scenes are those of OVOID_DATA or ../shared/data: the Panda and the Fetch in
# scenes of MotionBenchMaker, others without obstacles. Each robot gets EDGES edges (default 5000) whose both ends are free;
# joints move by at most 0.3 of their range. Exit 1 where a proof does not hold.
set -eu
# shellcheck source=scripts/help.sh
. "$(dirname "$0")/help.sh"
tool=${OVOID_TOOL:-$(cd "$(dirname "$0")/.." && pwd)/build/release/ovoid}
data=${OVOID_DATA:-$(cd "$(dirname "$0")/.." && pwd)/../shared/data}/robots
wanted=${1:-5000} seed=${2:-1} scenes=20
[ -x "$tool" ] || { echo "path_proofs.sh: $tool is not there: make first" >&2; exit 2; }
[ -d "$data" ] || { echo "path_proofs.sh: there are no robots in $data; OVOID_DATA names the folder of data" >&2; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fails=0 all=0

seconds() { date +%s.%N; }

# make_edges COUNT: random states, each two an edge, by the variables that $work/info lists.
make_edges() {
    awk -v count="$1" -v seed="$seed" '
        BEGIN { n = 0 }
        /^variable/ { on = 1; next }
        on && NF < 6 { on = 0 }
        on && $(NF - 3) !~ /floating|planar/ { name[n] = $2; low[n] = $(NF - 2); high[n] = $(NF - 1); n++ }
        END {
            srand(seed)
            for (i = 0; i < n; i++) printf "%s%s", name[i], i + 1 < n ? "," : "\n"
            for (k = 0; k < count; k++) {
                for (i = 0; i < n; i++) {
                    a = low[i] == "-" ? -3.14159 : low[i] + 0
                    b = high[i] == "-" ? 3.14159 : high[i] + 0
                    q[i] = a + (b - a) * rand()
                    p[i] = q[i] + 0.3 * (b - a) * (2 * rand() - 1)
                    if (p[i] < a) p[i] = a
                    if (p[i] > b) p[i] = b
                }
                for (i = 0; i < n; i++) printf "%.6f%s", q[i], i + 1 < n ? "," : "\n"
                for (i = 0; i < n; i++) printf "%.6f%s", p[i], i + 1 < n ? "," : "\n"
            }
        }' "$work/info"
}

# shellcheck disable=SC2086 # $options is a list of words
# run_scene NAME EDGES URDF [OPTION...]: until that many edges are checked, or four tries are over.
run_scene() {
    name=$1 most=$2
    shift 2
    "$tool" robot info "$1" $options >"$work/info" 2>/dev/null
    seed=$((seed + 1))
    make_edges $((20 * most)) >"$work/all.csv"
    "$tool" robot check "$@" $options --states "$work/all.csv" --limit-slack 1e-6 --csv >"$work/check.csv" 2>/dev/null || true
    # Edges whose both ends are free.
    awk -F, -v most="$most" 'FNR == NR { if (FNR > 1) free[$1] = $2 == "free"; next }
        FNR == 1 { print; next }
        { i = FNR - 2; if (i % 2 == 0) first = $0; else if (free[i - 1] && free[i] && made < most) { made++; print first; print } }' \
        "$work/check.csv" "$work/all.csv" >"$work/edges.csv"
    edges=$((($(wc -l <"$work/edges.csv") - 1) / 2))
    [ $edges -gt 0 ] || return 0
    begin=$(seconds)
    "$tool" robot path "$@" $options --states "$work/edges.csv" --limit-slack 1e-6 --edges --proofs -o "$work/proofs.jsonl" 2>"$work/notes" || true
    middle=$(seconds)
    "$tool" verify "$work/proofs.jsonl" --states "$work/edges.csv" --json >"$work/counts" 2>"$work/failures" || fails=1
    end=$(seconds)
    grep '^ovoid: error' "$work/failures" >&2 || true
    bytes=$(wc -c <"$work/proofs.jsonl")
    printf '%s,%s,%s,%s,%s\n' "$name" "$bytes" "$(echo "$middle - $begin" | bc)" "$(echo "$end - $middle" | bc)" "$(cat "$work/counts")" >>"$work/table"
    all=$((all + edges))
}

# run_problems NAME ARCHIVE EDGES URDF [OPTION...]: some scenes of an archive.
run_problems() {
    robot=$1 archive=$2 each=$(($3 / scenes + 1))
    shift 3
    mkdir -p "$work/$robot"
    tar -xjf "$archive" -C "$work/$robot" --wildcards '*/scene*.yaml'
    find "$work/$robot" -name 'scene*.yaml' | sort | awk -v n=$scenes '{ line[NR] = $0 } END { for (i = 0; i < n; i++) print line[int(i * NR / n) + 1] }' >"$work/list"
    while IFS= read -r scene; do run_scene "$robot" "$each" "$@" --scene "$scene" </dev/null; done <"$work/list"
}

: >"$work/table"
options="--srdf $data/panda_mbm/panda.srdf -p meshes=$data/panda_mbm/meshes"
run_problems panda "$data/panda/mbm_problems.tar.bz2" "$wanted" "$data/panda_mbm/panda.urdf"
options="--srdf $data/fetch_mbm/fetch.srdf -p meshes=$data/fetch_mbm/meshes"
run_problems fetch "$data/fetch_mbm/problems.tar.bz2" "$wanted" "$data/fetch_mbm/fetch.urdf"
scenes=1
for robot in kinova_jaco/robots/kinova.urdf:kinova_jaco/srdf/kinova.srdf solo12/robots/solo12.urdf:solo12/srdf/solo.srdf \
    anymal_b/robots/anymal.urdf:anymal_b/srdf/anymal.srdf; do
    options="--srdf $data/${robot#*:}"
    name=${robot%%/*}
    run_scene "$name" "$wanted" "$data/${robot%:*}"
done

# The table: edges, those that are free and hit, proofs that hold, steps, bytes and microseconds an edge.
awk -F, '
    function get(key,    text) { text = $0; sub(".*\"" key "\":", "", text); sub(/[,}].*/, "", text); return text + 0 }
    { n = $1; if (!(n in paths)) order[++count] = n
      paths[n] += get("paths"); hold[n] += get("hold"); free[n] += get("free"); hit[n] += get("hit")
      open[n] += get("undecided"); steps[n] += get("steps"); bytes[n] += $2; find[n] += $3; check[n] += $4 }
    END {
        printf "%-12s %8s %8s %8s %10s %8s %8s %10s %10s %10s\n", "robot", "edges", "free", "hit", "undecided", "hold", "steps", "bytes", "us, find", "us, verify"
        for (i = 1; i <= count; i++) {
            n = order[i]
            printf "%-12s %8d %8d %8d %10d %8d %8.1f %10.0f %10.0f %10.0f\n", n, paths[n], free[n], hit[n], open[n], hold[n], steps[n] / paths[n], bytes[n] / paths[n], 1e6 * find[n] / paths[n], 1e6 * check[n] / paths[n]
        }
    }' "$work/table"
echo "edges: $all, all proofs hold: $([ $fails -eq 0 ] && echo yes || echo no)"
exit $fails
