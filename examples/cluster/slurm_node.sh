#!/bin/sh
# slurm_node.sh FOLDER COMMAND...: Slurm on this machine alone, for the time of a command: munged, slurmctld and slurmd with
# a configuration of their own in FOLDER, ended when the command ends. SLURM_CONF is set for it. Needs root, as slurmd
# does. Exit code 77: Slurm is absent or did not start, and why.
set -u
give_up() {
    echo "slurm: $1" >&2
    exit 77
}
mkdir -p "$1" && folder=$(cd "$1" && pwd) || exit 3
shift
PATH=$PATH:/usr/sbin:/sbin
for program in munged slurmctld slurmd sbatch sinfo; do
    command -v $program >/dev/null || give_up "$program is not installed"
done
[ "$(id -u)" -eq 0 ] || give_up "slurmd needs root"
host=$(hostname -s)
mkdir -p "$folder/state" "$folder/spool" && chmod 755 "$folder"
# Ports that no other Slurm here uses.
base=$((20000 + $$ % 20000))
cat >"$folder/slurm.conf" <<CONF
ClusterName=one
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$base
SlurmdPort=$((base + 1))
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
CredType=cred/munge
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_interval=1
ReturnToService=2
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
CONF
SLURM_CONF=$folder/slurm.conf
export SLURM_CONF
pids=
finish() {
    # shellcheck disable=SC2086 # numbers
    kill $pids 2>/dev/null
    # shellcheck disable=SC2086
    wait $pids 2>/dev/null
}
trap finish EXIT
trap 'exit 143' INT TERM
(umask 077 && dd if=/dev/urandom of="$folder/munge.key" bs=1024 count=1 2>/dev/null)
munged --foreground --force --num-threads=2 --key-file="$folder/munge.key" --socket="$folder/munge.socket" \
    --pid-file="$folder/munged.pid" --seed-file="$folder/munge.seed" --log-file="$folder/munged.log" &
pids="$pids $!"
for _ in 1 2 3 4 5 6 7 8 9 10; do [ -S "$folder/munge.socket" ] || sleep 0.3; done
[ -S "$folder/munge.socket" ] || give_up "munged did not start: $(tail -n 1 "$folder/munged.log" 2>/dev/null)"
slurmctld -D -f "$SLURM_CONF" >"$folder/slurmctld.out" 2>&1 &
pids="$pids $!"
slurmd -D -f "$SLURM_CONF" >"$folder/slurmd.out" 2>&1 &
pids="$pids $!"
tries=0
until sinfo -h -o %T 2>/dev/null | grep -q idle; do
    tries=$((tries + 1))
    [ $tries -lt 60 ] || give_up "the node is not idle: $(tail -qn 1 "$folder/slurmctld.out" "$folder/slurmd.out" | tr '\n' ' ')"
    sleep 0.5
done
"$@"
