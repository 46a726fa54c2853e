#!/bin/sh
# fuzz.sh SECONDS [TARGET...]: runs the fuzz targets one after another, each for that long, on one processor. Seeds: the
# corpus in fuzz/corpus, and where Debian's assimp-testmodels are installed its small files of the target's formats. What is
# found on the way is kept in build/fuzz/grown, so that the next run goes on from there; what breaks a promise is written
# to build/fuzz/found. One line a target in build/fuzz/fuzz.log: runs, seconds of the clock and of processor time, edges
# covered, inputs kept, failures.
# Exit 1 where a target failed.
set -u
# shellcheck source=scripts/help.sh
. "$(dirname "$0")/help.sh"
cd "$(dirname "$0")/.." || exit 1
seconds=${1:-60}
[ $# -eq 0 ] || shift
build=build/fuzz
models=/usr/share/assimp/models
if [ $# -eq 0 ]; then
    for program in "$build"/fuzz/fuzz_*; do set -- "$@" "$(basename "$program" | sed 's/^fuzz_//')"; done
fi

# The formats of a target, as patterns of names.
formats_of() {
    case $1 in
    stl | obj | off | ply) echo "*.$1" ;;
    assimp) echo '*.dae *.gltf *.glb *.3ds *.x3d *.fbx *.3mf' ;;
    esac
}

# Seconds that one input may take; Assimp's children have limits of their own.
timeout_of() { if [ "$1" = assimp ]; then echo 300; else echo 10; fi; }

# collect_seeds TARGET FOLDER: the models of its formats, up to 32 KB each. Of the Assimp target the first byte says which
# format it is (fuzz/targets/fuzz_assimp.c), so it is put before.
collect_seeds() {
    mkdir -p "$2"
    [ -d "$models" ] || return 0
    set -f
    for pattern in $(formats_of "$1"); do
        find "$models" -iname "$pattern" -size -32k -type f | sort | while IFS= read -r file; do
            name=$(printf '%s' "$file" | cksum | tr ' ' -)
            case $1:$pattern in
            assimp:*.dae) printf 0 ;;
            assimp:*.gltf) printf 1 ;;
            assimp:*.glb) printf 2 ;;
            assimp:*.3ds) printf 3 ;;
            assimp:*.x3d) printf 4 ;;
            assimp:*.fbx) printf 5 ;;
            assimp:*.3mf) printf 6 ;;
            esac >"$2/$name"
            cat "$file" >>"$2/$name"
        done
    done
    set +f
}

# read_stat NAME LOG: the number after it.
read_stat() { sed -n "s/^stat::$1: *//p" "$2" | tail -n 1; }

# Seconds of processor time of all that ran so far.
read_cpu() {
    times >"$build/times"
    awk 'NR == 2 { split($1, u, /[ms]/); split($2, s, /[ms]/); printf "%d", 60 * (u[1] + s[1]) + u[2] + s[2] }' "$build/times"
}

failed=0
for target; do
    [ -x "$build/fuzz/fuzz_$target" ] || { echo "fuzz: $build/fuzz/fuzz_$target is not there: make fuzz builds all" >&2 && failed=1 && continue; }
    seeds=$build/seeds/$target grown=$build/grown/$target found=$build/found log=$build/fuzz_$target.log
    mkdir -p "$grown" "$found"
    collect_seeds "$target" "$seeds"
    before=$(find "$found" -name "$target-*" -size +0c | wc -l) # an Assimp child that dies may leave an empty one
    start=$(date +%s)
    read_cpu >"$build/cpu_before"
    "$build/fuzz/fuzz_$target" -max_total_time="$seconds" -timeout="$(timeout_of "$target")" -rss_limit_mb=2048 -max_len=65536 \
        -malloc_limit_mb=-1 -print_final_stats=1 -artifact_prefix="$found/$target-" "$grown" "fuzz/corpus/$target" "$seeds" >"$log" 2>&1
    code=$?
    read_cpu >"$build/cpu_after"
    crashes=$(($(find "$found" -name "$target-*" -size +0c | wc -l) - before))
    [ $code -eq 0 ] && [ $crashes -eq 0 ] || failed=1
    edges=$(sed -n 's/.* cov: \([0-9]*\) .*/\1/p' "$log" | tail -n 1)
    printf '%s  %-8s %9s runs %5s s %5s s cpu %6s edges %6s inputs %3s failures (exit %s)\n' "$(date -u +%FT%TZ)" \
        "$target" "$(read_stat number_of_executed_units "$log")" $(($(date +%s) - start)) \
        $(($(cat "$build/cpu_after") - $(cat "$build/cpu_before"))) "$edges" \
        "$(find "$grown" -type f | wc -l)" "$crashes" "$code" | tee -a "$build/fuzz.log"
done
[ $failed -eq 0 ]
