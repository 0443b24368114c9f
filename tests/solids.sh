#!/bin/sh
# Checks written meshes for self-intersections (tests/tools/crossings.c), in .off and in .stl with its 32-bit
# numbers: the kernel's workloads (bench/kernel). LONG=1: all but the largest of them. It also runs random trees of
# boxes through the language (tests/oracle/fuzz.c): (volume o) and the volume of the .off file, which must be closed,
# equal the count of cells. Joined walls of random plans have no gaps and overlaps (tests/oracle/wall_graphs.vs), curved
# ones at small angles (tests/oracle/acute_walls.vs), too. LONG=1:
# straight skeletons are CGAL's (tests/oracle/skeletons_cgal.cc).
. tests/report.sh
case $ONLY in ""|solids*) ;; *) exit ;; esac
here=bench/kernel
for kind in cell turned spelt; do
  case solids/$kind in *"$ONLY"*) ;; *) continue ;; esac
  : > "$work/why"
  for seed in $(seq "$([ -z "${LONG:-}" ] && echo 16 || echo 150)"); do
    "$BUILD/tools/fuzz" -p $kind "$seed" > "$work/tree.vs"
    rm -f "$work/tree.off"
    limited 60 "$vs" --quiet $here/suite.vs "$work/tree.vs" -o "$work/tree.off" > "$work/said" 2>&1 || echo "ended with $?" >> "$work/said"
    # a subtraction that misses is no fault of a random tree
    awk '/subtract takes nothing away here/ { skip = 2; next } skip > 0 && /^ / { skip--; next } { skip = 0; print }' "$work/said" > "$work/rest" && mv "$work/rest" "$work/said"
    # contacts of the exact solid with itself are no fault, all others are
    limited 60 "$BUILD/tools/crossings" "$work/tree.off" | sed 's/, [0-9]* touching ([^)]*)$//' |
      awk -v first="$(head -n 1 "$work/tree.vs")" '{ split(first, want); d = $NF - want[3] } !/ triangles, volume [^ ]*$/ || d > want[5] * want[3] || -d > want[5] * want[3]
        END { if (NR != 1) print "no mesh" }' >> "$work/said" 2>&1
    [ ! -s "$work/said" ] || { echo "seed $seed:"; cat "$work/said" "$work/tree.vs"; } >> "$work/why"
  done
  if [ -s "$work/why" ]; then echo "not ok solids/$kind"; head -n 24 "$work/why" | sed 's/^/    /'; else echo "ok solids/$kind"; fi
done
case solids/fine in *"$ONLY"*) # details finer than a format's numbers: the loss is told of, and what is left of them may lie on itself, but crosses nowhere
  cat > "$work/fine.vs" <<'END'
(define body (make-box (xyz -500 -500 -500) (xyz 500 500 500)))
(define bumps (for*/list ([i 10] [j 10]) (make-sphere (xyz (* i 3e-4) (* j 3e-4) 500) 1e-4)))
(define pits (for*/list ([i 10] [j 10]) (make-cylinder (xyz (+ 100 (* i 1e-3)) (* j 1e-3) 499.9999) 1 2e-4)))
(draw (subtract (unite body bumps) pits))
END
  limited 60 "$vs" --quiet "$work/fine.vs" -o "$work/fine.stl" > "$work/said" 2>&1 || echo "ended with $?" >> "$work/said"
  limited 60 "$BUILD/tools/crossings" "$work/fine.stl" > "$work/why"
  if grep -q 'details that are finer' "$work/said" && grep -q ' triangles, volume ' "$work/why" && ! grep -q ' crossing (' "$work/why"; then echo "ok solids/fine"
  else echo "not ok solids/fine"; cat "$work/said" "$work/why" | sed 's/^/    /'; fi ;;
esac
case solids/radial in *"$ONLY"*) # holes whose flat ends meet in one axis: where corners are only places, none of the slivers along it is left that crosses anything
  : > "$work/why"
  for tower in '60 0.4 4' '30 0.5 6' '100 0.433333333 12' '20 0.35 4'; do # height, distance of the holes, how many
    cat > "$work/radial.vs" <<END
(define (hole step i)
  (define z (+ 4 (* i step)))
  (do-rotate (make-pyramid (xyz 0 0 z) 0.8 24 (xyz 0 -15 z) 0.8) 'z (degrees->radians (* i 137.5))))
(define (tower height step holes)
  (apply subtract (make-box (xyz -5 -5 0) (xyz 5 5 height)) (map (lambda (i) (hole step i)) (iota holes))))
(draw (tower $tower))
END
    limited 60 "$vs" --quiet "$work/radial.vs" -o "$work/radial.stl" > "$work/said" 2>&1 || echo "ended with $?" >> "$work/why"
    grep 'triangles touch or cross triangles' "$work/said" >> "$work/why"
    limited 60 "$BUILD/tools/crossings" -q "$work/radial.stl" >> "$work/why" 2>&1
  done
  if [ ! -s "$work/why" ]; then echo "ok solids/radial"; else echo "not ok solids/radial"; sed 's/^/    /' "$work/why"; fi ;;
esac
case solids/walls in *"$ONLY"*) # random plans of joined walls; LONG=1: 1,000
  limited 3000 "$vs" --quiet tests/oracle/wall_graphs.vs -D cases="$([ -z "${LONG:-}" ] && echo 12 || echo 1000)" > "$work/why" 2>&1 || echo "ended with $?" >> "$work/why"
  # walls between two acute joints: a straight one, and one whose layer turns back on itself at a seam
  [ "${LONG:-}" ] || for seed in 86 771; do limited 60 "$vs" --quiet tests/oracle/wall_graphs.vs -D seed=$seed -D cases=1 >> "$work/why" 2>&1; done
  if [ ! -s "$work/why" ]; then echo "ok solids/walls"; else echo "not ok solids/walls"; head -n 24 "$work/why" | sed 's/^/    /'; fi ;;
esac
case solids/acute in *"$ONLY"*) # curved walls that meet at 6 to 35 degrees; LONG=1: 1,000
  limited 3000 "$vs" --quiet tests/oracle/acute_walls.vs -D cases="$([ -z "${LONG:-}" ] && echo 24 || echo 1000)" > "$work/why" 2>&1 || echo "ended with $?" >> "$work/why"
  if [ ! -s "$work/why" ]; then echo "ok solids/acute"; else echo "not ok solids/acute"; head -n 24 "$work/why" | sed 's/^/    /'; fi ;;
