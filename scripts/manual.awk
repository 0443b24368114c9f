# Converts the manual from Markdown to HTML: headings, paragraphs, lists, tables, blocks of code, `code`, **strong**, links, pictures.
# -v title=...   of the page, if the text has none       -v root=...  the way up to the manual's first page: "" or "../"
# -v after=...   HTML that goes behind the last block of code (a picture)
# -v pictures=P  a picture P-N.png goes behind the N-th block of scheme, where that file is (-v folder=... says where it is looked for)
# -v index_to=FILE  where the page's sections are written down for the search, as rows of a JavaScript array; -v page=URL  the page's own
function unlinked(s,    at, to, inner) { # links by their text alone, pictures not at all
  gsub(/!\[[^]]*\]\([^)]*\)/, "", s)
  while (at = match(s, /\[[^][]*\]\([^)]*\)/)) {
    to = at + RLENGTH; inner = substr(s, at + 1); sub(/\].*/, "", inner)
    s = substr(s, 1, at - 1) inner substr(s, to)
  }
  return s
}
function text_of(s) { gsub(/[\\"]/, "\\\\&", s); gsub(/[\t\r]/, " ", s); return s } # within a string of JavaScript
function told() { # the section that ends here
  if (index_to == "" || section == "") return
  printf "[\"%s\",\"%s\",\"%s#%s\",\"%s\"],\n", text_of(section), text_of(first), page, anchor, text_of(body) >> index_to
}
function open_section(text,   id) { # gives the heading's id
  told()
  gsub(/`|\*\*/, "", text); id = tolower(text); gsub(/[^a-z0-9]+/, "-", id); sub(/^-/, "", id); id = substr(id, 1, 60); sub(/-$/, "", id)
  if (id == "") id = "section"
  if (taken[id]++) id = id "-" taken[id]
  if (first == "") first = text
  section = text; anchor = id; body = ""
  return id
}
function escape(s) { gsub(/&/, "\\&amp;", s); gsub(/</, "\\&lt;", s); gsub(/>/, "\\&gt;", s); return s }
# Code first: marks within it have no meaning. Links to pages of the manual become links to their HTML.
function inline(s,   out, from, length_) { # marked() matches too: what was matched here is kept
  out = ""
  while (match(s, /`[^`]*`/)) {
    from = RSTART; length_ = RLENGTH
    out = out marked(substr(s, 1, from - 1)) "<code>" escape(substr(s, from + 1, length_ - 2)) "</code>"
    s = substr(s, from + length_)
  }
  return out marked(s)
}
function marked(s,   out, text, link) {
  s = escape(s)
  while (match(s, /\*\*[^*]+\*\*/)) s = substr(s, 1, RSTART - 1) "<strong>" substr(s, RSTART + 2, RLENGTH - 4) "</strong>" substr(s, RSTART + RLENGTH)
  out = ""
  while (match(s, /!?\[[^]]*\]\([^)]*\)/)) {
    text = substr(s, RSTART, RLENGTH); link = text
    sub(/^!?\[/, "", text); sub(/\].*/, "", text); sub(/^[^(]*\(/, "", link); sub(/\)$/, "", link)
    sub(/README\.md$/, "index.html", link); sub(/\.md$/, ".html", link)
    out = out substr(s, 1, RSTART - 1) (substr(s, RSTART, 1) == "!" ? "<img src=\"" link "\" alt=\"" text "\">" : "<a href=\"" link "\">" text "</a>")
    s = substr(s, RSTART + RLENGTH)
  }
  return out s
}
function close_block() {
  if (paragraph != "") print "<p>" inline(paragraph) "</p>"
  if (item != "") print "<li>" inline(item) "</li>"
  if (list != "") print "</" list ">"
  if (table) print "</table>"
  paragraph = item = list = ""; table = 0
}
function code_end() {
  held = held "</code></pre>"
  if (behind != "") print behind
  behind = held
  if (scheme) {
    blocks++
    if (pictures != "" && (getline line < (folder "/" pictures "-" blocks ".png")) >= 0) {
      close(folder "/" pictures "-" blocks ".png")
      behind = behind "\n<p><img class=\"picture\" src=\"" pictures "-" blocks ".png\" alt=\"what the program draws\"></p>"
    }
  }
}
BEGIN {
  print "<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width\">"
  print "<title>" escape(title) "</title>\n<link rel=\"stylesheet\" href=\"" root "manual.css\">"
  print "<nav><a href=\"" root "index.html\">VisualScheme</a>"
  print "<input id=\"search\" type=\"search\" placeholder=\"Search the manual\" aria-label=\"Search the manual\" autocomplete=\"off\"><ol id=\"found\"></ol></nav>\n<main>"
}
!/^(```|#+ |\|[-| :]+\|$)/ || (code && /^#/) { said = unlinked($0); gsub(/`|\*\*/, "", said); gsub(/ *\| */, " ", said); if (said ~ /[^ ]/) body = body (body == "" ? "" : " ") said }
code { if (/^```$/) { code = 0; code_end() } else held = held escape($0) "\n"; next }
# the last block of code, which was held back, is written before any later text
/^```/ { close_block(); if (behind != "") { print behind; behind = "" } code = 1; scheme = /^```scheme/; held = "<pre><code>"; next }
behind != "" && /[^ ]/ { print behind; behind = "" }
/^#+ / { close_block(); level = index($0, " ") - 1; text = substr($0, level + 2); id = open_section(text); print "<h" level " id=\"" id "\">" inline(text) "</h" level ">"; next }
/^\|[-| :]+\|$/ { next }
/^\|/ {
  if (!table) { close_block(); print "<table>"; table = 1; cell = "th" } else cell = "td"
  gsub(/^\| *| *\|$/, ""); n = split($0, cells, / *\| */); row = ""
  for (i = 1; i <= n; i++) row = row "<" cell ">" inline(cells[i]) "</" cell ">"
  print "<tr>" row "</tr>"; next
}
/^- / || /^[0-9]+\. / {
  kind = /^- / ? "ul" : "ol"
  if (item != "") print "<li>" inline(item) "</li>"; else { close_block(); list = kind; print "<" list ">" }
  item = $0; sub(/^(-|[0-9]+\.) /, "", item); next
}
/^ *$/ { close_block(); next }
item != "" { line = $0; sub(/^ +/, "", line); item = item " " line; next }
{ paragraph = paragraph (paragraph == "" ? "" : " ") $0 }
END {
  close_block()
  if (behind != "") print behind
  if (after != "") print after
  told()
  print "</main>\n<script src=\"" root "index.js\"></script>\n<script src=\"" root "search.js\" data-root=\"" root "\"></script>\n</html>"
}
