#!/bin/sh
# mutate.sh [-g GROUP]... [NAME...]: do the tests notice a fault? Copies the sources to build/mutate, makes one mutation of
# scripts/mutations/ after another (all, those of the groups, or those named), builds, and runs tests until one fails. The
# judge is not mutated: it is what the rest is held against. Tests that compare stored hashes of bits are left out, since
# they notice any change.
# Prints a line for each: the mutation, what it breaks, and the test that noticed it, or SURVIVED; and puts the result into
# scripts/mutations/results.tsv, from which scripts/mutations.py --write makes the tables of docs/mutation.md. Exit 1 where
# a mutation does not apply (its text must be there exactly once) or does not compile. Two to three hours for all on two
# cores.
# mutate.sh --check: nothing is built; every mutation has all it needs and applies.
# mutate.sh --list: the groups, how many mutations each has, and its tests.
set -u
options="--check --list -g"
# shellcheck source=scripts/help.sh
. "$(dirname "$0")/help.sh"
cd "$(dirname "$0")/.." || exit 1
jobs=${JOBS:-2}
copy=build/mutate
tree=$copy/tree
groups="allowance query prepared depth_memory growth gauss boxes closed swept exact hull shape ellipsoid simd environment tools world world_manifolds solid_manifolds compound solid solid_body solid_files decompose motion smooth paper manifold table lanes floats batch io robot robot_read robot_solid robot_spheres robot_cover robot_table robot_compare ompl fcl adapters robot_cli robot_spheres_cli shard verify page report python python_solid decompose_watch robot_watch hostile hostile_cli packed contact_faces contact_python python_fcl python_swept"

