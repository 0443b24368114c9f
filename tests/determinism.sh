#!/bin/sh
# Tests that a file depends on neither compiler, optimisation, number of threads nor chance: every example in
# every format that needs no worker, RUNS (5) times on each of THREADS (1 2 8) by each of BUILDS (gcc and clang at -O0,
# -O2, -O3), which are built beside $BUILD. An example that takes the reference more than HEAVY (0.5) seconds of
# processor time runs once on each; parameters make large ones smaller. EXAMPLES: only these. Part of `make check`; it
# takes more than two hours of processor time, half an hour of which for rules/four-trees.
case determinism in *"${ONLY:-}"*) ;; *) exit 0 ;; esac
. tests/report.sh
. tests/smaller.sh
threads=${THREADS:-1 2 8} heavy=${HEAVY:-0.5}
examples=${EXAMPLES:-$(ls examples/*.vs examples/*/*.vs examples/*/*.gml examples/*/*.lsp examples/*/*.js)}
formats=$(sed -n 's/^VS_FORMAT(\([^,]*\), [^,]*, "[^"]*", NULL.*/\1/p' backends/backends.def)
[ "$(echo $formats | wc -w)" -ge 15 ] || echo "not ok determinism: the table of formats was not read: $formats"

# The program asks the system for the number of processors: this library answers.
cat > "$work/processors.c" <<'C'
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdlib.h>
#include <unistd.h>
long sysconf(int name) {
  const char *n = getenv("PROCESSORS");
  if (name == _SC_NPROCESSORS_ONLN && n) return atol(n);
  return ((long (*)(int))dlsym(RTLD_NEXT, "sysconf"))(name);
}
C
cc -shared -fPIC -o "$work/processors.so" "$work/processors.c" || { echo "skip determinism: no preloaded library"; exit 0; }

built=
for b in ${BUILDS:-gcc-O0 gcc-O2 gcc-O3 clang-O0 clang-O2 clang-O3}; do
  if ! command -v "${b%-O*}" >/dev/null 2>&1; then echo "skip determinism/$b: not installed"; continue; fi
  if MAKEFLAGS= make -s -j2 BUILD="${BUILD#"$PWD"/}/determinism/$b" CC="${CCACHE:-} ${b%-O*}" OPT="-${b#*-}" all > "$work/log" 2>&1; then built="$built $b"
  else echo "not ok determinism/$b: does not build"; tail -n 5 "$work/log" | sed 's/^/    /'; fi
done

# sums EXAMPLE BUILD THREADS FILE: the checksum of each output, and of the printed text
sums() {
  rm -rf "$work/out"; mkdir "$work/out"
  outputs=
  for f in $formats; do outputs="$outputs -o $work/out/a.$f"; done
  PROCESSORS=$3 LD_PRELOAD=$work/processors.so timeout 900 "$BUILD/determinism/$2/vs" -q $(smaller "$1") "$1" $outputs > "$work/out/printed" 2> "$work/out/told" < /dev/null
  echo $? > "$work/out/code"
  (cd "$work/out" && sha256sum ./*) > "$4"
}

# The seconds of the child processes so far; `times` itself prints them, since a pipe's subshell has none.
spent() { awk 'END { split($1, u, /[ms]/); print 60 * u[1] + u[2] }' "$work/$1"; }

compared=0 differ=0
for example in $examples; do
  first=
  again=${RUNS:-5}
  for b in $built; do
    for t in $threads; do
      run=0
      while [ $run -lt "$again" ]; do
        run=$((run + 1))
        if [ -z "$first" ]; then
          first=$b
          times > "$work/before"
          sums "$example" "$b" "$t" "$work/reference"
          times > "$work/after"
          if [ "$(cat "$work/out/code")" = 124 ]; then echo "not ok determinism: $example is not done in 900 s"; continue 4; fi
          [ "$(awk "BEGIN { print ($(spent after) - $(spent before) > $heavy) }")" = 1 ] && again=1
          continue
        fi
        sums "$example" "$b" "$t" "$work/sums"
        compared=$((compared + $(wc -l < "$work/reference")))
        if ! cmp -s "$work/reference" "$work/sums"; then
          differ=$((differ + 1))
          echo "not ok determinism: $example by $b, $t threads, run $run, differs from $first:"
          diff "$work/reference" "$work/sums" | sed -n 's/^> [^ ]* */    /p'
        fi
      done
    done
  done
done
[ $compared -gt 0 ] && [ $differ = 0 ] && echo "ok determinism: $compared files were compared"
