#!/bin/sh
# Tests the language: runs every tests/lang/*.vs and compares the result with the expectations in its comments.
#
#   ; expect: TEXT            the program prints exactly these lines, in this order
#   ; expect error: TEXT      an error at this line of the file whose message contains TEXT; exit code 1
#   ; expect warning: TEXT    a warning at this line whose message contains TEXT
#   ; expect error 12: TEXT   the same at line 12 (also `warning 12`)
#   ; expect no other warnings
#   ; args: -O0               further arguments of vs
# Without an expected error the program must end with 0.
set -u
. tests/report.sh
for script in tests/lang/*.vs tests/lang/*/*.vs; do
  [ -f "$script" ] || continue
  name=${script#tests/}
  case $name in *"$ONLY"*) ;; *) continue ;; esac
  case $script in tests/lang/*/lib/*|tests/lang/lib/*) continue ;; esac
  args=$(sed -n 's/^; args: //p' "$script")
  # shellcheck disable=SC2086
  limited "${UNIT_SECONDS:-60}" "$BUILD/vs" --quiet $args "$script" > "$work/out" 2> "$work/err" < /dev/null
  status=$?
  awk -v script="$script" -v status="$status" -v errors="$work/err" -v output="$work/out" '
    function contains_at(kind, line, text,   i, prefix) {
      prefix = script ":" line ":"
      for (i = 1; i <= said; i++)
        if (index(message[i], prefix) == 1 && index(message[i], text) && (kind == "error" || index(message[i], "warning: "))) { known[i] = 1; return 1 }
      return 0
    }
    BEGIN {
      while ((getline line < errors) > 0) message[++said] = line
      while ((getline line < output) > 0) printed[++lines] = line
    }
    match($0, /; expect: ?/) { wanted[++wants] = substr($0, RSTART + RLENGTH); next }
    /; expect no other warnings/ { closed = 1; checks++ }
    match($0, /; expect (error|warning)( [0-9]+)?: /) {
      head = substr($0, RSTART, RLENGTH); text = substr($0, RSTART + RLENGTH)
      kind = head ~ /error/ ? "error" : "warning"
      at = FNR; if (match(head, /[0-9]+/)) at = substr(head, RSTART, RLENGTH)
      if (kind == "error") failing = 1
      checks++
      if (!contains_at(kind, at, text)) trouble[++troubles] = "no " kind " at line " at " saying: " text
    }
    END {
      if (status + 0 != (failing ? 1 : 0)) trouble[++troubles] = "ended with " status
      for (i = 1; i <= wants || i <= lines; i++)
        if (wanted[i] != printed[i] || i > wants || i > lines) {
          trouble[++troubles] = "printed line " i ": wanted `" wanted[i] "`, got `" printed[i] "`"
          if (++shown == 8) break
        }
      for (i = 1; closed && i <= said; i++)
        if (index(message[i], script ":") == 1 && index(message[i], ": warning: ") && !known[i]) trouble[++troubles] = "not expected: " message[i]
      if (!troubles && wants + checks == 0) trouble[++troubles] = "expects nothing: it cannot fail"
      name = script; sub(/^tests\//, "", name)
      if (!troubles) { print "ok " name; exit }
      print "not ok " name
      for (i = 1; i <= troubles; i++) print "    " trouble[i]
      for (i = 1; i <= said && i <= 12; i++) print "    stderr: " message[i]
    }' "$script"
done
