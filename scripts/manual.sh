#!/bin/sh
# Makes the manual for reading: BUILD/manual, HTML pages of manual/*.md. Each kind of model/prims.def, and each operator of rules, has a page with its forms and contracts,
# what it is in the tree, an example, and the picture that the example makes; the tutorial has the pictures of its steps.
#
#   scripts/manual.sh BUILD   KINDS="sphere text"  pictures and pages of these kinds alone, and no steps   STEPS=last  a picture of each step's last program
#                             QUALITY=draft  SIZE=640x480  PICTURES=no  no pictures       PAGES=DIR  instead of BUILD/manual
set -u
cd "$(dirname "$0")/.." || exit 1
BUILD=$1
vs=$BUILD/vs out=${PAGES:-$BUILD/manual}
mkdir -p "$out/primitives" "$out/rules" "$out/language" "$out/internals" || exit 1
cp scripts/manual.css manual/*.jpg manual/*.svg "$out/"
cp scripts/manual_search.js "$out/search.js"
echo 'const manual = [' > "$out/index.js" # the search's index: a row for each heading, which the pages add
failed=$out/failed
: > "$failed"
pictures=${PICTURES:-yes}
if [ "$pictures" = yes ] && ! command -v povray > /dev/null; then
  echo "no pictures: POV-Ray is missing (package povray)" >&2
  pictures=no
fi

# The kinds with their class, in the table's order: "sphere SOLID"; and one kind's fields: "c point, r real".
kinds() { sed -n 's/^VS_KIND([A-Z_0-9]*, [a-z_0-9]*, "\([^"]*\)", \([A-Z]*\), .*/\1 \2/p' model/prims.def; }
fields() {
  awk -v kind="$1" 'index($0, "VS_KIND(") == 1 { split($0, part, "\""); here = part[2] == kind }
    here && match($0, /VS_FIELD\([a-z]+/) { type = substr($0, RSTART + 9, RLENGTH - 9); split($0, part, "\""); printf "%s<code>%s</code> %s", sep, part[2], type; sep = ", " }' model/prims.def
}
block() { awk -v n="$2" '/^```scheme$/ { inside = 1; text = ""; count++; next } /^```$/ { if (inside && count == n) printf "%s", text; inside = 0 } inside { text = text $0 "\n" }' "$1"; }
blocks() { grep -c '^```scheme$' "$1"; }

# picture PROGRAM PICTURE SOURCE: makes the picture again if the source or vs is newer
picture() {
  [ "$pictures" = yes ] || return 0
  if [ "$2" -nt "$3" ] && [ "$2" -nt "$vs" ]; then return 0; fi
  quality=${QUALITY:-good}
  grep -q '(ghost ' "$1" && quality=draft # which alone shows ghosts
  timeout 300 "$vs" --quiet --quality "$quality" --size "${SIZE:-640x480}" "$1" -o "$2" 2> "$1.said" || { echo "$3: no picture" >> "$failed"; cat "$1.said" >> "$failed"; }
}

work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT

kinds | while read -r kind class; do
  [ -z "${KINDS:-}" ] || case " $KINDS " in *" $kind "*) ;; *) continue ;; esac
  page=manual/primitives/$kind.md
  block "$page" "$(blocks "$page")" > "$work/$kind.vs"
  picture "$work/$kind.vs" "$out/primitives/$kind.png" "$page"
  after=
  [ ! -f "$out/primitives/$kind.png" ] || after="<p><img class='picture' src='$kind.png' alt='what the program draws'></p>"
  what=$(echo "$class" | tr '[:upper:]' '[:lower:]')
  [ "$what" != inherit ] || what="what its parts make it"
  with=$(fields "$kind")
  after="$after<p class='facts'>In the tree: <code>$kind</code>, $what${with:+; $with}.</p>"
  awk -v title="$kind" -v root=../ -v index_to="$out/index.js" -v page="primitives/$kind.html" -v after="$after" -f scripts/manual.awk "$page" > "$out/primitives/$kind.html"
done

# The operators of rules: a page for each, with the picture of its last program.
for page in manual/rules/*.md; do
  [ -z "${KINDS:-}" ] || break
  name=$(basename "$page" .md)
  block "$page" "$(blocks "$page")" > "$work/$name.vs"
  picture "$work/$name.vs" "$out/rules/$name.png" "$page"
  after=
  [ ! -f "$out/rules/$name.png" ] || after="<p><img class='picture' src='$name.png' alt='what the program draws'></p>"
  awk -v title="$name" -v root=../ -v index_to="$out/index.js" -v page="rules/$name.html" -v after="$after" -f scripts/manual.awk "$page" > "$out/rules/$name.html"
done

for page in manual/language/*.md manual/internals/*.md; do
  name=$(basename "$page" .md)
  file=$(basename "$(dirname "$page")")/$([ "$name" = README ] && echo index || echo "$name").html
  awk -v title="$name" -v root=../ -v index_to="$out/index.js" -v page="$file" -f scripts/manual.awk "$page" > "$out/$file"
done

# The tutorial: a block can use the definitions of earlier blocks in its step.
if [ -z "${KINDS:-}" ] || [ -n "${STEPS:-}" ]; then
  awk -v work="$work" -v steps="${STEPS:-all}" '
    function program() { if (n) { file = work "/tutorial-" n ".vs"; printf "%s", text > file; close(file) } }
    /^## / { if (steps == "last") program(); text = "" }
    /^```scheme$/ { inside = 1; n++; if (text != "") text = text "(erase-all)\n"; next } # a picture shows its own program, with what was defined before
    /^```$/ && inside { inside = 0; if (steps != "last") program(); next }
    inside { text = text $0 "\n" }
    END { if (steps == "last") program() }' manual/tutorial.md
  for program in "$work"/tutorial-*.vs; do picture "$program" "$out/$(basename "$program" .vs).png" manual/tutorial.md; done
fi
for page in manual/*.md; do
  name=$(basename "$page" .md)
  [ "$name" != README ] || continue # the first page, below
  awk -v title="$name" -v root= -v index_to="$out/index.js" -v page="$name.html" -v pictures="$name" -v folder="$out" -f scripts/manual.awk "$page" > "$out/$name.html"
done

# The first page: manual/README.md, and a sheet of all kinds by their class.
{ cat manual/README.md; printf '%s\n' '' '## Kinds of objects' ''; } > "$work/index.md"
sheet=$(for class in CURVE REGION SURFACE SOLID INHERIT NOTHING; do
  case $class in CURVE) say=Curves ;; REGION) say=Regions ;; SURFACE) say=Surfaces ;; SOLID) say=Solids ;; INHERIT) say='Made from others' ;; NOTHING) say=Nothing ;; esac
  list=$(kinds | awk -v class="$class" '$2 == class { print $1 }')
  [ -n "$list" ] || continue
  echo "<h3>$say</h3><div class='sheet'>"
  for kind in $list; do echo "<a href='primitives/$kind.html'><img src='primitives/$kind.png' alt=''>$kind</a>"; done
  echo '</div>'
done)
awk -v title=VisualScheme -v root= -v after="$(echo "$sheet" | tr '\n' ' ')" -f scripts/manual.awk "$work/index.md" > "$out/index.html"

echo '];' >> "$out/index.js"
if [ -s "$failed" ]; then cat "$failed" >&2; exit 1; fi
rm -f "$failed"
echo "$out/index.html"
