# Of the JSON of vs fit: is each parameter that `want` names ("height=5 foot=.8") as near as `within`, a share of it?
BEGIN { n = split(want, pair, " "); for (i = 1; i <= n; i++) { split(pair[i], part, "="); value[part[1]] = part[2] } }
/"name":/ {
  name = $0; sub(/.*"name": "/, "", name); sub(/".*/, "", name)
  found = $0; sub(/.*"value": /, "", found); sub(/,.*/, "", found)
  low = $0; sub(/.*"low": /, "", low); sub(/,.*/, "", low)
  high = $0; sub(/.*"high": /, "", high); sub(/[,}].*/, "", high)
  if (!(name in value)) next
  off = found / value[name] - 1; if (off < 0) off = -off
  print name, (off <= within ? "is near" : "is " found ", not " value[name]) (low <= found && found <= high ? "" : ", outside of its interval")
}
/"fits"/ { sub(/^ */, ""); print }
