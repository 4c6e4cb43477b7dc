#!/usr/bin/env bash
# Tries the Debian package on a bare Debian 12, in a folder: installs it there with apt and runs the programs, with no
# compiler at hand. Needs root, debootstrap and the mirror that this machine's apt uses. The folder is kept, and used
# again by the next call; about 1.5 GB.
#   scripts/try_package.sh FOLDER [VIDEO]
# With a video, a first project is made of it too. Results, a screenshot of the editor among them, are left in
# FOLDER/root/results.
set -euo pipefail
if [ "${SIGS_OWN_MOUNTS:-}" != yes ]; then
  [ $# -ge 1 ] || { echo "usage: scripts/try_package.sh FOLDER [VIDEO]" >&2; exit 64; }
  [ "$(id -u)" -eq 0 ] || { echo "error: only root can change to another root folder" >&2; exit 69; }
  exec env SIGS_OWN_MOUNTS=yes unshare --mount bash "$0" "$@"
fi
video=$(realpath "${2:-$(dirname "$0")/../assets/footage/sample.mp4}")
mkdir -p "$1"
root=$(realpath "$1")
cd "$(dirname "$0")/.."
package=$(ls build/package/sigs_*.deb)

if [ ! -e "$root/etc/debian_version" ]; then
  mirror=$(apt-get indextargets 'Created-By: Packages' 'Codename: bookworm' --format '$(REPO_URI)' | head -n 1)
  debootstrap --variant=minbase bookworm "$root" "$mirror"
fi
mount -t proc proc "$root/proc"
mount --rbind /dev "$root/dev"
cp /etc/resolv.conf "$root/etc/"
rm -rf "$root/root/results"
mkdir -p "$root/root/results"
cp "$package" "$video" "$root/root/results/"

inside() { chroot "$root" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive bash -euo pipefail -c "cd /root/results; $1"; }
step() { printf '\n== %s\n' "$1"; inside "$1"; }

inside "apt-get update -q" >/dev/null
inside "if dpkg -s sigs >/dev/null 2>&1; then apt-get purge -q -y sigs; fi" >/dev/null
step "apt-get install -q -y --no-install-recommends ./$(basename "$package") | tail -n 3"
step "for tool in cc gcc g++ clang ld cmake; do if command -v \$tool; then echo 'error: this root has a compiler' >&2; exit 1; fi; done"
step "sigs --version"
name=$(basename "$video")
if inside "sigs --help" | grep -q '^  init '; then
  step "sigs init $name --fov 70 --out first/first.json"
  step "sigs check first/*.json"
  step "sigs export first/*.json --out first/out --frames 0-49"
fi
step "sigs export /usr/share/sigs/projects/head-on/head-on.json --out out --codec h264 --frames 140-160"
step "sigs frame /usr/share/sigs/projects/head-on/head-on.json --frame 150 --out out"
step "cd /; python3 -c 'import sigs; print(sigs.__file__)'"

# For looking at the window and the manual alone.
inside "apt-get install -q -y --no-install-recommends xvfb man-db ffmpeg bash-completion" >/dev/null
step "man sigs-export | head -n 12"
step "source /usr/share/bash-completion/bash_completion; _completion_loader sigs || true; complete -p sigs
  COMP_WORDS=(sigs exp) COMP_CWORD=1; _sigs 2>/dev/null; echo \"sigs exp<TAB> gives: \${COMPREPLY[*]}\"; [ \"\${COMPREPLY[*]}\" = export ]"
step "Xvfb :77 -screen 0 1600x960x24 -nolisten tcp 2>/dev/null & server=\$!
  sleep 2
  export DISPLAY=:77
  sigs-editor --probe probe.json /usr/share/sigs/projects/head-on/head-on.json 2>editor.log & editor=\$!
  for second in \$(seq 90); do sleep 1; grep -q '\"current\":true' probe.json 2>/dev/null && break; done
  sleep 5
  ffmpeg -v error -y -f x11grab -video_size 1600x960 -i :77 -frames:v 1 editor.png
  kill \$editor
  sigs-editor --probe start.json 2>>editor.log & editor=\$!
  sleep 8
  ffmpeg -v error -y -f x11grab -video_size 1600x960 -i :77 -frames:v 1 start.png
  kill \$editor \$server; cat editor.log; grep -q '\"current\":true' probe.json"
printf '\nResults: %s\n' "$root/root/results"
