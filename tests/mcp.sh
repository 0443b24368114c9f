#!/bin/sh
# Tests vs mcp with a client that speaks the protocol (tests/mcp/mcp.py): a recorded session, each tool, and what is
# wrong.
. tests/report.sh
case $ONLY in ""|mcp*) ;; *) exit ;; esac
if ! command -v python3 > /dev/null; then echo "skip mcp: no python3"; exit; fi
limited "${UNIT_SECONDS:-300}" env PYTHONDONTWRITEBYTECODE=1 python3 tests/mcp/mcp.py "$vs" "$work" "$ONLY" ||
  echo "not ok mcp: ended with $?"