# The tests of a group, fastest first; arguments after a colon.
tests_of() {
    query="test_query test_query_warm test_query_near test_simd_small_gjk test_judge_common_point test_judge_verify test_query_surface test_query_simplex test_judge test_query_trials:--rounds:5 test_query_trials_known test_query_trials:--family:near-coplanar:--trial:9537145888130744208"
    query="$query test_query_batch test_judge_capacity test_game_hulls test_query_refine test_query_altered"
    case $1 in
    allowance) echo "test_allowance test_allowance_axis test_judge_allowance test_shape_ellipsoid test_judge_round test_shape_rim test_robot_round" ;;
    query) echo "$query" ;;
    prepared) echo "test_prepared test_environment" ;;
    depth_memory) echo "test_query_memory test_query_surface" ;;
    growth) echo "test_simd_epa8 test_judge_capacity $query" ;;
    gauss) echo "test_query_gauss test_solid_contacts test_query_trials $query" ;;
    boxes) echo "test_simd_box_axes test_simd_box_separation test_query_boxes $query" ;;
    closed) echo "test_query_closed test_judge_closed test_query_batch test_prepared test_allowance test_query_boxes $query" ;;
    swept) echo "test_query_box_triangle test_query_swept_axis test_query_swept_minima test_query_swept" ;;
    exact) echo "test_linear test_hull $query" ;;
    hull) echo "test_linear test_hull_sort test_hull test_measures test_shape $query" ;;
    shape) echo "test_centered_box test_regular_solid test_measures test_shape test_shape_triangles test_shape_file test_shape_lean test_shape_rim test_shape_ellipsoid $query" ;;
    ellipsoid) echo "test_ellipsoid_quick test_ellipsoid_contain test_ellipsoid_overlap test_ellipsoid_gap test_ellipsoid_exact test_ellipsoid_nearest test_ellipsoid_outer test_ellipsoid_inner $query" ;;
    simd) echo "test_simd test_simd_corner $query" ;;
    environment) echo "test_environment $query" ;;
    tools) echo "test_tools" ;;
    world) echo "test_simd_extents test_simd_kept8 test_simd_move8 test_world_moves test_world_depth test_world_tree test_world_margins test_world_rules test_world_even test_world_states test_world_find test_world test_world_far test_world_threads test_world_soak" ;;
    solid_manifolds) echo "test_solid_facets test_solid_contacts test_solid_manifolds test_world_slide" ;;
    world_manifolds) echo "test_world_manifolds test_body_manifolds test_world_rules test_world_threads test_world_soak" ;;
    solid_body) echo "test_solid_compound test_solid_impact test_solid_impact_altered test_world_solids test_io_scene" ;;
    solid) echo "test_solid_create test_solid_frames test_hull_match test_solid_crossings test_solid test_solid_compound test_solid_flush test_judge_solid_altered test_judge_solid" ;;
    solid_files) echo "test_cli_altered_solids.sh test_cli.sh:solid:info" ;;
    decompose) echo "test_decompose_cells test_decompose test_decompose_verify" ;;
    hostile) echo "test_io_json test_io_texts test_io_child" ;;
    hostile_cli) echo "test_cli_hostile.sh" ;;
    decompose_watch) echo "test_decompose_watch" ;;
    compound) echo "test_compound_create test_compound_far test_compound_bounds test_compound_proofs test_compound test_compound_impact test_compound_impact_altered test_judge_compound test_compound_altered test_query_near" ;;
    motion) echo "test_motion_gap test_motion_pose test_judge_motion test_motion test_impact test_impact_rod test_impact_altered test_judge_impact test_impact_trials test_compound_impact" ;;
    smooth) echo "test_smooth test_smooth_bounds test_gradient test_gradient_round test_gradient_bounds" ;;
    paper) echo "test_paper test_area" ;;
    manifold) echo "test_manifold test_manifold_demand test_simd_patch test_manifold_altered test_manifold_hard test_judge_manifold" ;;
    table) echo "test_lookup test_shape test_simd test_query" ;;
    lanes) echo "test_simd_areas test_simd_octet test_simd_gjk8 test_simd_solid8 test_query_batch test_judge_batch" ;;
    batch) echo "test_simd_nearest test_query_floats test_query_batch test_judge_batch" ;;
    floats) echo "test_simd_float test_simd_given test_query_floats test_query_batch test_judge_batch" ;;
    robot) echo "test_robot_depth test_robot_model test_robot_poses test_robot_balls test_robot_hits test_robot_collide test_robot_matrix test_robot_path test_robot_path_altered test_robot_path_bounds test_robot_judge test_robot_clearance test_robot_motion" ;;
    io) echo "test_io_numbers test_io_json test_io_convexity test_io_motion test_io_scene test_io_pairs test_io_mesh test_io_limits test_io_results test_io_solid" ;;
    packed) echo "test_io_packed test_cli.sh:solid_scene" ;;
    contact_faces) echo "test_io_contacts test_cli.sh:check:distance test_cli_lies.sh" ;;
    contact_python) echo "test_python_manifold test_python_pickle" ;;
    python_fcl) echo "test_python_fcl" ;;
    python_swept) echo "test_python_swept" ;;
    robot_read) echo "test_robot_urdf test_robot_srdf test_robot_packages test_robot_scenes test_robot_place test_robot_known" ;;
    robot_solid) echo "test_robot_solid test_robot_urdf test_robot_scenes test_cli.sh:robot_solid" ;;
    robot_cover) echo "test_robot_cover test_robot_cover:--rounds:4 test_robot_edges test_robot_path test_robot_solid" ;;
    robot_table) echo "test_robot_table test_robot_apart test_robot_reach" ;;
    robot_compare) echo "test_robot_compare" ;;
    robot_watch) echo "test_robot_watch" ;;
    ompl) echo "test_hpp_ompl" ;;
    fcl) echo "test_hpp_fcl test_hpp_fcl_cache test_hpp_fcl_contacts test_hpp_fcl_meshes test_hpp_fcl_manager test_fcl_preload.sh" ;;
    adapters) echo "test_adapter_bullet test_adapter_mujoco test_adapter_dart" ;;
    robot_cli) echo "test_cli.sh:robot:robot_check:robot_path:robot_states:robot_attach test_cli_altered_paths.sh" ;;
    robot_spheres_cli) echo "test_cli.sh:robot_spheres:robot_matrix" ;;
    shard) echo "test_io_pairs test_cli_shard.sh" ;;
    verify) echo "test_cli_run.sh test_cli_altered.sh test_cli_lies.sh" ;;
    page) echo "test_cli.sh:page test_page.sh" ;;
    report) echo "test_cli.sh:paper" ;;
    robot_spheres) echo "test_robot_spheres" ;;
    python) echo "test_python_pair test_python_batch test_python_world test_python_motion test_python_robot test_python_prepared test_python_solid test_python_robot_paths test_python_show test_python_plan test_python_names" ;;
    python_solid) echo "test_python_solid_moving test_python_solid_parts test_python_solid test_python_trimesh_compat" ;;
    *) return 1 ;;
    esac
}

