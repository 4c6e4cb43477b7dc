#!/usr/bin/env bash
# A dataset as a Slurm array job is, byte for byte, the one that one machine makes; a shard that fails is reported by the merge.
#   dataset_test.sh SIGS SOURCE     run by ctest
set -euo pipefail
sigs=$1
source_dir=$2
source "$source_dir/tests/slurm/cluster.sh"
for program in slurmctld slurmd munged sbatch; do
  if ! PATH=$PATH:/usr/sbin command -v "$program" >/dev/null; then
    echo "SKIPPED: $program (slurmctld, slurmd, slurm-client, munge) is absent"
    exit 0
  fi
done

# munge's socket needs a short path.
folder=$(mktemp -d /tmp/sigs-slurm.XXXXXX)
trap 'cluster_stop "$folder/cluster"; rm -rf "$folder"' EXIT

fail() {
  echo "error: $1" >&2
  tail -n 20 "$folder"/out*/logs/*.log >&2 || true
  cluster_logs "$folder/cluster"
  exit 1
}

# Waits for a job to leave the queue.
await() {
  for _ in $(seq 480); do
    [ -n "$(squeue --noheader --jobs="$1" 2>/dev/null)" ] || return 0
    sleep 0.25
  done
  fail "job $1 is still in the queue"
}

# Name and checksum of every file but the logs.
checksums() {
  (cd "$1" && find . -type f -not -path './logs/*' -print0 | sort -z | xargs -0 sha256sum)
}

# Four videos of three frames; in a folder whose name has a blank.
write_recipe() {
  mkdir -p "$folder/my recipes"
  cat >"$1" <<JSON
{
  "sigs_dataset": 1,
  "name": "cluster",
  "seed": 0,
  "settings": {"export.video.codec": "h264", "export.labels": ["xml", "coco"]},
  "backgrounds": [{"name": "sample", "footage": {"video": "$source_dir/assets/footage/sample.mp4",
    "calibration": "$source_dir/assets/calibrations/sample.xml"}, "camera": {"speed_mps": 22}}],
  "aircraft": [{"name": "airliner", "model": {"file": "$source_dir/assets/models/airliner/airliner.obj"}}],
  "videos": [{"name": "{flight}", "frames": 3, "flights": [
    {"name": "LR", "kind": "left_right"}, {"name": "RL", "kind": "right_left"},
    {"name": "FN", "kind": "approaching"}, {"name": "NF", "kind": "moving_away"}]}]
}
JSON
}

recipe="$folder/my recipes/cluster.json"
write_recipe "$recipe"
"$sigs" dataset "$recipe" --out "$folder/one machine" --progress none >/dev/null || fail "the dataset could not be made"

cluster_start "$folder/cluster" || fail "the cluster did not start"
export SIGS=$sigs
jobs=$("$source_dir/scripts/slurm/submit.sh" "$recipe" "$folder/out" 3) || fail "nothing was submitted"
await "${jobs% *}"
await "${jobs#* }"
[ -e "$folder/out/index.json" ] || fail "the merge wrote no index"
diff <(checksums "$folder/one machine") <(checksums "$folder/out") || fail "the cluster's dataset is another one"
[ "$(find "$folder/out/logs" -name 'shard_*.log' | wc -l)" -eq 3 ] || fail "there are not three logs"

# A shard that cannot be written: the merge reports it, and the same submitted again continues.
rm -r "$folder/out/LR" "$folder/out/index.json"
: >"$folder/out/LR"
jobs=$("$source_dir/scripts/slurm/submit.sh" "$recipe" "$folder/out" 3) || fail "nothing was submitted again"
await "${jobs% *}"
await "${jobs#* }"
[ ! -e "$folder/out/index.json" ] || fail "an index was written although a video is missing"
grep -q LR "$folder/out/logs/merge.log" || fail "the merge does not name the video that is missing"
rm "$folder/out/LR"
jobs=$("$source_dir/scripts/slurm/submit.sh" "$recipe" "$folder/out" 3) || fail "nothing was submitted at last"
await "${jobs% *}"
await "${jobs#* }"
diff <(checksums "$folder/one machine") <(checksums "$folder/out") || fail "the completed dataset is another one"
echo "the cluster's dataset is the one machine's: $(checksums "$folder/out" | sha256sum | cut -c1-16)"
