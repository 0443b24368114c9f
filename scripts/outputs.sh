#!/bin/sh
# Owns the sums of all that a binary writes, for holding two builds to equal bytes: `sh scripts/outputs.sh VS > sums` on each, then diff.
# Every example, every workload of bench/kernel and the sheet of tests/cross, in FORMATS. A line: program, format, exit code, sum; and what was
# printed. A program that takes longer than PATIENCE (300) seconds is cut off.
set -u
vs=$(realpath "$1")
cd "$(dirname "$0")/.." || exit 1
formats=${FORMATS:-stl off glb x3d pov scad}
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
sum() { # NAME ARGUMENT...: runs the program once for all formats
  name=$1
  shift
  rm -rf "$work/out"
  mkdir "$work/out"
  outputs=
  for f in $formats; do outputs="$outputs -o $work/out/a.$f"; done
  timeout "${PATIENCE:-300}" "$vs" -q "$@" $outputs > "$work/out/printed" 2> "$work/out/told" < /dev/null
  code=$?
  sed -i "s|$work|OUT|g" "$work/out/printed" "$work/out/told"
  (cd "$work/out" && for f in *; do echo "$name $f $code $(md5sum < "$f" | cut -c-32)"; done)
}
for example in $(ls examples/*.vs examples/*/*.vs examples/*/*.gml examples/*/*.js); do sum "$example" "$example"; done
node bench/kernel/gen.mjs "$work/kernel" > /dev/null
for workload in "$work"/kernel/sx/*.sx; do
  cat bench/kernel/suite.vs "$workload" > "$work/model.vs"
  sum "bench/kernel/$(basename "$workload")" "$work/model.vs"
done
for variant in mixed rotated mirrored scaled cut hollow; do sum "tests/cross/$variant" tests/cross/sheet.vs -D variant=$variant; done
