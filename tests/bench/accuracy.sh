#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# accuracy.sh BUILD PAGE: measures what a page states of accuracy and speed, and rewrites its tables, which stand between
# the lines `<!-- measured: NAME -->` and `<!-- end -->`. The accuracy is what the tests print; the speed is that of this
# machine, other programs included.
set -euo pipefail
(($# == 2)) || { echo "usage: accuracy.sh BUILD PAGE" >&2; exit 2; }
build=$1 page=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# `name<TAB>rms<TAB>worst<TAB>noise` of every line `[noise of the truth N %; ]name: .. rms R %, worst ..: W %`.
truth_lines() {
  "$build/tests/model_truth_test" | awk '
    match($0, /: [0-9]+ values, rms /) {
      noise = "-"; name = substr($0, 1, RSTART - 1)
      if (sub(/^noise of the truth /, "", name)) { noise = name; sub(/ %; .*/, "", noise); sub(/^[^;]*; /, "", name) }
      rms = $0; sub(/.* rms /, "", rms); sub(/ %.*/, "", rms)
      worst = $0; sub(/.*: /, "", worst); sub(/ %.*/, "", worst); sub(/^-/, "", worst)
      printf "%s\t%s\t%s\t%s\n", name, rms, worst, noise
    }'
}

# What the names of the test stand for, in the order of the table.
truth_labels='clear by day|Monte Carlo, clear, from the ground|sun <= 80, view <= 85 deg
clear to twilight|the same|sun <= 92, view <= 89 deg
haze by day|Monte Carlo, haze (aerosol optical depth 0.2)|sun <= 80, view <= 85 deg
haze to sun 88|the same|sun <= 88, view <= 89 deg
clear-400nm|Monte Carlo, clear, 400 nm|sun <= 87, view <= 88 deg
haze-650nm|Monte Carlo, haze, 650 nm|sun <= 87, view <= 88 deg
thick-haze-450nm|Monte Carlo, thick haze (1.4), 450 nm, ozone|sun <= 87, view <= 88 deg
peaked-haze|Monte Carlo, haze with a narrow lobe|sun <= 79, view <= 84 deg
low-sun-haze|Monte Carlo, haze under a low sun|sun 80..88, view <= 88 deg
twilight-clear|Monte Carlo, twilight, clear|sun 88..92, view <= 88 deg
twilight-haze|Monte Carlo, twilight in haze|sun 88..92, view <= 88 deg
deep-twilight|Monte Carlo, deep twilight|sun 92..95, view <= 85 deg
altitude-clear|Monte Carlo, clear, from 0 to 20 km|sun <= 85 deg, all views
altitude-haze|Monte Carlo, haze, from 0 to 20 km|sun <= 85 deg, all views
space|Monte Carlo, from 400 and 36 000 km, disc and limb|sun <= 84 deg
mars|Monte Carlo, a dusty Mars|sun <= 89, view <= 88 deg
R1|discrete ordinates, plane-parallel, air|all
R3|the same, thicker|all
A3|discrete ordinates, plane-parallel, aerosol|all'

truth_table() {
  truth_lines >"$work/truth"
  echo '| truth | region (zenith angles) | rms | worst | noise of the truth |'
  echo '|---|---|---|---|---|'
  awk -F'\t' -v labels="$truth_labels" '
    { rms[$1] = $2; worst[$1] = $3; noise[$1] = $4 }
    END {
      n = split(labels, rows, "\n")
      for (i = 1; i <= n; ++i) {
        split(rows[i], part, "|")
        if (!(part[1] in rms)) { print "accuracy.sh: the test prints no line " part[1] > "/dev/stderr"; exit 1 }
        printf "| %s | %s | %.2g %% | %.2g %% | %s |\n", part[2], part[3], rms[part[1]], worst[part[1]],
          noise[part[1]] == "-" ? "-" : sprintf("%.2g %%", noise[part[1]])
      }
    }' "$work/truth"
}

# bench PROGRAM FILTER: the lines `name<TAB>CPU time<TAB>unit`; of repetitions the median.
bench() {
  "$build/bench/$1" --benchmark_filter="$2" --benchmark_format=csv 2>/dev/null |
    awk -F, 'NR > 1 && $1 !~ /_(mean|stddev|cv)"/ { gsub(/"/, "", $1); print $1 "\t" ($1 ~ /median|real_time/ ? $3 : $4) "\t" $5 }'
}

# speed_row LABEL PROGRAM FILTER
speed_row() {
  bench "$2" "$3" | awk -F'\t' -v label="$1" '
    { unit = $3 }
    { value = $2 }
    END { if (NR == 0) exit 1; printf "| %s | %.3g %s |\n", label, value, unit }' ||
    { echo "accuracy.sh: $2 has no benchmark $3" >&2; exit 1; }
}

speed_table() {
  echo '| what | time |'
  echo '|---|---|'
  speed_row '4 wavelengths, 9 suns, 115 directions from the ground, CPU' forward_bench '^Value/1/'
  speed_row 'the same with ten exact derivatives, CPU' forward_bench '^ValueAndTenDerivatives/1/'
  speed_row 'fit of cie:12 with two lobes, 4 starts, two threads, waiting' fit_bench '^FitOfCie12/2/'
  speed_row 'the tables of a renderer, 4 wavelengths, CPU' tables_bench '^ComputeTables/earth_clear'
  speed_row 'a look-up of the sky in these tables in C++' tables_bench '^LookupRadiance'
  speed_row 'frame of the valley, 1280 x 720, software, median' render_bench '^View/valley_1280x720/'
  speed_row 'the same, air by pixel' render_bench '^View/valley_1280x720_by_pixel/'
  speed_row 'the same, 640 x 360' render_bench '^View/valley_640x360/'
  speed_row 'a full-screen pass of 1280 x 720 with eight 3D fetches' render_bench '^EightFetches/1280x720/'
}

# replace NAME: the table that follows the mark takes the place of the old one.
replace() {
  "$1_table" >"$work/table"
  grep -q "^<!-- measured: $1 -->\$" "$page" || { echo "accuracy.sh: $page has no table $1" >&2; exit 1; }
  awk -v name="$1" -v table="$work/table" '
    $0 == "<!-- end -->" { skip = 0 }
    !skip { print }
    $0 == "<!-- measured: " name " -->" { skip = 1; while ((getline line < table) > 0) print line }' "$page" >"$work/page"
  cat "$work/page" >"$page"
}

replace truth
replace speed
