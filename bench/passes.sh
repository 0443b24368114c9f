#!/bin/sh
# Owns the experiment of the thesis' table 4.1: a grid of 51 x 51 cylinders without passes, with folding, with sharing, with both, for every
# format: commands by the rule of manual/internals.md, bytes, processor time; and what POV-Ray needs to parse the four scenes.
# `bench/passes.sh build/vs build/measure`.
set -u
vs=$(realpath "$1") measure=$(realpath "$2")
cd "$(dirname "$0")/models" || exit 1
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
number() { sed -n "s/.*\"$1\": \([0-9.]*\).*/\1/p" "$2"; }

echo "| passes | commands | format | KB | ms |"
echo "|---|--:|---|--:|--:|"
for passes in 0 fold share fold,share; do
  for format in pov scad x3d glb stl; do
    out=$work/$passes.$format
    "$vs" --quiet "-O$passes" grid.vs -o "$out" --stats=json 2> "$work/stats" || { cat "$work/stats"; exit 1; }
    "$measure" 3 "$vs" --quiet "-O$passes" grid.vs -o "$out" 2> "$work/time"
    echo "| -O$passes | $(number commands.after "$work/stats") | .$format | $(($(wc -c < "$out") / 1024)) | $(awk '{ printf "%.0f", $1 }' "$work/time") |"
  done
done

command -v povray > /dev/null || exit 0
printf '\n| passes | POV-Ray parses in ms | and takes MB |\n|---|--:|--:|\n'
cd "$work" || exit 1
for passes in 0 fold share fold,share; do
  "$measure" 3 povray "$passes.pov" +W4 +H3 -D -V -GA +O/dev/null 2> "$work/said" > /dev/null
  # the process as a whole less that of an empty scene: parsing, for a picture of twelve pixels costs nothing
  tail -n 1 "$work/said" > "$work/line"
  echo 'camera { location <0, 0, 1> }' > empty.pov
  "$measure" 3 povray empty.pov +W4 +H3 -D -V -GA +O/dev/null 2>&1 > /dev/null | tail -n 1 > "$work/empty"
  echo "$passes $(cat "$work/line" "$work/empty" | tr '\n' ' ')" | awk '{ printf "| -O%s | %.0f | %.0f |\n", $1, $2 - $5, $4 / 1024 }'
done
