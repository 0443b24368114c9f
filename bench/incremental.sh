#!/bin/sh
# Runs the measure of writing again: a drawing written first, written again, written after a change of one parameter
# (the program runs again), and written by a fresh process with that parameter. Milliseconds of elapsed time, of the
# output alone: passes, meshes, the file; in brackets the time of the text. Then the numbers of clusters and of pieces
# of text in the changed drawing, and how many of them were made again. The last column compares the changed file with
# the fresh one. `bench/incremental.sh build/vs`.
set -u
vs=$(realpath "$1")
cd "$(dirname "$0")/.." || exit 1
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
echo "| drawing | change | format | first, ms | again | changed | fresh | clusters | of them combined again | texts | of them written again | same bytes |"
echo "|---|---|---|--:|--:|--:|--:|--:|--:|--:|--:|---|"
row() { # model parameter value format...
  model=$1 name=$2 value=$3; shift 3
  for format; do
    mkdir -p "$work/fresh"
    printf ',write %s\n,write %s\n,set %s %s\n,write %s\n,stats json\n' "$work/m.$format" "$work/m.$format" "$name" "$value" "$work/m.$format" |
      "$vs" --quiet -i "$model" 2>&1 > /dev/null | grep '^{' > "$work/said"
    "$vs" --quiet "$model" -D "$name=$value" -o "$work/fresh/m.$format" --stats=json 2>&1 | grep '^{' >> "$work/said"
    same=no; cmp -s "$work/m.$format" "$work/fresh/m.$format" && same=yes
    awk -v model="$(basename "$model" .vs)" -v change="$name $value" -v format="$format" -v same="$same" '
      { sub(/\], "time.evaluate.*/, ""); n = split($0, output, /"file": /)
        for (i = 2; i <= n; i++) {
          o++
          m = split(output[i], part, /, /)
          for (k = 1; k <= m; k++) { split(part[k], kv, /: /); gsub(/"/, "", kv[1]); value[o, kv[1]] = kv[2] } } }
      END { printf "| %s | %s | .%s", model, change, format
            for (i = 1; i <= 4; i++) printf " | %.0f (%.0f)", value[i, "time.total"] * 1000, value[i, "time.emit"] * 1000
            printf " | %d | %d | %d | %d | %s |\n", value[3, "clusters"], value[3, "clusters.combined"], value[3, "texts"], value[3, "texts.emitted"], same }' "$work/said"
  done
}
row bench/models/village.vs door 1.2 stl 3mf obj
row examples/arcade.vs bays 6 stl glb
row examples/gare-do-oriente.vs n-bars 11 stl glb html
row examples/rotunda.vs coffers 24 stl
row examples/city.vs tallest 45 glb pov scad html
row bench/models/village.vs door 1.2 pov scad
row bench/models/posts.vs height 2 pov scad
