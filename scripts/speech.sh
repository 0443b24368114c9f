#!/bin/sh
# Checks that texts keep the rules of plain speech (CONTRIBUTING.md). Compares the counts of manual, comments, messages and CHANGELOG with
# scripts/speech.limits, where a count may only shrink. Prints each count above its limit and ends with 1; names the limits that can be lowered.
#
#   sh scripts/speech.sh              check
#   sh scripts/speech.sh counts       print all counts, as scripts/speech.limits holds them
#   sh scripts/speech.sh list COUNT   print the sentences of that count with their places: sh scripts/speech.sh list manual-what
#   sh scripts/speech.sh pages        print the counts of each page of the manual
set -u
cd "$(dirname "$0")/.." || exit 1
export LC_ALL=C
folders=$(sed -n 's/^\([a-z]*\):.*/\1/p' scripts/layers.list)
files() { # KIND
  case $1 in
    manual) find manual README.md tests/README.md bench/README.md -name '*.md' ;;
    changes) echo CHANGELOG.md ;;
    *) find $folders -name '*.[ch]' -o -name '*.def' ;;
  esac | sort
}
counts() {
  for kind in manual comments messages changes; do files $kind | awk -v kind=$kind -f scripts/speech.awk; done
}
case ${1:-check} in
  counts) counts ;;
  list) files "${2%%-*}" | awk -v kind="${2%%-*}" -v list="$2" -f scripts/speech.awk ;;
  pages)
    files manual | while read -r page; do
      echo "$page" | awk -v kind=manual -f scripts/speech.awk | awk -v page="$page" '{ sub(/^manual-/, ""); text = text " " $0 } END { print page ":" text }'
    done ;;
  check)
    counts | awk '
      FILENAME == "scripts/speech.limits" { if ($0 !~ /^#/) { most[$1] = $2 } next }
      $1 == "manual-words" { next } # a new procedure needs words
      !($1 in most) { print $1 ": scripts/speech.limits has no limit"; wrong = 1; next }
      $2 > most[$1] { print $1 ": " $2 ", and scripts/speech.limits allows " most[$1] " (sh scripts/speech.sh list " $1 ")"; wrong = 1 }
      $2 < most[$1] && $1 != "manual-median" { better = better " " $1 " " $2 }
      END {
        if (!wrong && better != "") print "lower in scripts/speech.limits:" better
        exit wrong
      }' scripts/speech.limits - ;;
  *) echo "usage: sh scripts/speech.sh [counts | list COUNT | pages]" >&2; exit 2 ;;
esac
