# Converts the form of the manual's examples: turns a page into calls of (doctest place text kind expected), tests/manual/doctest.vs.
# In a ```scheme block the lines up to one that ends in `; => value`, `; prints: text` or `; error: text` are one example; a block in
# which no line does is one that has to run. `page` is the page's name in the results. With `tables` each `(...)` in a row's last column has to run.
function quoted(s) { gsub(/\\/, "&&", s); gsub(/"/, "\\\\&", s); gsub(/\n/, "\\n", s); return "\"" s "\"" }
function test(kind, expected) {
  printf "(doctest %s %s '%s %s)\n", quoted(page ":" FNR), quoted(text), kind, quoted(expected)
  text = ""; claims++
}
/^```scheme$/ { inside = 1; text = ""; claims = 0; next }
/^```$/ { if (inside && text ~ /[^ \n]/) test("runs", ""); inside = 0; next }
!inside && tables && /^\| .*`/ {
  n = split($0, cells, / *\| */); cell = cells[n - 1]
  while (match(cell, /`[^`]*`/)) {
    text = substr(cell, RSTART + 1, RLENGTH - 2); cell = substr(cell, RSTART + RLENGTH)
    if (text ~ /^[('[]/ && text !~ /…|\((load|require|load-mesh) /) test("runs", "")
  }
  text = ""
}
!inside { next }
match($0, / *; => ?/)       { text = text substr($0, 1, RSTART - 1); test("value",  substr($0, RSTART + RLENGTH)); next }
match($0, / *; prints: ?/)  { text = text substr($0, 1, RSTART - 1); test("prints", substr($0, RSTART + RLENGTH)); next }
match($0, / *; error: ?/)   { text = text substr($0, 1, RSTART - 1); test("error",  substr($0, RSTART + RLENGTH)); next }
{ text = text $0 "\n" }
