# Owns manual/formats.md: what becomes of every kind of object in every format, found out by writing each shape of the table to each format and looking
# at what came. `sh tests/cross/formats.sh` prints the page.
#
# native: in the format's own words. triangles: lowered to them. lines: to polylines. With "or": some forms of the kind one way, some the other.
# What is in italics is the warning with which the format leaves the kind out or shows it as something else.
. tests/report.sh
sheet=tests/cross/sheet.vs
formats='pov scad x3d glb stl'

cat <<'EOF'
# Formats

What becomes of every kind of object in every format. This page is made from what the program writes (`tests/cross/formats.sh`); a test keeps it current.

EOF
echo '| ending | |'
echo '|---|---|'
sed -n 's/^VS_\(FORMAT\|NOTATION\)(\([^,]*\), [^,]*, "\([^"]*\)", [^,]*, [^,]*, "\(.*\)")$/\1 \2 \3 \4/p' backends/backends.def | while read -r sort suffix name doc; do
  if [ "$sort" = FORMAT ]; then echo "| \`.$suffix\` | $doc |"; else echo "| \`--format $name\` | $doc |"; fi
done

# What of an object's looks comes along: one box of a made material, in a layer, in millimetres; the words by which it is known again.
cat > "$work/looks.vs" <<'EOF'
(units 'mm)
(draw (layer "walls" (with-material (make-material #:name "oak" #:color "#804020") (make-box (xyz 0 0 0) (xyz 1 1 1)))))
EOF
said() { if grep -a -q -e "$1" "$work/looks.words"; then printf ' | yes'; else printf ' | -'; fi; }
echo
echo '| ending | colours | names of materials | layers | units |'
echo '|---|---|---|---|---|'
for format in pov scad x3d html glb 3mf obj ply off stl tree; do
  rm -f "$work"/looks.[!v]*
  "$vs" --quiet "$work/looks.vs" -o "$work/looks.$format"
  case $format in
    3mf) "$tools/zipped" "$work/looks.3mf" > "$work/looks.words" ;;
    obj) cat "$work/looks.obj" "$work/looks.mtl" > "$work/looks.words" ;;
    html) sed -n 's/.*id="scene">\([^<]*\)<.*/\1/p' "$work/looks.html" | base64 -d > "$work/looks.words" ;;
    *) cp "$work/looks.$format" "$work/looks.words" ;;
  esac
  printf '| `.%s`' $format
  said 'rgb <\|color(\|diffuseColor=\|baseColorFactor\|olor="#\|^Kd\|property uchar red\|0\.501960784314 0\.25\|baseColor'
  said 'oak'
  said 'walls'
  said '[^a-z]mm\($\|[^a-z]\)\|millimeter\|"scale":\[0.001'
  echo ' |'
done
cat <<'EOF'

*native*: in the format's own words, so that it stays round and can be edited there. *triangles*: lowered to them, as fine as `--tolerance` says. *lines*: to
straight pieces. Where several stand, it depends on the form: a tapered extrusion is triangles where a straight one is not. What is in italics is
the warning that the program gives: no shape is left out in silence, but looks that a format has no words for are. `.png` and `.exr` are POV-Ray's; `.x3dv` and `.html` hold the shapes that `.x3d` does;
all that is made of bare triangles (`.stl .3mf .obj .ply .off`) holds the union of the drawing's solids; `.obj`, `.ply` and `.off` hold regions
and open surfaces as open faces, besides, and the first two curves as lines. [Drawings](drawings.md) (`.svg .pdf .dxf`) show solids,
surfaces and curves by their lines. `.tree` holds everything as it is.

One rule holds for all formats: a thing of a class that a format cannot show is shown thin where that can be read as what it is (`.pov .scad`), else left out, and a
warning names the first place. Others in the drawing are written all the same; with `--strict` it is an error. In pictures (`.png .exr`, and `.pov`) curves are two pixels
wide and more, and curves, flat regions, text and open surfaces without a material are dark.

EOF

# The words of a file: native, triangles, lines or nothing.
words() {
  case $1 in
    pov) awk '/^(camera|light_source|sky_sphere)/ { aside = 1 } /^}/ { aside = 0 } aside { next } /mesh2/ { t = 1 }
      /(^|[ {])(box|sphere|cylinder|cone|torus|prism|lathe|plane|superellipsoid|height_field|polygon|disc) \{/ { n = 1 } END { print n ? (t ? "both" : "native") : t ? "triangles" : "nothing" }' "$2" ;;
    scad) awk '/polyhedron\(/ { t = 1 } /(cube|sphere|cylinder|circle|polygon|square)\(/ { n = 1 } END { print n ? (t ? "both" : "native") : t ? "triangles" : "nothing" }' "$2" ;;
    x3d) awk '/<IndexedTriangleSet/ { t = 1 } /<(Box|Sphere|Cylinder|Cone)/ { n = 1 } /<IndexedLineSet/ { l = 1 }
      END { print n ? (t ? "both" : "native") : t ? "triangles" : l ? "lines" : "nothing" }' "$2" ;;
    glb) if grep -a -q '"mode":[13]' "$2"; then echo lines; elif grep -a -q '"meshes"' "$2"; then echo triangles; else echo nothing; fi ;;
    stl) if [ "$(wc -c < "$2")" -gt 84 ]; then echo triangles; else echo nothing; fi ;;
  esac
}

