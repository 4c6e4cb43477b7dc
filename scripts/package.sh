#!/usr/bin/env bash
# Builds what is installed and makes the Debian packages sigs and libsigs-dev of it, in build/package. The same source
# gives the same bytes: the time in them is that of the last commit, or SOURCE_DATE_EPOCH where that is set.
#   scripts/package.sh
set -euo pipefail
source "$(dirname "$0")/setup.sh"

sigs_install programs package
export SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2>/dev/null || stat -c %Y CHANGELOG.md)}
options=()
[ -e build/release/CMakeCache.txt ] || options=(-DSIGS_TESTS=OFF -DSIGS_BENCH=OFF)
sigs_build release -DSIGS_PYTHON=ON -DSIGS_EDITOR=ON "${options[@]}" -- installed
mkdir -p build/package
# Permissions in the package are not those of whoever builds it.
umask 022
(cd build/release && cpack -G DEB -B "$PWD/../package")
rm -rf build/package/_CPack_Packages
ls -l build/package/*.deb
