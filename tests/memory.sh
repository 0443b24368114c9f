#!/bin/sh
# Tests that a run that is out of memory ends with 4 and one message, which names the limit and a place. Two authorities
# refuse memory: the library, which counts, and the system (RLIMIT_DATA), which makes malloc fail. Each format of
# backends.def is written under growing limits of either, until one suffices. LONG=1: all formats, more limits.
case limits/memory in *"$ONLY"*) ;; *) exit 0 ;; esac
. tests/report.sh
wrong=$work/wrong
: > "$wrong"
cat > "$work/model.vs" << 'END'
(displayln "begun")
(draw (unite (for/list ([i 60]) (make-sphere (xy (* 0.7 i) (* 0.3 (modulo i 3))) 1))))
(for ([i 2000]) (draw (do-rotate (make-box (xyz (* 3 i) 9 0) 1 1 (+ 1 (* i 1e-4))) 'z i)))
END

# attempt FORMAT LIMIT AUTHORITY: writes the output with LIMIT MB. Returns true if the limit suffices, and adds a line
# to $wrong if the end is neither whole nor as promised. Before the program runs there is no place.
attempt() {
  (cd "$work" && rm -f out && { [ "$3" = library ] || ulimit -d $(($2 * 1024)); } &&
    exec "$vs" -q --limit-memory "$2" --format "$1" -o out model.vs) > "$work/said" 2> "$work/err" < /dev/null
  status=$?
  [ $status != 0 ] || return 0
  refused=$((refused + 1))
  place='model\.vs:[0-9]*:[0-9]*'
  grep -q begun "$work/said" || place="\\($place\\|vs\\)"
  if [ $status = 4 ] && [ "$(grep -c 'out of memory' "$work/err")" = 1 ] && [ ! -e "$work/out" ] &&
     head -n 1 "$work/err" | grep -q "^$place: out of memory: stopped at $2 MB, the limit\$"; then return 1; fi
  echo "$1, $2 MB of the $3: ended with $status: $(head -n 1 "$work/err")" >> "$wrong"
  return 1
}

formats=$(sed -n 's/^VS_\(FORMAT\|NOTATION\)([a-z0-9]*, *[a-z0-9_]*, *"\([^"]*\)", NULL.*/\2/p' backends/backends.def)
step=4
[ -n "${LONG:-}" ] || { formats="stl 3mf dxf povray"; step=9; }
for authority in library system; do
  refused=0
  for format in $formats; do
    limit=5
    until attempt "$format" "$limit" $authority || [ $limit -gt 400 ]; do limit=$((limit + step + limit / 8)); done
    [ $limit -le 400 ] || echo "$format: 400 MB of the $authority do not suffice" >> "$wrong"
  done
  [ $refused -gt 2 ] || echo "the $authority refused only $refused times: the test tests nothing" >> "$wrong"
done
result limits/memory "$wrong"