sed -n 's/^VS_KIND([A-Z_0-9]*, [a-z_0-9]*, "\([^"]*\)".*/\1/p' model/prims.def > "$work/kinds"
"$vs" --quiet $sheet -D task=forms > "$work/rows"
while IFS='	' read -r index kind name; do
  # a form is of the kind that its name begins with, else of its own
  if grep -q -x -F -e "${name%%/*}" "$work/kinds"; then kind=${name%%/*}; fi
  rm -f "$work"/x.*
  timeout -s KILL 60 "$vs" --quiet $sheet -D one="$index" -o "$work/x.pov" -o "$work/x.scad" -o "$work/x.x3d" -o "$work/x.glb" -o "$work/x.stl" > "$work/said" 2>&1
  for format in $formats; do
    case $format in pov) program=POV-Ray ;; scad) program=OpenSCAD ;; x3d) program=X3D ;; glb) program=glTF ;; stl) program=STL ;; esac
    lossy=$(sed -n "s/^.*: warning: \\($program .*\\)/\\1/p" "$work/said" | sort -u | head -n 1)
    if [ -n "$lossy" ]; then word="*$lossy*"; elif [ -f "$work/x.$format" ]; then word=$(words $format "$work/x.$format")
    else word="*$(sed -n 's/^[^ ]*:[0-9]*: //p; s/^vs: //p' "$work/said" | head -n 1)*"; fi
    printf '%s\t%s\t%s\n' "$kind" "$format" "$word"
  done
done < "$work/rows" | sort -u > "$work/found" # in an order of its own, whichever shape came first

echo '| kind | POV-Ray | OpenSCAD | X3D | glTF | meshes |'
echo '|---|---|---|---|---|---|'
awk -F '\t' -v found="$work/found" -v formats="$formats" '
  BEGIN {
    count = split(formats, format, " ")
    while ((getline line < found) > 0) {
      split(line, part, "\t")
      sub(/^\*STL holds/, "*meshes hold", part[3])
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
      # the usual order, whichever came first
      split("native triangles lines nothing", usual, " ")
      for (u = 1; u <= 4; u++) for (i = 1; i <= many; i++) if (each[i] == usual[u]) text = text (text == "" ? "" : " or ") each[i]
      for (i = 1; i <= many; i++) if (each[i] ~ /^\*/) text = text (text == "" ? "" : "; ") each[i]
      row = row " " (text == "" ? "-" : text) " |"
    }
    print row
  }' "$work/kinds"
