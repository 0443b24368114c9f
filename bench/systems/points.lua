-- The points and gvectors of the language that the geometry programs use, as tables.
local sqrt = math.sqrt
local P = {}
function P.xyz(x, y, z) return { x = x, y = y, z = z } end
local xyz = P.xyz
function P.add(a, b) return xyz(a.x + b.x, a.y + b.y, a.z + b.z) end
function P.sub(a, b) return xyz(a.x - b.x, a.y - b.y, a.z - b.z) end
function P.dot(a, b) return a.x * b.x + a.y * b.y + a.z * b.z end
function P.cross(a, b) return xyz(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x) end
function P.vlength(v) return sqrt(v.x * v.x + v.y * v.y + v.z * v.z) end
function P.unitize(v) local l = P.vlength(v) return xyz(v.x / l, v.y / l, v.z / l) end
function P.distance(p, q) return P.vlength(P.sub(q, p)) end
function P.intermediate(p, q, t) return xyz(p.x + t * (q.x - p.x), p.y + t * (q.y - p.y), p.z + t * (q.z - p.z)) end
function P.cyl(p, rho, phi, z) return xyz(p.x + rho * math.cos(phi), p.y + rho * math.sin(phi), p.z + z) end
