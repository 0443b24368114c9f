local function list(...)
  local l = nil
  for i = select("#", ...), 1, -1 do l = { (select(i, ...)), l } end
  return l
end
local function map(f, l) if l == nil then return nil end return { f(l[1]), map(f, l[2]) } end
local function deriv(a)
  if type(a) ~= "table" then return a == "x" and 1 or 0 end
  local op = a[1]
  if op == "+" then return { "+", map(deriv, a[2]) } end
  if op == "-" then return { "-", map(deriv, a[2]) } end
  if op == "*" then return list("*", a, { "+", map(function(b) return list("/", deriv(b), b) end, a[2]) }) end
  local u, v = a[2][1], a[2][2][1]
  return list("-", list("/", deriv(u), v), list("/", u, list("*", v, v, deriv(v))))
end
local function size(a) if type(a) == "table" then return 1 + size(a[1]) + size(a[2]) end return 1 end
local polynomial = list("+", list("*", 3, "x", "x"), list("*", "a", "x", "x"), list("*", "b", "x"), 5)
local sum = 0
for i = 1, 100000 do sum = sum + size(deriv(polynomial)[2]) end
print(sum)
