#!/bin/sh
# Owns the runs of the programs that attack the limits: a sample; LONG=1 all of them.
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
"$BUILD/tools/attack" "$BUILD/vs" tests/limits/attacks.txt "$folder" "$([ -n "${LONG:-}" ] && echo all || echo sample)" "${ATTACK:-}" || echo "not ok limits: ended with $?"
