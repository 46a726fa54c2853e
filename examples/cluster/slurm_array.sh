#!/bin/sh
#SBATCH --job-name=ovoid
#SBATCH --cpus-per-task=1
#SBATCH --output=slurm-%A_%a.log
# slurm_array.sh FOLDER COMMAND...: one shard of an ovoid command as a task of a job array, and the merge as a job after it:
#
#   job=$(sbatch --parsable --array=1-16 slurm_array.sh shards batch --shapes hulls.txt --pairs pairs.csv --json)
#   sbatch --dependency=afterok:$job --wrap 'ovoid merge shards/*.shard -o results.jsonl'
#
# A task that was ended by its time limit, or with its node, goes on where it stopped: scontrol requeue JOB_TASK.
set -u
folder=$1
shift
mkdir -p "$folder" || exit 3
"${OVOID:-ovoid}" "$@" --threads "${SLURM_CPUS_PER_TASK:-1}" \
    --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" --output "$folder/$SLURM_ARRAY_TASK_ID.shard"
code=$?
# 1 and 4 are answers: to Slurm the task has done its work.
case $code in 1 | 4) code=0 ;; esac
exit $code
