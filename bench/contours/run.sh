#!/bin/sh
# Runs the comparison of isosurfaces: `bench/contours/run.sh build/vs build/measure [CELLS...]`. A gyroid in a box,
# closed at its sides, by make-isosurface, by scikit-image's marching cubes and by Manifold's marching tetrahedra, in
# turn in one run: seconds of processor time, medians of RUNS (5) runs minus those of a run that only loads; largest
# memory; triangles; and the deviation of the volume from half of the box.
set -u
vs=$(realpath "$1") measure=$(realpath "$2"); shift 2
here=$(cd "$(dirname "$0")" && pwd) || exit 1
[ $# -gt 0 ] || set -- 64 128 256
work=${WORK:-/tmp/vs-bench-contours}
mkdir -p "$work" && cd "$work" || exit 1
if [ ! -f node_modules/manifold-3d/manifold.js ]; then
  cp "$here/../kernel/package.json" . && npm install --ignore-scripts --no-package-lock --no-audit --no-fund --silent ||
    echo "manifold-3d could not be fetched: its rows are left out" >&2
fi
/usr/bin/python3 -c 'import skimage.measure' 2> /dev/null || echo "scikit-image is not installed: its rows are left out" >&2
timed() { # runs, system, cells
  case $2 in
    vs)       "$measure" "$1" "$vs" --quiet --check -D cells="$3" "$here/gyroid.vs" ;;
    skimage)  "$measure" "$1" /usr/bin/python3 "$here/gyroid.py" "$3" ;;
    manifold) "$measure" "$1" node "$here/gyroid.mjs" "$work" "$3" ;;
  esac
}
echo "| cells | program | s | times vs | MB | triangles | off |"
echo "|--:|---|--:|--:|--:|--:|--:|"
for cells in "$@"; do
  ours=
  for system in vs skimage manifold; do
    timed "${RUNS:-5}" $system "$cells" 2> time > result || continue
    idle="$([ $system = vs ] && echo 2 || echo 0)" # two cells are nothing beside 64
    timed "${RUNS:-5}" $system "$idle" 2> loading > /dev/null || exit 1
    row=$(cat time loading result | grep -a '^[0-9]' | tr '\n' ' ')
    ours=$(echo "$row" | awk -v n="$cells" -v s=$system -v ours="$ours" '{
      t = ($1 - $4) / 1000; if (ours == "") ours = t
      printf "| %d | %s | %.2f | %.2f | %d | %d | %.5f |\n", n, s, t, t / ours, $3 / 1024, $7, ($8 / (4 * 3.14159265358979 ^ 3) - 1) > "/dev/stderr"
      print ours }' 2>&3)
  done
done 3>&1
