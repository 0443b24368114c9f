#!/bin/sh
# Runs the tests: JOBS suites at a time, a line for each test, and the counts as the last line. `tests/run.sh BUILD
# [VERBOSE]`.
#
#   JOBS=n                      the number of suites that run at a time; default: the number of cores
#   SUITES="unit lang cli ..."  only these          ONLY=text   only tests whose name contains it
#   LONG=1                      tests that take a sample of many cases take all of them
#   SEEDS=FROM-TO               the kernel's random trees of these seeds (0.03 s each), in place of the sample
#   TIMES=FILE                  write the time of each entry to FILE, the longest first: seconds, seconds of processor
#                               time, its name
#   TICK=SECONDS                print a line for each running suite every SECONDS seconds; default: 30
#   BLESS=1                     rewrite the goldens of tests/cli instead of comparing
#
# Every suite is a script or a function that prints `ok NAME`, `not ok NAME` with its reasons indented below, or `skip
# NAME: why`.
set -u
cd "$(dirname "$0")/.." || exit 1
[ "${1:-}" = --suite ] || BUILD=${1:-build}
case $BUILD in /*) ;; *) BUILD=$PWD/$BUILD ;; esac
SUITES=${SUITES:-unit lang javascript cli shell editors format lsp mcp desk prompt keys signals manual bad workers cross texts slips solids embed install release limits layers compilers${LONG:+ page live playground determinism}}
export BUILD ONLY="${ONLY:-}" BLESS="${BLESS:-}" LONG="${LONG:-}" LC_ALL=C.UTF-8
. tests/limited.sh
work=$(mktemp -d) || exit 1
ticker=
trap '[ -z "$ticker" ] || kill "$ticker" 2> /dev/null; rm -rf "$work"' EXIT
trap 'exit 130' INT TERM

# Reads cmocka's TAP: `ok 1 - name`, `not ok 1 - name`, `not ok 1 # SKIP name` after the line `skip WHY`
# (tests/unit/skip.h). A program that crashes has failed, for any earlier output.
suite_unit() { # PROGRAM of BUILD/unit
  # A unit test may start workers: seconds, not minutes; more for all cases, for many seeds, or with a sanitizer.
  limited "$([ -z "${SEEDS:-}${LONG:-}" ] && echo "${UNIT_SECONDS:-900}" || echo 36000)" env CMOCKA_MESSAGE_OUTPUT=TAP "$BUILD/unit/$1" > "$work/out" 2> "$work/err"
  status=$?
  awk -v name="unit/$1" '
    /^skip /   { sub(/^skip /, ""); why = $0; next }
    /^(not )?ok [0-9]+ .*# *SKIP/ { sub(/^.*# *SKIP */, ""); print "skip " name ":" $0 ": " why; next }
    /^ok /     { sub(/^ok [0-9]+ *-? */, "");     print "ok " name ":" $0; next }
    /^not ok / { sub(/^not ok [0-9]+ *-? */, ""); print "not ok " name ":" $0; bad = 1; next }
    bad && /^#/ { print "    " $0 }' "$work/out"
  failed=$(grep '^not ok' "$work/out" | grep -vc SKIP)
  if [ $status -ne 0 ] && [ "$failed" = 0 ]; then
    echo "not ok unit/$1: ended with $status"
    tail -n 20 "$work/err" | sed 's/^/    /'
  elif ! grep -q '^ok\|^not ok' "$work/out"; then
    echo "not ok unit/$1: reported no test"
  fi
}

suite_lang()      { sh tests/lang.sh; }
suite_javascript() { sh tests/javascript.sh; }
suite_cli()       { sh tests/cli.sh; }
suite_shell()     { sh tests/shell.sh; }
suite_editors()   { sh tests/editors.sh; }
suite_format()    { sh tests/format.sh; }
suite_lsp()       { sh tests/lsp.sh; }
suite_mcp()       { sh tests/mcp.sh; }
suite_desk()      { sh tests/desk.sh; }
suite_prompt()    { sh tests/prompt.sh; }
suite_keys()      { sh tests/prompt/screen.sh; }
suite_signals()   { sh tests/signals.sh; }
suite_manual()    { sh tests/manual.sh; }
suite_workers()   { sh "tests/workers/$1"; }
suite_page()      { sh tests/page.sh; }
suite_live()      { sh tests/live.sh; }
suite_playground() { sh tests/playground.sh; }
suite_cross()     { sh tests/cross.sh; }
suite_texts()     { sh tests/texts.sh; }
suite_slips()     { sh tests/slips.sh; }
suite_solids()    { sh tests/solids.sh; }
suite_bad()       { case $ONLY in ""|bad*) limited 300 "$BUILD/tools/badcalls" tests/bad/calls.txt || echo "not ok bad: ended with $?" ;; esac; }
suite_limits()    { sh tests/limits.sh; }
suite_determinism() { sh tests/determinism.sh; }
suite_install()   { sh tests/install.sh; }
suite_release()   { sh tests/release.sh; }
suite_embed()     { [ ! -f tests/embed.sh ] || sh tests/embed.sh; }
suite_layers() {
  if ! command -v objdump >/dev/null 2>&1; then echo "skip layers: no objdump (package binutils)"; return; fi
  if sh scripts/layers.sh "$BUILD" > "$work/out" 2>&1 && grep -q "no mutable globals" "$work/out"; then echo "ok layers"; else echo "not ok layers"; sed 's/^/    /' "$work/out"; fi
}
# Both compilers accept all sources without a warning. `make test` builds with gcc's warnings as errors; clang's
# warnings come from its front end, which runs alone here. LONG=1: both build everything anew with other optimisation,
# and link the programs.
suite_compilers() {
  for compiler in ${LONG:+gcc} clang; do
    if ! command -v $compiler >/dev/null 2>&1; then echo "skip compilers/$compiler: not installed"; continue; fi
    if MAKEFLAGS= make -s -j2 CC=$compiler BUILD="${BUILD#"$PWD"/}/$compiler" OPT="$([ -n "$LONG" ] && echo -O1 || echo -fsyntax-only)" EXTRA=-Werror \
         $([ -n "$LONG" ] && echo all || echo objects) > "$work/out" 2>&1; then
      echo "ok compilers/$compiler"
    else
      echo "not ok compilers/$compiler"; grep -v '^  [a-z]* * [^ ]*$' "$work/out" | head -n 30 | sed 's/^/    /'
    fi
  done
}

