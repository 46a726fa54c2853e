#!/bin/sh
# parallel.sh PARTS FOLDER OUT COMMAND...: an ovoid command in PARTS shards by GNU parallel, as many at a time as there are
# processors, merged into OUT. Run again after an interruption it goes on; FOLDER keeps the shards.
#
#   examples/cluster/parallel.sh 16 shards results.jsonl batch --shapes hulls.txt --pairs pairs.csv --json
#
# On several machines: add --sshloginfile hosts --wd . to the line of parallel, in a folder that all of them see.
set -u
if [ $# -lt 4 ]; then echo "usage: $0 PARTS FOLDER OUT COMMAND..." >&2 && exit 2; fi
parts=$1 folder=$2 out=$3
shift 3
mkdir -p "$folder" || exit 3
# Each shard's own exit code says what it found: 1 and 4 are answers, all above are failures. merge says what is missing.
seq "$parts" | parallel --quote --will-cite "${OVOID:-ovoid}" "$@" --threads 1 --shard "{}/$parts" --output "$folder/{}.shard"
exec "${OVOID:-ovoid}" merge "$folder"/*.shard --output "$out"
