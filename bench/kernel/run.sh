#!/bin/sh
# Owns the comparison of the mesh kernel with Manifold (manifold-3d, WebAssembly) and OpenSCAD, and how its time grows.
# `bench/kernel/run.sh build/vs build/measure [WORKLOAD ...]`; RUNS=3 is how often ours runs, SCAD=20 how many seconds OpenSCAD gets (0: none).
#
# All times are processor seconds (user and system, all threads): other work on the machine then matters less. Ours is the whole process, from the
# program's text to the STL file; what reading and evaluating it took is beside it. Manifold's is from its tree to the triangles. OpenSCAD's is the whole process.
set -u
cd "$(dirname "$0")/../.." || exit 1
vs=$PWD/$1 measure=$PWD/$2; shift 2
runs=${RUNS:-3} limit=${SCAD:-20} work=$PWD/build/bench-kernel here=$PWD/bench/kernel
mkdir -p "$work" && cd "$work" || exit 1
node "$here/gen.mjs" "$work" > /dev/null || exit 1
if [ ! -f node_modules/manifold-3d/manifold.js ]; then
  cp "$here/package.json" . && npm install --no-package-lock --no-audit --no-fund --silent || echo "manifold-3d could not be fetched: its columns stay empty" >&2
fi
[ $# -gt 0 ] || set -- $(sed 1d INDEX.tsv | cut -f1)

echo "| workload | vs s | of it evaluating | vs MB | triangles | closed | Manifold s | MB | triangles | closed | Manifold / vs | OpenSCAD s | MB |"
echo "|---|--:|--:|--:|--:|---|--:|--:|--:|---|--:|--:|--:|"
: > figures
for name in "$@"; do
  cat "$here/suite.vs" "sx/$name.sx" > "$name.vs"
  "$measure" "$runs" "$vs" --quiet "$name.vs" --stats=json -o "$name.stl" 2> stats > /dev/null
  ours=$(tail -n 1 stats)
  evaluate=$(sed -n 's/.*"time.evaluate": *\([0-9.e-]*\).*/\1/p' stats | head -n 1)
  solid=$(node "$here/closed.mjs" "$name.stl" 2>/dev/null || echo "- failed")
  theirs= scad=
  if [ -f node_modules/manifold-3d/manifold.js ]; then
    theirs=$(timeout 600 "$measure" 1 node "$here/manifold.mjs" . "sx/$name.sx" 2> memory; tail -n 1 memory)
  fi
  if [ "$limit" -gt 0 ] && command -v openscad > /dev/null; then
    "$measure" 1 timeout "$limit" openscad -o "$name.scad.stl" "scad/$name.scad" 2> memory > /dev/null && scad=$(tail -n 1 memory)
  fi
  rm -f "$name.stl" "$name.scad.stl"
  printf '%s\n%s\n%s\n%s\n%s\n' "$ours" "$evaluate" "$solid" "$theirs" "$scad" | awk -v name="$name" -v figures=figures '
    # measure writes: processor ms, elapsed ms, kilobytes
    function seconds(line) { split(line, f, " "); return f[1] ~ /^[0-9.]+$/ ? sprintf("%.3f", f[1] / 1000) : "" }
    function megabytes(line) { split(line, f, " "); return f[3] ~ /^[0-9.]+$/ ? sprintf("%.0f", f[3] / 1024) : "" }
    { line[NR] = $0 }
    END {
      ours = seconds(line[1]); mb = megabytes(line[1]); split(line[3], s, " ")
      json = 0; memory = ""; scad = line[NR]
      for (i = 4; i < NR; i++) { if (line[i] ~ /^\{/) json = line[i]; else if (json != 0 && line[i] ~ /^[0-9]/) memory = megabytes(line[i]) }
      if (json != 0) {
        match(json, /"seconds":[0-9.e-]+/); time = substr(json, RSTART + 10, RLENGTH - 10)
        match(json, /"triangles":[0-9]+/); count = substr(json, RSTART + 12, RLENGTH - 12)
        closed = json ~ /"closed":true/ ? "yes" : "no"
        ratio = ours > 0 ? sprintf("%.1f", time / ours) : ""; time = sprintf("%.3f", time)
        print name, ours, time > figures ".one"
      }
      printf "| %s | %s | %.3f | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s |\n", name, ours, line[2], mb, s[1], s[2], time, memory, count, closed, ratio, seconds(scad), megabytes(scad)
    }'
  echo "$name $(echo "$ours" | awk '{ print $1 / 1000 }')" >> grown
  [ -f figures.one ] && cat figures.one >> figures && rm -f figures.one
done
echo
awk '{ if ($2 > 0) { sum += log($3 / $2); n++ } } END { if (n) printf "Manifold / vs, geometric mean of %d: %.1f\n", n, exp(sum / n) }' figures
# time ~ N^e between the ends of each family
awk '
  function size(name, p) { n = split(name, p, "_"); return p[n] }
  { name = $1; N = size(name); family = substr(name, 1, length(name) - length(N) - 1)
    if (family ~ /^b2?_/) N = N * N
    if (family == "f_spheres" && N == 100) next   # its spheres have twice the facets
    if (!(family in low) || N < low[family]) { low[family] = N; at_low[family] = $2 }
    if (!(family in high) || N > high[family]) { high[family] = N; at_high[family] = $2 } }
  END { for (family in low) if (family ~ /^(b_grid_overlap|c_wall|f_spheres|j_truss)$/ && high[family] > low[family] && at_low[family] > 0)
      printf "%s: from N = %d to %d, time grows as N^%.2f\n", family, low[family], high[family], log(at_high[family] / at_low[family]) / log(high[family] / low[family]) }' grown | sort
rm -f grown figures memory stats
