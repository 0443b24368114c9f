#!/bin/sh
# Tests the manual: every ```scheme block of the tutorial runs without an error or warning; blocks may use
# definitions of earlier blocks in the same step. The prompt prints the answers of each prompt block, on a terminal with
# the results' names.
. tests/report.sh
wanted manual || exit 0
awk -v work="$work" '
  /^## /         { step++; block = 0; text = ""; next }
  /^```scheme$/  { inside = 1; block++; next }
  /^```$/ && inside { inside = 0; name = sprintf("%s/step-%02d-%d.vs", work, step, block); printf "%s", text > name; close(name); next }
  inside         { text = text $0 "\n" }
  /^> [^,]/      {
    question = substr($0, 3); getline
    print question > (work "/questions"); print question "\\n" > (work "/keys-" step); print $0 > (work "/shown-" step)
    sub(/^\$[0-9]+ = /, ""); print $0 > (work "/answers")
  }' manual/tutorial.md
for program in "$work"/step-*.vs; do
  name=manual/tutorial:$(basename "$program" .vs)
  if "$BUILD/vs" --quiet "$program" -o "$work/out.stl" > "$work/said" 2>&1 && [ ! -s "$work/said" ]; then echo "ok $name"
  else echo "not ok $name"; sed 's/^/    /' "$work/said"; fi
done
"$BUILD/vs" < "$work/questions" > "$work/said" 2>&1
if diff "$work/answers" "$work/said" > "$work/diff"; then echo "ok manual/tutorial:prompt"; else echo "not ok manual/tutorial:prompt"; sed 's/^/    /' "$work/diff"; fi

