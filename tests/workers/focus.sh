# Tests depth of field: the blur of an edge is as wide as geometrical optics predicts, and objects in focus
# are sharp.
. tests/report.sh

wanted focus || exit 0
command -v povray > /dev/null || { echo "skip focus: no povray (package povray)"; exit 0; }

# A black edge at 2 m in front of a white wall; 50 mm at f/0.1 is an opening of 0.5 m. Focused on 10 m, a point of the
# edge is seen within 0.5 (1/2 - 1/10) = 0.2 of the distance: 0.2 * 50/36 * 400 = 111 pixels of 400. A disc's light
# grows from a quarter to three quarters in 0.404 of its width: 45 pixels.
while read -r name unit least most camera; do
  cat > "$work/edge.vs" <<EOF
(define k (/ 1 $unit))
(define (at x y z) (xyz (* k x) (* k y) (* k z)))
(draw (with-material (make-material #:color "black" #:roughness 1) (make-box (at -3 2 -3) (at 0 2.001 3))))
(draw (with-material (make-material #:color "white" #:roughness 1) (make-box (at -60 40 -60) (at 60 40.1 60))))
(sun #:azimuth 180 #:altitude 20)
$camera
EOF
  "$vs" --quiet --quality final --size 400x24 "$work/edge.vs" -o "$work/edge.exr" > "$work/why" 2>&1
  for x in $(seq 100 4 300); do
    "$vs" pick --json "$work/edge.exr" "$x" 12 2> /dev/null | sed -n "s/.*\"color\": \\[\\([^,]*\\),.*/$x \\1/p"
  done | awk -v least="$least" -v most="$most" '{ at[NR] = $1; v[NR] = $2 } END {
      for (i = 1; i < NR; i++) { # where a quarter and three quarters of the light are passed
        if (v[i] < v[NR] / 4 && v[i + 1] >= v[NR] / 4) low = at[i] + 4 * (v[NR] / 4 - v[i]) / (v[i + 1] - v[i])
        if (v[i] < v[NR] * .75 && v[i + 1] >= v[NR] * .75) high = at[i] + 4 * (v[NR] * .75 - v[i]) / (v[i + 1] - v[i])
      }
      if (!(high - low >= least && high - low <= most)) print "half of the blur is " high - low " pixels wide, not " least " to " most }' >> "$work/why"
  result "focus:$name" "$work/why"
done <<'EOF'
blurred 1 41 49 (camera origin (at 0 10 0) #:lens 50 #:aperture 0.1)
millimetres 0.001 41 49 (units 'mm) (camera origin (at 0 10 0) #:lens 50 #:aperture 0.1 #:focus (at 3 10 4))
upright 1 41 49 (view "model" #:from origin #:to (at 0 10 0) #:upright #t #:lens 50 #:aperture 0.1) (camera origin (at 0 10 0) #:lens 50 #:aperture 0.1)
sharp 1 0 6 (camera origin (at 0 10 0) #:lens 50 #:aperture 0.1 #:focus (at 0 2 0))
EOF
