#!/bin/sh
# Checks the layers and other rules of the sources. `sh scripts/layers.sh BUILD` prints all faults and
# ends with 1, or prints one line if there is none. It reads the sources, and the objects below BUILD that are newer
# than their sources: it builds nothing, and prints the number of objects that it had.
#
#   arrows     an include follows scripts/layers.list
#   globals    no object of the library has mutable data (cli/ has some: a signal handler gets no context)
#   rooms      a folder of a layer holds at most 21 names (a .c and its .h are one), and each has a README.md
#   Makefile   the objects that it names have sources
#   names      no two source files of different folders share a base name, and no two headers have a type of one name
#   files      a file that a comment names exists, and each source begins with a comment that says what it contains
#   dependants at most 40 objects depend on a header of bind/
#   ours       no file has a copyright line of others
#   speech     scripts/speech.sh: the texts of manual, comments, messages and CHANGELOG
#   ratchets   the counts of scripts/layers.limits, which may only fall; and asserts, whose number has a lower limit
set -u
build=$1
cd "$(dirname "$0")/.." || exit 1
export LC_ALL=C
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
layers=$(sed -n 's/^\([a-z]*\):.*/\1/p' scripts/layers.list)
find $layers -name '*.[ch]' | sort > "$work/sources"
# live/playground is built for WebAssembly alone.
grep '\.c$' "$work/sources" | grep -v '^live/playground/' > "$work/built-here"
while read -r source; do
  object=$build/obj/${source%.c}.o
  [ "$object" -nt "$source" ] && echo "$object"
done < "$work/built-here" > "$work/objects"
all=$(wc -l < "$work/built-here")
built=$(wc -l < "$work/objects")

