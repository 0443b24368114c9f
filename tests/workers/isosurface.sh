# Tests that POV-Ray's isosurface is the same solid as the mesh: pictures of the same function drawn both ways.
. tests/report.sh

wanted isosurface || exit 0
command -v povray > /dev/null || { echo "skip isosurface: no povray (package povray)"; exit 0; }

# name, least structural similarity, the form
while read -r name least form; do
  : > "$work/why"
  for exact in '#t' '#f'; do
    {
      echo "(define-function (torus x y z) (- (square (- (sqrt (+ (square x) (square y))) 1)) (- 0.16 (square z))))"
      echo "(define-function (cut x y z) (max (torus x y z) (- x 0.7)))"
      echo "(define (made) (make-isosurface cut (xyz -1.6 -1.6 -0.6) (xyz 1.6 1.6 0.6) #:cells 72 #:exact $exact))"
      echo "(draw $form)"
      echo "(camera (xyz 2 -4 3) origin #:lens 50)(sun #:azimuth 215 #:altitude 48)"
    } > "$work/made.vs"
    "$vs" --quiet --quality draft --size 160x120 "$work/made.vs" -o "$work/$exact.exr" 2>> "$work/why"
  done
  "$vs" compare --json "$work/#t.exr" "$work/#f.exr" 2>> "$work/why" | tr ',' '\n' | awk -F: -v least="$least" '
    /"ssim"/ { seen = 1; if (!($2 + 0 >= least)) print "the pictures are alike to " $2 ", not to " least }
    END { if (!seen) print "nothing was compared" }' >> "$work/why"
  result "isosurface:$name" "$work/why"
done <<'EOF'
alone 0.985 (made)
cut 0.985 (subtract (made) (make-box (xyz -2 -0.2 -1) (xyz 0 0.2 1)))
moved 0.985 (do-rotate (color "red" (made)) 'y 0.4)
units 0.985 (begin (units 'mm) (made))
EOF
