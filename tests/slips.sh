#!/bin/sh
# Tests slips: each is answered with its place, its cause and what to write, and vs check finds it without
# running where the contracts know (tests/slips/). SCORE=1 prints the counts.
. tests/report.sh
case $ONLY in ""|slips*) ;; *) exit ;; esac
if ! command -v python3 > /dev/null; then echo "skip slips: no python3"; exit; fi
limited 300 env PYTHONDONTWRITEBYTECODE=1 python3 tests/slips/slips.py "$vs" "$work" "$ONLY" || echo "not ok slips: ended with $?"