# ---- arrows ----
awk '
  # The row of a file: the longest folder of its path that has a row; "" without.
  function row(path) { while (sub(/\/[^\/]*$/, "", path)) if (path in allowed) return path; return "" }
  FILENAME == "scripts/layers.list" { if ($0 !~ /^#/ && split($0, part, ":") == 2) allowed[part[1]] = part[2]; next }
  /^[ \t]*#[ \t]*include[ \t]*"/ {
    header = $0; sub(/^[^"]*"/, "", header); sub(/".*/, "", header)
    folder = row(FILENAME); of = row(header)
    ok = folder == of
    n = split(allowed[folder], prefix, " ")
    for (i = 1; i <= n; i++) if (index(header, prefix[i]) == 1 && (of == "" || length(prefix[i]) > length(of))) ok = 1
    if (!ok) print FILENAME ":" FNR ": a file of " folder "/ may not include \"" header "\""
  }' scripts/layers.list $(cat "$work/sources") > "$work/wrong"

# ---- globals: sizes are hexadecimal; .data.rel.ro holds constants with addresses and is read-only once loaded ----
grep -v "^$build/obj/cli/" "$work/objects" | xargs -r objdump -t | awk '
  /:[ \t]+file format/ { object = $0; sub(/:[ \t]+file format.*/, "", object) }
  NF >= 5 {
    for (i = 3; i < NF; i++)
      if ($i ~ /^\.(data|bss|tdata|tbss)(\.|$)/ && $i !~ /^\.data\.rel\.ro/ || $i == "*COM*")
        if ($(i + 1) !~ /^0+$/) print object ": mutable global " $NF " in " $i
  }' >> "$work/wrong"

# ---- rooms and names ----
for room in $(find $layers -type d | sort); do
  count=$(find "$room" -maxdepth 1 -type f ! -name README.md | sed 's/\.[^.]*$//' | sort -u | wc -l)
  [ "$count" -gt 0 ] || continue
  [ "$count" -le 21 ] || echo "$room/: $count names; a room holds at most 21" >> "$work/wrong"
  case $room in backends/*) ;; *) [ -f "$room/README.md" ] || echo "$room/: no README.md says what the room owns" >> "$work/wrong" ;; esac
done
find $layers -name '*.[ch]' -o -name '*.def' -o -name '*.scm' | awk '{
    base = $0; sub(/.*\//, "", base); sub(/\.[a-z]+$/, "", base); folder = $0; sub(/[^\/]*$/, "", folder)
    if (!(base in seen)) seen[base] = folder
    else if (seen[base] != folder) print $0 ": " seen[base] " has a file of this base name already"
  }' > "$work/names"

grep '\.h$' "$work/sources" | xargs grep -HoE '^\} vs_[a-z_0-9]+;|^typedef [^(]*[ *]vs_[a-z_0-9]+;' | sed -E 's/^([^:]*):.*[ *](vs_[a-z_0-9]+);$/\2 \1/' | sort -u | awk '
  $1 == type && $2 != header && !/_s$/ { print $2 ": the type " type " stands in " header " already" }
  { type = $1; header = $2 }' > "$work/types"
while read -r line; do
  # a name that is declared before it is defined is one type
  type=$(echo "$line" | sed 's/.*the type \(vs_[a-z_0-9]*\) .*/\1/')
  [ "$(xargs grep -lE "^\} $type;|^struct $type \{|^typedef (struct|enum)[a-z_ ]*\{.*\} $type;" < "$work/sources" | grep -c '\.h$')" -le 1 ] || echo "$line" >> "$work/wrong"
done < "$work/types"

# ---- the Makefile: a rule for an object whose source has moved is ignored without a message ----
made='^(assets|library_image|library_words|manual_text|licenses_text|shipped|shipped_texts)$' # objects whose sources are made
grep -oE '\$\(BUILD\)/obj/[a-z_/]+\.o' Makefile | sort -u | sed 's/^\$(BUILD)\/obj\///; s/\.o$//' | grep -vE "$made" | while read -r object; do
  [ -f "$object.c" ] || echo "Makefile: $object.o has no source $object.c"
done >> "$work/wrong"

# ---- openings: the comment that says what the file contains, the folders that it names, and the guard, which is the header's path ----
grep '\.h$' "$work/sources" | while read -r header; do
  guard=VS_$(echo "${header%.h}" | tr a-z/ A-Z_)_H
  grep -qx "#ifndef $guard" "$header" && grep -qx "#define $guard" "$header" || echo "$header: its guard is not $guard"
done >> "$work/wrong"
xargs grep -m 1 -HoE '^/\* .*' < "$work/sources" | sed 's/:/ /' | while read -r source opening; do
  for folder in $(echo "$opening" | grep -oE '(^|[ (])([a-z_0-9]+/)+([ .,;:)]|$)' | grep -oE '([a-z_0-9]+/)+'); do
    [ -d "$folder" ] || [ -d "${source%%/*}/$folder" ] || [ -d "${source%/*}/$folder" ] || echo "$source: its first line names $folder, and there is no such folder"
  done
done >> "$work/wrong"
xargs awk 'FNR == 1 && !/^\/\*/ { print FILENAME ": begins without a comment that says what the file contains" }' < "$work/sources" >> "$work/wrong"

# ---- ours: LICENSE holds for every file, so none has another's copyright line; NOTICE names what comes from elsewhere ----
find . \( -name node_modules -o -name .git -o -path "./${build#./}" -o -path ./build -o -path ./out -o -path ./scripts -o -path ./manual -o -path ./debian \) -prune -o -type f -print |
  sed 's/^\.\///' | grep -vxE 'LICENSE|NOTICE' | xargs -d '\n' grep -IlE '[Cc]opyright +(\([Cc]\)|©|[0-9]{4}|by )|\([Cc]\) *[12][0-9]{3} |[Aa]ll [Rr]ights [Rr]eserved|SPDX-' |
  sed 's/$/: has a copyright line; code of others lives in packages, and NOTICE names what is embedded/' >> "$work/wrong"

# ---- ratchets ----
limit() { # NAME COUNT WHERE: what the count is of, and where to look
  most=$(awk -v name="$1" '$1 == name { print $2 }' scripts/layers.limits)
  if [ "$2" -gt "${most:-0}" ]; then echo "$1: $2, and scripts/layers.limits allows ${most:-0} ($3)" >> "$work/wrong"; fi
  [ "$2" -ge "${most:-0}" ] || echo "$1 $2" >> "$work/better"
}
limit same-names "$(wc -l < "$work/names")" "$(tr '\n' ';' < "$work/names")"
limit long-lines "$(xargs awk 'length($0) > 120' < "$work/sources" | wc -l)" "lines past 120 columns"
limit raw-allocations "$(xargs grep -hoE '\b(malloc|calloc|realloc)\(' < "$work/sources" | wc -l)" "malloc, calloc and realloc by hand: VS_GROW, VS_FRESH, vs_fresh and vs_zeros of model/store/array.h check the size"
# Asserts of each 1000 lines of a layer, rounded down.
for layer in kernel model geometry vm; do
  least=$(awk -v name="asserts-$layer" '$1 == name { print $2 }' scripts/layers.limits)
  count=$(grep "^$layer/" "$work/sources" | xargs cat | awk '{ count += gsub(/(^|[^A-Z_])VS_ASSERT\(/, "") } END { print int(1000 * count / NR) }')
  [ "$count" -ge "${least:-0}" ] || echo "asserts-$layer: $count of 1000 lines, and scripts/layers.limits wants $least (VS_ASSERT of model/assert.h)" >> "$work/wrong"
done
limit static-prefixed "$(grep '\.c$' "$work/sources" | xargs grep -hE '^static [^=;(]*\bvs_[a-z0-9_]*\(' | wc -l)" "static functions named vs_, a prefix of externals"

# Sentences of comments that begin with What, That, One, Those or So: a sentence's subject is a noun of the field.
limit vague-openers "$(xargs grep -hE '(/\*+|^ *\*|//|\.) +(What|That|One|Those|So) ' < "$work/sources" | wc -l)" "comments with a sentence that begins with What, That, One, Those or So"

# Files that a comment or a table names, by name or by the end of a path, and that do not exist.
{ find . -name node_modules -prune -o -name '.git' -prune -o -path "./${build#./}" -prune -o -name '*.[ch]' -print; echo ==; cat "$work/sources"; } | awk '
  /^==$/ { reading = 1; next }
  !reading { sub(/^\.\//, ""); for (path = $0; ; ) { have[path] = 1; if (!sub(/^[^\/]*\//, "", path)) break }; next }
  { while ((getline line < $0) > 0) {
      if (line ~ /^[ \t]*#/) continue
      while (match(line, /[A-Za-z_>.\/][a-z_\/0-9]*[a-z_0-9][a-z_0-9][a-z_0-9]\.[ch]([^A-Za-z_0-9.(\[]|\.[^a-z]|\.?$)/)) {
        name = substr(line, RSTART, RLENGTH); line = substr(line, RSTART + RLENGTH)
        if (name ~ /^[>.A-Z]/) continue
        sub(/\.[^a-z]?$/, "", name); sub(/[^a-z]+$/, "", name)
        if (!(name in have)) print $0 ": " name
      }
    }
    close($0) }' | sort -u > "$work/unknown-files"
[ ! -s "$work/unknown-files" ] || sed 's/: \(.*\)/ names \1, and there is no such file/' "$work/unknown-files" >> "$work/wrong"

# Externals of a .c file that the header of its name does not declare, nor the public header. Tables declare the others: procedures.def the natives
# vs_p_, forms.def the forms vs_form_, passes.def the passes vs_pass_.
xargs -r nm -A --defined-only -g < "$work/objects" | awk -v build="$build/obj/" '
  $2 == "T" || $3 == "T" {
    file = $1; sub(/:.*/, "", file); symbol = $NF
    sub("^" build, "", file); sub(/\.o$/, ".h", file)
    if (!public) while ((getline line < "visualscheme.h") > 0) public = public line "\n"
    if (!(file in text)) { text[file] = " "; while ((getline line < file) > 0) text[file] = text[file] line "\n"; close(file) }
    if (symbol != "main" && symbol !~ /^vs_(p|form|pass)_/ && !match(text[file], "[^a-z0-9_]" symbol "\\(") && !match(public, "[^a-z0-9_]" symbol "\\(")) print file ": does not declare " symbol
  }' > "$work/elsewhere"
[ "$built" -lt "$all" ] || limit declared-elsewhere "$(wc -l < "$work/elsewhere")" "external functions that the header of their file's name does not declare"

# Circles of objects: each uses a symbol of the next. The expander is one machine in several files and has a limit of its own.
[ "$built" -lt "$all" ] || xargs -r nm -A -g < "$work/objects" | awk -v build="$build/obj/" '
  { object = $1; sub(/:.*/, "", object); sub("^" build, "", object); sub(/\.o$/, "", object) }
  $(NF - 1) == "U" || $(NF - 1) ~ /:U$/ { uses[++count] = object " " $NF; next }
  { owner[$NF] = object }
  END {
    for (i = 1; i <= count; i++) {
      split(uses[i], use, " ")
      if (!(use[2] in owner) || owner[use[2]] == use[1]) continue
      from = use[1]; to = owner[use[2]]
      if (!((from, to) in have)) { have[from, to] = 1; next_of[from] = next_of[from] " " to; node[from] = node[to] = 1 }
    }
    for (start in node) {
      split("", seen); top = 1; stack[1] = start
      while (top) { n = split(next_of[stack[top--]], out, " "); for (i = 1; i <= n; i++) if (!(out[i] in seen)) { seen[out[i]] = 1; stack[++top] = out[i] } }
      for (other in seen) reach[start, other] = 1
    }
    for (a in node) {
      size = 0; text = ""; expander = 0
      for (b in node) if (((a, b) in reach) && ((b, a) in reach)) { size++; text = text " " b; if (b == "vm/front/expand") expander = 1 }
      if (expander) { if (size > machine) { machine = size; whole = text } }
      else if (size > most) { most = size; widest = text }
    }
    print most + 0, widest; print machine + 0, whole
  }' > "$work/circles"
[ ! -s "$work/circles" ] || {
  limit symbol-circle "$(sed -n '1s/ .*//p' "$work/circles")" "objects in the widest circle:$(sed -n '1s/^[0-9]*//p' "$work/circles")"
  limit expander-circle "$(sed -n '2s/ .*//p' "$work/circles")" "objects in the circle of the expander:$(sed -n '2s/^[0-9]*//p' "$work/circles")"
}

# ---- dependants: a change of a header of bind/ rebuilds at most 40 objects; headers that offer less keep it so ----
sed 's/\.o$/.d/' "$work/objects" | xargs -r cat | tr ' ' '\n' | grep -E '^bind/.*\.h$' | sort | uniq -c | while read -r count header; do
  [ "$count" -le 40 ] || echo "$header: $count objects depend on it, and at most 40 may: split it, or include a smaller header"
done >> "$work/wrong"

# Words that the glossary has replaced (scripts/words.list: WORD MOST INSTEAD).
while read -r word most instead; do
  case $word in ''|'#'*) continue ;; esac
  count=$(xargs grep -hoiE "\b$word\b" < "$work/sources" | wc -l)
  count=$((count + $(cat manual/*.md manual/*/*.md | grep -oiE "\b$word\b" | wc -l)))
  [ "$count" -le "$most" ] || echo "the word '$word' stands in $count places, and scripts/words.list allows $most: say $instead" >> "$work/wrong"
  [ "$count" -ge "$most" ] || echo "word $word $count" >> "$work/better"
done < scripts/words.list

# ---- speech ----
if sh scripts/speech.sh > "$work/speech"; then cat "$work/speech" >> "$work/better"; else cat "$work/speech" >> "$work/wrong"; fi

if [ -s "$work/wrong" ]; then cat "$work/wrong"; exit 1; fi
[ ! -s "$work/better" ] || { echo "lower these limits:"; sort "$work/better"; } | tr '\n' ' ' | sed 's/ $/\n/'
objects="no mutable globals"
[ "$built" -eq "$all" ] || objects="objects of $built of $all files, the others are not built or older than their sources: 'make all' first to have all looked at"
echo "layers: includes follow the arrows; rooms, names and words as they should be; $objects"
