local function line(i) return '<point id="' .. tostring(i) .. '" x="' .. tostring(i * 17) .. '"/>' end
local function count(c, s)
  local found = 0
  for i = 1, #s do if s:byte(i) == c then found = found + 1 end end
  return found
end
local function round_trip()
  local lines = {}
  for i = 0, 1999 do lines[#lines + 1] = line(i) end
  local text = table.concat(lines)
  local letters = {}
  for i = 1, 5000 do letters[i] = text:sub(i, i) end
  return #text + count(55, text) + #letters
end
local sum = 0
for i = 1, 40 do sum = sum + round_trip() end
print(sum)
