#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# A campaign as a job array of a Slurm of one node, started for this test alone, leaves what a campaign of one process
# leaves. Exit code 77 (skipped) where Slurm is not installed.
set -eu
skyfit=$1 examples=$2
for program in munged slurmctld slurmd sbatch squeue scontrol; do
  PATH=$PATH:/usr/sbin command -v "$program" >/dev/null || { echo "skipped: no $program in PATH"; exit 77; }
done
PATH=$PATH:/usr/sbin

folder=$(mktemp -d)
stop() {
  for daemon in slurmd slurmctld munged; do
    [ ! -s "$folder/$daemon.pid" ] || kill "$(cat "$folder/$daemon.pid")" 2>/dev/null || true
  done
  sleep 1
  rm -rf "$folder"
}
trap stop EXIT
fail() {
  echo "FAILED: $1"
  tail -n 30 "$folder"/*.log || true
  exit 1
}
# Runs the rest up to 60 times, a second apart, until it succeeds.
await() {
  local what=$1 tries=0
  shift
  until "$@" >/dev/null 2>&1; do
    tries=$((tries + 1))
    [ $tries -lt 60 ] || fail "$what"
    sleep 1
  done
}

user=$(id -un) host=$(hostname -s)
mkdir -m 700 "$folder/munge" "$folder/state" "$folder/spool"
head -c 1024 /dev/urandom >"$folder/munge/key"
chmod 400 "$folder/munge/key"
munged --force --key-file "$folder/munge/key" --socket "$folder/munge/socket" --pid-file "$folder/munged.pid" \
  --log-file "$folder/munged.log" --seed-file "$folder/munge/seed"
cat >"$folder/slurm.conf" <<CONF
ClusterName=skyfit-test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$((20000 + RANDOM % 10000))
SlurmdPort=$((30000 + RANDOM % 2000))
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
AuthInfo=socket=$folder/munge/socket
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MailProg=/bin/true
SchedulerType=sched/builtin
ReturnToService=2
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=$host Default=YES State=UP
CONF
echo "IgnoreSystemd=yes" >"$folder/cgroup.conf"
export SLURM_CONF="$folder/slurm.conf"
slurmctld
slurmd || fail "slurmd does not start"
await "the node is not idle" sh -c "sinfo --noheader --format=%T | grep -qx idle"

mkdir "$folder/scans"
for day in 15 16 17 18 19; do
  sed "s/2024-05-15/2024-05-$day/" "$examples/sky_scan_145.csv" >"$folder/scans/$day.csv"
done
echo "no sky" >"$folder/scans/none.csv"
cat >"$folder/plan.json" <<'PLAN'
{"skyfit_campaign": 1, "inputs": ["scans/*.csv"], "tasks_per_file": 1,
 "options": {"lobes": 1, "starts": 1, "free": "mie.scattering"}}
PLAN
cd "$folder"
"$skyfit" campaign plan.json --out alone >/dev/null
"$skyfit" campaign plan.json --out array --slurm 3 --threads 1 >/dev/null
job=$(sbatch --parsable array/campaign.slurm) || fail "sbatch refuses the script"
await "the job array does not end" sh -c "test -z \"\$(squeue --noheader --jobs=$job 2>/dev/null)\""
"$skyfit" campaign plan.json --out array --merge >merged.txt
grep -q "^6 tasks: 5 fitted, 0 of them outliers, 1 failed$" merged.txt || fail "$(cat merged.txt slurm-*.out)"
cmp alone/campaign.nc array/campaign.nc || fail "another result than that of one process"
echo "job array $job: $(head -n 1 merged.txt)"
