#!/bin/sh
# Runs the programs that attack the limits (a sample; LONG=1: all), the test of the rights of an untrusted
# model, outputs that run out of memory, and the inputs that fuzzers have found.
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
. tests/limited.sh
"$BUILD/tools/attack" "$BUILD/vs" tests/limits/attacks.txt "$folder" "$([ -n "${LONG:-}" ] && echo all || echo sample)" "${ATTACK:-}" || echo "not ok limits: ended with $?"
sh tests/untrusted.sh
sh tests/inputs.sh
sh tests/faults.sh
sh tests/memory.sh
for fuzzer in "$BUILD"/tools/replay_*; do
  [ -x "$fuzzer" ] || continue
  name=${fuzzer##*/replay_}
  if limited "$([ -n "${LONG:-}" ] && echo 3600 || echo 60)" "$fuzzer" -n "$([ -n "${LONG:-}" ] && echo 20000 || echo 100)" tests/fuzz/corpus/"$name"/* > "$folder/said" 2>&1; then echo "ok limits/fuzz-$name"; else echo "not ok limits/fuzz-$name: ended with $?"; tail -n 5 "$folder/said" | sed 's/^/    /'; fi
done
