# Tests that thin objects are legible in a picture: curves, edges, flat text and open surfaces without a
# material are dark, curves at least 1.35 pixels wide and not much wider, at 400 x 300, in drafts and final pictures.
# The test compares the number of dark pixels with lengths and areas.
. tests/report.sh

wanted readable || exit 0
command -v povray > /dev/null || { echo "skip readable: no povray (package povray)"; exit 0; }

# Each prints the expected dark area: the length of its curves or the area of the rest, in the picture's pixels.
cat > "$work/curves.vs" <<'EOF'
(define scale (/ 300 20 1.08)) ; the largest circle fills the height but for the margin
(define small (make-circle origin 2))
(draw (make-circle origin 10) (do-edges (make-box (xyz -5 -5 0) (xyz 5 5 1))) small (do-move small (vxyz 7.5 0 0)))
(view-from 'top)
(displayln (* scale (+ (* 2pi 14) 40)))
EOF
cat > "$work/depth.vs" <<'EOF'
(define (line depth z) (make-line (xyz (/ depth -5) depth z) (xyz (/ depth 5) depth z)))
(draw (line 10 -2) (line 100 0) (line 400 100))
(camera origin (xyz 0 1 0) #:lens 36)
(displayln (* 3 160))
EOF
cat > "$work/painted.vs" <<'EOF'
(draw (color "yellow" (unite (make-circle origin 10) (make-text origin 2 "HHH"))))
(view-from 'top)
(displayln 0)
EOF
cat > "$work/flat.vs" <<'EOF'
(define text (make-text origin 6 "HM"))
(define hills (make-surface (lambda (u v) (xyz (* 10 u) (- (* -6 v) 1) (* 0.1 (sin (* 9 u)))))))
(draw text hills)
(view-from 'top)
(define size (apply p->q (bounding-box (unite text hills))))
(define scale (min (/ 400 1.08 (cx size)) (/ 300 1.08 (cy size))))
(displayln (* scale scale (+ (area text) 60)))
EOF
while read -r name least most; do
  for quality in draft final; do
    : > "$work/why"
    dark=$("$vs" --quiet --quality $quality --size 400x300 "$work/$name.vs" -o "$work/$name.png" 2> "$work/said") || cat "$work/said" >> "$work/why"
    echo "$dark $("$BUILD/tools/pngstat" "$work/$name.png" 2>&1)" | awk -v least="$least" -v most="$most" '
      !($6 >= least * $1 && $6 <= most * $1 + 40) { print $6 " pixels are dark; must be " least " to " most " times " $1 }' >> "$work/why"
    result "readable:$name, $quality" "$work/why"
  done
done <<'EOF'
curves 1.35 2.6
depth 1.5 2.6
flat 0.6 1.1
painted 0 0
EOF
