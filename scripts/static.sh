#!/bin/sh
# Implements `make static`: prints the findings of cppcheck, clang's analyzer (scan-build's) and gcc -fanalyzer in the code that
# reads untrusted data: texts, files, requests. Every finding was read; scripts/static.known lists the false ones, a
# line each: TOOL FILE MESSAGE | why it is false. Fails if there is another finding, or if an installed tool cannot be
# run.
#
# usage: scripts/static.sh [TOOL...]   cppcheck clang gcc: only these
set -u
cd "$(dirname "$0")/.." || exit 1
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
layers="javascript vm model geometry/files geometry/text geometry/dynamic.c bind session live cli backends"
facing="languages/javascript/*.c vm/javascript/*.c vm/front/*.c vm/values/*.c vm/library/*.c bind/data.c bind/constructors/files.c
  bind/constructors/heights.c bind/constructors/letters.c bind/constructors/meshes.c geometry/files/*.c geometry/text/*.c
  geometry/dynamic.c geometry/fitting/scan_points.c live/*.c session/host.c session/visualscheme.c cli/confine.c cli/untrusted.c cli/limits.c"
flags="-std=c11 -D_POSIX_C_SOURCE=200809L -I. $(pkg-config --cflags freetype2 2>/dev/null) $(pkg-config --cflags-only-I OpenEXR 2>/dev/null)"
export flags LC_ALL=C

# Turns FILE:LINE:COLUMN: warning: MESSAGE into TOOL FILE MESSAGE: a finding stays the same when its line moves.
name() { sed -n "s/^\.\{0,1\}\/\{0,1\}\([a-z][^: ]*\.[ch]\):[0-9]*:[0-9]*: \(warning\|error\|portability\): \(.*\)/$1 \1 \3/p" | sort -u; }

: > "$work/found"
for tool in ${*:-cppcheck clang gcc}; do
  if ! command -v "$tool" >/dev/null 2>&1; then echo "skip static/$tool: not installed"; continue; fi
  case $tool in
  cppcheck)
    cppcheck --enable=warning,portability --quiet -j "${JOBS:-$(nproc)}" --std=c11 -I. -D_POSIX_C_SOURCE=200809L -D__GNUC__=12 \
      --suppress=missingIncludeSystem --template='{file}:{line}:{column}: {severity}: {message} [{id}]' $layers ;;
  clang)
    ls $facing | xargs -P "${JOBS:-$(nproc)}" -n 4 sh -c 'for f; do
      case $f in
      vm/front/expand.c|geometry/files/byte_scan.c|languages/javascript/script.c) layer= ;; # they define some of them
      languages/javascript/*) layer="-DANALYZED_SCRIPT -include scripts/analyzer.h" ;;
      geometry/files/*) layer="-DANALYZED_MODEL -DANALYZED_FILES -include scripts/analyzer.h" ;;
      vm/*) layer="-include scripts/analyzer.h" ;;
      live/*|cli/*) layer= ;;
      *) layer="-DANALYZED_MODEL -include scripts/analyzer.h" ;;
      esac
      clang --analyze -Xclang -analyzer-output=text $layer $flags "$f" || echo "$f:1:1: error: clang cannot read it"; done' sh ;;
  gcc)
    ls $facing | xargs -P "${JOBS:-$(nproc)}" -n 4 sh -c 'for f; do gcc -O1 -fanalyzer $flags -c "$f" -o /dev/null ||
      echo "$f:1:1: error: gcc cannot read it"; done' sh ;;
  esac > "$work/said" 2>&1
  name "$tool" < "$work/said" > "$work/$tool"
  cat "$work/$tool" >> "$work/found"
  echo "static/$tool: $(wc -l < "$work/$tool") findings"
done
sed -n 's/^\([^#|][^|]*[^ |]\) *| .*/\1/p' scripts/static.known | sort -u > "$work/known"
sort -u "$work/found" | grep -v -x -F -f "$work/known" > "$work/new"
if [ -s "$work/new" ]; then
  sed 's/^/not judged: /' "$work/new"
  exit 1
fi
echo "static: each is judged in scripts/static.known"
