# Tests that POV-Ray's absolute tolerances and 32-bit numbers do not show: a model with lengths of millionths,
# of millions, and far from the origin looks as it does with ordinary numbers.
. tests/report.sh
wanted extremes || exit 0
if ! command -v povray > /dev/null; then echo "skip extremes: no povray"; exit 0; fi
picture() { "$BUILD/vs" --quiet tests/workers/extremes.vs -D size="$1" -D away="$2" --size 240x180 -o "$work/$3.png" > "$work/why" 2>&1; }
picture 1.0 0.0 plain || { echo "not ok extremes:plain"; sed 's/^/    /' "$work/why"; exit 1; }
for case in "1e-6 0.0 tiny" "1e7 0.0 huge" "1.0 1e6 far" "1e-6 1e-2 tiny-and-far"; do
  # shellcheck disable=SC2086
  set -- $case
  if picture "$1" "$2" "$3" && "$BUILD/tools/pngstat" "$work/plain.png" "$work/$3.png" > "$work/why" 2>&1 && [ "$(cat "$work/why")" -le 10 ]; then echo "ok extremes:$3"
  else echo "not ok extremes:$3"; head -n 5 "$work/why" | sed 's/^/    /'; fi
done
