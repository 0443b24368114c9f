# Writes manual/formats.md: every kind of object in every format, from writing each shape of the table to each format. `sh
# tests/cross/formats.sh` prints the page.
#
# native: in the format's own words. triangles: lowered to them. lines: to polylines. With "or": some forms of the kind
# one way, some the other. Text in italics is the short form of the warning with which the format omits the kind or
# shows it as another.
. tests/report.sh
sheet=tests/cross/sheet.vs

cat <<'EOF'
# Formats

This page shows how each format writes each kind of object. `tests/cross/formats.sh` makes the page from the outputs of
`vs`; a test compares them.

EOF
echo '| ending | content |'
echo '|---|---|'
sed -n 's/^VS_\(FORMAT\|NOTATION\)(\([^,]*\), [^,]*, "\([^"]*\)", [^,]*, [^,]*, "\(.*\)")$/\1 \2 \3 \4/p' backends/backends.def | while read -r sort suffix name doc; do
  if [ "$sort" = FORMAT ]; then echo "| \`.$suffix\` | $doc |"; else echo "| \`--format $name\` | ${doc%: --format *} |"; fi
done

# The attributes that a format keeps: a box of a new material, in a layer, in millimetres; the words by which the script
# finds each.
cat > "$work/looks.vs" <<'EOF'
(units 'mm)
(draw (layer "walls" (with-material (make-material #:name "oak" #:color "#804020") (make-box (xyz 0 0 0) (xyz 1 1 1)))))
EOF
said() { if grep -a -q -e "$1" "$work/looks.words"; then printf ' | yes'; else printf ' | -'; fi; }
echo
echo '| ending | colours | names of materials | layers | units |'
echo '|---|---|---|---|---|'
for format in pov scad lsp x3d html glb usda ifc 3mf obj ply off stl tree; do
  rm -f "$work"/looks.[!v]*
  "$vs" --quiet "$work/looks.vs" -o "$work/looks.$format"
  case $format in
    3mf) "$tools/zipped" "$work/looks.3mf" > "$work/looks.words" ;;
    obj) cat "$work/looks.obj" "$work/looks.mtl" > "$work/looks.words" ;;
    html) node tests/tools/scene.mjs "$work/looks.html" > "$work/looks.words" ;;
    *) cp "$work/looks.$format" "$work/looks.words" ;;
  esac
  printf '| `.%s`' $format
  said 'rgb <\|color(\|vs:color)\|diffuseColor=\|baseColorFactor\|olor="#\|^Kd\|property uchar red\|0\.501960784314 0\.25\|baseColor\|inputs:diffuseColor\|IFCCOLOURRGB'
  said 'oak'
  said 'walls'
  said '[^a-z]mm\($\|[^a-z]\)\|millimeter\|"scale":\[0.001\|metersPerUnit = 0.001\|MILLI'
  echo ' |'
done
cat <<'EOF'

### Parts

A [part](primitives/part.md) keeps its name, and its solids stay apart from those of other parts:

| ending | a part is |
|---|---|
| `.glb` | a node around its meshes, with `"extras": {"part": true}` |
| `.usda` | a prim of the kind `component` |
| `.ifc` | the name of its elements |
| `.3mf` | an object with the part's name as `name` and `partnumber` |
| `.obj` | a group `o`; blanks become `_` |
| `.x3d` `.x3dv` | a Group with a MetadataString `part` |
| `.svg` `.pdf` `.dxf`, `--format dxf-3d` | the layer of all objects in no other layer |

All other formats unite the parts. `load-model` reads the parts of `.glb`, `.3mf` and `.x3d` files of `vs`. An output
with `%p` in its file name, such as `-o '%p.stl'`, becomes a file for each part, in any format. `%p` is the part's name
with hyphens for slashes and for characters that file names should not have.

### Kinds

- *native*: shapes of the format itself; round shapes stay round
- *triangles*, *lines*: triangles or straight pieces, as fine as `--tolerance`
- *rods*, *slabs*: curves become thin rods, flat regions or open surfaces thin slabs; `vs` warns
- other *italics*: `vs` warns with this text

If a cell has several entries, the object decides: a straight extrusion can be native, a tapered one triangles. `vs`
warns of omitted shapes, but not of colours and names that a format cannot hold.

- The column *POV-Ray* also holds for `.png` and `.exr`, *X3D* for `.x3dv` and `.html`, *glTF* for `--format dxf-3d`.
- The column *glTF* also holds for `.usda`, whose boxes, spheres, cylinders and cones are native, and for `.ifc`, which
  omits curves; its boxes, cylinders and straight extrusions are native.
- The column *meshes* is for formats of triangles (`.stl .3mf .obj .ply .off`), which contain the union of solids.
  `.obj`, `.ply` and `.off` also contain regions and open surfaces, as open faces; `.obj` and `.ply` contain curves, as
  lines.
- [Drawings](drawings.md) (`.svg .pdf .dxf`) show solids, surfaces and curves by their lines.
- `.lsp` programs hold boxes, wedges, spheres, cylinders, cones, tori and vertical prisms as commands, booleans as
  booleans, and all other solids as meshes that AutoCAD converts; `vs` omits curves, regions and surfaces, and warns.
- `.tree` files contain all kinds.
- `--up y` turns `.obj`, `.ply`, `.stl`, `.off`, `.usda` and `--format dxf-3d`, so that Y points upwards.
- `--units mm` converts lengths in `.stl`, `.obj`, `.ply`, `.off`, `.3mf`, `.usda`, `.dxf` and `--format dxf-3d`:
  a model in metres becomes a file in millimetres. STL files have no unit, and most programs for printing read
  millimetres.

A warning names the place of the first omitted shape, and `vs` writes all other objects. With `--strict` an omission, or
a [rule of the design](building.md#rules-of-a-design) that is not met, is an error. In pictures (`.png .exr`, and
`.pov`) curves are at least two pixels wide. Curves, flat regions, text and open surfaces without a material are dark.

EOF

# Writes a shape as a line of the table of forms: its kind, each format and its form there. It reads the messages of vs,
# then the files that are text.
cat > "$work/found.awk" <<'EOF'
FNR == 1 { file = FILENAME; sub(/.*\./, "", file); aside = 0 }
file == "said" {
  line = $0
  for (f = 1; f <= 5; f++)
    for (rest = line; (at = index(rest, ": warning: " program[f] " ")) > 0; rest = substr(rest, at + 11)) {
      text = substr(rest, at + 11)
      if (index(text, ": warning: " program[f] " ") == 0 && (!(f in lossy) || text < lossy[f])) lossy[f] = text
    }
  if (first == "" && (sub(/^[^ ]*:[0-9]*: /, "", line) || sub(/^vs: /, "", line))) first = line
}
file == "pov" && /^(camera|light_source|sky_sphere)/ { aside = 1 }
file == "pov" && /^}/ { aside = 0 }
aside { next }
file == "pov" && /mesh2/ { triangles[1] = 1 }
file == "pov" && /(^|[ {])(box|sphere|cylinder|cone|torus|prism|lathe|plane|superellipsoid|height_field|polygon|disc) \{/ { native[1] = 1 }
file == "scad" && /polyhedron\(/ { triangles[2] = 1 }
file == "scad" && /(cube|sphere|cylinder|circle|polygon|square)\(/ { native[2] = 1 }
file == "x3d" && /<IndexedTriangleSet/ { triangles[3] = 1 }
file == "x3d" && /<(Box|Sphere|Cylinder|Cone)/ { native[3] = 1 }
file == "x3d" && /<IndexedLineSet/ { lines[3] = 1 }
BEGIN { split("POV-Ray OpenSCAD X3D glTF STL", program, " "); split("pov scad x3d glb stl", format, " ") }
END {
  if (glb ~ /"mode":[13]/) lines[4] = 1; else if (glb != "") triangles[4] = 1
  if (stl > 84) triangles[5] = 1
  for (f = 1; f <= 5; f++)
    print kind "\t" format[f] "\t" (f in lossy ? "*" lossy[f] "*" : index(written, "." format[f] " ") == 0 ? "*" first "*" : \
      native[f] ? (triangles[f] ? "both" : "native") : triangles[f] ? "triangles" : lines[f] ? "lines" : "nothing")
}
EOF
cat > "$work/one" <<'EOF'
tab=$(printf '\t'); IFS=$tab; set -f; set -- $1; unset IFS
index=$1 kind=$2 at=$work/shape-$1; mkdir "$at"
# a form belongs to the kind with which its name begins, otherwise it is a separate kind
if grep -q -x -F -e "${3%%/*}" "$work/kinds"; then kind=${3%%/*}; fi
timeout -s KILL 60 "$vs" --quiet $sheet -D one="$index" -o "$at/x.pov" -o "$at/x.scad" -o "$at/x.x3d" -o "$at/x.glb" -o "$at/x.stl" > "$at/said" 2>&1
mv "$at/said" "$at/x.said"
text= written=
for format in pov scad x3d glb stl; do
  if [ -f "$at/x.$format" ]; then written="$written.$format "; case $format in pov|scad|x3d) text="$text $at/x.$format" ;; esac; fi
done
glb=$([ ! -f "$at/x.glb" ] || grep -a -o -e '"mode":[13]' -e '"meshes"' "$at/x.glb" | sort -u | tr '\n' ' ')
stl=$([ ! -f "$at/x.stl" ] || wc -c < "$at/x.stl")
awk -v kind="$kind" -v written="$written" -v glb="$glb" -v stl="${stl:-0}" -f "$work/found.awk" "$at/x.said" $text > "$work/found-$index"
rm -r "$at"
EOF

sed -n 's/^VS_KIND([A-Z_0-9]*, [a-z_0-9]*, "\([^"]*\)".*/\1/p' model/prims.def > "$work/kinds"
"$vs" --quiet $sheet -D task=forms > "$work/rows"
export work vs sheet
xargs -P "$(nproc)" -d '\n' -n 1 sh "$work/one" < "$work/rows"
cat "$work"/found-* | sort -u > "$work/found" # in an order of its own, whichever shape came first

echo '| kind | POV-Ray | OpenSCAD | X3D | glTF | meshes |'
echo '|---|---|---|---|---|---|'
awk -F '\t' -v found="$work/found" -v formats='pov scad x3d glb stl' '
  BEGIN {
    count = split(formats, format, " ")
    while ((getline line < found) > 0) {
      split(line, part, "\t")
      sub(/^\*(the drawing holds nothing that this format can show|every drawn object is empty[^*]*)/, "*nothing to show", part[3])
      sub(/^\*[^:]*: /, "*", part[3]); sub(/ are drawn as /, " as ", part[3]); sub(/ are (left out|omitted)/, " omitted", part[3])
      sub(/^\*curves as thin rods/, "*rods", part[3]); sub(/^\*(flat regions|open surfaces) as thin slabs/, "*slabs", part[3])
      key = part[1] SUBSEP part[2]
      met[part[1]] = 1
      word = part[3] == "both" ? "native\ttriangles" : part[3]
      many = split(word, each, "\t")
      for (i = 1; i <= many; i++) if (!((key, each[i]) in seen)) { seen[key, each[i]] = 1; said[key] = said[key] "\t" each[i] }
    }
  }
  {
    row = "| [" $1 "](primitives/" $1 ".md) |"
    for (f = 1; f <= count; f++) {
      text = ""
      many = split(substr(said[$1 SUBSEP format[f]], 2), each, "\t")
      # the usual order, independent of the order of occurrence
      split("native triangles lines nothing", usual, " ")
      for (u = 1; u <= 4; u++) for (i = 1; i <= many; i++) if (each[i] == usual[u]) text = text (text == "" ? "" : " or ") each[i]
      for (i = 1; i <= many; i++) if (each[i] ~ /^\*/) text = text (text == "" ? "" : "; ") each[i]
      row = row " " (text == "" ? "-" : text) " |"
    }
    print row
  }' "$work/kinds"
