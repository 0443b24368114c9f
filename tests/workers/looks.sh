# Tests the looks of pictures: (look 'NAME) and --look NAME make the same picture. White looks have no colour, the
# technical look has lines, and glass stays glass.
. tests/report.sh

wanted looks || exit 0
command -v povray > /dev/null || { echo "skip looks: no povray (package povray)"; exit 0; }
[ -x "$BUILD/tools/pngstat" ] || { echo "skip looks: no pngstat (make build/tools/pngstat)"; exit 0; }

cat > "$work/model.vs" <<'EOF'
(draw (color "red" (make-box (xyz 0 0 0) (xyz 4 3 2))) (color "navy" (make-cylinder (xyz 4 3 0) (xyz 4 3 3.5) 1.2)))
EOF

# colour FILE: prints the largest difference among red, green and blue of some pixels, in 1000 of the brightest
colour() {
  for place in 60,60 80,70 90,60 100,50 110,60 20,100; do
    "$vs" pick --json "$1" "${place%,*}" "${place#*,}" 2> /dev/null | sed -n 's/.*"color": \[\([^]]*\)\].*/\1/p'
  done | awk -F, '{ m = $1 > $2 ? $1 : $2; if ($3 > m) m = $3; l = $1 < $2 ? $1 : $2; if ($3 < l) l = $3
                    if (m > 0 && 1000 * (m - l) / m > most) most = 1000 * (m - l) / m }
                  END { printf "%d\n", most }'
}

sed -n 's/^STYLE([A-Z]*, "\(.*\)").*/\1/p' model/styles.def > "$work/names"
while read -r name; do
  : > "$work/why"
  { cat "$work/model.vs"; echo "(look '$name)"; } > "$work/own.vs"
  "$vs" -q --size 160x120 "$work/own.vs" -o "$work/own.png" 2>> "$work/why" < /dev/null
  "$vs" -q --size 160x120 --look "$name" "$work/model.vs" -o "$work/$name.png" 2>> "$work/why" < /dev/null
  "$vs" -q --size 160x120 --layers --look "$name" "$work/model.vs" -o "$work/$name.exr" 2>> "$work/why" < /dev/null
  cmp "$work/own.png" "$work/$name.png" >> "$work/why" 2>&1
  seen=$(colour "$work/$name.exr")
  case $name in
  arctic | technical) [ "$seen" -le 20 ] || echo "a white look has colours: $seen" >> "$work/why" ;;
  model) [ "$seen" -le 500 ] || echo "card has the model's colours: $seen" >> "$work/why" ;;
  *) [ "$seen" -ge 600 ] || echo "the model's colours are missing: $seen" >> "$work/why" ;;
  esac
  result "looks:$name" "$work/why"
done < "$work/names"

# Lines: the technical picture has clearly more edges than the white one.
: > "$work/why"
for name in arctic technical; do "$BUILD/tools/pngstat" "$work/$name.png" > "$work/$name.stat"; done
paste "$work/arctic.stat" "$work/technical.stat" | awk '
{ if (!($11 > $4 + 15)) print "edges: " $4 " and " $11 " in 1000" }
' >> "$work/why"
result looks:lines "$work/why"

# Glass stays glass: the red box behind a pane is as visible in white as a white box.
: > "$work/why"
cat > "$work/glass.vs" <<'EOF'
(draw (make-box (xyz -2 2 0) (xyz 2 3 2)))
(draw (with-material 'glass (make-box (xyz -3 0 0) (xyz 3 0.02 3))))
(camera (xyz 0 -8 1.5) (xyz 0 0 1.2))
EOF
"$vs" -q --size 80x60 --layers --look arctic "$work/glass.vs" -o "$work/glass.exr" 2>> "$work/why"
inside=$("$vs" pick --json "$work/glass.exr" 40 30 2>> "$work/why" | sed -n 's/.*"color": \[\([^],]*\).*/\1/p')
awk -v x="$inside" 'BEGIN { if (!(x > 0.1)) print "behind the pane: " x }' >> "$work/why"
result looks:glass "$work/why"

# A wrong name.
: > "$work/why"
"$vs" -q --look artic "$work/model.vs" -o "$work/no.png" > "$work/said" 2>&1
[ $? = 2 ] && grep -q arctic "$work/said" || cat "$work/said" >> "$work/why"
result looks:wrong-name "$work/why"
