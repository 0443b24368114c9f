# Tests the picture of a plain model: it has a pale ground with a contact shadow, unless the program sets a ground,
# a sky or lamps, or the eye is below the model.
. tests/report.sh

wanted studio || exit 0
command -v povray > /dev/null || { echo "skip studio: no povray (package povray)"; exit 0; }

# light PICTURE COLUMN ROW: prints the luminance of the pixel
light() {
  "$vs" pick --json "$1" "$2" "$3" 2>> "$work/why" | sed -n 's/.*"color": \[\([^]]*\)\].*/\1/p' |
    awk -F, '{ printf "%.4f\n", 0.2126 * $1 + 0.7152 * $2 + 0.0722 * $3 }'
}

# The picture is 160 by 120. The sun is in the south-west, so the shadow of the box falls to the right. Each row: the
# name, least and most of the light at the foot as a fraction of that of the open ground, and what the program adds.
while read -r name least most words; do
  : > "$work/why"
  cat > "$work/plain.vs" <<EOF2
(draw (make-box (xyz -1 -1 0) (xyz 1 1 2)))
(sun #:azimuth 225 #:altitude 45)
(camera (xyz 0 -9 5) (xyz 0 0 0.5))
$words
EOF2
  "$vs" -q --layers --size 160x120 "$work/plain.vs" -o "$work/plain.exr" 2>> "$work/why"
  open=$(light "$work/plain.exr" 20 66) foot=$(light "$work/plain.exr" 104 58)
  awk -v open="$open" -v foot="$foot" -v least="$least" -v most="$most" 'BEGIN {
    if (!(open > 0 && foot >= least * open && foot <= most * open))
      print "light " foot " at the foot, " open " in the open" }
  ' >> "$work/why"
  result "studio:$name" "$work/why"
done <<'EOF'
plain 0 0.8
own-ground 0 0.8 (ground 0)
plain-sky 0.9 1.3 (sky 'plain)
coloured-sky 0.9 1.3 (sky #:color "skyblue")
physical-sky 0.9 1.3 (sky #:turbidity 3)
EOF

# From below the model is visible: the middle of the picture differs from the corner.
: > "$work/why"
echo '(draw (make-box (xyz -1 -1 0) (xyz 1 1 2))) (camera (xyz 4 -4 -6) (xyz 0 0 1))' > "$work/below.vs"
"$vs" -q --layers --size 40x30 "$work/below.vs" -o "$work/below.exr" 2>> "$work/why"
middle=$(light "$work/below.exr" 20 15) corner=$(light "$work/below.exr" 2 2)
awk -v a="$middle" -v b="$corner" '
  BEGIN { if (!(a > 0 && b > 0 && (a < 0.9 * b || b < 0.9 * a))) print "middle " a ", corner " b }' >> "$work/why"
result studio:below "$work/why"
