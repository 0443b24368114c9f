# Tests mistakes in pictures: each gives one clear message, and no file stays behind; a camera within a wall
# gives a warning.
. tests/report.sh

wanted mistakes || exit 0
command -v povray > /dev/null || { echo "skip mistakes: no povray (package povray)"; exit 0; }
head -c 60 tests/lang/lib/pictures/halves.png > "$work/cut.png"
head -c 300 tests/lang/lib/pictures/tiles.exr > "$work/cut.exr"

while IFS='|' read -r name code words option program; do
  : > "$work/why"
  mkdir -p "$work/$name" && cp "$work"/cut.* "$work/$name/"
  echo "$program" > "$work/$name/m.vs"
  # shellcheck disable=SC2086
  (cd "$work/$name" && "$vs" -q --quality draft --size 80x60 $option m.vs -o m.png) > "$work/said" 2>&1; status=$?
  [ $status = "$code" ] || echo "ended with $status, not $code" >> "$work/why"
  [ -z "$words" ] || grep -qF -e "$words" "$work/said" || { echo "'$words' is not said, but:"; cat "$work/said"; } >> "$work/why"
  [ "$code" = 0 ] || [ "$(ls "$work/$name" | wc -l)" = 3 ] || { echo "left behind:"; ls "$work/$name"; } >> "$work/why"
  result "mistakes:$name" "$work/why"
done <<'OUTER2'
font|1|make-text: cannot open none.ttf: no such file||(draw (make-text origin 1 "a" #:font "none.ttf"))
texture|1|make-material: cannot open none.png: no such file||(draw (with-material (make-material #:image "none.png") (make-sphere origin 1)))
cut texture|1|the PNG file is cut off or broken||(draw (with-material (make-material #:image "cut.png") (make-sphere origin 1)))
hdr|1|sky: cannot open none.hdr: no such file||(draw (make-sphere origin 1)) (sky #:image "none.hdr")
cut exr|1|m.vs:1:31: sky:||(draw (make-sphere origin 1)) (sky #:image "cut.exr")
ies|1|lamp: cannot open none.ies: no such file||(draw (make-sphere origin 1)) (lamp (xyz 0 0 3) #:ies "none.ies")
zero size|2|--size 0x60: expected WIDTHxHEIGHT|--size 0x60|(draw (make-sphere origin 1))
at itself|1|camera: target must be another point than eye||(draw (make-sphere origin 1)) (camera origin origin)
empty|1|nothing is drawn||(define a 1)
date|1|sun: date must be a day such as||(draw (make-sphere origin 1)) (sun #:latitude 38 #:longitude -9 #:date "2026-02-30" #:time "12:00")
in a wall|0|m.vs:1:7: warning: the camera is inside this object||(draw (subtract (make-box origin (xyz 4 4 4)) (make-box (xyz 1 1 1) (xyz 3 3 3)))) (camera (xyz 0.5 2 2) (xyz 9 2 2))
night|0|||(draw (make-sphere origin 1)) (sun #:azimuth 0 #:altitude -20)
OUTER2

# a camera in a room is not within its walls
: > "$work/why"
echo '(draw (subtract (make-box origin (xyz 4 4 4)) (make-box (xyz 1 1 1) (xyz 3 3 3)))) (camera (xyz 2 2 2) (xyz 9 2 2))' > "$work/m.vs"
"$vs" -q --quality draft --size 80x60 "$work/m.vs" -o "$work/m.png" > "$work/why" 2>&1
result mistakes:in-a-room "$work/why"
