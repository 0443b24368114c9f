# Writes broken programs of OpenSCAD, broken-1.scad to broken-N.scad: a few lines of the given programs, with one to three
# tokens removed, doubled, exchanged, or replaced by a token of another place; some end early.
# awk -v count=N -f mutate.awk FILE...
function pick(n) { return int(rand() * n) + 1 }
function tokens(text, to,   n) {
  n = 0
  while (text != "") {
    if (match(text, /^[ \t]+/)) { text = substr(text, RLENGTH + 1); continue }
    if (!match(text, /^("([^"\\]|\\.)*"|[A-Za-z0-9_$.]+|[<>=!]=|&&|.)/)) break
    to[++n] = substr(text, 1, RLENGTH)
    text = substr(text, RLENGTH + 1)
  }
  return n
}
/[;}]$/ { line[++lines] = $0; n = tokens($0, part); for (i = 1; i <= n; i++) pool[++pooled] = part[i] }
END {
  srand(7)
  for (k = 1; k <= count; k++) {
    file = "broken-" k ".scad"
    first = pick(lines); text = ""
    for (i = first; i < first + 4 && i <= lines; i++) text = text " \n " line[i]
    n = split(text, rows, "\n"); total = 0
    for (i = 1; i <= n; i++) { m = tokens(rows[i], row); for (j = 1; j <= m; j++) all[++total] = row[j]; all[++total] = "\n" }
    for (m = pick(3); m > 0; m--) {
      i = pick(total); j = pick(total); how = pick(5)
      if (how == 1) all[i] = ""
      else if (how == 2) all[i] = all[i] " " all[i]
      else if (how == 3) { t = all[i]; all[i] = all[j]; all[j] = t }
      else if (how == 4) all[i] = pool[pick(pooled)]
      else if (pick(4) == 1) total = i
      else all[i] = all[j]
    }
    text = ""
    for (i = 1; i <= total; i++) text = text all[i] " "
    printf "%s", text > file
    close(file)
  }
}
