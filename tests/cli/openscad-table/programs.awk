# Writes small programs of OpenSCAD from tables, p1.scad to pN.scad, and prints N. The file `tables` has sections that
# begin with [name]; each other line is a row. A flat shape goes through an extrusion or a flat operation, a solid through
# a solid operation; eight expressions make a program of echoes.
# awk -f programs.awk tables
/^\[/ { section = substr($0, 2, length($0) - 2); next }
/^$/  { next }
      { row[section, ++rows[section]] = $0 }
function put(text) { file = "p" (++count) ".scad"; print text > file; close(file) }
# Returns the row in which @ is the object, and @@ a second one.
function with(frame, one, other) { gsub(/@@/, other, frame); gsub(/@/, one, frame); return frame }
function pick(name, i) { return row[name, (i - 1) % rows[name] + 1] }
END {
  for (i = 1; i <= rows["extrusions"]; i++)
    for (j = 0; j < 3; j++) put(with(row["extrusions", i], pick("flat", i + 3 * j), pick("flat", i + j + 1)))
  for (i = 1; i <= rows["flat operations"]; i++)
    for (j = 0; j < 4; j++)
      put("linear_extrude(2) " with(row["flat operations", i], pick("flat", i + 2 * j), pick("flat", i + j + 1)))
  for (i = 1; i <= rows["operations"]; i++)
    for (j = 0; j < 4; j++) put(with(row["operations", i], pick("solids", i + 2 * j), pick("solids", i + j + 1)))
  for (i = 1; i <= rows["statements"]; i++) put(row["statements", i])
  for (i = 1; i <= rows["expressions"]; i += 3) {
    text = ""
    for (j = i; j < i + 3 && j <= rows["expressions"]; j++) text = text "echo(" row["expressions", j] ");\n"
    put(text)
  }
  print count
}
