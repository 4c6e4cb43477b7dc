#!/usr/bin/env bash
# Installs what SIGS is built with, on Debian 12 or Ubuntu 24.04, skipping what is there. Sourced by demo.sh and test.sh;
# on its own: scripts/setup.sh
set -euo pipefail

sigs_packages=(
  g++ cmake ninja-build pkg-config
  libopencv-dev libopencv-contrib-dev libavformat-dev libavcodec-dev libavutil-dev libswscale-dev
  libglm-dev libtinyobjloader-dev libepoxy-dev libegl-dev libegl1 libegl-mesa0 libgl1-mesa-dri
  nlohmann-json3-dev libcli11-dev libpugixml-dev libyaml-cpp-dev libexpected-dev libfmt-dev
  libimgui-dev libglfw3-dev libgl1 libglx-mesa0 fonts-inter fonts-dejavu-core
  doctest-dev libembree-dev ffmpeg libxml2-utils xvfb xdotool gnuplot-nox
  slurmctld slurmd slurm-client munge
)

sigs_as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    echo "error: packages are missing and neither root nor sudo is at hand; install: ${sigs_missing[*]}" >&2
    exit 69
  fi
}

sigs_install_packages() {
  sigs_missing=()
  local package
  for package in "${sigs_packages[@]}"; do
    dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed || sigs_missing+=("$package")
  done
  [ "${#sigs_missing[@]}" -gt 0 ] || return 0
  echo "installing: ${sigs_missing[*]}"
  sigs_as_root env DEBIAN_FRONTEND=noninteractive apt-get update -q
  sigs_as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${sigs_missing[@]}"
}

# sigs_build PRESET [more cmake options]
sigs_build() {
  local preset=$1
  shift
  cmake --preset "$preset" "$@"
  cmake --build --preset "$preset" --parallel "$(nproc)"
}

cd "$(dirname "${BASH_SOURCE[0]}")/.."
sigs_install_packages
