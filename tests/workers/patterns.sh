# Tests that POV-Ray accepts every pattern and shows it: a wall with it, seen from 2 m, clearly differs from the
# same wall in the plain colour.
. tests/report.sh

wanted patterns || exit 0
command -v povray > /dev/null || { echo "skip patterns: no povray (package povray)"; exit 0; }

names=$(sed -n 's/^VS_PATTERN([A-Z]*, *"\([a-z]*\)".*/\1/p' model/looks/patterns.def)
for name in $names; do
  : > "$work/why"
  for pattern in "$name" none; do
    {
      echo "(define m (make-material #:color (list .6 .5 .4) #:metallic 1 #:roughness .1 #:pattern '$pattern #:pattern-color (list .2 .15 .1) #:pattern-size 0.4))"
      echo "(draw (with-material m (make-box origin (xyz 2 0.3 2)))) (view-from 'front) (sun #:azimuth 200 #:altitude 40)"
    } > "$work/$pattern.vs"
    "$vs" --quiet --quality draft --size 80x80 --exposure 0 "$work/$pattern.vs" -o "$work/$pattern.png" 2>> "$work/why"
  done
  least=30; [ "$name" != rippled ] || least=0 # waves shift what a wall mirrors, which is nearly of one colour here
  share=$("$tools/pngstat" "$work/$name.png" "$work/none.png" 2>&1)
  awk -v share="$share" -v least="$least" 'BEGIN { if (!(share + 0 >= least)) print share " of 1000 pixels differ from the plain wall: at least " least " are wanted" }' >> "$work/why"
  ! cmp -s "$work/$name.png" "$work/none.png" || echo "the wall looks as without a pattern" >> "$work/why"
  result "patterns:$name" "$work/why"
done
