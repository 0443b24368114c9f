#!/bin/sh
# Runs the measure of sampling a function: `bench/sampling.sh build/vs build/measure`. A million values of x² + y² + z²
# - 1, by a kept expression and by calls of a lambda: milliseconds of processor time (user and system) of each, medians
# of RUNS (5) runs, in turn, minus the time of an empty program.
set -u
vs=$(realpath "$1") measure=$(realpath "$2")
cd "$(dirname "$0")/.." || exit 1
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
turns=10
for run in $(seq "${RUNS:-5}"); do
  for by in nothing kept called; do
    "$measure" 1 "$vs" --quiet --check -D by=$by -D times=$turns bench/sampling.vs 2>> "$work/$by" >> "$work/$by.value" || exit 1
  done
done
[ "$(sort -u "$work/kept.value")" = "$(sort -u "$work/called.value")" ] || { echo "the values differ" >&2; exit 1; }
median() { sort -n "$work/$1" | awk '{ at[NR] = $1 } END { print at[int((NR + 1) / 2)] }'; }
awk -v nothing="$(median nothing)" -v kept="$(median kept)" -v called="$(median called)" -v turns="$((turns + 1))" 'BEGIN {
  kept = (kept - nothing) / turns; called = (called - nothing) / turns
  print "| a million values | ms | times |"
  print "|---|--:|--:|"
  printf "| by a kept expression | %.1f | 1 |\n| by calling a lambda | %.1f | %.1f |\n", kept, called, called / kept }'
