#!/bin/sh
# Runs the comparison of handing meshes to a host with Manifold's getMesh (manifold-3d in node, fetched as for
# bench/kernel/run.sh): `bench/handover.sh`, after `make`. Medians of three runs; processor seconds.
set -u
cd "$(dirname "$0")/.." || exit 1
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
make -s DESTDIR="$work" PREFIX=/usr install || exit 1
${CC:-cc} -std=c11 -O2 -I"$work/usr/include" bench/handover.c -o "$work/handover" \
  -L"$work/usr/lib" -lvisualscheme || exit 1
echo '(draw (make-sphere (xyz 0 0 0) 1 #:segments 1024))' > "$work/sphere.vs"
echo '(for ([i (in-range 10000)])
  (draw (make-box (xyz (* 2 (remainder i 100)) (* 2 (quotient i 100)) 0)
                  1 1 (+ 1 (remainder i 7)))))' > "$work/boxes.vs"

# the median of each column
medians() {
  for column in $(seq "$(head -n 1 "$work/figures" | wc -w)"); do
    cut -d ' ' -f "$column" "$work/figures" | sort -n | sed -n 2p
  done | paste -s -d '|' | sed 's/|/ | /g'
}
echo "| drawing | meshes | places | triangles | MB | s | host's copy s | memory grew MB | again s |"
echo "|---|--:|--:|--:|--:|--:|--:|--:|--:|"
for file in "$work/sphere.vs" "$work/boxes.vs" examples/city.vs; do
  for run in 1 2 3; do LD_LIBRARY_PATH=$work/usr/lib "$work/handover" "$file"; done > "$work/figures"
  echo "| $(basename "$file" .vs) | $(medians) |"
done
echo
# OpenCASCADE, if its headers are installed (Debian: libocct-visualization-dev, libocct-modeling-data-dev); OCCT: their
# folder
occt=${OCCT:-/usr/include/opencascade}
if [ -f "$occt/BRep_Builder.hxx" ] && "${CXX:-c++}" -O2 -w -I"$occt" bench/handover_occt.cc -o "$work/occt" \
     -l:libTKBRep.so.7 -l:libTKMath.so.7 -l:libTKernel.so.7 -l:libTKG3d.so.7; then
  LD_LIBRARY_PATH=$work/usr/lib "$work/handover" examples/city.vs "$work/city" || exit 1
  echo "| OpenCASCADE | meshes | places | MB | filled s | MB of it | s |"
  echo "|---|--:|--:|--:|--:|--:|--:|"
  for run in 1 2 3; do "$work/occt" "$work/city"; done > "$work/figures"
  echo "| city | $(medians) |"
  echo
else
  echo "OpenCASCADE was not found" >&2
fi
modules=build/bench-kernel
[ -f $modules/node_modules/manifold-3d/manifold.js ] || {
  mkdir -p $modules && cp bench/kernel/package.json $modules &&
    (cd $modules && npm install --no-package-lock --no-audit --no-fund --silent)
} || { echo "manifold-3d could not be fetched" >&2; exit 0; }
echo "| Manifold | triangles | MB | s | getMesh s |"
echo "|---|--:|--:|--:|--:|"
for what in sphere boxes; do
  for run in 1 2 3; do node bench/handover.mjs $modules $what; done > "$work/figures"
  echo "| $what | $(medians) |"
done