# One line a mutation: name, group, file, from, to, breaks, between tabs.
list() {
    awk 'function flush() { if (name) printf "%s\t%s\t%s\t%s\t%s \t%s\n", name, tests, file, from, to, breaks
                            name = tests = file = from = to = breaks = "" }
         FNR == 1 || /^#/ || /^$/ { flush() }
         /^#/ || /^$/ { next }
         { key = $0; sub(/:.*/, "", key); value = substr($0, length(key) + 3) }
         key == "name" { name = value; tests = "query" } key == "tests" { tests = value } key == "file" { file = value }
         key == "from" { from = value } key == "to" { to = value } key == "breaks" { breaks = value }
         END { flush() }' scripts/mutations/*.txt
}

# mutated FILE FROM TO: the file with the one place of the text replaced; 1 if it is not there exactly once.
mutated() {
    FROM=$2 TO=$3 awk '{ text = text $0 "\n" }
        END { from = ENVIRON["FROM"]; at = from == "" ? 0 : index(text, from)
              if (!at || index(substr(text, at + 1), from)) exit 1
              printf "%s%s%s", substr(text, 1, at - 1), ENVIRON["TO"], substr(text, at + length(from)) }' "$1"
}

# build TARGET: 0 built, 1 it does not compile, 2 there is no such target here.
build() {
    if cmake --build $copy/build -j "$jobs" --target "$1" >$copy/build.log 2>&1; then return 0; fi
    if grep -qE 'No rule to make target|unknown target' $copy/build.log; then return 2; fi
    return 1
}

# notice GROUP: builds and runs; prints which test noticed, or SURVIVED, or what stopped it. A test that a fault sends round
# for ever, or through all memory, is stopped by what it has used, not by a clock.
notice() {
    for entry in $(tests_of "$1"); do
        test=${entry%%:*}
        arguments=$(echo "$entry" | cut -s -d: -f2- | tr : ' ')
        program=$copy/build/tests/$test target=$test
        case $test in *.sh) program="sh $tree/tests/cli/$test" target=ovoid_cli ;; esac
        build "$target"
        case $? in
        1) echo "does not compile" && return ;;
        2) continue ;;
        esac
        # shellcheck disable=SC2086,SC3045 # words of the program and its arguments; where ulimit has no -v, there is no limit
        if ! (ulimit -t 300 && { ulimit -v 8000000 2>/dev/null || :; } && exec $program $arguments) >$copy/test.log 2>&1; then
            echo "$test"
            return
        fi
    done
    echo SURVIVED
}

# record NAME GROUP WORD: the result becomes the last one of the mutation.
record() {
    results=scripts/mutations/results.tsv
    NAME=$1 awk -F'\t' '$1 != ENVIRON["NAME"]' $results >$copy/results
    printf '%s\t%s\t%s\t%s\n' "$1" "$2" "$3" "$(date +%F)" >>$copy/results
    LC_ALL=C sort $copy/results >$results
}

