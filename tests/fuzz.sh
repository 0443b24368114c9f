#!/bin/sh
# Owns a run of the fuzzers: `tests/fuzz.sh BUILD SECONDS`, so long for each. Says how many inputs each has tried and how much it reached; what crashes is left in
# BUILD/found, and belongs into tests/fuzz/corpus when it is mended. FUZZ="reader emit": only these.
set -u
cd "$(dirname "$0")/.." || exit 1
build=$1 seconds=$2
mkdir -p "$build/found"
bad=0
for name in ${FUZZ:-reader program import emit calls}; do
  corpus=$build/corpus/$name
  mkdir -p "$corpus"
  # importers: each file of the tests behind the number of its reader
  if [ "$name" = import ]; then
    i=0
    for kind in stl obj off ply stl ply png exr ttf hdr; do
      for f in tests/lang/lib/meshes/*.$kind tests/lang/lib/pictures/*.$kind; do
        [ -f "$f" ] && [ "$(wc -c < "$f")" -lt 20000 ] && { printf "\\$(printf %03o $i)"; cat "$f"; } > "$corpus/$kind-$i-$(basename "$f")"
      done
      i=$((i + 1))
    done
  fi
  dict=tests/fuzz/scheme.dict
  [ "$name" = import ] && dict=tests/fuzz/files.dict
  "$build/fuzz_$name" -max_total_time="$seconds" -dict=$dict -rss_limit_mb=3000 -timeout=20 -max_len=4096 -artifact_prefix="$build/found/$name-" -print_final_stats=1 \
    "$corpus" "tests/fuzz/corpus/$name" > "$build/$name.log" 2>&1 || bad=1
  awk -v name="$name" '/ cov: / { for (i = 1; i < NF; i++) if ($i == "cov:") cov = $(i + 1) } /number_of_executed_units/ { n = $2 } /Test unit written|ERROR:|SUMMARY:/ { print "  " $0 }
    END { printf "%s: %d executions, %d edges reached\n", name, n, cov }' "$build/$name.log"
done
exit $bad
