# Tests web pages: every example as a page in Chromium, by playwright-core (tests/page/page.mjs). Parameters
# make large models small.
case page in *"${ONLY%%/*}"*) ;; *) exit 0 ;; esac
command -v chromium > /dev/null || { echo "skip page: no chromium (package chromium)"; exit 0; }
[ -d tests/node_modules/playwright-core ] && [ -d node_modules/three ] || { echo "skip page: no playwright-core or no viewer (make check fetches both)"; exit 0; }
. tests/report.sh
# The choice of parts that a picture omits, the unpacking of a tree into parts, and readings need no browser.
for name in budget parts measure; do node tests/page/$name.mjs || echo "not ok page/$name: ended with $?"; done
for model in examples/*.vs; do
  name=$(basename "$model" .vs)
  case $name in city) set -- -D blocks=2 -D tallest=6 ;; *) set -- ;; esac
  "$BUILD/vs" --quiet "$@" "$model" -o "$work/$name.html" || echo "not ok page/$name: ended with $?"
done
for name in facade-stages plans cornice-corners four-trees lily massive-street; do
  case $name in massive-street) set -- -D lots=4 ;; *) set -- ;; esac
  "$BUILD/vs" --quiet "$@" "examples/rules/$name.vs" -o "$work/rules-$name.html" || echo "not ok page/rules-$name: ended with $?"
done
# Equal parts add little to a page: at most 2,000,000 bytes for a street whose scene has 4 MB before compression.
size=$(wc -c < "$work/rules-massive-street.html")
if [ "$size" -le 2000000 ]; then echo "ok page/size of a street"; else echo "not ok page/size of a street"; echo "    $size bytes"; fi
"$BUILD/vs" --quiet examples/doric-columns.vs -o "$work/doric-columns.x3d"
cat > "$work/hostile.vs" <<'EOF'
(draw (layer "<img src=x onerror=window.owned=1></script><script>owned=1</script>"
  (with-material (make-material #:name "<b onclick=owned=1>\"'&</style>" #:color "red") (make-box (xyz 0 0 0) (xyz 1 2 3)))))
EOF
mkdir "$work/<img src=x onerror=owned=1>" && cp "$work/hostile.vs" "$work/<img src=x onerror=owned=1>/<b>&amp;.vs"
"$BUILD/vs" --quiet "$work/<img src=x onerror=owned=1>/<b>&amp;.vs" -o "$work/hostile.html" || echo "not ok page/hostile: ended with $?"
echo '(for*/list ([i (in-range 120)] [j (in-range 100)]) (draw (make-box (xyz i j 0) (xyz (+ i 0.4) (+ j 0.4) 1))))' > "$work/crowd.vs"
"$BUILD/vs" --quiet "$work/crowd.vs" -o "$work/crowd.html" || echo "not ok page/crowd: ended with $?"
cat > "$work/flat.vs" <<'EOF'
(draw (color "red" (make-circle (xy 0 0) 2)))
(draw (make-line (xy 4 0) (xy 8 2)))
(draw (make-spline (xy 9 0) (xy 10 2) (xy 11 3)))
(draw (color "blue" (make-region (make-rectangle (xy 3 3) (xy 8 8)) (make-rectangle (xy 4 4) (xy 6 6)))))
EOF
cat > "$work/tree.vs" <<'EOF'
(units 'mm)
(define (tower x)
  (unite (make-box (xyz x 0 0) (xyz (+ x 1) 1 3)) (make-sphere (xyz (+ x 0.5) 0.5 4) 0.5)))
(draw (tower 0) (tower 3))
(draw (make-sphere (xyz 6 0 1) 1))
EOF
for name in flat tree; do
  "$BUILD/vs" --quiet "$work/$name.vs" -o "$work/$name.html" || echo "not ok page/$name: ended with $?"
done
cat > "$work/light.vs" <<'EOF'
(ground 0)
(camera (xyz 6 -12 5) (xyz 0 0 1.2) #:lens 40)
(draw (make-box (xyz -3 -1 0) (xyz -1 1 2.5)))
(draw (with-material (make-material #:color "red") (make-box (xyz 0.2 -1 0) (xyz 2 1 2.5))))
(draw (with-material (make-material #:color "gray") (make-sphere (xyz 4 0 1) 1)))
EOF
{ cat "$work/light.vs"; echo '(sky #:turbidity 3) (sun #:azimuth 230 #:altitude 45)'; } > "$work/daylight.vs"
{ cat "$work/light.vs"; echo '(sky #:turbidity 4) (sun #:azimuth 250 #:altitude 10)'; } > "$work/evening.vs"
for name in light daylight evening; do
  "$BUILD/vs" --quiet "$work/$name.vs" -o "$work/$name.html" || echo "not ok page/$name: ended with $?"
  if command -v povray > /dev/null; then "$BUILD/vs" --quiet "$work/$name.vs" --size 480x360 -o "$work/$name.png" || echo "not ok page/$name: ended with $?"
  else echo "skip page/$name: no POV-Ray (package povray)"; fi
done
echo '(define-parameter n 1) (define-parameter style "flat") (report "area" (* n n)) (draw (make-box origin (xyz n 1 1)))' > "$work/swept.vs"
"$BUILD/vs" sweep -q "$work/swept.vs" --set n=1..4:1 --set style=flat,steep --format svg -o "$work/swept/" || echo "not ok page/parallel coordinates: ended with $?"
# Values that differ by rounding alone, and an axis of numbers with five digits.
echo '(define-parameter n 1) (report "same" (* n 0.1 (/ 10.0 n) 1000.0)) (report "long" (+ 10230 (* 2.5 n))) (draw (make-box origin (xyz n 1 1)))' > "$work/rounded.vs"
"$BUILD/vs" sweep -q "$work/rounded.vs" --set n=1..12:1 --format svg -o "$work/rounded/" || echo "not ok page/parallel coordinates: ended with $?"
timeout 120 node tests/page/parallel.mjs "$work/swept/index.html" "$work/rounded/index.html" || echo "not ok page/parallel coordinates: ended with $?"
timeout 1500 node tests/page/page.mjs "$work" || echo "not ok page: ended with $?"

# .x3d files: the form of each kind of node, instances, and two examples.
mkdir "$work/x3d"
cat > "$work/x3d/kinds.vs" <<'EOF'
(ground 0 #:material (make-material #:color "olive"))
(draw (layer "a <b> & \"c\"" (with-material (make-material #:name "brass" #:color "goldenrod" #:metallic 1 #:roughness 0.3) (make-box (xyz 0 0 0) 1 1 1))))
(draw (with-material (make-material #:color "teal" #:transparency 0.6) (make-sphere (xyz 3 0 1) 1)))
(draw (make-cylinder (xyz 6 0 0) 0.5 2) (make-cone (xyz 9 0 2) (xyz 9 0 0) 1) (make-torus (xyz 9 4 1) 1 0.3))
(draw (make-line (xyz 0 0 3) (xyz 9 3 4) (xyz 9 0 3)) (make-text (xyz 0 3 0) 1 "X3D"))
(draw (subtract (make-box (xyz 4 3 0) (xyz 6 5 2)) (make-sphere (xyz 5 4 2) 0.8)))
(for-each (lambda (i) (draw (make-box (xyz i -2 0) (xyz (+ i 0.4) -1.6 2)))) '(1 2 3))
EOF
echo '(draw (make-sphere (xyz 0 0 0) 1))' > "$work/x3d/reader.vs"
"$BUILD/vs" --quiet "$work/x3d/reader.vs" -o "$work/x3d/reader.html" || echo "not ok page/x3d: ended with $?"
size=$(wc -c < "$work/x3d/reader.html")
if [ "$size" -le 900000 ]; then echo "ok page/size of an almost empty page"; else echo "not ok page/size of an almost empty page"; echo "    $size bytes, 900,000 are promised"; fi
"$BUILD/vs" --quiet "$work/x3d/kinds.vs" -o "$work/x3d/kinds.x3d" || echo "not ok page/x3d:kinds: ended with $?"
"$BUILD/vs" --quiet -D rows=1 -D columns=2 examples/gare-do-oriente.vs -o "$work/x3d/gare.x3d" || echo "not ok page/x3d:gare: ended with $?"
for name in arcade doric-columns; do "$BUILD/vs" --quiet examples/$name.vs -o "$work/x3d/$name.x3d" || echo "not ok page/x3d:$name: ended with $?"; done
if [ -d tests/node_modules/x_ite ]; then timeout 300 node tests/page/x3d.mjs "$work/x3d" || echo "not ok page/x3d: ended with $?"
else echo "skip page/x3d: no X_ITE (npm ci --prefix tests --ignore-scripts)"; fi
# Photographs on surfaces in other viewers.
mkdir "$work/photographs" && cp tests/lang/lib/pictures/halves.png "$work/photographs/"
cat > "$work/photographs/wall.vs" <<'EOF'
(draw (with-material (make-material #:image "halves.png" #:roughness 0.9 #:pattern-size 1) (make-box origin (xyz 2 0.2 2))))
(camera (xyz 1 -6 1) (xyz 1 0 1) #:lens 100)
(sun #:azimuth 200 #:altitude 40)
EOF
"$BUILD/vs" --quiet "$work/photographs/wall.vs" -o "$work/photographs/wall.glb" -o "$work/photographs/wall.x3d" || echo "not ok page/photographs: ended with $?"
if [ -d tests/node_modules/x_ite ]; then timeout 300 node tests/page/photographs.mjs "$work/photographs" || echo "not ok page/photographs: ended with $?"
else echo "skip page/photographs: no X_ITE (npm ci --prefix tests --ignore-scripts)"; fi
# No package contains the Web3D Consortium's schema: X3D_SCHEMA is its x3d-4.0.xsd, with the included files beside it.
if [ -f "${X3D_SCHEMA:-}" ]; then
  for name in kinds gare arcade doric-columns; do
    if xmllint --noout --nonet --schema "$X3D_SCHEMA" "$work/x3d/$name.x3d" 2> "$work/why"; then echo "ok page/schema:$name"; else echo "not ok page/schema:$name"; sed 's/^/    /' "$work/why" | head; fi
  done
else echo "skip page/schema: X3D_SCHEMA names no x3d-4.0.xsd (from web3d.org/specifications)"; fi
