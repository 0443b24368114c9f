#!/bin/sh
# Runs the measure of growth, from program to file: 2,500 to 1,000,000 cylinders, made one by one and as rows of rows,
# written to four formats. For comparison: OpenSCAD's .csg of the same grid, and a Guile and a Lua program that only
# print the text of the scene. Processor seconds and MB, ratios to the printers, and the exponent of time against number
# from 10,000 on, where the start of the process no longer affects it. `bench/growth.sh build/vs build/measure
# [COUNT...]`: cylinders along a side.
set -u
vs=$(realpath "$1") measure=$(realpath "$2"); shift 2
cd "$(dirname "$0")/models" || exit 1
[ $# -gt 0 ] || set -- 50 100 316 1000
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
guile --no-auto-compile -c '(use-modules (system base compile))
  (compile-file "printer.scm" #:output-file (cadr (command-line)) #:optimization-level 2)' "$work/printer.go" > /dev/null
timed() { "$measure" "${RUNS:-3}" "$@" 2>&1 > "$work/text" | tail -n 1; }

echo "| cylinders | what | s | MB | MB written |"
echo "|--:|---|--:|--:|--:|"
row() { # cylinders, what, figures, file
  echo "$3 $(wc -c < "$4")" | awk -v n="$1" -v what="$2" '{ printf "| %d | %s | %.3f | %.0f | %.1f |\n", n, what, $1 / 1000, $3 / 1024, $4 / 1e6 }'
}
for count in "$@"; do
  cylinders=$((count * count))
  for model in separate rows; do
    for format in pov x3d stl glb; do
      case $count.$model.$format in 1000.separate.x3d | 1000.*.stl) continue ;; esac # 6 GB of triangles, which nobody opens
      row $cylinders "$model .$format" "$(timed "$vs" --quiet -D count="$count" $model.vs -o "$work/out.$format")" "$work/out.$format"
      [ $model.$format != separate.pov ] || sed -n '/^union {/,$p' "$work/out.pov" > "$work/separate"
    done
  done
  row $cylinders "printed by Guile" "$(GC_MARKERS=1 timed guile --no-auto-compile -c '(load-compiled (list-ref (command-line) 2))' "$count" "$work/printer.go")" "$work/text"
  cmp "$work/separate" "$work/text" >&2
  row $cylinders "printed by Lua" "$(timed lua5.4 printer.lua "$count")" "$work/text"
  cmp "$work/separate" "$work/text" >&2
  [ "$count" -gt 316 ] || row $cylinders "OpenSCAD .csg" "$(timed openscad -q -D count="$count" -o "$work/out.csg" grid.scad)" "$work/out.csg"
done | tee "$work/rows"

printf '\n| cylinders | separate .pov / Guile | separate .pov / Lua | rows .pov / Guile |\n|--:|--:|--:|--:|\n'
awk -F' *[|] *' '$3 ~ /^(separate .pov|rows .pov|printed by (Guile|Lua))$/ { t[$2, $3] = $4; if (!seen[$2]++) order[++n] = $2 }
  END { for (i = 1; i <= n; i++) { c = order[i]; g = t[c, "printed by Guile"]; l = t[c, "printed by Lua"]
    if (g > 0 && l > 0) printf "| %d | %.2f | %.2f | %.3f |\n", c, t[c, "separate .pov"] / g, t[c, "separate .pov"] / l, t[c, "rows .pov"] / g } }' "$work/rows"

printf '\nExponents of time against number from 10,000 on, least squares:\n\n'
awk -F' *[|] *' '$2 >= 10000 && $4 + 0 > 0 { k = $3; x = log($2); y = log($4); n[k]++; sx[k] += x; sy[k] += y; sxx[k] += x * x; sxy[k] += x * y }
  END { for (k in n) if (n[k] > 1) printf "- %s: %.2f\n", k, (n[k] * sxy[k] - sx[k] * sy[k]) / (n[k] * sxx[k] - sx[k] ^ 2) }' "$work/rows" | sort
