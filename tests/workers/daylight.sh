# Tests daylight of (visualscheme analysis) beside POV-Ray's pictures: a row of places on the floor of a room of 6 x 4 x 3 m
# with one window, under the overcast sky. Radiosity smooths a picture, so its single places differ by up to 13 %, and
# the means by 4 %. A room whose walls are black has light from the sky alone.
. tests/report.sh

wanted daylight || exit 0
command -v povray > /dev/null || { echo "skip daylight: no povray (package povray)"; exit 0; }

cat > "$work/room.vs" <<'EOF2'
(import (visualscheme) (visualscheme analysis))
(define-parameter dark #t)
(define-parameter answer #f)
(define grey (make-material #:color "#bcbcbc" #:roughness 1)) ; reflects 0.412
(define black (make-material #:color "#000000" #:roughness 1))
(define shell (subtract (make-box (xyz -0.3 -0.3 -0.2) (xyz 6.3 4.3 3.3)) (make-box (xyz 0 0 -1) (xyz 6 4 3)) (make-box (xyz 2 3.9 0.9) (xyz 4 4.5 2.3))))
(define slab (make-box (xyz -0.3 -0.3 -0.4) (xyz 6.3 4.3 0)))
(draw (with-material (if dark black grey) shell) (with-material grey slab))
(sky 'overcast)
(sun #:azimuth 180 #:altitude 45)
(camera (xyz 3 2 2.95) (xyz 3 2.0001 0) #:lens 18) ; 201 pixels show 5.9 m
(define rows '(60 70 80 90 100 110 120 130 140 150))
(define (place row) (xyz 3 (+ 2 (* (- 100 row) 5.9 1/201)) 0))
(if answer
    (for-each (lambda (row lux) (printf "~a ~a~%" row lux)) rows
      (illuminance (map place rows) #:outdoor (+ 300 (* 21000 (sin (/ pi 4)))) #:among (list shell slab) #:reflectance (if dark 0 0.412) #:rays 16384)))
EOF2
for dark in '#t' '#f'; do
  "$vs" --quiet -D "dark=$dark" -D answer=#t "$work/room.vs" > "$work/ours" 2> "$work/why"
  "$vs" --quiet -D "dark=$dark" --layers --quality good --size 201x201 "$work/room.vs" -o "$work/room.exr" 2>> "$work/why"
  while read -r row ours; do
    "$vs" pick "$work/room.exr" 100 "$row" | awk -v ours="$ours" -v row="$row" '$1 == "illuminance" { print row, ours, $2 }'
  done < "$work/ours" | awk '{ n++; ours += $2; theirs += $3; if (($3 / $2 - 1) ^ 2 > 0.13 ^ 2) print "in row " $1 ": " $2 " lx, and " $3 " in the picture" }
    END { if (n != 10) print "the picture has " n " of 10 places"; else if ((theirs / ours - 1) ^ 2 > 0.04 ^ 2) print "the means are " ours / n " and " theirs / n " lx" }' >> "$work/why"
  result "daylight:dark=$dark" "$work/why"
done
