#!/bin/sh
# Tests texts: a character of every class of Unicode in every text that a user gives, in every format of
# backends.def, every language of vs translate and the reports, and names of files that are not UTF-8 (tests/texts/).
# Installed programs that read such files judge them.
. tests/report.sh
case $ONLY in ""|texts*) ;; *) exit ;; esac
if ! command -v python3 > /dev/null; then echo "skip texts: no python3"; exit; fi
limited 300 env PYTHONDONTWRITEBYTECODE=1 python3 tests/texts/texts.py "$vs" "$work" "$ONLY" || echo "not ok texts: ended with $?"
