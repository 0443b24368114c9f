# Tests that the ground fades into the sky: no line separates them, for any model and any height of the eye, and
# the sky has more than one colour. Pictures of 200 x 150: the test limits the largest step from a row to the next (a
# line from side to side would be a step of 43 with the plain ground, of 140 and 200 with the others).
. tests/report.sh

wanted horizon || exit 0
command -v povray > /dev/null || { echo "skip horizon: no povray (package povray)"; exit 0; }

# eye's height, size of the model, the largest step, the ground's arguments
while read -r name eye size most ground; do
  sky=""; [ "${name#daylight}" = "$name" ] || sky='(sky #:turbidity 3) (sun #:azimuth 90 #:altitude 30)'
  : > "$work/why"
  {
    echo "(ground $ground) $sky"
    echo "(camera (xyz 0 (* -3 $size) $eye) (xyz 0 0 $eye) #:lens 28)"
    echo "(draw (make-box (xyz (* -0.1 $size) 0 (- (* 0.02 $size))) (xyz (* 0.1 $size) $size (* 0.02 $size))))"
  } > "$work/$name.vs"
  "$vs" --quiet --quality draft --size 400x300 "$work/$name.vs" -o "$work/$name.png" 2> "$work/why" &&
    "$tools/pngstat" "$work/$name.png" 2>&1 | awk -v most="$most" '
      !($6 <= most) { print "a row differs by " $6 " of 255 from the row above: a line from side to side" }
      !($3 >= 20) { print $3 " colours: the sky is of one" }' >> "$work/why"
  result "horizon:$name" "$work/why"
done <<'EOF'
eye-level 1.7 20 35 0
daylight 1.7 20 35 0
daylight-grass 40 20 45 0 #:material grass
from-above 40 20 35 0 #:material grass
dark-ground 2 10 45 0 #:material (make-material #:name "asphalt" #:color "#202020")
tiny 0.0015 0.01 35 0
huge 6000 20000 35 0 #:material grass
EOF
