#!/bin/sh
# Prints the checksums of all outputs of a binary, for comparing two builds byte by byte: `sh scripts/outputs.sh VS >
# sums` for each, then diff.
#
# Programs: every example, every workload of bench/kernel, and tests/cross: the sheet in each variant, its tree and each
# form of Appendix A. FORMATS: every row of backends.def that needs no worker. PROGRAMS=text selects those whose name
# contains the text, WHOLE=1 the large examples in full size.
#
# A line: program, file, exit codes, checksum; `printed` and `told` are the program's two streams, if it wrote to them.
# The last line has the number of programs. A program that takes more than PATIENCE (600) seconds of processor time is
# ended: its only line reports that, and the exit code of the script is 1.
set -u
vs=$(realpath "$1") || exit 2
cd "$(dirname "$0")/.." || exit 1
. tests/limited.sh
. tests/smaller.sh
patience=${PATIENCE:-600}
formats=${FORMATS:-$(sed -n 's/^VS_FORMAT(\([^,]*\), [^,]*, "[^"]*", NULL.*/\1/p' backends/backends.def)}
notations=${NOTATIONS-$(sed -n 's/^VS_NOTATION([^,]*, [^,]*, "\([^"]*\)", NULL.*/\1/p' backends/backends.def)}
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
programs=0 cut=0

run() { # FILE ARGUMENT...: runs the program in the empty folder out; its streams go to FILE.printed and FILE.told
  file=$1
  shift
  limited "$patience" "$vs" -q "$@" > "$work/out/$file.printed" 2> "$work/out/$file.told" < /dev/null
  code=$?
  sed -i "s|$work|OUT|g" "$work/out/$file.printed" "$work/out/$file.told"
  find "$work/out" -name "$file.*" -empty -delete
  [ $code -lt 124 ] || cut_off=1
}

sum() { # NAME ARGUMENT...: runs the program once for all formats, and once for each notation
  name=$1
  shift
  case $name in *"${PROGRAMS:-}"*) ;; *) return ;; esac
  rm -rf "$work/out"
  mkdir "$work/out"
  cut_off=
  outputs=
  for f in $formats; do outputs="$outputs -o $work/out/a.$f"; done
  # shellcheck disable=SC2086
  run formats "$@" $outputs
  codes=$code
  for n in $notations; do
    [ -n "$cut_off" ] || run "$n" "$@" --format "$n" -o "$work/out/$n"
    codes=$codes,$code
  done
  programs=$((programs + 1))
  if [ -n "$cut_off" ]; then
    cut=$((cut + 1))
    echo "$name cut off after $patience seconds"
    return
  fi
  (cd "$work/out" && for f in *; do echo "$name $f $codes $(md5sum < "$f" | cut -c-32)"; done)
}

whole() { [ -n "${WHOLE:-}" ] || smaller "$1"; }
# shellcheck disable=SC2046
for example in examples/*.vs examples/*/*.vs examples/*/*.gml examples/*/*.lsp examples/*/*.js; do sum "$example" "$example" $(whole "$example"); done

sheet=tests/cross/sheet.vs
for variant in $(sed -n 's/^(define-parameter variant .*(\(.*\)))$/\1/p' $sheet | tr -d '"'); do
  sum "tests/cross/$variant" $sheet -D variant="$variant"
done
sum tests/cross/tree $sheet -D task=tree
cat > "$work/appendix.vs" <<'VS'
(define-syntax entry
  (syntax-rules ()
    ((_ name form measure value) (draw (layer name form)))))
(load "tests/cross/appendix-a.vs")
VS
sum tests/cross/appendix-a -L . "$work/appendix.vs"

node bench/kernel/gen.mjs "$work/kernel" > /dev/null || exit 1
for workload in "$work"/kernel/sx/*.sx; do
  cat bench/kernel/suite.vs "$workload" > "$work/model.vs"
  sum "bench/kernel/$(basename "$workload" .sx)" "$work/model.vs"
done
echo "$programs programs, $cut cut off"
[ $cut = 0 ]
