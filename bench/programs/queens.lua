local function safe(row, distance, placed)
  while placed do
    local p = placed[1]
    if p == row + distance or p == row - distance or p == row then return false end
    distance, placed = distance + 1, placed[2]
  end
  return true
end
local function queens(n, k, placed)
  if k == 0 then return 1 end
  local found = 0
  for row = 1, n do
    if safe(row, 1, placed) then found = found + queens(n, k - 1, { row, placed }) end
  end
  return found
end
print(queens(10, 10, nil))