# On a terminal each step has a separate prompt.
for keys in "$work"/keys-*; do
  step=${keys##*-}
  HOME=$work XDG_STATE_HOME=$work/state TERM=xterm LSAN_OPTIONS=detect_leaks=0 "$BUILD/tools/typist" "$BUILD/vs" < "$keys" > "$work/screen"
  if [ $? = 77 ]; then echo "skip manual/tutorial:terminal-$step: no pseudo-terminal here"; continue; fi
  while read -r line; do grep -qF -- "$line" "$work/screen" || echo "the screen does not show $line"; done < "$work/shown-$step" > "$work/why"
  result "manual/tutorial:terminal-$step" "$work/why"
done

# Each step of the tutorial ends in links and has a picture that is not empty; this test makes only the picture of its
# last program, the pages have all.
awk '/^## / { if (step && !linked) print step; step = $2; linked = 0 } /^Read on: .*\]\(/ { linked = 1 } END { if (!linked) print step }' manual/tutorial.md > "$work/said"
if [ ! -s "$work/said" ]; then echo "ok manual/tutorial:links"; else echo "not ok manual/tutorial:links: steps without"; sed 's/^/    /' "$work/said"; fi
if command -v povray > /dev/null; then
  PAGES="$work/steps" KINDS=none STEPS=last QUALITY=draft SIZE=80x60 sh scripts/manual.sh "$BUILD" > "$work/said" 2>&1 || { echo "not ok manual/tutorial:pictures"; sed 's/^/    /' "$work/said"; }
  steps=$(grep -c '^## ' manual/tutorial.md)
  for picture in "$work"/steps/tutorial-*.png; do
    "$BUILD/tools/pngstat" "$picture" | awk -v name="$(basename "$picture" .png)" '{ if ($3 > 5 && $4 > 8) print "ok manual/" name; else print "not ok manual/" name ": the picture shows nothing: " $0 }'
  done
  [ "$(ls "$work"/steps/tutorial-*.png | wc -l)" = "$steps" ] || echo "not ok manual/tutorial:pictures: not one for each of $steps steps"
else echo "skip manual/tutorial:pictures: no povray"
fi

# The reference. A heading of level 3 opens an entry: it describes each name between backticks, `name` or `(name
# argument ...)`. The manual describes every name that a program can use, once, and no other.
sed -n '/^### /p' manual/language/*.md | grep -o '`[^`]*`' | sed 's/^`(\{0,1\}//; s/[ )`].*//' | sort > "$work/described"
"$BUILD/tools/names" | sort > "$work/names"
uniq -d "$work/described" > "$work/twice"
# A constructor whose form is only on the page of its kind is described, too.
sed -n 's/^- `(\([^ )`]*\).*/\1/p' manual/primitives/*.md | cat - "$work/described" | sort -u | comm -13 - "$work/names" > "$work/missing"
sort -u "$work/described" | comm -23 - "$work/names" > "$work/unknown"
for list in twice missing unknown; do
  if [ -s "$work/names" ] && [ ! -s "$work/$list" ]; then echo "ok manual/language:names:$list"
  else echo "not ok manual/language:names:$list"; tr '\n' ' ' < "$work/$list" | fold -s -w 120 | sed 's/^/    /'; echo; fi
done

# Every procedure that is called wrongly reports the error under the name of the call, and none runs forever on a
# circular list.
limited 300 "$BUILD/vs" --quiet --limit-time 280 tests/manual/wrong.vs < "$work/names" > "$work/said" 2> "$work/errors"
grep -c '^ok ' "$work/said" > "$work/count"
grep -A 1 '^not ok' "$work/said"
if [ "$(cat "$work/count")" -gt 600 ] && tail -n 1 "$work/said" | grep -q 'zoom-extents'; then echo "ok manual/wrong"
else echo "not ok manual/wrong: stopped after $(tail -n 1 "$work/said")"; sed 's/^/    /' "$work/errors" | tail -n 5; fi

# Each kind of model/prims.def has a page with its name.
sed -n 's/^VS_KIND([A-Z_0-9]*, [a-z_0-9]*, "\([^"]*\)".*/\1/p' model/prims.def | sort > "$work/kinds"
ls manual/primitives | sed 's/\.md$//' | sort > "$work/pages"
if [ -s "$work/kinds" ] && diff "$work/kinds" "$work/pages" > "$work/diff"; then echo "ok manual/primitives:pages"
else echo "not ok manual/primitives:pages differ from prims.def"; sed 's/^/    /' "$work/diff"; fi

# Each operator of rules has a page with the name of its procedure; queries have none.
sed -n '/^## Operators/,$p' manual/language/rules.md | grep '^### ' | grep -o '`[^`]*`' | sed 's/^`(\{0,1\}//; s/[ )`].*//' |
  grep -vxE 'absolute|relative|flag\?|scope-flags|touches\?|inside\?|scope-overlap|find-scopes|scope-name|scope-property|scope-signals|scope-detail|derivation' | sort > "$work/operators"
ls manual/rules | sed 's/\.md$//' | sort > "$work/pages"
if [ -s "$work/operators" ] && diff "$work/operators" "$work/pages" > "$work/diff"; then echo "ok manual/rules:pages"
else echo "not ok manual/rules:pages differ from the operators of language/rules.md"; sed 's/^/    /' "$work/diff"; fi

# The tables of phases, steps and stages have a row for each row of their .def file, in its order.
table() { # DEF ROW HEAD: the names of a .def file against the first column below the head
  sed -n "s/^$2([A-Z_]*, *\([a-z_]*\),.*/\1/p" "$1" > "$work/wanted"
  awk -v head="$3" 'index($0, head) == 1 { on = 1; getline; next } on && !/^\|/ { on = 0 } on { sub(/^\| */, ""); sub(/ *\|.*/, ""); print }' manual/command.md > "$work/shown"
  if [ -s "$work/wanted" ] && diff "$work/wanted" "$work/shown" > "$work/diff"; then echo "ok manual/command:$1"
  else echo "not ok manual/command:$1"; sed 's/^/    /' "$work/diff"; fi
}
# The page describes each command of the prompt.
missing=$(sed -n 's/^COMMAND(\([a-z]*\),.*/\1/p' cli/prompt/prompt_commands.def | while read -r word; do grep -q "\`,$word[ \`]" manual/command.md || echo "$word"; done)
if [ -z "$missing" ]; then echo "ok manual/command:prompt"; else echo "not ok manual/command:prompt: missing" $missing; fi
table model/tally.def VS_PHASE '| phase |'
table model/steps.def VS_STEP '| step |'
table session/stages.def VS_STAGE '| stage |'
# The walk names existing files, and functions that these contain.
awk -F' *[|] *' '/^\| step \|/ { next } /^\| stage \|/ { next } /^\|--/ || !/^\|/ || $3 !~ /`/ { next } { print $3 "|" $4 }' manual/walk.md |
  while IFS='|' read -r files functions; do
    folder= paths=
    for file in $(echo "$files" | tr -d '`,'); do
      case $file in */*) folder=${file%/*}/ ;; *) file=$folder$file ;; esac
      [ -f "$file" ] && paths="$paths $file" || echo "there is no file $file"
    done
    for function in $(echo "$functions" | tr -d '`,'); do
      grep -qE "^[a-z].*\b$function\(" $paths /dev/null || echo "no function $function begins a line of$paths"
    done
  done > "$work/why"
result manual/walk "$work/why"
# The page on materials names each ready material, and each pattern with its size.
sed -n 's/^VS_READY_MATERIAL("\([a-z-]*\)".*/\1/p' model/looks/materials.def | sort > "$work/wanted"
sed -n '/^!\[Samples/,/^Fourteen/p' manual/materials.md | grep '^[- ]' | grep -o '`[a-z-]*`' | tr -d '\140' | sort > "$work/shown"
sed -n 's/^VS_PATTERN([A-Z]*, *"\([a-z]*\)", *\([0-9.]*\), *"\(.*\)")$/| `\1` | \3 | \2 m |/p' model/looks/patterns.def >> "$work/wanted"
grep '^| `' manual/materials.md >> "$work/shown"
if [ -s "$work/wanted" ] && diff "$work/wanted" "$work/shown" > "$work/diff"; then echo "ok manual/materials:tables"
else echo "not ok manual/materials:tables"; sed 's/^/    /' "$work/diff"; fi

# The examples are true. If the first line of a block is a comment with the name of a file in another language, the
# block is that file.
awk -v work="$work" '
  /^```/ { file = ""; first = 1; next }
  first  { first = 0; if (match($0, /^(%|\/\/) [a-z]+\.(gml|js)$/)) { file = $2 } }
  file   { print > (work "/" file) }' manual/gml.md
for page in manual/analysis.md manual/assembly.md manual/building.md manual/gml.md manual/i-want-to.md manual/materials.md manual/drawings.md manual/coming-from-[agoj]*.md manual/language/*.md manual/primitives/*.md manual/rules/*.md; do
  name=${page#manual/}
  case $name in coming-from-*) tables=1 ;; *) tables= ;; esac
  cat tests/manual/doctest.vs > "$work/page.vs"
  awk -v page="$name" -v tables="$tables" -f tests/manual/doctest.awk "$page" > "$work/calls"
  cat "$work/calls" >> "$work/page.vs"
  limited 60 "$BUILD/vs" --quiet "$work/page.vs" > "$work/said" 2> "$work/errors" < /dev/null
  cat "$work/said"
  [ "$(grep -c '^ok \|^not ok ' "$work/said")" = "$(wc -l < "$work/calls")" ] ||
    { echo "not ok manual/$name: stopped early"; sed 's/^/    /' "$work/errors"; }
  [ -s "$work/calls" ] || echo "not ok manual/$name: has no example"
  if grep 'warning: check-' "$work/errors" > "$work/why"; then echo "not ok manual/$name: checks fail"; sed 's/^/    /' "$work/why"; fi
done

# The programs in GML print the output that the block gives. Each continues the one before.
awk -v work="$work" '
  /^```gml$/ { inside = 1; next }
  /^```$/    { inside = 0 }
  inside     { print > (work "/blocks.gml"); n = split($0, part, "% => "); for (i = 2; i <= n; i++) { sub(/ *$/, "", part[i]); print part[i] > (work "/gml-wanted") } }' manual/gml.md
"$BUILD/vs" --quiet "$work/blocks.gml" -o "$work/out.stl" > "$work/said" 2> "$work/errors"
if diff "$work/gml-wanted" "$work/said" > "$work/diff" && [ ! -s "$work/errors" ]; then echo "ok manual/gml"
else echo "not ok manual/gml"; sed 's/^/    /' "$work/diff" "$work/errors"; fi
# The programs in AutoLISP on its page print what their lines give.
awk -v work="$work" '
  /^```lsp$/ { inside = 1; next }
  /^```$/    { inside = 0 }
  inside     { n = split($0, part, "; => "); print (n > 1 ? part[1] "(terpri)" : $0) > (work "/blocks.lsp"); if (n > 1) print part[2] > (work "/lsp-wanted") }' manual/autolisp.md
"$BUILD/vs" --quiet "$work/blocks.lsp" > "$work/said" 2> "$work/errors"
if diff "$work/lsp-wanted" "$work/said" > "$work/diff" && [ ! -s "$work/errors" ]; then echo "ok manual/autolisp"
else echo "not ok manual/autolisp"; sed 's/^/    /' "$work/diff" "$work/errors"; fi
# The programs in OpenSCAD on its page print what their lines give.
awk -v work="$work" '
  /^```scad$/ { inside = 1; next }
  /^```$/    { inside = 0 }
  inside     { n = split($0, part, "// => "); print part[1] > (work "/blocks.scad"); if (n > 1) print part[2] > (work "/scad-wanted") }' manual/openscad.md
"$BUILD/vs" --quiet "$work/blocks.scad" > "$work/said" 2> "$work/errors"
if diff "$work/scad-wanted" "$work/said" > "$work/diff" && [ $(grep -c "warning: " "$work/errors") = 1 ]; then echo "ok manual/openscad"
else echo "not ok manual/openscad"; sed 's/^/    /' "$work/diff" "$work/errors"; fi
# The page describes every operator.
"$BUILD/vs" --quiet -e '(import (only (gml) gml:operators)) (for-each displayln (map symbol->string (gml:operators)))' | sort > "$work/names"
grep -v '^```' manual/gml.md | grep -o '`[^`]*`' | tr -d '\140' | tr ' .' '\n\n' | sort -u > "$work/described"
missing=$(comm -23 "$work/names" "$work/described" | tr '\n' ' ')
if [ -s "$work/names" ] && [ -z "$missing" ]; then echo "ok manual/gml:operators"; else echo "not ok manual/gml:operators: missing $missing"; fi

# The last block of a primitive's page is a program; every back-end accepts it without a message, except the warning
# about bare curves.
for page in manual/primitives/*.md; do
  name=${page#manual/}
  awk '/^```scheme$/ { inside = 1; text = ""; next } /^```$/ { inside = 0 } inside { text = text $0 "\n" } END { printf "%s", text }' "$page" > "$work/example.vs"
  if limited 60 "$BUILD/vs" --quiet "$work/example.vs" -o "$work/out.pov" -o "$work/out.scad" -o "$work/out.x3d" > "$work/all" 2>&1 &&
     awk '/curves are drawn as thin rods$/ { skip = 3 } skip-- > 0 { next } { print }' "$work/all" > "$work/said" && [ ! -s "$work/said" ]; then echo "ok manual/$name:program"
  else echo "not ok manual/$name:program"; sed 's/^/    /' "$work/all"; fi
done

# The HTML manual: every kind has its page, and the pages have all parts. Without pictures, which take a minute.
if PAGES="$work/html" PICTURES=no KINDS="sphere text" sh scripts/manual.sh "$BUILD" > "$work/said" 2>&1 &&
   grep -q '<code>(make-sphere c r)</code>: c a point' "$work/html/primitives/sphere.html" && grep -q 'In the tree: <code>sphere</code>, solid; <code>c</code> point, <code>r</code> real' "$work/html/primitives/sphere.html" &&
   grep -q "href='primitives/text.html'" "$work/html/index.html" && [ -s "$work/html/language/index.html" ] && ! grep -q '`\|\*\*' "$work/html/tutorial.html"
then echo "ok manual:pages"; else echo "not ok manual:pages"; sed 's/^/    /' "$work/said"; fi

# The search: its index is JavaScript, its first results for some words are the right ones, and every address is an
# existing heading.
if command -v node > /dev/null; then
  if node tests/manual/search.mjs "$work/html" > "$work/said" 2>&1; then cat "$work/said"; else echo "not ok manual:search"; sed 's/^/    /' "$work/said"; fi
else echo "skip manual:search: no node"
fi

# The pictures: each is whole, and ends with the marker of its format.
for picture in manual/*.jpg; do
  if [ "$(tail -c 2 "$picture" | od -An -tx1 | tr -d ' ')" = ffd9 ]; then echo "ok $picture"; else echo "not ok $picture"; echo "    the file ends before the picture does"; fi
done
