local sin, cos, xyz, add, distance = math.sin, math.cos, P.xyz, P.add, P.distance
local function translated(f, v) return function(t) return add(f(t), v) end end
local function scaled(f, s) return function(t) local p = f(t) return xyz(s * p.x, s * p.y, s * p.z) end end
local function apply(m, p)
  local x, y, z = p.x, p.y, p.z
  return xyz(m[1] * x + m[2] * y + m[3] * z + m[4], m[5] * x + m[6] * y + m[7] * z + m[8], m[9] * x + m[10] * y + m[11] * z + m[12])
end
local function transformed(f, m) return function(t) return apply(m, f(t)) end end
local function helix(r, pitch) return function(t) return xyz(r * cos(t), r * sin(t), pitch * t) end end
local path = translated(
  transformed(scaled(helix(3.0, .25), 1.5), { .8, -.6, 0.0, 1.0, .6, .8, 0.0, 2.0, 0.0, 0.0, 1.0, 3.0, 0.0, 0.0, 0.0, 1.0 }),
  xyz(10.0, 20.0, 30.0))
local function run(n)
  local p, length = path(0.0), 0.0
  for i = 0, n - 1 do
    local q = path(.0001 * (i + 1))
    p, length = q, length + distance(p, q)
  end
  return length
end
print(string.format("%.0f", 1000 * run(1000000)))
