#!/bin/sh
# Owns the tests of scripts in JavaScript: each tests/javascript/NAME.js prints what NAME.out holds. Where node is installed, it is
# asked too and must say the same; files whose first line is `// no node` hold what node lacks. BLESS=1 rewrites NAME.out, from node
# where it can.
set -u
. tests/report.sh
for file in tests/javascript/*.js; do
  name=javascript/$(basename "$file" .js)
  wanted "$name" || continue
  out=${file%.js}.out
  : > "$work/why"
  node=
  if command -v node > /dev/null && [ "$(head -n 1 "$file")" != "// no node" ]; then
    node=1
    { echo 'function print() { console.log(Array.prototype.map.call(arguments, String).join(" ")); }'; cat "$file"; } > "$work/node.js"
    timeout 60 node "$work/node.js" > "$work/want" 2> "$work/node.err" || tail -n 3 "$work/node.err" >> "$work/why"
  fi
  timeout 60 "$vs" "$file" > "$work/got" 2> "$work/err"
  grep -v 'no objects' "$work/err" >> "$work/why"
  if [ -n "$BLESS" ]; then cp "$work/$([ -n "$node" ] && echo want || echo got)" "$out"; fi
  [ -z "$node" ] || diff -u "$work/want" "$work/got" | sed 's/^/beside node: /' >> "$work/why"
  diff -u "$out" "$work/got" >> "$work/why"
  result "$name" "$work/why"
done
