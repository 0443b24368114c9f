local xyz, sub, cross, dot, unitize = P.xyz, P.sub, P.cross, P.dot, P.unitize
local origin = xyz(0.0, 0.0, 0.0)
local function on_sphere(p) return P.add(origin, unitize(sub(p, origin))) end
local function middle(a, b) return on_sphere(P.intermediate(a, b, .5)) end
local function divide(a, b, c, depth, visit)
  if depth == 0 then return visit(a, b, c) end
  local ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
  divide(a, ab, ca, depth - 1, visit)
  divide(ab, b, bc, depth - 1, visit)
  divide(ca, bc, c, depth - 1, visit)
  divide(ab, bc, ca, depth - 1, visit)
end
local function run(depth)
  local area, volume = 0.0, 0.0
  local function visit(a, b, c)
    local n = cross(sub(b, a), sub(c, a))
    area = area + P.vlength(n) / 2
    volume = volume + dot(sub(a, origin), n) / 6
  end
  local x, y, z, mx, my, mz = xyz(1.0, 0.0, 0.0), xyz(0.0, 1.0, 0.0), xyz(0.0, 0.0, 1.0), xyz(-1.0, 0.0, 0.0), xyz(0.0, -1.0, 0.0), xyz(0.0, 0.0, -1.0)
  divide(x, y, z, depth, visit); divide(y, mx, z, depth, visit); divide(mx, my, z, depth, visit); divide(my, x, z, depth, visit)
  divide(y, x, mz, depth, visit); divide(mx, y, mz, depth, visit); divide(my, mx, mz, depth, visit); divide(x, my, mz, depth, visit)
  return area + volume
end
print(string.format("%.0f", 1000000 * run(7)))
