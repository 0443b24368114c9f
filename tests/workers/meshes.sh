# Tests that solids which pictures draw as meshes look like POV-Ray's operations: a wall of brick with many
# openings and a round one, and a ball with many bores. A part of glass where nothing remains, which is not visible,
# makes them stay operations. A draft has no antialiasing, so a pixel at an edge may have either colour.
. tests/report.sh

wanted meshes || exit 0
command -v povray > /dev/null || { echo "skip meshes: no povray (package povray)"; exit 0; }
: > "$work/why"
cat > "$work/holes.vs" <<'V'
(define-parameter operations #f)
(define (bead p) (if operations (list (with-material 'glass (make-sphere p 0.05))) '()))
(define middle (xyz 2.5 -3 1.2))
(define (opening i j) (let ([p (xyz (+ 0.4 (* 2.2 i)) -1 (+ 0.6 (* 1.8 j)))]) (make-box p (+xyz p 1.2 3 1.2))))
(define openings (for*/list ([i 4] [j 2]) (opening i j)))
(define bores (for/list ([i 8]) (make-cylinder middle (+pol middle 2 (* i pi 1/4)) 0.3)))
(draw (with-material 'brick (apply subtract (make-box origin (xyz 9 0.6 5)) (make-cylinder (xyz 4.5 -1 4.3) (xyz 4.5 3 4.3) 0.4)
                                   (append openings (bead (xyz 1 0.3 1.2))))))
(draw (color "steelblue" (apply subtract (make-sphere middle 1.2) (append bores (bead (+x middle 1))))))
(ground 0)
(sun #:azimuth 215 #:altitude 40)
(camera (xyz 1 -12 2.5) (xyz 4.5 0 2.2))
V
# A program in place of POV-Ray prints the number of meshes in the scene.
mkdir "$work/counting"
cat > "$work/counting/povray" <<'S'
#!/bin/sh
for a; do case $a in +I*) echo "meshes: $(grep -c 'mesh2 {' "$(echo "${a#+I}" | tr -d '"')")" >&2 ;; esac; done
exit 1
S
chmod +x "$work/counting/povray"
for way in '#f 2' '#t 0'; do
  said=$(PATH=$work/counting:$PATH "$vs" --quiet --quality draft -D operations=${way% *} "$work/holes.vs" -o "$work/none.png" 2>&1)
  echo "$said" | grep -q "meshes: ${way#* }" || echo "operations=${way% *}: not ${way#* } meshes: $said" >> "$work/why"
  "$vs" --quiet --quality draft --size 200x150 -D operations=${way% *} "$work/holes.vs" -o "$work/${way#* }.exr" 2>> "$work/why"
done
# all pixels, those that differ, mean, largest
"$BUILD/tools/exrdiff" "$work/2.exr" "$work/0.exr" 2>> "$work/why" |
  awk '!($1 == 30000 && $3 * 100 < $1 && $6 + 0 < 0.002) { print "they look otherwise: " $0 }' >> "$work/why"
result meshes "$work/why"

# A ball that was turned is a mesh; where it turns away from the sun it has no steps compared with POV-Ray's sphere,
# although the drawing is large.
: > "$work/why"
cat > "$work/ball.vs" <<'V'
(define-parameter turned #f)
(define half (make-region (make-arc origin 1 -pi/2 pi/2 #:plane 'xz) (make-line (xz 0 1) (xz 0 -1))))
(draw (if turned (do-revolve half 'z) (make-sphere origin 1)))
(draw (make-box (xyz 0 60 -1) 30 1 1))
(sun #:azimuth 260 #:altitude 20)
(camera (xyz 0 -4 0.5) origin)
V
for turned in '#f' '#t'; do
  "$vs" --quiet --quality draft --size 400x300 -D turned=$turned "$work/ball.vs" -o "$work/ball$turned.exr" 2>> "$work/why"
done
"$BUILD/tools/exrdiff" "$work/ball#f.exr" "$work/ball#t.exr" 2>> "$work/why" |
  awk '!($1 == 120000 && $3 < 500 && $6 + 0 < 0.0015) { print "they look otherwise: " $0 }' >> "$work/why"
# A limit that holds for a file holds for its picture.
for suffix in stl png; do
  "$vs" --quiet --quality draft --size 40x30 --limit-triangles 2000 -D turned='#t' "$work/ball.vs" -o "$work/ball.$suffix" 2>> "$work/why"
done
result meshes:turned "$work/why"
