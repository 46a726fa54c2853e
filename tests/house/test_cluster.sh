#!/bin/sh
# examples/cluster on this machine: GNU parallel, a job array of Slurm on one node, Dask with two processes, and MPI, each
# where it is installed ("make cluster" installs them). Truth: one run, or one process, whose bytes all of them must have.
set -u
# shellcheck source=tests/cli/need_tool.sh
. "$(dirname "$0")/../cli/need_tool.sh"
# shellcheck source=tests/common/steps.sh
. "$(dirname "$0")/../common/steps.sh"
work=$OVOID_BUILD_DIR/test_cluster
rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 1
skipped=0
examples=$OVOID_SOURCE_DIR/examples/cluster
OVOID=$OVOID_TOOL
PATH=$PATH:/usr/sbin
export OVOID PATH

skip() {
    skipped=$((skipped + 1))
    echo "skipped: $1"
}

awk 'BEGIN { srand(5); print "a,b,ax,ay,az,aqw,aqx,aqy,aqz,bx,by,bz,bqw,bqx,bqy,bqz"
    for (i = 0; i < 1000; i++) printf "%d,%d,0,0,0,1,0,0,0,%.9f,%.9f,%.9f,1,%.6f,0,0\n", i % 2, i % 3 % 2, 2 * rand(), 2 * rand(), rand(), rand() }' >pairs.csv
printf '%s/cube.off\n%s/tetra.obj\n' "$OVOID_SOURCE_DIR/tests/cli/data" "$OVOID_SOURCE_DIR/tests/cli/data" >shapes.txt
set -- batch --shapes shapes.txt --pairs pairs.csv --json
"$OVOID" "$@" >one.jsonl 2>/dev/null
code=$?

if command -v parallel >/dev/null && parallel --version 2>/dev/null | grep -q GNU; then
    "$examples/parallel.sh" 5 parts parallel.jsonl "$@" 2>said
    check 'GNU parallel: the exit code' [ $? -eq $code ]
    check 'GNU parallel' cmp one.jsonl parallel.jsonl
    # Again with a shard that was lost: the others are whole and stay.
    rm parts/3.shard parallel.jsonl
    "$examples/parallel.sh" 5 parts parallel.jsonl "$@" 2>said
    check 'GNU parallel, again' cmp one.jsonl parallel.jsonl
    check 'GNU parallel, again: shards stay' [ "$(grep -c 'of them from before' said)" -eq 4 ]
else
    skip 'GNU parallel is not installed'
fi

# The job: an array of three tasks, waited for, then the merge.
cat >job.sh <<'JOB'
sbatch --wait --array=1-3 "$0" tasks "$@" && "$OVOID" merge tasks/*.shard -o slurm.jsonl
JOB
timeout -k 10 120 "$examples/slurm_node.sh" node sh -c "$(cat job.sh)" "$examples/slurm_array.sh" "$@" >said 2>&1
got=$?
case $got in
77 | 124 | 137) skip "Slurm: $(grep slurm: said || echo 'no answer in two minutes')" ;;
*)
    check "Slurm: the exit code $got of $(cat said)" [ $got -eq $code ]
    check 'Slurm' cmp one.jsonl slurm.jsonl
    ;;
esac

# Python: not with the sanitizers, whose runtime would have to be in every process.
PYTHONPATH=$OVOID_BUILD_DIR/python:$examples PYTHONDONTWRITEBYTECODE=1
export PYTHONPATH PYTHONDONTWRITEBYTECODE
python=/usr/bin/python3
if [ -n "${OVOID_SANITIZE:-}" ] || ! $python -c 'import ovoid, numpy' 2>/dev/null; then
    skip 'Dask and MPI: the Python package, without sanitizers, and NumPy are not here'
else
    if $python -c 'import dask.distributed, dask.array' 2>/dev/null; then
        timeout -k 10 300 $python "$examples/dask_batch.py" 4000 >said 2>&1
        check "Dask: $(tail -n 3 said)" [ $? -eq 0 ]
        check 'Dask: eight chunks' grep -q '^4000 poses in 8 chunks' said
    else
        skip 'python3-distributed is not installed'
    fi
    if $python -c 'import mpi4py' 2>/dev/null && command -v mpirun >/dev/null; then
        OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 \
            timeout -k 10 300 mpirun -n 3 $python "$examples/mpi_batch.py" 4000 >said 2>&1
        check "MPI: $(tail -n 3 said)" [ $? -eq 0 ]
        check 'MPI: three ranks' grep -q '^4000 poses on 3 ranks' said
    else
        skip 'python3-mpi4py is not installed'
    fi
fi
echo "$passed passed, $failed failed, $skipped skipped"
[ $failed -eq 0 ]
