#!/bin/sh
# Tests every kind of object in every format, against closed forms and against other programs that read our
# files (tests/cross/README.md):
#
#   closed        volume, area, length, bounding box and contains? against the table's closed forms
#   mesh          the written mesh: closed, and with the volume of the closed form
#   tree          the tree dump equals the golden tests/cross/shapes.tree, and reads back as the same tree
#   autolisp      the mesh of our .lsp, read back, against the closed forms
#   openscad      OpenSCAD's mesh of our .scad against ours
#   povray, x3d   silhouettes of our .pov in POV-Ray and of our page's X3D in Chromium against our mesh
#
# One variant of each shape (plain, turned, mirrored, ...); LONG=1 takes every variant. Contact sheets stay in
# BUILD/cross.
. tests/report.sh
case $ONLY in ""|cross*) ;; *) exit ;; esac
sheet=tests/cross/sheet.vs
variants=${VARIANTS:-mixed}
[ -z "${LONG:-}" ] || variants='plain rotated mirrored scaled cut hollow'
pixels=4000
mkdir -p "$BUILD/cross"

# known.txt lists known failures and their reasons (name, tab, reason). A listed test that passes is a failure too:
# remove its line.
known() {
  awk -F '\t' -v list=tests/cross/known.txt -v only="$ONLY" 'BEGIN { while ((getline line < list) > 0) if (line !~ /^#/ && split(line, part, "\t") == 2) why[part[1]] = part[2] }
    /^ok / && substr($0, 4) in why { print "not ok " substr($0, 4); print "    passes, but tests/cross/known.txt says: " why[substr($0, 4)]; quiet = 0; next }
    /^not ok / && substr($0, 8) in why { quiet = 1; if (index($0, only)) print "skip " substr($0, 8) ": known: " why[substr($0, 8)]; next }
    /^(ok|not ok|skip) / { quiet = !index($0, only) }
    !quiet'
}

