#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# compare_builds.sh OLD NEW: runs every line of compare_builds.txt with two programs and compares every number that it
# prints: the largest relative difference of each line, and how many numbers there are. Beside the programs lie their
# modules. For changes that must not move a digit; exit 1 where a line differs by more than 1e-6.
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
(($# == 2)) || { echo "usage: compare_builds.sh OLD NEW" >&2; exit 2; }
old=$(realpath "$1") new=$(realpath "$2")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Runs a line in an empty directory of its own; the examples are those of this checkout.
run_line() {
  mkdir "$work/$3" && (cd "$work/$3" && skyfit=$1 EXAMPLES=$here/../../data_refs/examples bash -c \
    'skyfit() { "$skyfit" "$@"; }; '"$2") >"$work/$3.out" 2>"$work/$3.err"
  local status=$?
  rm -rf "${work:?}/$3"
  return $status
}

numbers() {
  grep -oE '[-+]?[0-9]+\.?[0-9]*([eE][-+]?[0-9]+)?' "$1"
}

failed=0
while IFS= read -r line; do
  [[ -z "$line" || "$line" == \#* ]] && continue
  run_line "$old" "$line" old; old_status=$?
  run_line "$new" "$line" new; new_status=$?
  verdict=$(paste -d' ' <(numbers "$work/old.out") <(numbers "$work/new.out") | awk -v a="$old_status" -v b="$new_status" '
    NF != 2 { missing++; next }
    { n++; d = $1 - $2; if (d < 0) d = -d; m = $1 < 0 ? -$1 : $1; k = $2 < 0 ? -$2 : $2; if (k > m) m = k
      if (m > 0 && d / m > worst) worst = d / m }
    END { printf "%s %.1e of %d numbers", (worst > 1e-6 || missing || a != b || n == 0) ? "DIFFERS" : "same   ", worst, n
          if (missing) printf ", %d without a partner", missing
          if (a != b) printf ", exit %d and %d", a, b }')
  [[ "$verdict" == DIFFERS* ]] && failed=1
  printf '%-48s %s\n' "$verdict" "$line"
done <"$here/compare_builds.txt"
exit $failed
