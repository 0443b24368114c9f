# Tests that a picture has the same bytes on any number of processors and under load, and that a part of it
# equals that part of the whole, also when tiles are joined: each quality of --quality, each format that POV-Ray makes. LONG=1: all of them on 1, 2
# and 3 processors beside busy ones, three runs of six examples, and 4K in 16 tiles.
. tests/report.sh

wanted same || exit 0
command -v povray > /dev/null || { echo "skip same: no povray (package povray)"; exit 0; }
qualities=$(sed -n 's/^OPTION(0, "quality", VALUE_REQUIRED, "\([a-z|]*\)".*/\1/p' cli/options.def | tr '|' ' ')
formats=$(sed -n 's/^VS_FORMAT(\([^,]*\), [^,]*, "[^"]*", "povray".*/\1/p' backends/backends.def)
[ "$(echo $qualities $formats | wc -w)" -ge 5 ] || echo "not ok same: the tables of qualities and formats were not read: $qualities; $formats"

# Glass, a pattern, round and thin objects, a corner with indirect light alone; large enough to be made in strips.
cat > "$work/m.vs" <<'EOF'
(draw (with-material 'plaster (subtract (make-box (xyz -2 -1 0) (xyz 2 2 3)) (make-box (xyz -1.6 -1.1 0.2) (xyz 1.6 1.6 2.6)))))
(draw (with-material 'brick (make-box (xyz -3.4 -1 0) (xyz -2.6 0 2))))
(draw (with-material 'glass (make-sphere (xyz 1 -2 0.6) 0.6)))
(for* ((i 8)) (draw (make-cylinder (xyz (- (* 0.4 i) 1.4) -1 0.2) 0.04 2.4)))
(ground 0)
(camera (xyz 3 -9 2.5) (xyz -0.4 0 1.4) #:lens 40)
EOF
# A ray from below these boxes to the sun has less than 0.001 units inside the box. There, a lamp that is not in a
# light_group makes a pixel depend on the pixels before it: the pixel 351,234 was dark in the whole, and light alone.
cat > "$work/hovering.vs" <<'EOF'
(draw (make-box (xyz -0.04 -0.04 -0.01) (xyz 0.04 0.04 -0.0004)))
(for* ((i 3) (j 3)) (draw (make-box (xyz (- (* 0.024 i) 0.035) (- (* 0.024 j) 0.035) 0) 0.015 0.015 0.015)))
EOF
model=m size=80x480 crops="0,0,80,20 10,110,40,140 79,479,1,1 0,239,80,2" # four strips

# Loads the machine without the program's knowledge: as many processes that only count, until they are ended.
load() { busy=; for i in $(seq "$1"); do (while :; do :; done) & busy="$busy $!"; done; }
unload() { kill $busy; wait $busy 2> /dev/null; busy=; }

draw() { out=$1; shift; "$vs" -q "$work/$model.vs" -o "$out" --size $size "$@" 2>> "$work/why" || echo "$out: ended with $?" >> "$work/why"; }

one() { # QUALITY FORMAT PROCESSORS CROPS TILES
  wanted "same:$model-$1-$2" || return
  : > "$work/why"
  draw "$work/whole.$2" --quality "$1" --threads 1
  for n in $3; do
    draw "$work/other.$2" --quality "$1" --threads "$n"
    cmp "$work/whole.$2" "$work/other.$2" >> "$work/why" 2>&1 || echo "on $n processors" >> "$work/why"
  done
  for crop in $4; do
    top=${crop#*,}
    draw "$work/part.$2" --quality "$1" --crop "$crop"
    "$BUILD/tools/cutdiff" "$work/whole.$2" "$work/part.$2" "${crop%%,*}" "${top%%,*}" > "$work/said" 2>&1 || { echo "--crop $crop: $(cat "$work/said")"; } >> "$work/why"
  done
  for tiles in $5; do # in their own processes, the last first, then joined
    last=$((${tiles%x*} * ${tiles#*x}))
    for only in "--only $last" ""; do
      "$vs" render "$work/$model.vs" -q -o "$work/tiles.$2" --size $size --quality "$1" --tiles "$tiles" $only 2>> "$work/why" || echo "--tiles $tiles: ended with $?" >> "$work/why"
    done
    cmp "$work/whole.$2" "$work/tiles.$2" >> "$work/why" 2>&1 || echo "--tiles $tiles" >> "$work/why"
    rm -f "$work"/tiles*
  done
  result "same:$model-$1-$2" "$work/why"
}

few_pixels() { # FORMATS
  model=hovering size=480x270
  for format in $1; do one draft "$format" 3 "351,234,1,1 320,233,32,2 0,200,480,35" 4x4; done
  model=m size=80x480
}

if [ -z "${LONG:-}" ]; then # the default quality in each format, and a draft
  for format in $formats; do one good "$format" 3 "10,110,40,140" 1x3; done
  one draft png 3 "10,110,40,140" 2x2
  few_pixels png
  exit 0
fi
load 3
for quality in $qualities; do
  for format in $formats; do one "$quality" "$format" "2 3" "$crops" "1x3 4x4"; done
done
few_pixels "$formats"
size=240x160 # two strips side by side
for format in $formats; do one good "$format" "2 3" "0,0,20,160 100,10,40,140 119,0,1,160 239,159,1,1" 2x2; done
for example in vaulted-hall rotunda facade-by-rules voronoi-facade gyroid-pavilion doric-columns; do
  wanted "same:$example" || continue
  : > "$work/why"
  file=$(find examples -name "$example.vs" | head -n 1)
  for run in 1 2 3; do
    "$vs" -q "$file" -o "$work/$run.png" --size 480x360 2>> "$work/why" || echo "ended with $?" >> "$work/why"
    cmp "$work/1.png" "$work/$run.png" >> "$work/why" 2>&1
  done
  result "same:$example" "$work/why"
done
unload
# a picture of 4K
echo '(draw (make-sphere origin 1) (make-box (xyz -3 -3 -2) (xyz 3 3 -1)))' > "$work/large.vs"
model=large size=3840x2160
for quality in $qualities; do one $quality png "" "" 4x4; done
