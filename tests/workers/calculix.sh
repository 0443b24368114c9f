# Tests frames of (visualscheme analysis) beside CalculiX, which makes solids of beams: the nodes of ten frames move to the
# same places within 2 % of the greatest movement.
. tests/report.sh
wanted calculix || exit 0
command -v ccx > /dev/null || { echo "skip calculix: no ccx"; exit 0; }
for number in 1 2 3 4 5 6 7 8 9 10; do
  "$vs" --quiet -D number=$number tests/tools/calculix.vs > "$work/frame.inp" 2> "$work/why" &&
    "$vs" --quiet -D number=$number -D answer=#t tests/tools/calculix.vs > "$work/ours" 2> "$work/why"
  (cd "$work" && rm -f frame.dat && limited 60 ccx frame > ccx.log 2>&1)
  awk 'NR == FNR { for (k = 1; k <= 3; k++) ours[$1, k] = $(k + 1); known[$1] = 1; next }
    NF == 4 && $1 in known { away = size = 0
      for (k = 1; k <= 3; k++) { away += ($(k + 1) - ours[$1, k]) ^ 2; size += ours[$1, k] ^ 2 }
      if (away > most) most = away
      if (size > greatest) greatest = size
      seen++ }
    END { if (!seen || !greatest) print "CalculiX gave no movements"
      else if (sqrt(most / greatest) > 0.02) print "the movements differ by " 100 * sqrt(most / greatest) " %" }' "$work/ours" "$work/frame.dat" >> "$work/why" 2>&1
  result "calculix/frame-$number" "$work/why"
done
