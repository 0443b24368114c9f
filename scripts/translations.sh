#!/bin/sh
# Prints the figures of manual/translate.md: the number of programs that `vs translate` translates, and the number of
# translations that have, in their own programs, the volume of the original, with 12 facets a turn.
#
#   scripts/translations.sh BUILD          the rows of the table: translated, refused with a place, refused otherwise
#   scripts/translations.sh BUILD volumes  also, for each language: volumes that agree to 1e-6 (POV-Ray: scenes that it
#                                          reads), that differ, that were not made in time
#   SETS=examples LANGUAGES=povray LIMIT=20  these programs and languages alone; seconds for each translation (60)
#
# The programs are those of examples/ and the blocks of the manual that make solids alone.
set -u
cd "$(dirname "$0")/.." || exit 1
case $1 in /*) vs=$1/vs ;; *) vs=$PWD/$1/vs ;; esac
top=$PWD volumes=${2:-} limit=${LIMIT:-60}
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
mkdir "$work/manual"
awk -v work="$work" '/^```scheme$/ { out = sprintf("%s/manual/%04d.vs", work, ++n); next } /^```/ { out = "" } out { print > out }' manual/*.md manual/primitives/*.md
for f in "$work"/manual/*.vs; do
  "$vs" -q "$f" --limit-time 20 --segments 12 -o "$f.stl" > /dev/null 2>&1 || rm -f "$f" "$f.stl"
done
find examples -name '*.vs' -o -path 'examples/javascript/*.js' | grep -v /hosts/ | sort > "$work/examples.list"
ls "$work"/manual/*.vs > "$work/manual.list"
ln -s "$top/node_modules" "$work/node_modules"; echo '{"type": "module"}' > "$work/package.json"
echo 'const model = await import(process.argv[2]); console.log(model.volume(model.unite(model.drawn())));' > "$work/volume.mjs"
export HOME="$work"

measure() { "$vs" -q -e "(display (volume (load-mesh \"$1\" #:repair #t)))" 2> /dev/null; }

# Prints agrees, differs or late for the program $1, translated to $2.
compare() {
  [ -f "$work/ours.stl" ] || return
  case $3 in
  javascript) mv "$2" "$work/made.mjs"; theirs=$(cd "$work" && timeout "$limit" node volume.mjs ./made.mjs 2> /dev/null | tail -n 1) ;;
  openscad) theirs=$(timeout "$limit" openscad -q --export-format binstl -o "$work/theirs.stl" "$2" > /dev/null 2>&1; c=$?; [ $c = 124 ] || [ $c != 0 ] || measure "$work/theirs.stl") ;;
  povray) # read without a word of trouble
    mv "$2" "$work/made.pov"
    timeout "$limit" povray "$work/made.pov" +W8 +H6 -D +O"$work/o.png" > "$work/said" 2>&1; code=$?
    [ $code = 124 ] && echo late && return
    if [ $code = 0 ] && ! grep -qE 'Parse (Error|Warning)' "$work/said"; then echo agrees; else echo differs "$1 to $3" >> "$work/differ"; echo differs; fi
    return ;;
  esac
  case $theirs in [0-9]*) ;; *) theirs= ;; esac
  [ -n "$theirs" ] || { echo late; echo "$1 to $3: nothing" >> "$work/differ"; return; }
  measure "$work/ours.stl" | awk -v b="$theirs" -v name="$1 to $3" -v log_file="$work/differ" '{ off = $1 ? (b - $1) / $1 : 1; if (off * off <= 1e-12) print "agrees"; else { print "differs"; print name, $1, b >> log_file } }'
}

for set in ${SETS:-examples manual}; do
  for language in ${LANGUAGES:-openscad javascript povray}; do
    while read -r f; do
      if "$vs" translate "$f" --to $language --segments 12 -o "$work/made.$language" 2> "$work/said"; then
        echo translated
        [ -z "$volumes" ] && continue
        rm -f "$work/ours.stl"
        if [ $set = manual ]; then cp "$f.stl" "$work/ours.stl"; else timeout "$limit" "$vs" -q "$f" --segments 12 -o "$work/ours.stl" > /dev/null 2>&1; fi
        compare "$f" "$work/made.$language" $language
      elif head -n 1 "$work/said" | grep -qE '\.(vs|js):[0-9]+:[0-9]+: '; then echo refused
      else echo other; echo "$f to $language: $(head -n 1 "$work/said")" >&2
      fi
    done < "$work/$set.list" | sort | uniq -c | awk -v set=$set -v language=$language -v volumes="$volumes" '{ n[$2] = $1 }
      END { printf "| %s | %s | %d | %d | %d |", set, language, n["translated"], n["refused"], n["other"]
            if (volumes) printf " %d | %d | %d |", n["agrees"], n["differs"], n["late"]; print "" }'
  done
done
[ -f "$work/differ" ] && cat "$work/differ" >&2
exit 0