# An entry of the pool below. Its lines are printed together at its end, since other entries run beside it.
if [ "${1:-}" = --suite ]; then
  begin=$(date +%s)
  : > "$work/lines"
  # The sleeping process must not keep the suite's output open after its end.
  (while sleep "${TICK:-30}" > /dev/null 2>&1; do
     echo "  $2: $(($(date +%s) - begin)) s, $(grep -a -c '^ok ' "$work/lines") passed, $(grep -a -c '^not ok ' "$work/lines") failed"
   done) & ticker=$!
  suite_"${2%%/*}" "${2#*/}" > "$work/lines" 2>&1
  times > "$work/times"
  kill "$ticker" 2> /dev/null; ticker=
  awk -v name="$2" -v seconds="$(($(date +%s) - begin))" 'function s(t) { split(t, p, /[ms]/); return 60 * p[1] + p[2] }
    { cpu += s($1) + s($2) } END { printf "%d %.0f %s\n", seconds, cpu, name }' "$work/times" >> "$3.times"
  if [ "$4" = VERBOSE ]; then cat "$work/lines"; else grep -a -v '^ok ' "$work/lines"; fi > "$work/said"
  exec 9> "$3.lock" && flock 9 && cat "$work/said" && cat "$work/lines" >> "$3"
  exit 0
fi

# Prints the programs of this build that the suites run and that are missing. If ONLY selects tests, their tools are not
# checked.
lacking() {
  for suite in $SUITES; do
    echo vs
    case $suite in
      unit)   for f in tests/unit/test_*.c; do f=unit/$(basename "$f" .c); case $f in *"$ONLY"*) echo "$f" ;; esac; done ;;
      bad)    echo tools/badcalls ;;
      limits) grep -hoE 'tools"?/[a-z_]+' tests/limits.sh tests/faults.sh tests/untrusted.sh; for f in tests/fuzz/fuzz_*.c; do f=${f#*/fuzz_}; echo "tools/replay_${f%.c}"; done ;;
      *)      grep -rhoE 'tools"?/[a-z_]+' "tests/$suite.sh" "tests/$suite" 2> /dev/null ;;
    esac
  done | tr -d '"' | sort -u | while read -r f; do
    case $f in
      vs|unit/*) [ -x "$BUILD/$f" ] || echo "$f" ;;
      tools/fuzz|tools/replay_?*) [ -n "$ONLY" ] || [ -x "$BUILD/$f" ] || echo "$f" ;;
      *) [ -n "$ONLY" ] || [ ! -f "tests/$f.c" ] || [ -x "$BUILD/$f" ] || echo "$f" ;;
    esac
  done
}
lacking > "$work/lacking"
if [ -s "$work/lacking" ]; then
  echo "not built in ${BUILD#"$PWD"/}, and run by these tests: $(head -n 4 "$work/lacking" | tr '\n' ' ')$([ "$(wc -l < "$work/lacking")" -le 4 ] || echo "... ($(wc -l < "$work/lacking"))")"
  echo "make $([ "${BUILD#"$PWD"/}" = build ] || echo "BUILD=${BUILD#"$PWD"/} ")all units tools builds them; make tests builds and runs"
  exit 2
fi

# The pool: a suite is an entry, but each program of unit/ and each script of workers/ is a separate entry.
log=$work/log
: > "$log"
for suite in $SUITES; do
  case $suite in
    unit)    (cd "$BUILD" && for program in unit/test_*; do case $program in *.d|*.gcno|*.gcda) ;; *"$ONLY"*) echo "$program" ;; esac; done) ;;
    workers) (cd tests && ls workers/*.sh) ;;
    *)       echo "$suite" ;;
  esac
done | xargs -P "${JOBS:-$(nproc)}" -I SUITE sh tests/run.sh --suite SUITE "$log" "${2:-QUIET}"

[ -z "${TIMES:-}" ] || sort -k 2,2nr "$log.times" > "$TIMES"
passed=$(grep -a -c '^ok ' "$log")
failed=$(grep -a -c '^not ok ' "$log")
skipped=$(grep -a -c '^skip ' "$log")
if [ "$skipped" = 0 ]; then echo "$passed passed, $failed failed"; else echo "$passed passed, $failed failed, $skipped skipped"; fi
[ "$failed" = 0 ] && [ "$passed" != 0 ]
