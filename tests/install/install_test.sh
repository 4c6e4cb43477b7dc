#!/usr/bin/env bash
# The project as it is installed into a folder, which is then moved: nothing in it names the source tree, the programs
# find their samples, a program of a stranger builds with find_package(sigs) and composes the frame that sigs composes.
#   install_test.sh BUILD SOURCE CXX_FLAGS     run by ctest
set -euo pipefail
build=$1
source_dir=$2
flags=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "error: $1" >&2; exit 1; }

cmake --install "$build" --prefix "$work/first" >"$work/install.log" || { tail "$work/install.log"; fail "cmake --install"; }
mv "$work/first" "$work/moved"
prefix=$work/moved

# Debug information, where there is any, names sources by intent.
naming=$(grep -rlF --exclude=*.a -e "$source_dir" -e "$build" "$prefix" || true)
case $flags$(grep -F CMAKE_BUILD_TYPE:STRING= "$build/CMakeCache.txt") in
  *sanitize* | *=*Deb*) naming= ;;
esac
[ -z "$naming" ] || fail "these name the source tree: $naming"
naming=$(grep -rlF -e "$work/first" "$prefix" || true)
[ -z "$naming" ] || fail "these name the folder that they were installed into: $naming"
for file in bin/sigs include/sigs/base/result.h share/sigs/assets/models share/sigs/projects/head-on/head-on.json \
  share/man/man1/sigs-export.1.gz share/bash-completion/completions/sigs share/zsh/vendor-completions/_sigs \
  share/doc/sigs/README.md; do
  [ -e "$prefix/$file" ] || fail "$file is not there"
done

cd /
project=$prefix/share/sigs/projects/head-on/head-on.json
"$prefix/bin/sigs" check "$project" >/dev/null || fail "the installed sample project does not check"
"$prefix/bin/sigs" frame "$project" --frame 150 --out "$work/out" >/dev/null

if command -v man >/dev/null; then
  for page in "$prefix"/share/man/man1/*.1.gz; do
    warnings=$(LC_ALL=C.UTF-8 MANROFFSEQ='' man --warnings --local-file "$page" 2>&1 >/dev/null)
    [ -z "$warnings" ] || fail "$page: $warnings"
  done
fi
if command -v desktop-file-validate >/dev/null && [ -e "$prefix/share/applications" ]; then
  desktop-file-validate "$prefix"/share/applications/*.desktop
fi

cmake -S "$source_dir/docs/examples/one_frame" -B "$work/example" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_CXX_FLAGS="$flags" >"$work/example.log" 2>&1 || { cat "$work/example.log"; fail "find_package(sigs)"; }
cmake --build "$work/example" >"$work/example.log" 2>&1 || { cat "$work/example.log"; fail "the example does not build"; }
"$work/example/one_frame" "$project" 150 "$work/one_frame.png"
cmp "$work/one_frame.png" "$work/out/frame_150.png" || fail "the example composes another frame than sigs does"

if [ -d "$prefix/lib/python3/dist-packages/sigs" ] && [[ $flags != *sanitize* ]]; then
  PYTHONPATH=$prefix/lib/python3/dist-packages /usr/bin/python3 -c 'import sigs' || fail "import sigs"
fi
