#!/bin/sh
# Owns the check that the house stands: includes follow scripts/layers.list, and no object of the library has mutable globals (cli/ has
# one: a signal handler gets no context).
set -u
build=$1
cd "$(dirname "$0")/.." || exit 1

wrong_includes=$(awk '
  FILENAME == "scripts/layers.list" { if ($0 !~ /^#/ && split($0, part, ":") == 2) allowed[part[1]] = part[2]; next }
  /^[ \t]*#[ \t]*include[ \t]*"/ {
    header = $0; sub(/^[^"]*"/, "", header); sub(/".*/, "", header)
    folder = FILENAME; sub(/\/.*/, "", folder)
    if (!(folder in allowed)) next
    ok = index(header, folder "/") == 1
    n = split(allowed[folder], prefix, " ")
    for (i = 1; i <= n; i++) if (index(header, prefix[i]) == 1) ok = 1
    if (!ok) print FILENAME ":" FNR ": a file of " folder "/ may not include \"" header "\""
  }' scripts/layers.list $(find $(sed -n 's/^\([a-z]*\):.*/\1/p' scripts/layers.list) -name '*.[ch]'))

# Section sizes in hexadecimal; .data.rel.ro holds constants with addresses and is read-only once loaded.
globals=$(find "$build/obj" -path "$build/obj/cli" -prune -o -name "*.o" -print | sort | while read -r object; do
  objdump -t "$object" | awk -v object="$object" '
    NF >= 5 {
      for (i = 3; i < NF; i++)
        if ($i ~ /^\.(data|bss|tdata|tbss)(\.|$)/ && $i !~ /^\.data\.rel\.ro/ || $i == "*COM*")
          if ($(i + 1) !~ /^0+$/) print object ": mutable global " $NF " in " $i
    }'
done)

if [ -n "$wrong_includes$globals" ]; then
  [ -z "$wrong_includes" ] || echo "$wrong_includes"
  [ -z "$globals" ] || echo "$globals"
  exit 1
fi
echo "layers: every include follows the arrows; no mutable globals"
