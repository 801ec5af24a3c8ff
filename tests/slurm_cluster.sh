#!/bin/sh
# A Slurm cluster of two nodes on this machine, for as long as a command runs:
#   tests/slurm_cluster.sh COMMAND...
# Needs root and the Debian packages slurm-wlm and munge; ends with 77 where they are missing.
set -eu
[ "$(id -u)" -eq 0 ] && command -v slurmctld slurmd munged sbatch >/dev/null || exit 77

dir=$(mktemp -d)
daemons=
cleanup() {
    for pid in $daemons; do kill "$pid" 2>/dev/null || true; done
    wait
    rm -rf "$dir"
}
trap cleanup EXIT

chmod 755 "$dir"
install -d -o munge -g munge -m 755 "$dir/munge"
dd if=/dev/urandom of="$dir/munge/key" bs=1024 count=1 2>/dev/null
chown munge "$dir/munge/key"
chmod 400 "$dir/munge/key"
runuser -u munge -- munged --foreground --socket="$dir/munge/sock" --key-file="$dir/munge/key" \
    --pid-file="$dir/munge/pid" --log-file="$dir/munge/log" --seed-file="$dir/munge/seed" >/dev/null 2>&1 &
daemons=$!

host=$(hostname -s)
port=$((20000 + $$ % 10000 * 4))
mkdir "$dir/state" "$dir/n1" "$dir/n2"
cat >"$dir/slurm.conf" <<END
ClusterName=throwaway
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$dir/munge/sock
CredType=cred/munge
SlurmctldPort=$port
StateSaveLocation=$dir/state
SlurmdSpoolDir=$dir/%n
SlurmctldPidFile=$dir/slurmctld.pid
SlurmdPidFile=$dir/%n.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
ReturnToService=2
MailProg=/bin/true
CompleteWait=0
KillWait=2
SchedulerParameters=sched_interval=1,sched_min_interval=100000,batch_sched_delay=0,bf_interval=1
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=1 RealMemory=1000
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=1 RealMemory=1000
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
END
export SLURM_CONF="$dir/slurm.conf"
sleep 0.5
for daemon in "slurmctld -D" "slurmd -D -N n1" "slurmd -D -N n2"; do
    # shellcheck disable=SC2086
    $daemon -f "$dir/slurm.conf" >"$dir/log" 2>&1 &
    daemons="$daemons $!"
done
tries=0
until [ "$(sinfo -h -t idle -o %D 2>/dev/null)" = 2 ]; do
    tries=$((tries + 1))
    [ "$tries" -lt 300 ] || { echo "slurm_cluster.sh: the nodes are not ready" >&2; exit 1; }
    sleep 0.2
done
code=0
"$@" || code=$?
exit "$code"
