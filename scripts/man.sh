#!/bin/sh
# Prints the manual page of the command, vs(1), made from cli/options.def, cli/commands.def and manual/command.md.
#
#   scripts/man.sh VERSION
set -u
cd "$(dirname "$0")/.." || exit 1
# The table's rows, each on one line.
rows() { sed -e ':again' -e '/^\(COMMAND\|OPTION\)(.*,$/{N;s/\n */ /;b again' -e '}' "$@"; }
day=$(date -u -r manual/command.md +%Y-%m-%d) # when what the page says last changed
{
  printf '.TH VS 1 %s "VisualScheme %s" "User Commands"\n.SH NAME\nvs \\- solid models from Scheme programs\n.SH SYNOPSIS\n' "$day" "${1:-}"
  printf '%s\n' '.B vs' '[\fIOPTION\fR ...] [\fIFILE\fR] [\fB\-o\fR \fIOUT\fR ...] [\fB\-\-\fR \fIARG\fR ...]'
  rows cli/commands.def | awk -F '"' '/^COMMAND\(/ { name = $1; sub(/^COMMAND\(/, "", name); sub(/,.*/, "", name); printf ".br\n\\fBvs %s\\fR%s\n", name, ($2 != "" ? " \\fI" $2 "\\fR" : "") }'
  echo '.SH DESCRIPTION'
  awk -v part=first -f scripts/man.awk manual/command.md
  echo '.SH COMMANDS'
  rows cli/commands.def | awk -F '"' 'function safe(s) { gsub(/\\/, "\\e", s); gsub(/-/, "\\-", s); return s }
    /^COMMAND\(/ { name = $1; sub(/^COMMAND\(/, "", name); sub(/,.*/, "", name); printf ".TP\n\\fB%s\\fR%s\n%s\n", name, ($2 != "" ? " \\fI" $2 "\\fR" : ""), safe($4) }'
  echo '.SH OPTIONS'
  rows cli/options.def | awk -F '"' 'function safe(s) { gsub(/\\/, "\\e", s); gsub(/-/, "\\-", s); return s }
    /^OPTION\(/ {
      letter = match($1, /\047.\047/) ? substr($1, RSTART + 1, 1) : ""
      if ($3 ~ /NONE/) { short_ = long_ = "" } else if ($3 ~ /OPTIONAL/) { short_ = "[\\fI" safe($4) "\\fR]"; long_ = "[=\\fI" safe($4) "\\fR]" } else { short_ = " \\fI" safe($4) "\\fR"; long_ = " \\fI" safe($4) "\\fR" }
      printf ".TP\n%s%s%s\n%s\n", (letter != "" ? "\\fB\\-" letter "\\fR" short_ : ""), (letter != "" && $2 != "" ? ", " : ""), ($2 != "" ? "\\fB\\-\\-" safe($2) "\\fR" long_ : ""), safe($6)
    }'
  awk -v part=rest -f scripts/man.awk manual/command.md
}
