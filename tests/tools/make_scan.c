/* Makes scans for the tests of vs fit: points of a mesh as a scanner would record them. Equal arguments give equal
 * points.
 *
 * `make_scan MESH.off POINTS NOISE MISSING TILT [FORM]` writes a PLY file to standard output: POINTS points spread
 * evenly over the mesh. The scan omits a sector around the vertical axis through the middle of the mesh's box; MISSING
 * is the sector's fraction of a full turn (0 to 1). Each coordinate of a point gets a normally distributed error with
 * the standard deviation NOISE. Then all points are rotated by TILT degrees about (0.6 0.8 0.3) and moved by (12 -7 3).
 *
 * FORM: ascii, little (binary, the default), big, or damaged. `damaged` is `little` with a dent: a tenth of the box at
 * its middle is pressed in by a twentieth. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static uint64_t state = UINT64_C(88172645463325252);
static double share(void) {
  state ^= state << 13, state ^= state >> 7, state ^= state << 17;
  return (double)(state >> 11) * 0x1p-53;
}
/* Returns a normally distributed random number (G. Box, M. Muller, 1958). */
static double normal(void) { return sqrt(-2 * log(1 - share())) * cos(2 * acos(-1) * share()); }

static void put_float(float x, int big) {
  unsigned char b[4], r[4];
  memcpy(b, &x, 4);
  for (int i = 0; i < 4; i++) r[i] = b[big ? 3 - i : i];
  fwrite(r, 1, 4, stdout);
}

int main(int argc, char **argv) {
  if (argc < 6) return fputs("make_scan MESH.off POINTS NOISE MISSING TILT [ascii|little|big|damaged]\n", stderr), 2;
  const char *form = argc > 6 ? argv[6] : "little";
  long wanted = atol(argv[2]);
  double noise = atof(argv[3]), missing = atof(argv[4]), tilt = atof(argv[5]) * acos(-1) / 180;
  FILE *f = fopen(argv[1], "r");
  char word[64];
  size_t points, faces, edges;
  if (!f || fscanf(f, "%63s %zu %zu %zu", word, &points, &faces, &edges) != 4)
    return fputs("make_scan: no OFF file\n", stderr), 2;
  double(*at)[3] = malloc((points + 1) * sizeof *at), *sums = malloc((faces + 1) * sizeof *sums), area = 0;
  uint32_t(*t)[3] = malloc((faces + 1) * sizeof *t);
  double low[3] = { 1e300, 1e300, 1e300 }, high[3] = { -1e300, -1e300, -1e300 }, middle[3];
  if (!at || !sums || !t) return 2;
  for (size_t i = 0; i < points; i++)
    for (int k = 0; k < 3; k++) {
      if (fscanf(f, "%lf", &at[i][k]) != 1) return 2;
      low[k] = fmin(low[k], at[i][k]), high[k] = fmax(high[k], at[i][k]);
    }
  for (int k = 0; k < 3; k++) middle[k] = (low[k] + high[k]) / 2;
  for (size_t i = 0; i < faces; i++) {
    if (fscanf(f, "%*u %u %u %u", &t[i][0], &t[i][1], &t[i][2]) != 3) return 2;
    const double *a = at[t[i][0]], *b = at[t[i][1]], *c = at[t[i][2]];
    double u[3] = { b[0] - a[0], b[1] - a[1], b[2] - a[2] }, v[3] = { c[0] - a[0], c[1] - a[1], c[2] - a[2] };
    double x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2], z = u[0] * v[1] - u[1] * v[0];
    sums[i] = area += sqrt(x * x + y * y + z * z);
  }
  fclose(f);
  int ascii = !strcmp(form, "ascii"), big = !strcmp(form, "big"), damaged = !strcmp(form, "damaged");
  printf("ply\nformat %s 1.0\nelement vertex %ld\nproperty float x\nproperty float y\nproperty float z\nend_header\n",
         ascii ? "ascii"
         : big ? "binary_big_endian"
               : "binary_little_endian",
         wanted);
  double axis[3] = { .6, .8, .3 }, length = sqrt(1.09), c = cos(tilt), s = sin(tilt);
  double bite = .1 * sqrt(pow(high[0] - low[0], 2) + pow(high[1] - low[1], 2) + pow(high[2] - low[2], 2));
  for (int k = 0; k < 3; k++) axis[k] /= length;
  for (long n = 0; n < wanted;) {
    double place = share() * area, u = share(), v = share();
    size_t a = 0, b = faces;
    while (a < b) {
      size_t m = (a + b) / 2;
      if (sums[m] < place)
        a = m + 1;
      else
        b = m;
    }
    if (u + v > 1) u = 1 - u, v = 1 - v;
    double p[3], q[3];
    for (int k = 0; k < 3; k++)
      p[k] = at[t[a][0]][k] + u * (at[t[a][1]][k] - at[t[a][0]][k]) + v * (at[t[a][2]][k] - at[t[a][0]][k]);
    double angle = atan2(p[1] - middle[1], p[0] - middle[0]) / (2 * acos(-1)) + .5;
    if (angle < missing) continue;
    double near =
        damaged ? sqrt(pow(p[0] - high[0], 2) + pow(p[1] - middle[1], 2) + pow(p[2] - middle[2], 2)) : 2 * bite;
    for (int k = 0; k < 2; k++)
      if (near < bite) p[k] += (middle[k] - p[k]) * .2 * (1 - near / bite);
    for (int k = 0; k < 3; k++) p[k] += noise * normal();
    double dot = axis[0] * p[0] + axis[1] * p[1] + axis[2] * p[2];
    for (int k = 0; k < 3; k++) {
      double cross = axis[(k + 1) % 3] * p[(k + 2) % 3] - axis[(k + 2) % 3] * p[(k + 1) % 3];
      q[k] = p[k] * c + cross * s + axis[k] * dot * (1 - c);
    }
    q[0] += 12, q[1] -= 7, q[2] += 3;
    if (ascii)
      printf("%.6g %.6g %.6g\n", q[0], q[1], q[2]);
    else
      for (int k = 0; k < 3; k++) put_float((float)q[k], big);
    n++;
  }
  free(at), free(sums), free(t);
  return ferror(stdout) != 0;
}
