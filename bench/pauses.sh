#!/bin/sh
# Prints the pauses of the collector: of each program of bench/programs, and of programs with 10^5 to 10^7 live pairs, the
# number of collections, the longest one in milliseconds, and the time of the whole run in seconds.
#   sh bench/pauses.sh build/vs [PROGRAM ...]
set -eu
vs=$1
shift
[ $# -gt 0 ] || set -- bench/programs/*.scm
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
row() { # NAME FILE
  "$vs" --quiet "$2" --stats=json 2>&1 > "$work/out" | tr ',' '\n' | awk -v name="$1" -F ': ' '
    /"time.evaluate"/ && !("time" in v) { v["time"] = $2 }
    /"heap.collections"/ && !("count" in v) { v["count"] = $2 }
    /"heap.pause"/ && !("pause" in v) { v["pause"] = $2 }
    END {
      if (!("pause" in v)) { print name ": no statistics" > "/dev/stderr"; exit 1 }
      printf "| %s | %d | %.2f | %.2f |\n", name, v["count"], 1000 * v["pause"], v["time"]
    }'
}
echo '| program | collections | longest, ms | run, s |'
echo '|---|---|---|---|'
for program in "$@"; do row "$(basename "$program" .scm)" "$program"; done
for live in 100000 1000000 10000000; do
  cat > "$work/live.scm" <<EOF
(define kept (iota $live))
(define (turn i l) (if (= i 0) l (turn (- i 1) (list i i i))))
(turn 20000000 '())
(display (length kept))
EOF
  row "$live live pairs" "$work/live.scm"
done
