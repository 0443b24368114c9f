#!/bin/sh
# Runs the experiment of the thesis' table 4.1: a grid of 51 x 51 cylinders without passes, with folding, with sharing,
# with both, for every format: commands by the rule of manual/internals/model.md, bytes, processor time; the number of
# sets within an n-ary set; and POV-Ray's time and memory for parsing the four scenes. `bench/passes.sh build/vs
# build/measure`.
set -u
vs=$(realpath "$1") measure=$(realpath "$2")
[ -x "$vs" ] && [ -x "$measure" ] || { echo "bench/passes.sh: make all build/measure first" >&2; exit 1; }
cd "$(dirname "$0")/models" || exit 1
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
number() { sed -n "s/.*\"$1\": \([0-9.]*\).*/\1/p" "$2"; }

echo "| passes | commands | with a set of any size as one | format | KB | ms |"
echo "|---|--:|--:|---|--:|--:|"
for passes in 0 fold share fold,share; do
  "$vs" --quiet "-O$passes" grid.vs -o - --format tree > "$work/tree" || exit 1
  # definitions, uses (a line that is a name), and everything else in parentheses but the frame
  sets=$(awk '/^\(tree/ { next } /^ *\(define/ { n++; next } { line = $0; sub(/^ *\(draw /, "", line); if (line ~ /^ *\((unite|transform|cylinder)/ || line ~ /^ *t[0-9]+\)*$/) n++ } END { print n }' "$work/tree")
  for format in pov scad x3d glb 3mf stl; do
    out=$work/$passes.$format
    "$vs" --quiet "-O$passes" grid.vs -o "$out" --stats=json 2> "$work/stats" || { cat "$work/stats"; exit 1; }
    "$measure" 5 "$vs" --quiet "-O$passes" grid.vs -o "$out" 2> "$work/time"
    echo "| -O$passes | $(number commands.after "$work/stats") | $sets | .$format | $(($(wc -c < "$out") / 1024)) | $(awk '{ printf "%.0f", $1 }' "$work/time") |"
  done
done

command -v povray > /dev/null || exit 0
printf '\n| cylinders | passes | POV-Ray parses in ms | and takes MB |\n|--:|---|--:|--:|\n'
cd "$work" || exit 1
echo 'camera { location <0, 0, 1> }' > empty.pov
"$measure" 3 povray empty.pov +W4 +H3 -D -V -GA +O/dev/null 2>&1 > /dev/null | tail -n 1 > empty
for count in 51 401; do
  for passes in 0 fold share fold,share; do
    "$vs" --quiet "-O$passes" -D count=$count "$OLDPWD/grid.vs" -o "$passes.pov" || exit 1
    # POV-Ray's own count of processor seconds, and the memory of the process minus that of an empty scene: a picture of
    # twelve pixels costs nothing
    for run in 1 2 3; do
      povray "$passes.pov" +W4 +H3 -D -V +O/dev/null 2>&1 | awk '/Parse Time:/ { parse = 1 } parse && /CPU-seconds/ { for (i = 1; i < NF; i++) if ($(i + 1) ~ /^CPU/) { print $i * 1000; exit } }'
    done | sort -n | sed -n 2p > parse
    "$measure" 3 povray "$passes.pov" +W4 +H3 -D -V -GA +O/dev/null 2>&1 > /dev/null | tail -n 1 > line
    echo "$count $passes $(cat parse line empty | tr '\n' ' ')" | awk '{ printf "| %d | -O%s | %.0f | %.0f |\n", $1 * $1, $2, $3, ($6 - $9) / 1024 }'
  done
done
