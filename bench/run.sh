#!/bin/sh
# Runs the comparison: every program of bench/programs in vs, Guile without and with its JIT, Lua and Chez Scheme, one after the other
# in one run; a table on standard output. `bench/run.sh build/vs build/measure [PROGRAM...]`; RUNS=n sets the runs of each (5).
# WRITE=bench/README.md puts the table in that file, too, in place of the lines between its marks.
#
# A time is the median of the processor time of whole runs less that of an empty program in the same system just after; Guile's programs are compiled
# to its bytecode before, its collector has one thread (so that no time is counted twice). A program whose printed result differs from
# vs' is an error.
set -u
vs=$(realpath "$1") measure=$(realpath "$2"); shift 2
cd "$(dirname "$0")/.." || exit 1
runs=${RUNS:-5}
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
systems="vs guile guile-jit lua chez"
[ $# -gt 0 ] || set -- $(ls bench/programs/*.scm | sed 's|.*/||; s|\.scm$||')
bad=0

# system, program's name -> a file that is ready to run, or failure: the system has no such program
prepare() {
  case $1 in
    vs)     cp "bench/programs/$2.scm" "$work/vs-$2.scm" ;;
    guile)  cat bench/systems/guile.scm bench/systems/points.scm "bench/programs/$2.scm" > "$work/guile-$2.scm" &&
            guile --no-auto-compile -c '(use-modules (system base compile))
              (compile-file (cadr (command-line)) #:output-file (caddr (command-line)) #:optimization-level 2)' \
              "$work/guile-$2.scm" "$work/guile-$2.go" > /dev/null ;;
    guile-jit) : ;;
    lua)    [ -f "bench/programs/$2.lua" ] && cat bench/systems/points.lua "bench/programs/$2.lua" > "$work/lua-$2.lua" ;;
    chez)   cat bench/systems/chez.scm bench/systems/points.scm "bench/programs/$2.scm" > "$work/chez-$2.scm" ;;
  esac
}

# runs, system, program
timed() {
  GC_MARKERS=1; export GC_MARKERS
  case $2 in
    vs)        "$measure" "$1" "$vs" --quiet "$work/vs-$3.scm" ;;
    guile)     GUILE_JIT_THRESHOLD=-1 "$measure" "$1" guile --no-auto-compile -c '(load-compiled (cadr (command-line)))' "$work/guile-$3.go" ;;
    guile-jit) "$measure" "$1" guile --no-auto-compile -c '(load-compiled (cadr (command-line)))' "$work/guile-$3.go" ;;
    lua)       "$measure" "$1" lua5.4 "$work/lua-$3.lua" ;;
    chez)      "$measure" "$1" chezscheme --script "$work/chez-$3.scm" ;;
  esac
}

# The cost of an empty program, with the libraries that every program of the system loads.
: > "$work/vs-empty.scm"
: > "$work/empty"
cp bench/systems/points.lua "$work/lua-empty.lua"
cat bench/systems/chez.scm bench/systems/points.scm > "$work/chez-empty.scm"
cat bench/systems/guile.scm bench/systems/points.scm > "$work/guile-empty.scm"
guile --no-auto-compile -c '(use-modules (system base compile))
  (compile-file (cadr (command-line)) #:output-file (caddr (command-line)) #:optimization-level 2)' "$work/guile-empty.scm" "$work/guile-empty.go" > /dev/null
for system in $systems; do
  timed 21 "$system" empty 2> "$work/line" > /dev/null || { echo "$system: cannot run" >&2; bad=1; }
  echo "start $system $(cat "$work/line")" >> "$work/figures"
done

for program in "$@"; do
  for system in $systems; do
    prepare "$system" "$program" || continue
    timed "$runs" "$system" "$program" 2> "$work/line" > "$work/result" || { echo "$program in $system: failed" >&2; cat "$work/line" >&2; bad=1; continue; }
    result=$(tr -d '[:space:]' < "$work/result")
    [ "$system" = vs ] && expected=$result
    [ "$result" = "$expected" ] || { echo "$program in $system: $result, but vs has $expected" >&2; bad=1; }
    timed "$runs" "$system" empty 2> "$work/start" > /dev/null      # in the same seconds, so that both bear the same load
    echo "$program $system $(cat "$work/line" "$work/start" | tr '\n' ' ')" >> "$work/figures"
  done
done

awk -f bench/table.awk "$work/figures" > "$work/table" || bad=1
cat "$work/table"
if [ -n "${WRITE:-}" ] && [ $bad = 0 ]; then
  awk -v table="$work/table" '
    /^<!-- run.sh -->$/ { print; while ((getline line < table) > 0) print line; skip = 1 }
    /^<!-- end -->$/    { skip = 0 }
    !skip' "$WRITE" > "$work/page" && cat "$work/page" > "$WRITE" || bad=1
fi
exit $bad
