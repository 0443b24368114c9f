# Converts a page of the manual from Markdown to a page for man(1): headings, paragraphs, lists, tables,
# blocks of code, `code`, **strong**, links. -v part=first: the text before the first heading of level 2; -v part=rest:
# the other text.
function safe(s) { gsub(/\\/, "\\e", s); gsub(/-/, "\\-", s); return s }
function words(s,   link) { # links give their words alone
  while (match(s, /\[[^]]*\]\([^)]*\)/)) {
    link = substr(s, RSTART + 1, RLENGTH - 1); sub(/\].*/, "", link)
    s = substr(s, 1, RSTART - 1) link substr(s, RSTART + RLENGTH)
  }
  return s
}
function inline(s,   out, text) {
  s = words(s); out = ""
  while (match(s, /`[^`]*`|\*\*[^*]+\*\*|\*[^* ][^*]*\*/)) {
    text = substr(s, RSTART, RLENGTH)
    out = out safe(substr(s, 1, RSTART - 1))
    s = substr(s, RSTART + RLENGTH)
    if (text ~ /^`/) out = out "\\fB" safe(substr(text, 2, length(text) - 2)) "\\fR"
    else { gsub(/\*/, "", text); out = out "\\fI" safe(text) "\\fR" }
  }
  return out safe(s)
}
function say(s) { if (s ~ /^[.\047]/) s = "\\&" s; print s }
function flush_text() { if (held != "") { say(inline(held)); held = "" } }
BEGIN { titled = part == "first" } # no paragraph begins right below a heading
function on() { return part == "first" ? !seen : seen }
/^## / { if (on()) flush_text(); held = ""; seen = 1; if (on()) { title = toupper(words(substr($0, 4))); gsub(/`/, "", title); print ".SH \"" safe(title) "\"" } table = 0; titled = 1; next }
!on() { next }
/^# / { next }
/^```/ { flush_text(); code = !code; titled = 0; print code ? ".PP\n.nf\n.RS" : ".RE\n.fi"; next }
code { say(safe($0)); next }
/^### / { flush_text(); title = words(substr($0, 5)); gsub(/`/, "", title); print ".SS \"" safe(title) "\""; titled = 1; next }
/^\|[-| :]+\|$/ { table = 2; next }
/^\|/ {
  if (!table) { flush_text(); table = 1; next } # the head of a table says what its columns are: the text before it has said so
  gsub(/^\| *| *\|$/, ""); n = split($0, cells, / *\| */); row = ""
  for (i = 2; i <= n; i++) row = row (row != "" && cells[i] != "" ? "; " : "") cells[i]
  titled = 0; print ".TP"; say(inline(cells[1])); say(row == "" ? "\\&" : inline(row)); next
}
/^(-|[0-9]+\.) / { flush_text(); held = $0; sub(/^(-|[0-9]+\.) /, "", held); print ".IP \\(bu 2"; titled = 0; next }
/^ *$/ { flush_text(); table = 0; fresh = 1; next }
{ if (held == "" && fresh && !titled) print ".PP"; fresh = titled = 0; line = $0; sub(/^ +/, "", line); held = held (held == "" ? "" : " ") line }
END { if (on()) flush_text() }
