# Tests the formats that other programs read back: each contains the same solids, closed if the format
# promises it, and its reader accepts it without a message: the glTF validator, Assimp for 3MF.
. tests/report.sh
model=tests/workers/formats.vs

wanted formats || exit 0

"$vs" --quiet $model -o "$work/m.stl" -o "$work/m.ply" -o "$work/m.glb" -o "$work/m.3mf" > "$work/why" 2>&1 || echo "ended with $?" >> "$work/why"
"$vs" --quiet $model --format stl-ascii -o "$work/words.stl" >> "$work/why" 2>&1 || echo "ended with $?" >> "$work/why"
result formats:writes "$work/why"
# "closed: triangles N volume V": its fourth word is the volume that all others must have
mesh=$("$BUILD/tools/stlcheck" "$work/m.stl" 2> "$work/why") || echo "not closed: $mesh" >> "$work/why"
result formats:stl "$work/why"

same() { # name, what was printed, metres a unit, share of the volume that may differ
  echo "$mesh $2" | awk -v name="$1" -v unit="$3" -v share="$4" '
    { for (i = 1; i <= NF; i++) if ($i == "volume") at[++n] = $(i + 1)
      volume = n > 1 ? at[n] / unit ^ 3 : 0
      if (n < 1 || (volume - $4) ^ 2 > (share * $4) ^ 2) print name " holds " volume ", the mesh " $4 ": " $0 }' > "$work/why"
  result "formats:$1" "$work/why"
}
if command -v node > /dev/null; then
  same ply "$(node tests/tools/meshes.mjs "$work/m.ply" 2>&1)" 1 1e-6
  same stl-ascii "$(node tests/tools/meshes.mjs "$work/words.stl" 2>&1)" 1 1e-6
  if [ -d tests/node_modules/gltf-validator ]; then
    # copies keep facets for their own size, and the file contains a curve and the region too: therefore the volume
    # differs in the last digits
    same glb "$(node tests/tools/meshes.mjs "$work/m.glb" 2>&1)" 0.001 1e-3
  else echo "skip formats:glb: no gltf-validator (npm ci --prefix tests --ignore-scripts)"; fi
else echo "skip formats:ply, stl-ascii, glb: no node"; fi

# Assimp reads it as other programs do, with placed copies, and writes its result.
if command -v assimp > /dev/null; then
  assimp export "$work/m.3mf" "$work/back.stl" -fstlb > "$work/said" 2>&1 || tail -n 3 "$work/said"
  same 3mf "$("$BUILD/tools/stlcheck" "$work/back.stl" 2>&1)" 1 1e-6
else echo "skip formats:3mf: no assimp (package assimp-utils)"; fi

# Round walls have smooth shading: the corners of their triangles have different normals.
cat > "$work/walls.vs" <<'EOF'
(define-parameter kind "revolve")
(define (ring z r) (make-circle (xyz 0 0 z) r))
(define (guide a) (do-rotate (make-spline (xyz 1 0 0) (xyz 2 0 2) (xyz 1 0 4)) 'z a))
(draw (case kind
        (("revolve") (do-revolve (make-rectangle (xz 1 0) (xz 2 2)) 'z))
        (("loft") (do-loft (list (ring 0 1) (ring 2 2) (ring 4 1))))
        (("ruled-loft") (do-ruled-loft (list (ring 0 1) (ring 2 2))))
        (("guides") (do-guided-loft (list (ring 0 1) (ring 4 1)) (map guide (enumerate 0 2pi 3))))
        (("cut") (subtract (do-rotate (do-mirror (do-loft (list (ring 0 1) (ring 2 2) (ring 4 1))) 'yz) 'x 1) (make-sphere (xyz 0 0 4) 1)))
        (else (do-guided-loft (list (ring 0 1) (ring 4 1)) (make-line origin (xyz 0 0 4))))))
EOF
if command -v node > /dev/null; then
  for kind in revolve loft ruled-loft guided-loft guides cut; do
    "$vs" --quiet -D kind=$kind "$work/walls.vs" -o "$work/w.x3d" -o "$work/w.glb" -o "$work/w.html" > "$work/why" 2>&1
    for format in x3d glb html; do # caps are flat: of the revolution and the short lofts they are half
      node --no-warnings tests/tools/normals.mjs "$work/w.$format" 2>&1 | awk -v f=$format '!($2 > 100 && $4 > 0.45) { print "." f ": " $0 }'
    done >> "$work/why"
    result "formats:round walls of $kind" "$work/why"
  done
else echo "skip formats:round walls: no node"; fi
