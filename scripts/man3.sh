#!/bin/sh
# Writes the manual pages of the library, section 3, made from visualscheme.h: visualscheme(3) is the text before its
# first topic. Each topic has a page with the name of the topic's first function (or type, if it has none); all other
# names that the topic declares link to it.
#
#   scripts/man3.sh VERSION FOLDER
set -u
cd "$(dirname "$0")/.." || exit 1
day=$(date -u -r visualscheme.h +%Y-%m-%d) # when what the pages say last changed
mkdir -p "$2" && awk -v version="$1" -v day="$day" -v folder="$2" '
  function safe(s) { gsub(/\\/, "\\e", s); gsub(/-/, "\\-", s); return s ~ /^[.\047]/ ? "\\&" s : s }
  function close_page(   i, names, file) {
    if (title == "") return
    page = pages++ == 0 ? "visualscheme" : functions > 0 ? first_function : names_of[1]
    for (i = 1; i <= count; i++) names = names (i > 1 ? ", " : "") names_of[i]
    file = folder "/" page ".3"
    printf ".TH %s 3 %s \"VisualScheme %s\" \"Library\"\n.SH NAME\n%s \\- %s\n.SH SYNOPSIS\n.nf\n.B #include <visualscheme.h>\n.fi\n", \
      toupper(page), day, version, names == "" ? page : names, safe(title) > file
    printf ".SH DESCRIPTION\n.nf\n%s.fi\n", text > file
    printf ".SH SEE ALSO\n.BR visualscheme (3),\n.BR vs (1);\n.B vs help embedding\n" > file
    close(file)
    for (i = 1; i <= count; i++)
      if (names_of[i] != page) {
        file = folder "/" names_of[i] ".3"
        printf ".so man3/%s.3\n", page > file
        close(file)
      }
  }
  function begin_page(name) { title = name; text = ""; count = functions = 0; first_function = ""; split("", names_of) }
  BEGIN { begin_page("embed a VisualScheme interpreter: conventions, and how a call ends") }
  /^#ifdef __cplusplus/ { if (title != "" && NR > 100) exit }
  /^\/\* ---- .* ----/ {
    close_page()
    name = $0
    sub(/^\/\* ---- /, "", name); sub(/ ----.*/, "", name)
    begin_page(name)
    if (!/\*\/$/) text = "/*\n"
    next
  }
  {
    # omits blank lines at the top of a page
    if ($0 != "" || text != "") text = text safe($0) "\n"
    if (match($0, /^VS_API .*[ *]vs_[a-z_]*\(/)) {
      name = $0; sub(/\(.*/, "", name); sub(/.*[ *]/, "", name)
      names_of[++count] = name
      if (functions++ == 0) first_function = name
    } else if (match($0, /^(typedef .*|})[ *]vs_[a-z_]*(;|\()/)) {
      name = substr($0, 1, RLENGTH - 1); sub(/.*[ *]/, "", name)
      names_of[++count] = name
    }
  }
  END { close_page() }' visualscheme.h
