#!/bin/sh
# Tests scripts in JavaScript: each tests/javascript/NAME.js must print the text of NAME.out. If node is
# installed, it must print the same; files whose first line is `// no node` use features that node lacks. small.txt
# contains small programs, each after a line `=== NAME`. BLESS=1 rewrites the expected texts, from node if possible.
set -u
. tests/report.sh

asked_node() { # FILE OUT
  { echo 'function print() { console.log(Array.prototype.map.call(arguments, String).join(" ")); }'; cat "$1"; } > "$work/node.js"
  limited 60 node "$work/node.js" > "$2" 2> "$work/node.err" || tail -n 3 "$work/node.err" >> "$work/why"
}
tried() { # NAME FILE OUT
  : > "$work/why"
  node=
  if command -v node > /dev/null && [ "$(head -n 1 "$2")" != "// no node" ]; then node=1; asked_node "$2" "$work/want"; fi
  limited 60 "$vs" "$2" > "$work/got" 2> "$work/err"
  grep -v 'no objects' "$work/err" >> "$work/why"
  [ -z "$BLESS" ] || cp "$work/$([ -n "$node" ] && echo want || echo got)" "$3"
  [ -z "$node" ] || diff -u "$work/want" "$work/got" | sed 's/^/beside node: /' >> "$work/why"
  diff -u "$3" "$work/got" >> "$work/why"
  result "$1" "$work/why"
}

for file in tests/javascript/*.js; do
  name=javascript/$(basename "$file" .js)
  ! wanted "$name" || tried "$name" "$file" "${file%.js}.out"
done

wanted javascript/small || exit 0
awk -v work="$work" '/^=== / { if (file) close(file); file = sprintf("%s/small-%03d.js", work, ++n); print substr($0, 5) > (file ".name"); close(file ".name"); next } { print > file }' tests/javascript/small.txt
awk -v work="$work" '/^=== / { if (file) close(file); file = sprintf("%s/small-%03d.js.out", work, ++n); printf "" > file; next } file { print > file }' tests/javascript/small.out 2> /dev/null
[ -z "$BLESS" ] || : > tests/javascript/small.out
for file in "$work"/small-*.js; do
  [ -f "$file.out" ] || : > "$file.out"
  tried "javascript/small: $(cat "$file.name")" "$file" "$file.out"
  [ -z "$BLESS" ] || { echo "=== $(cat "$file.name")"; cat "$file.out"; } >> tests/javascript/small.out
done
