#!/bin/sh
# Runs the measure of memory: the interpreter's memory beyond the live data of four shapes, while it makes garbage, and
# the memory of a primitive. `bench/memory.sh build/vs`; two tables on standard output.
set -u
vs=$(realpath "$1")
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT

# Each program makes some 100 MB that stay, and then 400 MB of lists that become garbage. Live bytes: a pair 24, a
# number in it 0, a point 32, a vector 16 and 8 for each element, a string 32 and its bytes object 16 and 1 for each
# character, an entry of a hash table 24 and 8 in the index.
churn='(define (churn n) (if (> n 0) (begin (iota 1000) (churn (- n 1))))) (churn 17000)'
held() { # program text -> bytes held at the end, peak resident KB
  printf '%s\n' "$1" "$churn" > "$work/p.vs"
  "$vs" --quiet --stats "$work/p.vs" 2>&1 | awk '$1 == "memory.now" { printf "%d ", $2 }'
  /usr/bin/time -f %M "$vs" --quiet "$work/p.vs" 2>&1 > /dev/null | tail -n 1
}
empty=$(held "" | cut -d' ' -f1)
echo "| live data | MB | held MB | times | resident MB at most |"
echo "|---|--:|--:|--:|--:|"
shape() { # name, live bytes, program
  # shellcheck disable=SC2046
  set -- "$1" "$2" $(held "$3")
  awk -v name="$1" -v live="$2" -v now="$3" -v empty="$empty" -v peak="$4" 'BEGIN {
    printf "| %s | %.0f | %.0f | %.2f | %.0f |\n", name, live / 1e6, (now - empty) / 1e6, (now - empty) / live, peak / 1e3 }'
}
shape "list of 4 million numbers" 96000000 '(define l (iota 4000000))'
shape "vectors of points, 2 million" 84160000 '(define l (map (lambda (i) (build-vector 100 (lambda (j) (xyz i j 0)))) (iota 20000)))'
shape "strings of 100 characters, 600,000" 103200000 '(define l (map (lambda (i) (make-string 100 #\a)) (iota 600000)))'
shape "hash table of 2 million numbers" 67100000 '(define h (make-hash)) (let loop ((i 0)) (if (< i 2000000) (begin (hash-set! h i i) (loop (+ i 1)))))'

# A million primitives in a loop: bytes of each, of all, and the time compared with that of (list x y z) in the same
# loop.
seconds() { # expression -> the least of five times of a million in a loop, processor seconds
  cat > "$work/q.vs" <<END
(define (make n) (let loop ((i 0) (l '())) (if (= i n) l (loop (+ i 1) (cons $1 l)))))
(define l (make ${2:-1000000}))
END
  for i in 1 2 3 4 5; do /usr/bin/time -f "%U" "$vs" --quiet --check "$work/q.vs" 2>&1 > /dev/null | tail -n 1; done | sort -n | head -n 1
}
bytes() { "$vs" --quiet --check --stats "$work/q.vs" 2>&1 | awk '$1 == "memory.now" { print $2 }'; }
pairs=$(seconds "(list i i 0)")
seconds "i" > /dev/null
base=$(bytes)
echo
echo "| a million of | bytes each | microseconds each | times (list x y z) |"
echo "|---|--:|--:|--:|"
for form in "(list i i 0)" "(make-sphere (xyz i i 0) 1)" "(make-box (xyz i i 0) 1 1 1)" "(make-cylinder (xyz i i 0) 1 1)" "(do-move (make-sphere origin i) (vxyz i 0 0))"; do
  t=$(seconds "$form")
  b=$(bytes)
  awk -v f="$form" -v t="$t" -v b="$b" -v base="$base" -v pairs="$pairs" 'BEGIN { printf "| `%s` | %.0f | %.2f | %.1f |\n", f, (b - base) / 1e6, t, t / pairs }'
done
