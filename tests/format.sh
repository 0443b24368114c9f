#!/bin/sh
# Tests vs format on every program of the repository and on generated ones: a second run changes nothing, the data stay
# equal, the comments stay in order, and blanks of the author have no effect (tests/format/format.py). LONG=1: 10000
# generated programs; else 300.
. tests/report.sh
case $ONLY in ""|format*) ;; *) exit ;; esac
if ! command -v python3 > /dev/null; then echo "skip format: no python3"; exit; fi
count=300 seconds=300
[ -z "${LONG:-}" ] || count=10000 seconds=3000
limited "${UNIT_SECONDS:-$seconds}" env PYTHONDONTWRITEBYTECODE=1 \
  python3 tests/format/format.py "$vs" "$work" "$ONLY" "$count" ||
  echo "not ok format: ended with $?"
