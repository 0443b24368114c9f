# Defines a Slurm cluster of three nodes in a private folder, of Debian's munge and Slurm. A script sets `work` to an
# empty folder, calls no_cluster, start_cluster, and at its end stop_cluster. Where namespaces are allowed, each node is a
# machine with a network and processes of its own (spaces=1), so that it can be killed.
PATH=$PATH:/usr/sbin:/sbin

# Prints the reason why no cluster can run here, in one line; nothing if it can.
no_cluster() {
  for program in slurmctld slurmd sbatch munged; do
    command -v $program > /dev/null || { echo "no $program (packages slurmctld, slurmd, slurm-client, munge)"; return; }
  done
  # slurmd does not start without control groups, which a container may lack.
  grep -q ' cgroup2\? ' /proc/mounts || echo "no control groups here (/sys/fs/cgroup)"
}

# Starts the cluster. Prints a reason and returns 1 if munged does not start, 2 if the nodes do not.
start_cluster() {
  host=$(hostname -s) net=10.213.$(($$ % 250)) bridge=vsb$(($$ % 100000)) spaces=
  mkdir -m 700 "$work/munge" && mkdir "$work/run" "$work/state" "$work/spool" "$work/tmp" "$work/hidden" && chmod 755 "$work" || return 2
  dd if=/dev/urandom of="$work/munge/key" bs=128 count=1 2> /dev/null; chmod 600 "$work/munge/key"
  if unshare --fork --pid --mount --net --mount-proc true 2> /dev/null && ip link add "$bridge" type bridge 2> /dev/null &&
     ip addr add "$net.1/24" dev "$bridge" && ip link set "$bridge" up; then spaces=1; fi
  write_slurm_conf > "$work/slurm.conf"
  export SLURM_CONF="$work/slurm.conf"
  munged --force --key-file="$work/munge/key" --socket="$work/run/munge.socket" --pid-file="$work/run/munged.pid" \
    --log-file="$work/munge/log" --seed-file="$work/munge/seed" 2> "$work/munge/said" ||
    { echo "munged does not start: $(tail -n 1 "$work/munge/said")"; return 1; }
  start_controller
  for n in 1 2 3; do start_node $n; done
  for i in $(seq 100); do [ "$(sinfo -h -t idle -o %D 2> /dev/null)" = 3 ] && return; sleep .2; done
  echo "the nodes do not start"; sinfo; tail -n 3 "$work"/slurm*.log
  return 2
}

address() { [ "$spaces" ] && echo "$net.1$1" || echo 127.0.0.1; }
write_slurm_conf() {
  ports=$((20000 + $$ % 20000))
  cat << CONF
ClusterName=vs
SlurmctldHost=$host($([ "$spaces" ] && echo "$net.1" || echo 127.0.0.1))
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/munge
AuthInfo=socket=$work/run/munge.socket
SlurmctldPort=$ports
SlurmctldPidFile=$work/run/slurmctld.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdPidFile=$work/run/slurmd-%n.pid
SlurmdSpoolDir=$work/spool/%n
SlurmdLogFile=$work/slurmd-%n.log
StateSaveLocation=$work/state
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_interval=2,bf_interval=2,batch_sched_delay=0
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
ReturnToService=2
MpiDefault=none
SlurmdTimeout=10
SlurmctldTimeout=10
KillWait=2
CONF
  for n in 1 2 3; do echo "NodeName=n$n NodeHostname=$host NodeAddr=$(address $n) Port=$((ports + n)) CPUs=1 RealMemory=2000"; done
  echo "PartitionName=all Nodes=n[1-3] Default=YES MaxTime=INFINITE State=UP"
}

# Starts node n$1. In a namespace its process 1 is this shell: when that is killed, all processes of the node are.
start_node() {
  mkdir -p "$work/spool/n$1"
  if [ -z "$spaces" ]; then slurmd -N "n$1"; return; fi
  unshare --fork --pid --mount --net --mount-proc --kill-child sh -c '
    until ip link set eth0 up 2> /dev/null; do sleep .05; done
    ip addr add '"$(address "$1")"'/24 dev eth0; ip link set lo up
    [ '"$1"' != 3 ] || [ ! -f '"$work"'/small ] || { mount -t tmpfs -o size=4k full '"$work"'/tmp && cp /bin/sh '"$work"'/tmp/ 2> /dev/null; }
    mount -t tmpfs -o size=4k hidden '"$work"'/hidden
    [ '"$1"' != 2 ] || : > '"$work"'/hidden/other
    exec slurmd -D -N n'"$1" > /dev/null 2>&1 &
  echo $! > "$work/run/node$1"
  for i in $(seq 100); do inside=$(ps -o pid= --ppid "$!" | tr -d ' '); [ "$inside" ] && break; sleep .05; done
  ip link add "v$bridge$1" type veth peer name eth0 netns "$inside" && ip link set "v$bridge$1" master "$bridge" up
}
kill_node() { kill -9 "$(cat "$work/run/node$1")"; rm "$work/run/node$1"; }
start_controller() { slurmctld > /dev/null 2>&1; }


# Ends all processes of the cluster, and removes its folder.
stop_cluster() {
  for f in "$work"/run/*.pid; do [ ! -f "$f" ] || kill "$(cat "$f")" 2> /dev/null; done
  for n in 1 2 3; do [ ! -f "$work/run/node$n" ] || kill -9 "$(cat "$work/run/node$n")" 2> /dev/null; done
  [ -z "$spaces" ] || ip link del "$bridge" 2> /dev/null
  sleep 1; cd /; rm -rf "$work"
}
