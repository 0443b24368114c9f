#!/bin/sh
# Tests vs lsp with a client that speaks the protocol: each answer, positions in UTF-16, edits of every kind, and
# messages that are wrong (tests/lsp/lsp.py).
. tests/report.sh
case $ONLY in ""|lsp*) ;; *) exit ;; esac
if ! command -v python3 > /dev/null; then echo "skip lsp: no python3"; exit; fi
limited "${UNIT_SECONDS:-300}" env PYTHONDONTWRITEBYTECODE=1 python3 tests/lsp/lsp.py "$vs" "$work" "$ONLY" ||
  echo "not ok lsp: ended with $?"
