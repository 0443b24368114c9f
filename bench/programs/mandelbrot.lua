local function turns(cx, cy, limit)
  local x, y, n = 0.0, 0.0, 0
  while true do
    local xx, yy = x * x, y * y
    if n == limit or xx + yy > 4.0 then return n end
    x, y, n = xx - yy + cx, 2.0 * x * y + cy, n + 1
  end
end
local function picture(size, limit)
  local step, sum = 3.0 / size, 0
  for j = 0, size - 1 do
    for i = 0, size - 1 do sum = sum + turns(-2.0 + step * i, -1.5 + step * j, limit) end
  end
  return sum
end
print(picture(300, 100))
