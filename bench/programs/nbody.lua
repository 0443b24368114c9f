local sqrt, pi = math.sqrt, math.pi
local solar, year = 4 * pi * pi, 365.24
local function body(x, y, z, vx, vy, vz, m)
  return { x = x, y = y, z = z, vx = vx * year, vy = vy * year, vz = vz * year, m = m * solar }
end
local bodies = {
  body(0, 0, 0, 0, 0, 0, 1),
  body(4.84143144246472090, -1.16032004402742839, -.103622044471123109,
    .00166007664274403694, .00769901118419740425, -.0000690460016972063023, .000954791938424326609),
  body(8.34336671824457987, 4.12479856412430479, -.403523417114321381,
    -.00276742510726411190, .00499852801234917238, .0000230417297573763929, .000285885980666130812),
  body(12.8943695621391310, -15.1111514016986312, -.223307578892655734,
    .00296460137564761618, .00237847173959480950, -.0000296589568540237556, .0000436624404335156298),
  body(15.3796971148509165, -25.9193146099879641, .179258772950371181,
    .00268067772490389322, .00162824170038242295, -.0000951592254519715870, .0000515138902046611451),
}
local function advance(dt)
  for i = 1, 5 do
    local a = bodies[i]
    for j = i + 1, 5 do
      local b = bodies[j]
      local dx, dy, dz = a.x - b.x, a.y - b.y, a.z - b.z
      local d2 = dx * dx + dy * dy + dz * dz
      local mag = dt / (d2 * sqrt(d2))
      a.vx, a.vy, a.vz = a.vx - dx * b.m * mag, a.vy - dy * b.m * mag, a.vz - dz * b.m * mag
      b.vx, b.vy, b.vz = b.vx + dx * a.m * mag, b.vy + dy * a.m * mag, b.vz + dz * a.m * mag
    end
  end
  for i = 1, 5 do
    local a = bodies[i]
    a.x, a.y, a.z = a.x + dt * a.vx, a.y + dt * a.vy, a.z + dt * a.vz
  end
end
local function energy()
  local e = 0.0
  for i = 1, 5 do
    local a = bodies[i]
    e = e + .5 * a.m * (a.vx * a.vx + a.vy * a.vy + a.vz * a.vz)
    for j = i + 1, 5 do
      local b = bodies[j]
      local dx, dy, dz = a.x - b.x, a.y - b.y, a.z - b.z
      e = e - a.m * b.m / sqrt(dx * dx + dy * dy + dz * dz)
    end
  end
  return e
end
local px, py, pz = 0.0, 0.0, 0.0
for _, b in ipairs(bodies) do px, py, pz = px + b.vx * b.m, py + b.vy * b.m, pz + b.vz * b.m end
bodies[1].vx, bodies[1].vy, bodies[1].vz = -px / solar, -py / solar, -pz / solar
for i = 1, 40000 do advance(.01) end
print(string.format("%.0f", 1e9 * energy()))
