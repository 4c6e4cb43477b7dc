# A Slurm cluster of one machine in a folder of its own, on the loopback interface: real munged, slurmctld and slurmd, run by
# the current user. Sourced.
#   cluster_start FOLDER   returns once a node is idle; sets SLURM_CONF
#   cluster_stop FOLDER

cluster_config() {
  local folder=$1 port=$2 host user
  host=$(hostname -s)
  user=$(id -un)
  cat <<CONF
ClusterName=loopback
SlurmctldHost=$host(127.0.0.1)
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
AuthInfo=socket=$folder/munge/socket
CredType=cred/munge
SlurmctldPort=$port
SlurmdPort=$((port + 1))
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SwitchType=switch/none
MpiDefault=none
ReturnToService=2
MailProg=/bin/true
SchedulerParameters=sched_interval=1,batch_sched_delay=0,defer=0
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
}

port_is_free() {
  ! (exec 3<>"/dev/tcp/127.0.0.1/$1") 2>/dev/null
}

# Two free ports in a row, below those that the system gives to outgoing connections.
free_ports() {
  local port
  for _ in $(seq 100); do
    port=$((20000 + RANDOM % 10000))
    if port_is_free "$port" && port_is_free "$((port + 1))"; then
      echo "$port"
      return
    fi
  done
  return 1
}

cluster_logs() {
  tail -n 30 "$1"/slurmctld.log "$1"/slurmd.log "$1"/munge/log >&2 || true
}

cluster_start() {
  local folder=$1
  mkdir -p "$folder/spool" "$folder/state" "$folder/munge"
  chmod 700 "$folder" "$folder/munge"
  head -c 1024 /dev/urandom >"$folder/munge/key"
  chmod 400 "$folder/munge/key"
  # --force: else it refuses a folder other than /etc/munge.
  /usr/sbin/munged --force --key-file="$folder/munge/key" --socket="$folder/munge/socket" \
    --pid-file="$folder/munge/pid" --log-file="$folder/munge/log" --seed-file="$folder/munge/seed" 2>>"$folder/munge/log"
  export SLURM_CONF=$folder/slurm.conf
  cluster_config "$folder" "$(free_ports)" >"$SLURM_CONF"
  /usr/sbin/slurmctld -f "$SLURM_CONF"
  /usr/sbin/slurmd -f "$SLURM_CONF" -N "$(hostname -s)"
  for _ in $(seq 120); do
    if [ "$(sinfo --noheader --format=%T 2>/dev/null)" = idle ]; then return; fi
    sleep 0.25
  done
  echo "error: no node of the cluster became idle" >&2
  cluster_logs "$folder"
  return 1
}

cluster_stop() {
  local folder=$1 pid
  for pid in slurmd.pid slurmctld.pid munge/pid; do
    if [ -s "$folder/$pid" ]; then kill "$(cat "$folder/$pid")" 2>/dev/null || true; fi
  done
  for _ in $(seq 40); do
    [ -e "$folder/slurmctld.pid" ] || [ -e "$folder/munge/pid" ] || [ -e "$folder/slurmd.pid" ] || return 0
    sleep 0.25
  done
}
