#!/bin/sh
# Tests the commands of a programmer's desk: vs profile, vs new, vs add, vs jupyter (tests/desk/*.py).
. tests/report.sh
if ! command -v python3 > /dev/null; then echo "skip desk: no python3"; exit; fi
for part in tests/desk/*.py; do
  python=python3; case $part in */jupyter.py) [ ! -x /usr/bin/python3 ] || python=/usr/bin/python3 ;; esac
  name=desk/$(basename "$part" .py)
  case $name in *"$ONLY"*) ;; *) case $ONLY in "$name"*) ;; *) continue ;; esac ;; esac
  mkdir -p "$work/$(basename "$part" .py)"
  limited "${UNIT_SECONDS:-300}" env PYTHONDONTWRITEBYTECODE=1 $python "$part" "$vs" "$work/$(basename "$part" .py)" "$ONLY" ||
    echo "not ok $name: ended with $?"
done
