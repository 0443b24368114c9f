# Of an .off mesh a cloud of n points on the sides that a scanner at (-2 -9 1.6) may see, with errors of .005; the share `strays` of
# them in a tree before it. All turned by `degrees` about z, and tilted by `tilt` about x; moved by (3 -2 1) where `degrees` is not 0.
function u() { seed = (seed * 16807) % 2147483647; return seed / 2147483647 }
function g() { return sqrt(-2 * log(u())) * cos(6.2831853 * u()) }
BEGIN { seed = 4711; seen = at = 0 }
NR == 2 { points = $1; faces = $2; next }
NR > 2 && at < points { x[at] = $1; y[at] = $2; z[at++] = $3; next }
NR > 2 && NF >= 4 {
  a = $2; b = $3; c = $4; ux = x[b] - x[a]; uy = y[b] - y[a]; uz = z[b] - z[a]; vx = x[c] - x[a]; vy = y[c] - y[a]; vz = z[c] - z[a]
  nx = uy * vz - uz * vy; ny = uz * vx - ux * vz; nz = ux * vy - uy * vx
  if (nx * (-2 - x[a]) + ny * (-9 - y[a]) + nz * (1.6 - z[a]) <= 0) next
  A[seen] = a; B[seen] = b; C[seen] = c; sum += sqrt(nx * nx + ny * ny + nz * nz); S[seen++] = sum
}
END {
  print "ply\nformat ascii 1.0\nelement vertex " n "\nproperty float x\nproperty float y\nproperty float z\nend_header"
  p = degrees * 3.14159265 / 180; t = tilt * 3.14159265 / 180; away = degrees != 0
  for (i = 0; i < n; i++) {
    if (i < strays * n) { X = 6 + g(); Y = -3 + .8 * g(); Z = 2.6 + g() } else {
      w = u() * sum; f = 0; while (f < seen - 1 && S[f] < w) f++
      r = u(); s = u(); if (r + s > 1) { r = 1 - r; s = 1 - s }
      a = A[f]; b = B[f]; c = C[f]
      X = x[a] + r * (x[b] - x[a]) + s * (x[c] - x[a]) + .005 * g(); Y = y[a] + r * (y[b] - y[a]) + s * (y[c] - y[a]) + .005 * g()
      Z = z[a] + r * (z[b] - z[a]) + s * (z[c] - z[a]) + .005 * g()
    }
    Q = Y * cos(t) - Z * sin(t); R = Y * sin(t) + Z * cos(t)
    printf "%.5f %.5f %.5f\n", X * cos(p) - Q * sin(p) + 3 * away, X * sin(p) + Q * cos(p) - 2 * away, R + away
  }
}
