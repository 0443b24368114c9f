#!/bin/sh
# Compares pack-parts with libnest2d on published sets of parts: sheets, and use of material. Some six minutes for 13 sets.
# `bench/nesting/run.sh build/vs FOLDER [SET ...]`; FOLDER holds the sets, SET.json, in the form of the repository
# JeroenGar/jagua-rs (assets/): items with demand, allowed_orientations and shape. EFFORT=1: seconds of pack-parts.
#
#   sheets   as high as the set's strip; the parts have the area of 1.2 sheets. Angles are those of the set.
#   use %    area of the parts over that of all sheets, of which the last one counts as far as it is filled
#   overlap  area that parts share, in per cent of the parts: by vs' kernel, or by Clipper
#   hulls    the best of libnest2d's configurations (first fit, first fit with accuracy 1, DJD) with the parts' convex
#            hulls, which is how it keeps concave parts apart; seconds of this configuration
#   outlines the same with the outlines themselves: its no-fit polygons are those of convex parts, so that others overlap
#   ratio    use of pack-parts over that of libnest2d with hulls
# libnest2d is Debian's libnest2d-dev, built here with Clipper and NLopt.
set -u
cd "$(dirname "$0")/../.." || exit 1
[ $# -ge 2 ] && [ -x "$1" ] && [ -d "$2" ] || { echo "usage: bench/nesting/run.sh VS FOLDER [SET ...]" >&2; exit 1; }
vs=$(realpath "$1") sets=$(realpath "$2") here=$PWD/bench/nesting work=$PWD/build/bench-nesting
shift 2
[ $# -gt 0 ] || set -- $(cd "$sets" && ls ./*.json | sed 's|^./||;s|\.json$||')
mkdir -p "$work" && cd "$work" || exit 1
g++ -w -std=c++17 -O2 -DNDEBUG -DLIBNEST2D_GEOMETRIES_clipper -DLIBNEST2D_OPTIMIZER_nlopt -DLIBNEST2D_THREADING_std \
    -I/usr/include/polyclipping "$here/peer.cc" -o peer -lpolyclipping -lnlopt_cxx -lpthread 2> errors ||
  echo "run.sh: libnest2d could not be built (package libnest2d-dev): its columns stay empty" >&2

echo "| set | parts | sheets | use % | overlap % | s | hulls: sheets | use % | s | outlines: use % | overlap % | ratio |"
echo "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|"
failed=0
for name in "$@"; do
  "$vs" --quiet "$here/set.vs" -D "set=$sets/$name.json" -D "effort=${EFFORT:-1.0}" > ours && "$vs" --quiet "$here/set.vs" -D "set=$sets/$name.json" -D task=peer > input ||
    { echo "run.sh: vs failed on $name" >&2; failed=1; continue; }
  : > theirs
  [ ! -x peer ] || ./peer < input > theirs
  awk -F '\t' -v OFS=' | ' -v name="$name" '
    FILENAME == "input" { if (FNR > 2) { split($0, f, " "); parts += f[1] } }
    FILENAME == "ours" { sheets = $2; use = $3; overlap = $4; seconds = $5 }
    FILENAME == "theirs" && !$6 && /^hulls/ && $4 < .01 && $3 > hull { hull = $3; hull_sheets = $2; hull_seconds = $5 }
    FILENAME == "theirs" && !$6 && /^outlines/ && $3 > outline { outline = $3; shared = $4 }
    END { printf "| "
          print name, parts, sheets, use, sprintf("%.4f", overlap < 0 ? 0 : overlap), seconds, hull_sheets, hull, hull_seconds, outline, sprintf("%.1f", shared), (hull ? sprintf("**%.2f**", use / hull) : "") " |"
          exit !(use > 0 && overlap < .01) }' input ours theirs || failed=1
done
exit $failed
