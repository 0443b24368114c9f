# Counts the breaches of the rules of plain speech (CONTRIBUTING.md). Reads the files whose names are its input,
# one a line:
#   awk -v kind=manual|comments|messages|changes [-v list=NAME] -f scripts/speech.awk < NAMES
# Prints `KIND-COUNT NUMBER` for each count. With `list` it prints instead the sentences of the count of that name. A
# unit is a paragraph, an item, a cell of a table, a comment or a string. Code between backticks is one word.
function plain(s,    at, inner) { # a unit without pictures, code, and the addresses of links
  gsub(/!\[[^]]*\]\([^)]*\)/, "", s)
  gsub(/`[^`]*`/, "CODE", s)
  while (at = match(s, /\[[^][]*\]\([^)]*\)/)) {
    inner = substr(s, at + 1, RLENGTH - 1); sub(/\].*/, "", inner)
    s = substr(s, 1, at - 1) inner substr(s, at + RLENGTH)
  }
  return s
}
function found(name, n, text) { # n more of the count
  if (n < 1) return
  count[name] += n
  if (list == kind "-" name) print place ": " text
}
function sentence(s,    n, words) {
  sub(/^[ ("]+/, "", s); sub(/ +$/, "", s)
  n = split(s, words, " ")
  if (!n) return
  if (!cell) { lengths[n]++; sentences++ }
  if (n > 35) found("over-35-words", 1, s)
  if (s ~ /^(What|That|One|So)[ ,]/) found("openers", 1, s)
  if (s ~ / (of|for|with|to|from|at|into|on|by)\.$/) found("prepositions", 1, s)
}
function unit(s,    at, n, low, rest) {
  s = plain(s); gsub(/[ \t]+/, " ", s)
  if (s !~ /[A-Za-z]/) return
  low = " " tolower(s) " "; gsub(/[^a-z]+/, " ", low); gsub(/ /, "  ", low)
  rest = low; n = gsub(/ what /, "", rest); found("what", n, s)
  n = 0
  for (at = 1; at <= phrases; at++) { rest = low; n += gsub(" " phrase[at] " ", "", rest) }
  found("phrases", n, s)
  if (kind == "changes") { n = split(s, words_, " "); if (n > 25) found("over-25-words", 1, s); return }
  while (match(s, /[.!?][)"]* +[A-Z("0-9<$*[]/)) {
    at = RSTART + RLENGTH - 1
    sentence(substr(s, 1, at - 1)); s = substr(s, at)
  }
  sentence(s)
}
function end_unit() { if (held != "") unit(held); held = "" }
function is_long(line) { gsub(/[\200-\277]/, "", line); return length(line) > 120 } # characters of UTF-8: the bytes that begin one
function markdown(line,    n, cells, i) {
  if (line ~ /^ *```/) { end_unit(); code = !code; return }
  if (code) { if (is_long(line)) found("long-lines", 1, line); return }
  if (line ~ /^#/ || line ~ /^ *$/) { end_unit(); return }
  # A row of a table, and a line that is a picture or a link alone, cannot be broken.
  if (line ~ /^\|/) {
    end_unit()
    if (line ~ /^\|[-| :]+$/) return
    line = plain(line); gsub(/\\\|/, "/", line)
    n = split(line, cells, "|"); cell = 1; for (i = 2; i < n; i++) unit(cells[i]); cell = 0
    return
  }
  if (is_long(line) && line !~ /^ *(- )?!?\[[^]]*\]\([^)]*\)[.,]?$/) found("long-lines", 1, line)
  if (line ~ /^ *(-|[0-9]+\.) /) { end_unit(); sub(/^ *(-|[0-9]+\.) /, "", line) }
  sub(/^ +/, "", line)
  held = held (held == "" ? "" : " ") line
}
# The comments of a line of C; those of // that follow each other are one unit.
function comments(line,    at, text) {
  while (line != "") {
    if (inside) {
      at = index(line, "*/"); text = at ? substr(line, 1, at - 1) : line
      sub(/^[ \t]*\*?[ \t]*/, "", text)
      if (text ~ /^ *$/) { unit(held); held = "" } else held = held " " text
      if (!at) return
      end_unit(); inside = 0; line = substr(line, at + 2)
    } else {
      gsub(/\\./, "", line); gsub(/"[^"]*"/, "S", line)
      if (!match(line, /\/[*\/]/)) { if (line ~ /[^ \t]/) end_unit(); return }
      if (substr(line, RSTART, 2) == "//") {
        if (substr(line, 1, RSTART - 1) ~ /[^ \t]/) end_unit()
        held = held " " substr(line, RSTART + 2); return
      }
      end_unit(); line = substr(line, RSTART + 2); inside = 1; sub(/^[*!]+/, "", line)
    }
  }
}
# The strings of a line of C that are texts: three words or more. Those that follow each other, also on the next line, are one unit.
function messages(line,    at, text) {
  if (line ~ /^[ \t]*(#|\/\/|\/\*|\*)/) return
  while (match(line, /"([^"\\]|\\.)*"/)) {
    if (substr(line, 1, RSTART - 1) ~ /[^ \t]/) end_string()
    text = substr(line, RSTART + 1, RLENGTH - 2); line = substr(line, RSTART + RLENGTH)
    gsub(/\\n/, " ", text); gsub(/\\./, "", text); held = held text
  }
  if (line ~ /[^ \t]/) end_string()
}
function end_string() { if (held ~ /[a-z]+ +[a-z]+ +[a-z]/) unit(held); held = "" }
BEGIN {
  phrases = split("told of|warned of|made of it|stands|left out|worked out|that which|whatever", phrase, "|")
  for (at = 1; at <= phrases; at++) gsub(/ /, "  ", phrase[at])
  names = split(kind == "changes" ? "what phrases over-25-words" : kind == "messages" ? "what openers phrases" : \
                kind == "comments" ? "what openers phrases prepositions over-35-words" : \
                "what openers phrases prepositions over-35-words long-lines", name, " ")
}
{
  file = $0; number = code = inside = 0; held = ""
  while ((getline line < file) > 0) {
    place = file ":" ++number
    if (kind == "manual" || kind == "changes") { total += split(line, words_, " "); markdown(line) }
    else if (kind == "comments") comments(line)
    else messages(line)
  }
  close(file)
  if (kind == "messages") end_string(); else end_unit()
}
END {
  if (list != "") exit
  for (at = 1; at <= names; at++) print kind "-" name[at], count[name[at]] + 0
  if (kind != "manual") exit
  for (n = 1; n < 1000 && 2 * seen < sentences; n++) seen += lengths[n]
  print "manual-median", n - 1
  print "manual-words", total
}
