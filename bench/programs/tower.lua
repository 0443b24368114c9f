local pi, cos, xyz, sub, add, cross = math.pi, math.cos, P.xyz, P.sub, P.add, P.cross
local function section(z, turn, radius, n)
  local v = {}
  for i = 0, n - 1 do
    local a = turn + 2 * pi * i / n
    v[i] = P.cyl(xyz(0.0, 0.0, z), radius * (1.0 + .2 * cos(3 * a)), a, 0.0)
  end
  return v
end
local function facet(a, b, c) return cross(sub(b, a), sub(c, a)) end
local function band(lower, upper, n, visit)
  for i = 0, n - 1 do
    local j = i + 1 == n and 0 or i + 1
    local a, b, c, d = lower[i], lower[j], upper[j], upper[i]
    visit(facet(a, b, c))
    visit(facet(a, c, d))
  end
end
local function tower(storeys, n)
  local area, up, lower = 0.0, xyz(0.0, 0.0, 0.0), section(0.0, 0.0, 20.0, n)
  for k = 1, storeys do
    local z = 3.5 * k
    local upper = section(z, .01 * z, 20.0 - .05 * z, n)
    band(lower, upper, n, function(normal)
      area = area + P.vlength(normal) / 2
      up = add(up, P.unitize(normal))
    end)
    lower = upper
  end
  return area + up.z
end
print(string.format("%.0f", 1000 * tower(400, 200)))
