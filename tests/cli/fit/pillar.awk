# A cloud of n points of a pillar, 5 high, .8 at its foot and .55 at its neck, seen from three fifths of all sides, with normal errors
# of .008, tilted by .3 and moved.
function u() { seed = (seed * 16807) % 2147483647; return seed / 2147483647 }
function g() { return sqrt(-2 * log(u())) * cos(6.2831853 * u()) }
BEGIN {
  seed = 4711
  print "ply\nformat ascii 1.0\nelement vertex " n + bad "\nproperty float x\nproperty float y\nproperty float z\nend_header"
  for (i = 0; i < bad; i++) print "nan nan nan"
  for (i = 0; i < n; i++) {
    a = 3.8 * u(); z = 5 * u(); r = .8 - .25 * z / 5; k = u()
    if (k < .1) { r = .8 * sqrt(u()); z = 0 } else if (k < .15) { r = .55 * sqrt(u()); z = 5 }
    x = r * cos(a) + .008 * g(); y = r * sin(a) + .008 * g(); z += .008 * g(); c = cos(.3); s = sin(.3)
    printf "%.5f %.5f %.5f\n", x + 4, y * c - z * s - 2, y * s + z * c
  }
}
