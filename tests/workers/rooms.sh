# Tests light in rooms: the plain walls of a room of 6 x 4 x 3 m with one window are even, a room without a
# window is black, and in a draft no surface is. The test compares parts of pictures with the nearest smooth shading.
. tests/report.sh

wanted rooms || exit 0
command -v povray > /dev/null || { echo "skip rooms: no povray (package povray)"; exit 0; }

cat > "$work/closed.vs" <<'EOF'
(define window (make-box (xyz 20 20 1) (xyz 21 21 2))) ; outside
EOF
cat > "$work/window.vs" <<'EOF'
(define window (make-box (xyz 2 3.9 0.9) (xyz 4 4.5 2.3)))
EOF
for room in closed window; do
  cat >> "$work/$room.vs" <<'EOF'
(draw (with-material plaster
  (subtract (make-box (xyz -0.3 -0.3 -0.3) (xyz 6.3 4.3 3.3)) (make-box origin (xyz 6 4 3)) window)))
(ground -0.3)
(sun #:azimuth 216 #:altitude 40)
(camera (xyz 5.7 0.3 1.6) (xyz 1.0 3.0 1.4) #:lens 20)
EOF
done

# the room, quality, part of the picture; the largest allowed deviation, and the least and largest mean
while read -r name room quality x y width height most dark light; do
  : > "$work/why"
  [ -f "$work/$room-$quality.png" ] || "$vs" --quiet --quality "$quality" --size 240x180 --exposure 1.5 "$work/$room.vs" -o "$work/$room-$quality.png" 2> "$work/why"
  "$BUILD/tools/flatness" "$work/$room-$quality.png" "$x" "$y" "$width" "$height" 2>&1 | awk -v most="$most" -v dark="$dark" -v light="$light" '
    !($1 <= most && $2 <= 2 * most) { print "grey levels differ from smooth shading by " $1 ", a hundredth of them by " $2 }
    !($3 >= dark && $3 <= light) { print "the mean grey is " $3 }' >> "$work/why"
  result "rooms:$name" "$work/why"
done <<'EOF2'
end-wall,good window good 45 63 72 50 3 60 140
side-wall,good window good 1 30 18 110 3 70 150
window-wall,good window good 133 65 20 50 3 40 130
ceiling,good window good 60 5 80 30 3 40 140
end-wall,final window final 45 63 72 50 3 60 140
window-wall,final window final 133 65 20 50 3 40 130
closed,good closed good 10 10 220 160 0.1 0 0.1
ceiling,draft window draft 60 5 80 30 3 60 240
window-wall,draft window draft 133 65 20 50 3 60 240
EOF2
