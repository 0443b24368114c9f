# Prints the table. The input has lines "program system cpu-ms wall-ms kilobytes" and the same three figures of an empty
# program (for the program "start" those alone). The output, in Markdown, has times minus start-up, ratios to Guile
# without its JIT, geometric means and peak memory.
BEGIN { float = " fft mandelbrot nbody subdivide tower transforms " }
{ cpu[$1, $2] = $3; start[$1, $2] = $6; memory[$1, $2] = $5 / 1024; if (!($1 in seen) && $1 != "start") { seen[$1]; order[++programs] = $1 } }

function own(p, s,   t) { t = cpu[p, s] - start[p, s]; return t > 1 ? t : 1 }
function has(p, s) { return (p, s) in cpu }
function cell(p, s) { return has(p, s) ? sprintf("%.0f", own(p, s)) : "" }
function ratio(p, s) { return has(p, s) && has(p, "guile") ? sprintf("%.2f", own(p, s) / own(p, "guile")) : "" }
# geometric mean of s / t over the programs both have; only: "", or a list of programs
function mean(s, t, only,   i, n, sum, p) {
  for (i = 1; i <= programs; i++) {
    p = order[i]
    if (!has(p, s) || !has(p, t) || only != "" && index(only, " " p " ") == 0) continue
    sum += log(own(p, s) / own(p, t)); n++
  }
  return n ? exp(sum / n) : 0
}
END {
  print "| program | vs ms | Guile, no JIT | Guile, JIT | Lua 5.4 | Chez | vs ratio | JIT ratio | Lua ratio | Chez ratio | vs MB | Guile MB | Lua MB | Chez MB |"
  print "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|"
  for (i = 1; i <= programs; i++) {
    p = order[i]
    printf "| %s | %s | %s | %s | %s | %s | **%s** | %s | %s | %s | %.1f | %.1f | %s | %.1f |\n", p, cell(p, "vs"), cell(p, "guile"), cell(p, "guile-jit"),
      cell(p, "lua"), cell(p, "chez"), ratio(p, "vs"), ratio(p, "guile-jit"), ratio(p, "lua"), ratio(p, "chez"),
      memory[p, "vs"], memory[p, "guile"], has(p, "lua") ? sprintf("%.1f", memory[p, "lua"]) : "", memory[p, "chez"]
  }
  printf "| geometric mean | | | | | | **%.2f** | %.2f | %.2f | %.2f | | | | |\n", mean("vs", "guile"), mean("guile-jit", "guile"), mean("lua", "guile"), mean("chez", "guile")
  printf "| an empty program | %.1f | %.1f | %.1f | %.1f | %.1f | | | | | %.1f | %.1f | %.1f | %.1f |\n", cpu["start", "vs"], cpu["start", "guile"], cpu["start", "guile-jit"],
    cpu["start", "lua"], cpu["start", "chez"], memory["start", "vs"], memory["start", "guile"], memory["start", "lua"], memory["start", "chez"]
  printf "\nFloating point (%s), geometric means:\nvs / Guile without JIT %.2f, vs / Guile with JIT %.2f, vs / Lua %.2f, vs / Chez %.2f.\n", substr(float, 2, length(float) - 2),
    mean("vs", "guile", float), mean("vs", "guile-jit", float), mean("vs", "lua", float), mean("vs", "chez", float)
  printf "All programs: vs / Lua %.2f, vs / Guile with JIT %.2f, vs / Chez %.2f.\n", mean("vs", "lua"), mean("vs", "guile-jit"), mean("vs", "chez")
}
