#!/bin/sh
# Runs the command tests. Each folder tests/cli/NAME contains `cmd` (a shell script; `vs` is on its PATH, and it runs in
# a copy of the folder) and the expected results: `stdout`, `stderr`, `code` (0 if absent), and the files below `want/`.
# If this machine cannot run it, cmd prints the reason to standard error and ends with 77. BLESS=1 rewrites the expected
# results.
set -u
. tests/report.sh
PATH=$BUILD:$PATH
export PATH TOP="$PWD"
for folder in tests/cli/*/; do
  [ -f "$folder/cmd" ] || continue
  name=cli/$(basename "$folder")
  case $name in *"$ONLY"*) ;; *) continue ;; esac
  rm -rf "$work/run" && cp -r "$folder" "$work/run"
  (cd "$work/run" && rm -rf want stdout stderr code && limited "${UNIT_SECONDS:-300}" sh ./cmd > "$work/stdout" 2> "$work/stderr" < /dev/null)
  status=$?
  if [ $status = 77 ]; then echo "skip $name: $(tail -n 1 "$work/stderr")"; continue; fi
  if [ -n "$BLESS" ]; then
    for stream in stdout stderr; do
      if [ -s "$work/$stream" ]; then cp "$work/$stream" "$folder/$stream"; else rm -f "$folder/$stream"; fi
    done
    if [ $status = 0 ]; then rm -f "$folder/code"; else echo $status > "$folder/code"; fi
    if [ -d "$folder/want" ]; then
      (cd "$folder/want" && find . -type f) | while read -r file; do cp "$work/run/$file" "$folder/want/$file"; done
    fi
    echo "ok $name (blessed)"
    continue
  fi
  : > "$work/why"
  code=0; [ ! -f "$folder/code" ] || code=$(cat "$folder/code")
  [ "$status" = "$code" ] || echo "ended with $status, not $code" >> "$work/why"
  for stream in stdout stderr; do
    want=$folder/$stream; [ -f "$want" ] || want=/dev/null
    diff -u "$want" "$work/$stream" > "$work/diff" || { echo "$stream differs:"; head -n 30 "$work/diff"; } >> "$work/why"
  done
  if [ -d "$folder/want" ]; then
    (cd "$folder/want" && find . -type f) | while read -r file; do
      cmp "$folder/want/$file" "$work/run/$file" 2>&1 | head -n 1 >> "$work/why"
    done
  fi
  if [ -s "$work/why" ]; then echo "not ok $name"; sed 's/^/    /' "$work/why"; else echo "ok $name"; fi
done
