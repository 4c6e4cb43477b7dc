#!/usr/bin/env bash
# Installs the packages that SIGS needs, on Debian 12 or Ubuntu 24.04, and builds it. Sourced by demo.sh and test.sh.
#   sigs_install programs         the packages to build and run the two programs
#   sigs_install programs tests   and those for tests and measurements
#   sigs_install programs fuzz    and those for the fuzzers
#   sigs_install programs package and those for the Python module and the Debian packages
#   sigs_install lint, coverage   what scripts/lint.sh and scripts/coverage.sh need besides
#   sigs_build PRESET [cmake options] [-- targets]
# On its own, scripts/setup.sh installs all lists and builds nothing.
set -euo pipefail

sigs_packages_programs=(
  g++ cmake ninja-build pkg-config
  libopencv-dev libopencv-contrib-dev libavformat-dev libavcodec-dev libavutil-dev libswscale-dev
  libpng-dev libglm-dev libtinyobjloader-dev libassimp-dev libepoxy-dev libegl-dev libegl1 libegl-mesa0 libgl1-mesa-dri
  nlohmann-json3-dev libcli11-dev libpugixml-dev libyaml-cpp-dev libexpected-dev libfmt-dev libgeographiclib-dev
  pybind11-dev python3-dev python3-numpy
  libimgui-dev libglfw3-dev libx11-dev libgl1 libglx-mesa0 fonts-inter fonts-dejavu-core
)
# For the Debian packages (scripts/package.sh).
sigs_packages_package=(
  dpkg-dev file gzip
)
# doctest; Embree for the reference renderer; FFmpeg's, GeographicLib's and libxml2's programs as independent checks; Xvfb and xdotool for the
# window; Slurm for a dataset made by an array job; Python's tools for the wheel and types;
# man, zsh and desktop-file-validate for what is installed; locales, of which one writes a decimal comma.
sigs_packages_tests=(
  doctest-dev libembree-dev ffmpeg geographiclib-tools libxml2-utils xvfb xdotool
  slurmctld slurmd slurm-client munge
  python3-build python3-venv python3-pip mypy
  man-db zsh desktop-file-utils locales
)
# clang with libFuzzer and the sanitizers' libraries; FFmpeg's program makes videos to start from (scripts/fuzz.sh).
sigs_packages_fuzz=(
  clang-14 libclang-rt-14-dev ffmpeg
)
# For scripts/lint.sh.
sigs_packages_lint=(clang-14 clang-tidy-14 clang-tools-14)
# For scripts/coverage.sh.
sigs_packages_coverage=(gcovr)

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

# sigs_install LIST...: installs the packages of these lists that are not there.
sigs_install() {
  sigs_missing=()
  local list package
  for list in "$@"; do
    local -n packages="sigs_packages_$list"
    for package in "${packages[@]}"; do
      dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed || sigs_missing+=("$package")
    done
  done
  [ "${#sigs_missing[@]}" -gt 0 ] || return 0
  echo "installing: ${sigs_missing[*]}"
  sigs_as_root env DEBIAN_FRONTEND=noninteractive apt-get update -q
  sigs_as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${sigs_missing[@]}"
}

# sigs_build PRESET [cmake options] [-- targets]: without targets everything is built. A build from nothing compiles
# several sources at a time (SIGS_UNITY); a build folder that is there keeps its setting. With SIGS_WERROR=1 in the
# environment, as in CI, a warning of the compiler ends the build.
sigs_build() {
  local preset=$1 options=()
  shift
  [ -e "build/$preset/CMakeCache.txt" ] || options+=(-DSIGS_UNITY=ON)
  [ -z "${SIGS_WERROR:-}" ] || options+=(-DCMAKE_COMPILE_WARNING_AS_ERROR=ON)
  while [ $# -gt 0 ] && [ "$1" != -- ]; do
    options+=("$1")
    shift
  done
  [ $# -eq 0 ] || shift
  cmake --preset "$preset" "${options[@]}"
  cmake --build --preset "$preset" --parallel "$(nproc)" ${1:+--target "$@"}
}

cd "$(dirname "${BASH_SOURCE[0]}")/.."
[ "${BASH_SOURCE[0]}" != "$0" ] || sigs_install programs tests package fuzz
