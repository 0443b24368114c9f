# Tests that a lamp lights a floor by its IES file: luminance and illuminance at some angles, in a room whose
# walls reflect nothing, against candelas times the cube of the cosine divided by the square of the height; in pictures,
# and in a .pov that POV-Ray alone renders.
. tests/report.sh

wanted lamps || exit 0
command -v povray > /dev/null || { echo "skip lamps: no povray (package povray)"; exit 0; }
cp tests/lang/lib/lamps/spot.ies tests/lang/lib/lamps/asym.ies "$work"

room() { # WHAT: a lamp 2 m above a grey floor, seen from 3.5 m by a lens that shows 7 m
  echo '(define grey (make-material #:color "#808080" #:roughness 1)) (define dark (make-material #:color "#000000" #:roughness 1))'
  echo '(draw (with-material grey (make-box (xyz -6 -6 -1/10) (xyz 6 6 0))))'
  echo '(draw (with-material dark (subtract (make-box (xyz -6 -6 0) (xyz 6 6 4)) (make-box (xyz -5.9 -5.9 -1) (xyz 5.9 5.9 3.9)))))'
  echo "(lamp (xyz 0 0 2) $1) (camera (xyz 0 0 3.5) origin #:lens 18)"
}
# CASE LAMP COLUMN ROW CANDELAS...: a floor of linear grey 0.2159 that reflects 0.82 of it; the number 1 is 10,000 cd/m2
holds() {
  name=$1; : > "$work/why"
  room "$2" > "$work/$name.vs"
  "$vs" --quiet --size 200x200 "$work/$name.vs" -o "$work/$name.exr" -o "$work/$name.pov" 2>> "$work/why"
  (cd "$work" && HOME=$work povray "$name.pov" +W200 +H200 -D +FE "+O$work/$name-alone.exr") > "$work/said" 2>&1 || tail -n 5 "$work/said" >> "$work/why"
  shift 2
  while [ $# -ge 3 ]; do
    for how in "" -alone; do "$vs" pick "$work/$name$how.exr" "$1" "$2" 2> /dev/null | awk -v x="$1" -v y="$2" -v candelas="$3" -v how="$how" '
      $1 == "light" { got = how == "" ? $2 : $2 * 3.2 / 1.25 } END {
      px = ((x + .5) / 100 - 1) * 3.5; py = ((y + .5) / 100 - 1) * 3.5; away = sqrt(px * px + py * py + 4)
      want = candelas * (2 / away) ^ 3 / 4 / 31415.93 * .82 * .2159
      if (!(got > .98 * want && got < 1.02 * want)) print "at " x ", " y ": " got ", and " want " is wanted, within 2 percent" }' >> "$work/why"; done
    shift 3
  done
  result "lamps:$name" "$work/why"
}
# intensities at the angles of these points, between the files' rows
holds round '#:ies "spot.ies"' 100 100 998 110 100 966 130 100 776 150 100 562 170 100 396
holds even '#:lumens 12566.37' 100 100 1000 150 100 1000
holds dimmed '#:ies "spot.ies" #:dim 0.5' 110 100 483
holds turned '#:ies "asym.ies" #:turn 90' 100 43 801 43 100 504
holds straight '#:ies "asym.ies"' 157 100 797 100 43 504

# Illuminance: of a lamp of 1,000 cd at 2 m, 1,000 cos^3 / 4 lx. Minimum and maximum omit a hundredth of the pixels at
# either end.
: > "$work/why"
room '#:lumens 12566.37' > "$work/lux.vs"
"$vs" --quiet --size 200x200 "$work/lux.vs" -o "$work/lux.exr" --layers 2>> "$work/why"
"$vs" falsecolor --lux "$work/lux.exr" -o "$work/lux.png" > "$work/said" 2>&1 || cat "$work/said" >> "$work/why"
awk 'BEGIN { for (x = 0; x < 200; x++) for (y = 0; y < 200; y++) { px = ((x + .5) / 100 - 1) * 3.5; py = ((y + .5) / 100 - 1) * 3.5
  print 1000 * (2 / sqrt(px * px + py * py + 4)) ^ 3 / 4 } }' | sort -n | awk '{ e[NR] = $1 } END { print e[401], e[39600] }' > "$work/want"
awk 'NR == FNR { least = $1; most = $2; next } { if (!($2 > .98 * least && $2 < 1.02 * least && $4 > .98 * most && $4 < 1.02 * most && $5 == "lx;"))
  print "said: " $0 "; wanted: " least " to " most " within 2 percent" }' "$work/want" "$work/said" >> "$work/why"
for at in "100 100 250" "150 100 105.6" "157 100 88.2"; do
  # shellcheck disable=SC2086
  set -- $at; "$vs" pick "$work/lux.exr" "$1" "$2" | awk -v want="$3" '$1 == "illuminance" { got = $2 } END { if (!(got > .98 * want && got < 1.02 * want)) print "illuminance " got ", not " want }' >> "$work/why"
done
"$vs" falsecolor --lux "$work/even.exr" -o "$work/no.png" > "$work/said" 2>&1 && echo "a picture without layers has illuminances" >> "$work/why"
grep -q "with --layers" "$work/said" || cat "$work/said" >> "$work/why"
result lamps:illuminance "$work/why"
