# Tests that a picture on a wall has its size and its orientation: a wall with a picture of a dark and a light
# half looks like a wall of dark and light blocks, from its front and its back, rotated by right angles and by others,
# and horizontal.
. tests/report.sh

wanted pictures || exit 0
command -v povray > /dev/null || { echo "skip pictures: no povray (package povray)"; exit 0; }
cp tests/lang/lib/pictures/halves.png "$work/halves.png"

for turn in 0 22.5 30 90 200 flat; do
  : > "$work/why"
  for how in picture blocks; do
    {
      echo '(define (block x m) (with-material m (make-box (xyz x 0 0) (xyz (+ x 1/2) 0.2 2))))'
      echo '(define dark (make-material #:color "#802020" #:roughness 0.9)) (define light (make-material #:color "#e0e0d0" #:roughness 0.9))'
      echo '(define m (make-material #:image "halves.png" #:roughness 0.9 #:pattern-size 1))'
      if [ $how = picture ]; then echo '(define wall (with-material m (make-box origin (xyz 2 0.2 2))))'
      else echo '(define wall (unite (block 0 dark) (block 1/2 light) (block 1 dark) (block 3/2 light)))'; fi
      case $turn in
      flat) echo "(draw (do-rotate wall ux (- (/ pi 2)))) (view-from 'top)" ;;
      *)
        echo "(define a (* pi 1/180 $turn)) (draw (do-rotate wall uz a))"
        echo '(define n (vxyz (sin a) (- (cos a)) 0)) (define mid (p+v (xyz 0 0 1) (v*r (vxyz (cos a) (sin a) 0) 1)))'
        echo '(camera (p+v mid (v*r n 8)) mid #:lens 80)' ;;
      esac
      echo '(sun #:azimuth 200 #:altitude 40)'
    } > "$work/$how.vs"
    "$vs" --quiet --quality draft --size 120x120 --exposure 0 "$work/$how.vs" -o "$work/$how.png" 2>> "$work/why"
  done
  share=$("$tools/pngstat" "$work/picture.png" "$work/blocks.png" 2>&1)
  awk -v share="$share" 'BEGIN { if (!(share + 0 <= 60)) print share " of 1000 pixels differ from the wall of blocks: at most 60 may" }' >> "$work/why"
  result "pictures:$turn" "$work/why"
done