everything() {
# ---- no kind without a row ----

# Kinds of define-primitive have names of their own.
limited 120 "$vs" --quiet $sheet -D task=kinds > "$work/met" 2> "$work/said"
result cross/table:read "$work/said"
grep -q '(define-primitive (' tests/cross/shapes.vs && echo custom >> "$work/met"
sed -n 's/^VS_KIND([A-Z_0-9]*, [a-z_0-9]*, "\([^"]*\)".*/\1/p' model/prims.def | while read -r kind; do
  if grep -q -x -F -e "$kind" "$work/met"; then echo "ok cross/table:kind:$kind"
  elif grep -q "\"\(make-\|do-\|\)$kind\"" bind/reserved.def; then echo "skip cross/table:kind:$kind: nothing makes it yet"
  else echo "not ok cross/table:kind:$kind"; echo "    no shape has it"; fi
done
# unit/test_forms: every form of every constructor has a row

# ---- the form of every kind in every format, against the manual ----

: > "$work/why"
sh tests/cross/formats.sh > "$work/formats.md" 2> "$work/why"
[ -z "$BLESS" ] || cp "$work/formats.md" manual/formats.md
diff manual/formats.md "$work/formats.md" >> "$work/why"
[ ! -s "$work/why" ] || echo "BLESS=1 SUITES=cross sh tests/run.sh build writes the page anew" >> "$work/why"
result "cross/formats:manual/formats.md is current" "$work/why"

# ---- Appendix A in the formats that the table of kinds does not cover ----

# A plan from above, with cells 12 apart: the lines in each extend from one end of its bounding box to the other.
# Infinite lines are drawn beside them.
cat > "$work/plan.vs" <<'EOF'
(define-parameter appendix "")
(define index -1)
(define-syntax entry
  (syntax-rules ()
    ((_ name form measure value)
     (let ([o form])
       (set! index (+ index 1))
       (if (memq (object-kind o) '(xline ray))
           (draw (do-move o (vxyz -20 0 0)))
           (let* ([p (xy (* 12 (remainder index 8)) (* 12 (quotient index 8)))] [box (bounding-box o)] [low (first box)] [high (second box)])
             (draw (do-move o (p->q origin p)))
             (printf "~a ~a ~a ~a ~a ~a\n" index (cx low) (cy low) (cx high) (cy high) name)))))))
(draw (make-line (xyz -20 0 0) (xyz -21 0 0)))
(load appendix)
(view "roof" 'plan #:cut #f)
EOF
: > "$work/why"
outputs=; for f in dxf svg pdf html x3dv obj ply off 3mf; do outputs="$outputs -o $work/plan.$f"; done
# shellcheck disable=SC2086
limited 120 "$vs" --quiet -D appendix="$PWD/tests/cross/appendix-a.vs" --view roof "$work/plan.vs" $outputs > "$work/cells" 2> "$work/said" || cat "$work/said" > "$work/why"
grep warning: "$work/said" | grep -v 'are omitted$' >> "$work/why"
for f in $outputs; do [ "$f" = -o ] || [ -s "$f" ] || echo "$f is not written" >> "$work/why"; done
[ "$(grep -c . "$work/cells")" -ge 60 ] || echo "only $(grep -c . "$work/cells") forms are in the plan" >> "$work/why"
tr -d ' \r' < "$work/plan.dxf" | paste - - | awk -F '\t' -v cells="$work/cells" '
  $1 == 8 { here = $2 ~ /^(curve|edge|outline|cut)$/ }
  here && ($1 == 10 || $1 == 11) { x = $2 }
  here && ($1 == 20 || $1 == 21) && x > -10 {
    y = $2; i = int((x + 6) / 12); j = int((y + 6) / 12); c = i + 8 * j; a = x - 12 * i; y -= 12 * j
    if (!(c in least_x)) { least_x[c] = most_x[c] = a; least_y[c] = most_y[c] = y }
    if (a < least_x[c]) least_x[c] = a; if (a > most_x[c]) most_x[c] = a; if (y < least_y[c]) least_y[c] = y; if (y > most_y[c]) most_y[c] = y
  }
  function far(a, b) { return (a - b) ^ 2 > 0.02 ^ 2 }
  END {
    while ((getline line < cells) > 0) {
      split(line, t, " "); c = t[1]
      if (!(c in least_x)) print line ": nothing is drawn"
      else if (far(least_x[c], t[2]) || far(least_y[c], t[3]) || far(most_x[c], t[4]) || far(most_y[c], t[5])) print line ": drawn from " least_x[c] " " least_y[c] " to " most_x[c] " " most_y[c]
    }
  }' >> "$work/why"
result "cross/appendix:its forms in drawings and in the other formats" "$work/why"

# ---- the tree of every shape, against the committed one ----

# the golden has the length and checksum of long lists of points
limited 120 "$vs" --quiet $sheet -D task=tree -o "$work/shapes.tree" > "$work/said" 2>&1
awk 'length($0) <= 600 { print; next } { printf "%s ... %d characters, ", substr($0, 1, 200), length($0); fflush(); print | "cksum"; close("cksum") }' "$work/shapes.tree" > "$work/shapes.short"
[ -z "$BLESS" ] || cp "$work/shapes.short" tests/cross/shapes.tree
diff tests/cross/shapes.tree "$work/shapes.short" > "$work/why"
[ ! -s "$work/why" ] || echo "BLESS=1 SUITES=cross sh tests/run.sh build writes it anew; read the diff" >> "$work/why"
result "cross/tree:golden" "$work/why"

[ -z "$BLESS" ] || return # nothing else is written anew

for variant in $variants; do
  table=$work/$variant.table mesh=$work/$variant.stl
  limited 120 "$vs" --quiet $sheet -D task=measure -D variant=$variant > "$work/said" 2> "$work/why" || echo "ended with $?" >> "$work/why"
  cat "$work/said"
  result cross/measure:$variant "$work/why"

  if ! limited 120 "$vs" --quiet $sheet -D task=table -D variant=$variant > "$table" 2> "$work/why"; then result cross/table:$variant "$work/why"; continue; fi
  limited 120 "$vs" --quiet --segments 128 $sheet -D variant=$variant -o "$mesh" > "$work/said" 2>&1 || { result cross/mesh:$variant:written "$work/said"; continue; }
  "$tools/sheetmesh" "$table" "$mesh"

  : > "$work/why"
  limited 120 "$vs" --quiet $sheet -D variant=$variant -o "$work/sheet.tree" > "$work/said" 2>&1 || cat "$work/said" >> "$work/why"
  "$tools/reread" "$work/sheet.tree" 2>> "$work/why" || echo "reading back failed" >> "$work/why"
  result cross/tree:$variant "$work/why"

  # ---- AutoLISP: our program, which our own front end reads back, against the closed forms ----
  limited 200 "$vs" --quiet --segments 128 $sheet -D variant=$variant -o "$work/sheet.lsp" > "$work/said" 2>&1 &&
    limited 200 "$vs" --quiet --segments 128 "$work/sheet.lsp" -o "$work/back.stl" > "$work/said" 2>&1
  if [ $? = 0 ]; then "$tools/sheetmesh" "$table" "$work/back.stl" | sed 's|cross/mesh|cross/autolisp|'
  else result cross/autolisp:$variant "$work/said"; fi

  # ---- OpenSCAD: a run for each shape, because it unites all shapes of a file, slowly; several runs at a time ----
  if command -v openscad > /dev/null; then
    awk -F '\t' '$3 == "solid" { print $1, $2 }' "$table" > "$work/list"
    : > "$work/results"
    cat > "$work/one" <<EOF
index=\$1; shift; name=\$*; at=$work/scad-\$index
. tests/limited.sh
limited 120 "$vs" --quiet --tolerance 0.01 $sheet -D variant=$variant -D one=\$index -o \$at.stl -o \$at.scad > \$at.said 2>&1
limited 200 openscad --export-format binstl -o \$at-theirs.stl \$at.scad > \$at.openscad 2>&1
grep -e ERROR: -e WARNING: \$at.openscad >> \$at.said
difference=\$("$tools/sheetdiff" \$at.stl \$at-theirs.stl 0.02) || echo "\$difference" >> \$at.said
if [ -s \$at.said ]; then echo "not ok cross/openscad:\$name"; sed 's/^/    /' \$at.said | head -n 8; else echo "ok cross/openscad:\$name"; fi > \$at.result
EOF
    xargs -P 2 -I '{}' sh -c "sh $work/one {}" < "$work/list"
    cat "$work"/scad-*.result
    rm -f "$work"/scad-*
  else echo "skip cross/openscad:$variant: no openscad (package openscad)"; fi

  # ---- silhouettes ----
  limited 120 "$vs" --quiet --tolerance 0.001 $sheet -D variant=$variant -D standin=#t -o "$work/standin.stl" > "$work/said" 2>&1 || { result cross/standin:$variant "$work/said"; continue; }
  limited 120 "$vs" --quiet --quality draft --tolerance 0.01 --size ${pixels}x$pixels $sheet -D variant=$variant -o "$work/sheet.pov" -o "$work/sheet.x3d" -o "$work/sheet.html" > "$work/said" 2>&1 || { result cross/pictures:$variant "$work/said"; continue; }

  if command -v povray > /dev/null; then
    # without its sky the background is transparent
    sed -e '/^sky_sphere/,/^}/d' -e '/^  radiosity/d' "$work/sheet.pov" > "$work/bare.pov"
    echo 'Library_Path="/usr/share/povray-3.7/include"' > "$work/povray.ini"
    limited 200 env HOME="$work" POVINI="$work/povray.ini" povray "$work/bare.pov" +W$pixels +H$pixels -D +FN8 +UA +Q1 -A "+O$work/pov.png" > "$work/said" 2>&1
    grep -e 'Warning:' -e 'Error:' "$work/said" > "$work/why"
    result "cross/povray:$variant:no warning" "$work/why"
    "$tools/sheetview" "$table" "$work/standin.stl" "$work/sheet.pov" "$work/pov.png" povray "$BUILD/cross/povray-$variant.png"
  else echo "skip cross/povray:$variant: no povray (package povray)"; fi

  if ! command -v chromium > /dev/null; then echo "skip cross/x3d:$variant: no chromium (package chromium)"
  elif [ ! -d tests/node_modules/playwright-core ] || [ ! -d node_modules/three ]; then echo "skip cross/x3d:$variant: no viewer or no playwright-core (npm ci --prefix tests --ignore-scripts)"
  else
    limited 300 node tests/page/silhouette.mjs "$work/sheet.html" "$work/sheet.x3d" $pixels "$work/x3d.png" > "$work/said" 2>&1 || { result cross/x3d:$variant "$work/said"; continue; }
    "$tools/sheetview" "$table" "$work/standin.stl" "$work/sheet.x3d" "$work/x3d.png" x3d "$BUILD/cross/x3d-$variant.png"
  fi
done
}

everything | known