esac
case solids/skeletons in *"$ONLY"*) # LONG=1: straight skeletons of 1,000 random outlines with holes, beside CGAL's
  if [ -z "${LONG:-}" ]; then :
  elif ! [ -f /usr/include/CGAL/create_straight_skeleton_2.h ] || ! command -v g++ > /dev/null; then echo "skip solids/skeletons: no CGAL (packages g++ libcgal-dev)"
  else
    limited 600 g++ -O1 tests/oracle/skeletons_cgal.cc -o "$work/judge" -lgmp -lmpfr > "$work/why" 2>&1
    limited 300 "$vs" --quiet tests/oracle/skeletons.vs -D cases=1000 > "$work/outlines" 2>> "$work/why" || echo "ended with $?" >> "$work/why"
    limited 300 "$work/judge" < "$work/outlines" >> "$work/why" 2>&1
    if grep -q '^1000 outlines, .* 0 differ$' "$work/why"; then echo "ok solids/skeletons"; else echo "not ok solids/skeletons"; tail -n 24 "$work/why" | sed 's/^/    /'; fi
  fi ;;
esac
if ! command -v node > /dev/null; then echo "skip solids: no node (package nodejs)"; exit; fi
case solids/repaired in *"$ONLY"*) # damaged meshes, repaired: each is written without an intersection, or with a warning that it has some
  : > "$work/why"
  limited 60 "$vs" --quiet -e '(draw (make-sphere origin 1 #:segments 12))' -o "$work/ball.off"
  limited 60 "$vs" --quiet -e '(draw (subtract (make-box (xyz 0 0 0) (xyz 3 3 1)) (make-cylinder (xyz 1.5 1.5 -1) 3 .7)))' -o "$work/plate.off"
  limited 60 "$vs" --quiet -e '(draw (unite (make-box origin (xyz 2 2 2)) (make-box (xyz 1 1 1) (xyz 3 3 3))))' -o "$work/boxes.off"
  for seed in $(seq "$([ -z "${LONG:-}" ] && echo 40 || echo 400)"); do
    node tests/oracle/damaged.mjs "$seed" "$work/ball.off" "$work/plate.off" "$work/boxes.off" > "$work/damaged.off"
    rm -f "$work/repaired.stl" "$work/repaired.off"
    echo '(draw (load-mesh "damaged.off" #:repair #t))' > "$work/repaired.vs"
    limited 60 "$vs" --quiet "$work/repaired.vs" -o "$work/repaired.stl" -o "$work/repaired.off" > "$work/said" 2>&1 || { echo "seed $seed: ended with $?"; tail -n 2 "$work/said"; } >> "$work/why"
    for file in "$work/repaired.stl" "$work/repaired.off"; do
      limited 60 "$BUILD/tools/crossings" "$file" | grep -q ' crossing (' || continue
      grep -q 'touch or cross triangles' "$work/said" || { echo "seed $seed: ${file##*.} crosses itself without a warning"; cat "$work/said"; } >> "$work/why"
    done
  done
  if [ -s "$work/why" ]; then echo "not ok solids/repaired"; head -n 24 "$work/why" | sed 's/^/    /'; else echo "ok solids/repaired"; fi ;;
esac
node $here/gen.mjs "$work" > "$work/said" 2>&1 || { echo "not ok solids: the workloads cannot be made"; exit; }
small='b_grid_overlap_5 c_wall_50 d_menger_2 e_sphere_minus_32 e2_sphere_nearcoinc_32 f_spheres_20 g_cubes_5 g2_checker_8 h_torus_64 i_twist_40 i_twist_200 j_truss_512 k_tower_5 l_drill_50 m_arcade_10'
names=$small
[ -z "${LONG:-}" ] || names=$(sed 1d "$work/INDEX.tsv" | cut -f1 | grep -v -e torus_1024 -e truss_8220 -e menger_4 -e minus_256 -e spheres_1000 -e nearcoinc_128 -e disjoint_100)
for name in $names; do
  case solids/$name in *"$ONLY"*) ;; *) continue ;; esac
  : > "$work/why"
  cat $here/suite.vs "$work/sx/$name.sx" > "$work/$name.vs"
  limited 300 "$vs" --quiet "$work/$name.vs" -o "$work/$name.off" -o "$work/$name.stl" 2> "$work/said" || echo "ended with $?" > "$work/why"
  [ -s "$work/why" ] || limited 300 "$BUILD/tools/crossings" -q "$work/$name.off" "$work/$name.stl" > "$work/why" 2>&1
  if [ -s "$work/why" ]; then echo "not ok solids/$name"; cat "$work/said" "$work/why" | head -n 12 | sed 's/^/    /'; else echo "ok solids/$name"; fi
  rm -f "$work/$name".*
done
