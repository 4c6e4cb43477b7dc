#!/usr/bin/env bash
# Puts a file's text between the lines <!-- NAME:begin --> and <!-- NAME:end --> of a page.
#   bench/fill.sh PAGE NAME FILE
set -euo pipefail
grep -q "<!-- $2:begin -->" "$1" && grep -q "<!-- $2:end -->" "$1" || { echo "error: $1 has no place for $2" >&2; exit 1; }
filled=$(mktemp)
trap 'rm -f "$filled"' EXIT
awk -v name="$2" -v file="$3" '
  $0 == "<!-- " name ":end -->" { inside = 0 }
  !inside { print }
  $0 == "<!-- " name ":begin -->" { inside = 1; while ((getline line < file) > 0) print line }' "$1" >"$filled"
cat "$filled" >"$1"
