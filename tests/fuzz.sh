#!/bin/sh
# Runs the fuzzers: `tests/fuzz.sh BUILD SECONDS [PLAIN]`. Each fuzzer of tests/fuzz runs for SECONDS under
# libFuzzer and the sanitizers of BUILD. If PLAIN names a build without sanitizers, each then runs for SECONDS there on
# random changes of the inputs that libFuzzer has kept: thirty times as many inputs. Prints the number of inputs and of
# reached edges for each, and the sums of all runs, which BUILD/executions keeps. An input that crashes stays in
# BUILD/found; once the fault is fixed, add it to tests/fuzz/corpus. A journal there contains the inputs of one
# interpreter (replay_NAME -j). FUZZ="reader emit": only these.
set -u
cd "$(dirname "$0")/.." || exit 1
build=$1 seconds=$2 plain=${3:-}
mkdir -p "$build/found"
bad=0
count() { echo "$1 $2 $3" >> "$build/executions"; }
for name in ${FUZZ:-reader text program forms script import emit calls live}; do
  corpus=$build/corpus/$name
  mkdir -p "$corpus"
  # importers: each file of the tests, after the number of its reader
  if [ "$name" = import ]; then
    i=0
    for kind in stl obj off ply stl ply png exr ttf hdr vs json csv otf jpg ies mtl; do
      for f in tests/lang/lib/meshes/*.$kind tests/lang/lib/pictures/*.$kind tests/lang/lib/data/*.$kind tests/lang/lib/lamps/*.$kind; do
        [ -f "$f" ] && [ "$(wc -c < "$f")" -lt 20000 ] && { printf "\\$(printf %03o $i)"; cat "$f"; } > "$corpus/$kind-$i-$(basename "$f")"
      done
      i=$((i + 1))
    done
  fi
  dict= most=128
  case $name in import) dict=-dict=tests/fuzz/files.dict most=2048 ;; reader|program|script) dict=-dict=tests/fuzz/scheme.dict ;; esac
  if [ "$seconds" != 0 ]; then
    # The leak check runs only if the interpreter ends with its input; elsewhere it would take most of the time.
    leaks=0
    [ "$name" = calls ] && leaks=1
    FUZZ_JOURNAL=$build/found/$name.journal "$build/fuzz_$name" -max_total_time="$seconds" $dict -detect_leaks=$leaks -rss_limit_mb=3000 \
      -timeout=30 -max_len=$most -artifact_prefix="$build/found/$name-" -print_final_stats=1 "$corpus" "tests/fuzz/corpus/$name" > "$build/$name.log" 2>&1 || bad=1
    count "$name" sanitized "$(awk '/number_of_executed_units/ { n = $2 } END { print n + 0 }' "$build/$name.log")"
    awk -v name="$name" '/ cov: / { for (i = 1; i < NF; i++) if ($i == "cov:") cov = $(i + 1) } /number_of_executed_units/ { n = $2 } /Test unit written|ERROR:|SUMMARY:/ { print "  " $0 }
      END { printf "%s: %d executions, %d edges reached\n", name, n, cov }' "$build/$name.log"
  fi
  if [ -n "$plain" ]; then
    end=$(($(date +%s) + ${seconds:-60})) turn=$(date +%s)
    while [ "$(date +%s)" -lt "$end" ]; do
      turn=$((turn + 1))
      case $name in reader|text) some=400000 ;; program|forms|import) some=100000 ;; *) some=2000 ;; esac
      if FUZZ_JOURNAL=$build/found/$name.journal "$plain/tools/replay_$name" -s $turn -n $some \
           tests/fuzz/corpus/"$name"/* $(find "$corpus" -type f | shuf -n 1500) > "$build/$name.plain" 2>&1;  then
        count "$name" plain $some
      else
        echo "  $name: replay ended with $?, seed $turn: $build/found/$name.journal-$turn"
        cp "$build/found/$name.journal" "$build/found/$name.journal-$turn"
        bad=1
        break
      fi
    done
  fi
done
awk '{ sum[$1 " " $2] += $3 } END { for (k in sum) printf "all runs: %s %d\n", k, sum[k] }' "$build/executions" | sort
exit $bad
