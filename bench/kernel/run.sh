#!/bin/sh
# Runs the comparison of the mesh kernel with Manifold and OpenSCAD, and the growth of its time. Some 20 minutes on a
# quiet machine.
# `bench/kernel/run.sh build/vs build/measure [WORKLOAD ...]`; RUNS=3: runs of vs; SCAD=20: the limit in seconds for
# OpenSCAD (0: omit it); WASM=120: the limit for manifold-3d.
#
#   vs s       elapsed seconds from the tree to the written .stl, the median of the runs; beside it the time for reading
#              and evaluating the program
#   cpu s, MB  of the whole process, all threads, in runs without --stats, which walks the tree repeatedly
#   native     Manifold's library, from its tree to the triangles in memory, elapsed, all threads; it is built with TBB
#              from its sources (include/, src/) in MANIFOLD=FOLDER
#   elsewhere  Manifold 3.5.1, the whole process from ready facets, measured on another machine (native.tsv)
#   wasm       manifold-3d, from its tree to the triangles in memory, without starting its module; OpenSCAD: the whole
#              process, processor seconds
# Without names it runs the 44 workloads of gen.mjs. Workloads of families.mjs (many solids in one place) run by name,
# with SCAD=0: `... boxes_50 boxes_100 boxes_200`. Once OpenSCAD has not finished a member of a family, the script omits
# it for the larger ones.
set -u
usage() { echo "usage: bench/kernel/run.sh VS MEASURE [WORKLOAD ...]" >&2; exit 1; }
cd "$(dirname "$0")/../.." || exit 1
[ $# -ge 2 ] || usage
for program in "$1" "$2"; do [ -x "$program" ] || { echo "run.sh: there is no program $program (make all $2)" >&2; exit 1; }; done
command -v node > /dev/null || { echo "run.sh: there is no node (package nodejs)" >&2; exit 1; }
vs=$PWD/$1 measure=$PWD/$2; shift 2
runs=${RUNS:-3} limit=${SCAD:-20} patience=${WASM:-120} work=$PWD/build/bench-kernel here=$PWD/bench/kernel
mkdir -p "$work" && cd "$work" || exit 1
node "$here/gen.mjs" "$work" > /dev/null && node "$here/families.mjs" "$work" || exit 1
if [ ! -f node_modules/manifold-3d/manifold.js ]; then
  cp "$here/package.json" . && npm install --no-package-lock --no-audit --no-fund --silent || echo "manifold-3d could not be fetched: its columns stay empty" >&2
fi
if [ -n "${MANIFOLD-}" ] && [ ! -x native ]; then # two minutes, once
  g++ -std=c++17 -O3 -DNDEBUG -DMANIFOLD_PAR=1 -I"$MANIFOLD/include" "$here/native.cc" "$MANIFOLD"/src/*.cpp -o native -ltbb || echo "Manifold could not be built: its columns stay empty" >&2
fi
command -v openscad > /dev/null || { echo "openscad is not installed: its columns stay empty" >&2; limit=0; }
[ $# -gt 0 ] || set -- $(sed 1d INDEX.tsv | cut -f1)

# the median of the input's numbers, one a line
median() { sort -n | awk '{ x[NR] = $1 } END { if (NR) print NR % 2 ? x[(NR + 1) / 2] : (x[NR / 2] + x[NR / 2 + 1]) / 2 }'; }
# the values that the program printed under that name, one for each run
stat_of() { sed -n "s/.*}\], .*\"$1\": *\([0-9.e-]*\).*/\1/p" stats | median; }

echo "| workload | vs s | + evaluating | cpu s | MB | triangles | closed | native s | MB | native / vs | elsewhere s | MB | elsewhere / vs | wasm s | MB | triangles | closed | wasm / vs | OpenSCAD s | MB |"
echo "|---|--:|--:|--:|--:|--:|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|---|--:|--:|--:|"
: > figures
failed=0 gave_up=
for name in "$@"; do
  [ -f "sx/$name.sx" ] || { echo "run.sh: there is no workload $name" >&2; exit 1; }
  cat "$here/suite.vs" "sx/$name.sx" > "$name.vs"
  rm -f "$name.stl"
  : > stats
  for run in $(seq "$runs"); do "$vs" --quiet "$name.vs" --stats=json -o "$name.stl" 2>> stats > /dev/null; done
  ours=$("$measure" "$runs" "$vs" --quiet "$name.vs" -o "$name.stl" 2>&1 > /dev/null | tail -n 1) phase=$(stat_of time.write) evaluate=$(stat_of time.evaluate)
  if [ ! -s "$name.stl" ] || [ -z "$phase" ]; then
    echo "run.sh: vs failed on $name: $(head -n 2 stats)" >&2
    failed=1
    continue
  fi
  solid=$(node --max-old-space-size=8192 "$here/closed.mjs" "$name.stl" 2> /dev/null || echo "- failed")
  elsewhere=$(awk -F '\t' -v name="$name" '$1 == name { print $2, $3 }' "$here/native.tsv")
  native= theirs= scad= family=${name%_*}
  if [ -x native ]; then
    native=$(for run in $(seq "$runs"); do timeout "$patience" ./native "sx/$name.sx"; done | sed 's/.*"seconds": \([0-9.]*\),.*/\1/' | median)
    native="$native $(timeout "$patience" "$measure" 1 ./native "sx/$name.sx" 2>&1 > /dev/null | tail -n 1 | awk '{ printf "%.0f", $3 / 1024 }')"
  fi
  if [ -f node_modules/manifold-3d/manifold.js ]; then
    theirs=$(timeout "$patience" "$measure" 1 node "$here/manifold.mjs" . "sx/$name.sx" 2> memory; tail -n 1 memory)
  fi
  case " $gave_up " in *" $family "*) ;; *)
    if [ "$limit" -gt 0 ]; then
      "$measure" 1 timeout "$limit" openscad -o "$name.scad.stl" "scad/$name.scad" 2> memory > /dev/null
      if [ -s "$name.scad.stl" ]; then scad=$(tail -n 1 memory); else gave_up="$gave_up $family"; fi
    fi ;;
  esac
  rm -f "$name.stl" "$name.scad.stl" "$name.vs"
  printf '%s\n' "name $name" "ours $ours" "phase $phase" "evaluate $evaluate" "solid $solid" "native $native" "elsewhere $elsewhere" "scad $scad" "$theirs" | awk -v figures=figures '
    # measure prints: processor ms, elapsed ms, kilobytes
    function seconds(x) { return x ~ /^[0-9.]+$/ ? sprintf(x < 10000 ? "%.3f" : "%.1f", x / 1000) : "" }
    function megabytes(x) { return x ~ /^[0-9.]+$/ ? sprintf("%.0f", x / 1024) : "" }
    function ratio(x) { return x > 0 && phase > 0 ? sprintf("%.1f", x / phase) : "" }
    $1 == "name" { name = $2 }
    $1 == "ours" { cpu = seconds($2); mb = megabytes($4) }
    $1 == "phase" { phase = $2 }
    $1 == "evaluate" { evaluate = $2 }
    $1 == "solid" { count = $2; closed = $3 }
    $1 == "native" { native = $2; native_mb = $3 }
    $1 == "elsewhere" { elsewhere = $2; elsewhere_mb = $3 }
    $1 == "scad" { scad = seconds($2); scad_mb = megabytes($4) }
    /^\{/ { json = $0 }
    json != "" && /^[0-9]/ { wasm_mb = megabytes($3) }
    END {
      if (match(json, /"seconds":[0-9.e-]+/)) wasm = substr(json, RSTART + 10, RLENGTH - 10)
      if (match(json, /"triangles":[0-9]+/)) wasm_count = substr(json, RSTART + 12, RLENGTH - 12)
      if (json != "") wasm_closed = json ~ /"closed":true/ ? "yes" : "no"
      printf "| %s | %.3f | %.3f | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s |\n", name, phase, evaluate, cpu, mb, count, closed,
        native, native_mb, ratio(native), elsewhere, elsewhere_mb, ratio(elsewhere), wasm == "" ? "" : sprintf("%.3f", wasm), wasm_mb, wasm_count, wasm_closed, ratio(wasm), scad, scad_mb
      print name, phase, mb, native == "" ? "-" : native, native_mb == "" ? "-" : native_mb, elsewhere == "" ? "-" : elsewhere, wasm == "" ? "-" : wasm, scad == "" ? "-" : scad > figures ".one"
    }'
  cat figures.one >> figures && rm -f figures.one
done
[ -s figures ] || { echo "run.sh: nothing was measured" >&2; exit 1; }
echo
awk '
  # groups of the aims; each of whole names
  BEGIN {
    group[1] = "all"; member[1] = ".*"; aim[1] = "5"
    group[2] = "many small parts (b d f_1000 j l)"; member[2] = "^(b_.*|d_.*|f_spheres_1000|j_.*|l_.*)$"; aim[2] = "8"
    group[3] = "instanced and disjoint (a k m)"; member[3] = "^(a|k|m)_.*$"; aim[3] = "10"
    group[4] = "two large meshes (e_256 h_1024)"; member[4] = "^(e_sphere_minus_256|h_torus_1024)$"; aim[4] = "1"
    group[5] = "near-coincident (e2)"; member[5] = "^e2_.*$"; aim[5] = "1"
    print "Geometric means; the aim is against native Manifold.\n"
    print "| group | aim | native / vs | of | native MB / vs MB | elsewhere / vs | of | wasm / vs | of | OpenSCAD / vs | of |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|"
  }
  { for (g = 1; g <= 5; g++) if ($1 ~ member[g] && $2 > 0) {
      if ($4 != "-") { native[g] += log($4 / $2); n[g]++; memory[g] += log($5 / $3) }
      if ($6 != "-") { elsewhere[g] += log($6 / $2); e[g]++ }
      if ($7 != "-") { wasm[g] += log($7 / $2); m[g]++ }
      if ($8 != "-") { scad[g] += log($8 / $2); s[g]++ } } }
  function mean(sum, count) { return count ? sprintf("%.1f", exp(sum / count)) : "" }
  END { for (g = 1; g <= 5; g++) if (n[g] + e[g] + m[g] + s[g])
    printf "| %s | %s | %s | %d | %s | %s | %d | %s | %d | %s | %d |\n", group[g], aim[g], mean(native[g], n[g]), n[g], mean(memory[g], n[g]), mean(elsewhere[g], e[g]), e[g], mean(wasm[g], m[g]), m[g], mean(scad[g], s[g]), s[g] }' figures
echo
# time ~ N^e, fitted by least squares over a family; beside it the e of N log N between the same ends
awk '
  { name = $1; parts = split(name, p, "_"); N = p[parts]; family = substr(name, 1, length(name) - length(N) - 1)
    if (family ~ /^b_/) N = N * N
    if (name == "f_spheres_100") next   # its spheres have twice the facets
    if (family !~ /^(b_grid_overlap|c_wall|f_spheres|j_truss)$/ || $2 <= 0) next
    x = log(N); y = log($2); k[family]++; sx[family] += x; sy[family] += y; sxx[family] += x * x; sxy[family] += x * y
    if (!(family in low) || N < low[family]) low[family] = N
    if (!(family in high) || N > high[family]) high[family] = N }
  END { for (f in k) if (k[f] > 1 && high[f] > low[f])
      printf "%s: over %d sizes from N = %d to %d, time grows as N^%.2f; N log N would be N^%.2f\n", f, k[f], low[f], high[f],
        (k[f] * sxy[f] - sx[f] * sy[f]) / (k[f] * sxx[f] - sx[f] * sx[f]), log(high[f] * log(high[f]) / (low[f] * log(low[f]))) / log(high[f] / low[f]) }' figures | sort
rm -f figures memory stats
exit $failed
