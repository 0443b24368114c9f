#!/bin/sh
# Runs the measure of start-up: an empty program in vs, Lua, Guile and Chez Scheme, 50 runs each, milliseconds per run.
# `bench/startup.sh build/vs`.
set -u
vs=$1
empty=$(mktemp) || exit 1
trap 'rm -f "$empty"' EXIT
measure() {
  name=$1; shift
  if ! command -v "$1" >/dev/null 2>&1; then echo "$name: not installed"; return; fi
  "$@" > /dev/null 2>&1 || { echo "$name: failed"; return; }
  begin=$(date +%s%N); i=0
  while [ $i -lt 50 ]; do "$@" > /dev/null 2>&1; i=$((i + 1)); done
  end=$(date +%s%N)
  echo "$name $begin $end" | awk '{ printf "%-8s %6.2f ms\n", $1, ($3 - $2) / 50e6 }'
}
measure "true" /bin/true
measure vs "$vs" --quiet "$empty"
measure lua5.4 lua5.4 "$empty"
measure guile guile --no-auto-compile "$empty"
measure chez chezscheme --script "$empty"
