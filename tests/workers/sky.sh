# Tests the physical sky in POV-Ray's pictures: its luminances are the model's (the formulas of Preetham,
# Shirley and Smits, evaluated with numpy), with 1 for 10,000 cd/m2, and its sun is that of a clear day.
. tests/report.sh

wanted sky || exit 0
command -v povray > /dev/null || { echo "skip sky: no povray (package povray)"; exit 0; }

# Turbidity, the sun's altitude (it is in the east), the direction of view: angle from the zenith, azimuth from east by
# north; the luminance there.
while read -r turbidity altitude zenith azimuth expected; do
  cat > "$work/look.vs" <<EOF
(define (towards zenith azimuth)
  (let ([z (* zenith (/ pi 180))] [a (* azimuth (/ pi 180))]) (xyz (* 10 (sin z) (cos a)) (* 10 (sin z) (sin a)) (* 10 (cos z)))))
(draw (make-sphere (xyz 0 0 -50) 1))
(camera origin (towards (+ $zenith 0.01) $azimuth) #:lens 2000)
(sky #:turbidity $turbidity)
(sun #:azimuth 90 #:altitude $altitude)
EOF
  "$vs" --quiet --layers --quality draft --size 16x16 "$work/look.vs" -o "$work/look.exr" > "$work/why" 2>&1
  "$vs" pick --json "$work/look.exr" 8 8 > "$work/said" 2>> "$work/why"
  sed -n 's/.*"color": \[\(.*\)\].*/\1/p' "$work/said" | awk -F, -v expected="$expected" '
    { y = 1e4 * (0.2126 * $1 + 0.7152 * $2 + 0.0722 * $3); seen = 1 }
    END { if (!seen || !((y - expected)^2 < (0.02 * expected)^2)) print "luminance " y ", not " expected }' >> "$work/why"
  result "sky:$turbidity at $altitude, $zenith from the zenith" "$work/why"
done <<'EOF'
2 45 0 0 4469.6
2 45 60 90 6821.1
3 60 0 0 10413.1
6 10 30 0 5614.6
8 30 80 180 6393.0
EOF

# The same in the dark, where POV-Ray computes with a gain: a sky, the sun's altitude, the luminance of the zenith. The
# overcast sky has 9 / (7 pi) of the illuminance 300 + 21000 sin a, within 3 %; twilight at -6 degrees has 3.4 lx.
while read -r sky altitude least most; do
  cat > "$work/look.vs" <<EOF
(draw (make-sphere (xyz 0 0 -50) 1))
(camera origin (xyz 0.001 0 10) #:lens 2000)
$(echo "$sky" | tr _ ' ')
(sun #:azimuth 90 #:altitude $altitude)
EOF
  "$vs" --quiet --layers --quality draft --size 16x16 "$work/look.vs" -o "$work/look.exr" > "$work/why" 2>&1
  "$vs" pick --json "$work/look.exr" 8 8 > "$work/said" 2>> "$work/why"
  sed -n 's/.*"color": \[\(.*\)\].*/\1/p' "$work/said" | awk -F, -v least="$least" -v most="$most" '
    { y = 1e4 * (0.2126 * $1 + 0.7152 * $2 + 0.0722 * $3); seen = 1 }
    END { if (!seen || !(y >= least && y <= most)) print "luminance " y ", not " least " to " most }' >> "$work/why"
  result "sky:$sky at $altitude" "$work/why"
done <<'EOF'
(sky_'overcast) 45 6000 6500
(sky_'overcast) 10 1590 1720
(sky_'night) 45 0.05 0.15
(sky_#:turbidity_3) -6 0.2 3
(sky_#:turbidity_3) -12 0.0005 0.006
EOF

# A lit room at night: at most 1 % of the picture is white, the sky stays dark, and the room is bright.
cat > "$work/room.vs" <<'EOF'
(define grey (make-material #:color "#c8c4bc" #:roughness 1))
(ground 0)
(draw (with-material grey (subtract (make-box (xyz 0 0 0) (xyz 8 6 3.2)) (make-box (xyz 0.2 0.2 0.1) (xyz 7.8 5.8 3))
                                    (make-box (xyz 1 -1 0.1) (xyz 5 1 2.6)))))
(camera (xyz -4 -9 2) (xyz 4 2 1.4) #:lens 28)
(sky 'night)
(lamp (xyz 3 3 2.5) #:lumens 4000)
EOF
if [ -x "$BUILD/tools/pngstat" ]; then
  : > "$work/why"
  # part of the picture, its place, least and most share of it that is as dark as ink, in 1000
  while read -r part crop least most; do
    "$vs" -q --size 200x150 --crop "$crop" "$work/room.vs" -o "$work/room.png" 2>> "$work/why"
    "$BUILD/tools/pngstat" "$work/room.png" | awk -v part="$part" -v least="$least" -v most="$most" -v crop="$crop" '
      { split(crop, c, ","); ink = 1000 * $5 / (c[3] * c[4]); seen = 1 }
      part == "whole" && $7 > 10 { print $7 " pixels in 1000 are white" }
      END { if (!seen || !(ink >= least && ink <= most)) print part ": ink " ink ", not " least " to " most }
      ' >> "$work/why"
  done <<'EOF'
whole 0,0,200,150 500 950
sky 0,0,200,10 500 980
room 85,64,20,20 0 250
EOF
  result sky:lit-room-at-night "$work/why"
else
  echo "skip sky:lit-room-at-night: no pngstat (make build/tools/pngstat)"
fi

# The sun of a clear day (127.5 klx exp(-0.21 / sin 45), the Illuminating Engineering Society's) in a .pov, where the light is 1.25 / 3.2 of a picture's.
echo '(draw (make-sphere origin 1)) (sky #:turbidity 2) (sun #:altitude 45)' > "$work/sun.vs"
"$vs" --quiet "$work/sun.vs" -o "$work/look.pov" > "$work/why" 2>&1
sed -n '/^light_source/,/}/s/^  color rgb <\(.*\)>$/\1/p' "$work/look.pov" | awk -F, '
  { lux = 1e4 * 3.14159265 * 3.2 / 1.25 * (0.2126 * $1 + 0.7152 * $2 + 0.0722 * $3); expected = 127500 * exp(-0.21 / sqrt(0.5)) }
  END { if (!((lux - expected)^2 < (0.05 * expected)^2)) print "the sun gives " lux " lx, not " expected }' >> "$work/why"
result sky:sun "$work/why"

# A sky of 0.2 with a sun of 3 in a picture: the sun becomes a light, so the floor gets 3 sin 30 + 0.2 pi, and in a
# wall's shadow less than the sky's light.
if [ -x "$BUILD/tools/exrmake" ]; then
  : > "$work/why"
  "$BUILD/tools/exrmake" 2048 1024 "$work/sun.exr" sun
  cat > "$work/hdr.vs" <<'EOF'
(define grey (make-material #:color "#808080" #:roughness 1))
(draw (with-material grey (make-box (xyz -40 -40 -1) (xyz 40 40 0))))
(draw (with-material grey (do-rotate (make-box (xyz -0.5 -4 0) (xyz 0.5 4 2)) 'z (* pi 1/9))))
(sky #:image "sun.exr")
(camera (xyz 0 0 20) origin #:lens 36)
EOF
  "$vs" -q --size 80x80 "$work/hdr.vs" -o "$work/hdr.exr" --layers 2>> "$work/why"
  # 20 m are 80 pixels; the sun is in the west by south, at 250 degrees: the shadow falls to the east by north, 2 / tan
  # 30 = 3.46 m long
  while read -r name column row least most; do
    "$vs" pick "$work/hdr.exr" "$column" "$row" --candelas 1 | awk -v name="$name" -v least="$least" -v most="$most" '
      $1 == "illuminance" { got = $2 } END { if (!(got >= least && got <= most)) print name ": illuminance " got ", wanted " least " to " most }' >> "$work/why"
  done <<'EOF'
sunny 8 50 2.04 2.22
shadow 50 36 0.25 0.63
behind-it 60 32 1.95 2.22
EOF
  result sky:picture-with-sun "$work/why"
else
  echo "skip sky:picture-with-sun: no exrmake (make build/tools/exrmake)"
fi
