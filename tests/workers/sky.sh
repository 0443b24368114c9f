# Owns the test of the physical sky in POV-Ray's pictures: its luminances are the model's (the formulas of Preetham, Shirley and Smits as numpy works
# them out), with 1 for 10,000 cd/m2, and its sun that of a clear day.
. tests/report.sh

wanted sky || exit 0
command -v povray > /dev/null || { echo "skip sky: no povray (package povray)"; exit 0; }

# Turbidity, the sun's altitude (it stands in the east), where the eye looks: angle from the zenith, azimuth from east by north; the luminance there.
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

# The sun of a clear day (127.5 klx exp(-0.21 / sin 45), the Illuminating Engineering Society's) in a .pov, where the light is 1.25 / 3.2 of a picture's.
echo '(draw (make-sphere origin 1)) (sky #:turbidity 2) (sun #:altitude 45)' > "$work/sun.vs"
"$vs" --quiet "$work/sun.vs" -o "$work/look.pov" > "$work/why" 2>&1
sed -n '/^light_source/,/}/s/^  color rgb <\(.*\)>$/\1/p' "$work/look.pov" | awk -F, '
  { lux = 1e4 * 3.14159265 * 3.2 / 1.25 * (0.2126 * $1 + 0.7152 * $2 + 0.0722 * $3); expected = 127500 * exp(-0.21 / sqrt(0.5)) }
  END { if (!((lux - expected)^2 < (0.05 * expected)^2)) print "the sun gives " lux " lx, not " expected }' >> "$work/why"
result sky:sun "$work/why"