check_list() {
    passed=0 failed=0
    twice=$(cut -f1 $copy.list | sort | uniq -d)
    while IFS='	' read -r name group file from to breaks <&3; do
        word=
        [ -n "$breaks" ] || word="what it breaks is not said"
        [ "$from " != "$to" ] || word="nothing is changed"
        tests_of "$group" >/dev/null || word="no such group of tests: $group"
        mutated "$file" "$from" "$to" >/dev/null 2>&1 || word="its text must be in $file exactly once"
        if echo "$twice" | grep -qFx -- "$name"; then word="the name is there twice"; fi
        if [ -z "$word" ]; then passed=$((passed + 1)); else failed=$((failed + 1)) && echo "FAILED mutation \"$name\": $word"; fi
    done 3<$copy.list
    echo "$passed passed, $failed failed, 0 skipped"
    [ $failed -eq 0 ] && [ $passed -gt 0 ]
}

mkdir -p build
list >$copy.list
wanted=
while [ $# -gt 0 ]; do
    case $1 in
    --check) check_list && exit 0 || exit 1 ;;
    --list)
        for group in $groups; do echo "$group, $(cut -f2 $copy.list | grep -cFx "$group"): $(tests_of "$group")"; done
        exit 0
        ;;
    -g)
        tests_of "${2:-}" >/dev/null || { echo "mutate: no such group of tests: ${2:-}; there are: $groups" >&2 && exit 2; }
        wanted="$wanted $2"
        shift 2
        ;;
    -*) echo "mutate: unknown option $1" >&2 && exit 2 ;;
    *) break ;;
    esac
done

# The lines that are wanted: of the groups, and of the names, where any are given.
awk -F'\t' -v groups="$wanted" 'BEGIN { n = split(groups, g, " "); for (i = 1; i <= n; i++) in_group[g[i]] = 1
                                for (i = 1; i < ARGC; i++) if (i > 1) { named[ARGV[i]] = 1; ARGV[i] = ""; names++ } }
    (n == 0 || $2 in in_group) && (names == 0 || $1 in named)' $copy.list "$@" >$copy.wanted
[ -s $copy.wanted ] || { echo "mutate: no such mutation" >&2 && exit 2; }

# Where the tests of the tool, which are scripts, find it and their files.
export OVOID_SOURCE_DIR="$PWD/$tree" OVOID_BUILD_DIR="$PWD/$copy/build" OVOID_TOOL="$PWD/$copy/build/ovoid"
mkdir -p $copy
rm -rf $tree
mkdir $tree
# With the time of now: what an earlier run built from its last mutation is newer than the sources.
tar -cf - --exclude=./build --exclude='./.git*' . | tar -xmf - -C $tree
generator=$(command -v ninja >/dev/null && echo "-G Ninja")
# shellcheck disable=SC2086 # none, or two words
cmake -S $tree -B $copy/build $generator -DCMAKE_BUILD_TYPE=None -DCMAKE_C_FLAGS=-O1 -DOVOID_IO=ON >$copy/build.log 2>&1 || {
    cat $copy/build.log
    exit 1
}
# Without a mutation all must pass.
for group in $groups; do
    cut -f2 $copy.wanted | grep -qFx "$group" || continue
    word=$(notice "$group")
    if [ "$word" != SURVIVED ]; then
        echo "without a mutation: $word"
        tail -n 5 $copy/build.log $copy/test.log
        exit 1
    fi
done

bad=0
while IFS='	' read -r name group file from to breaks <&3; do
    cp "$tree/$file" $copy/original
    if mutated "$tree/$file" "$from" "${to% }" >$copy/mutated; then
        cp $copy/mutated "$tree/$file"
        word=$(notice "$group")
    else
        word="DOES NOT APPLY"
    fi
    cp $copy/original "$tree/$file"
    case $word in "DOES NOT APPLY" | "does not compile") bad=1 ;; *) record "$name" "$group" "$word" ;; esac
    echo "$name, ${file#src/}, $breaks: $word"
done 3<$copy.wanted
exit $bad
