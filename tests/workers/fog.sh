# Tests fog: the share of fog in front of a black wall, by the wall's distance, against the formula; fog with
# a height does not change the sky overhead.
. tests/report.sh

wanted fog || exit 0
command -v povray > /dev/null || { echo "skip fog: no povray (package povray)"; exit 0; }

# A black wall at the distance; the value of the fog itself is that of a wall behind all fog.
while read -r name unit visibility distance share; do
  : > "$work/why"
  for at in "$distance" "$((100 * visibility))"; do
    cat > "$work/$at.vs" <<EOF
(units '$unit)
(define k (if (equal? "$unit" "mm") 1000 1))
(draw (with-material (make-material #:color "#000000" #:roughness 1) (make-box (xyz (* k -9e4) (* k $at) (* k -9e4)) (xyz (* k 9e4) (* k (+ $at 1)) (* k 9e4)))))
(fog (* k $visibility) #:color "#808080")
(camera origin (xyz 0 k 0))
EOF
    "$vs" --quiet --size 16x12 --quality draft "$work/$at.vs" -o "$work/$at.exr" 2>> "$work/why"
  done
  far=$("$vs" pick "$work/$((100 * visibility)).exr" 8 6 2> /dev/null | awk '$1 == "light" { print $3 }')
  "$vs" pick "$work/$distance.exr" 8 6 2> /dev/null | awk -v far="$far" -v share="$share" '$1 == "light" { got = $3 / far } END {
    if (!(got > .98 * share && got < 1.02 * share)) print "the fog before it is " got " of all, and " share " is wanted" }' >> "$work/why"
  result "fog:$name" "$work/why"
done <<'EOF'
near m 100 10 0.2589
half m 100 50 0.7764
visibility m 100 100 0.95
millimetres mm 100 50 0.7764
EOF

# overhead within a tenth of the value without fog; at the horizon the value of the fog
: > "$work/why"
for fog in "" '(fog 600 #:height 3)'; do
  echo "(ground 0) (draw (make-box (xyz -1 8 0) (xyz 1 10 2))) (sky #:turbidity 3) (sun #:azimuth 200 #:altitude 40) $fog (camera (xyz 0 0 1.6) (xyz 0 1 8))" > "$work/up.vs"
  "$vs" --quiet --size 16x12 --quality draft "$work/up.vs" -o "$work/up${fog:+-fog}.exr" 2>> "$work/why"
done
clear=$("$vs" pick "$work/up.exr" 8 6 2> /dev/null | awk '$1 == "light" { print $3 }')
"$vs" pick "$work/up-fog.exr" 8 6 2> /dev/null | awk -v clear="$clear" '$1 == "light" { got = $3 } END { if (!(got > .9 * clear && got < 1.1 * clear)) print "overhead " got ", and without fog " clear }' >> "$work/why"
result fog:overhead "$work/why"
