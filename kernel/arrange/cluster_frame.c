/* Chooses the frame of a cluster: a linear map that most leaves share, so that their boxes are axis-parallel in it.
 *
 * The linear part of a leaf's placement is split into directions, mostly a rotation, and scales along the leaf's axes.
 * Two linear parts are equal if they agree to 1e-12 up to a signed permutation of axes. Thus a quarter turn, a mirror
 * image, and the same rotation computed in another way are equal. The frame is the most frequent of these linear parts.
 * Its leaves get exact permutations and scales, and only their translation is rotated. A linear part that shears is
 * also a possible frame, for leaves that all have it.
 *
 * Very thin plates have precedence. Rounding by half a step on either side changes the thickness of a plate and its
 * volume. In the plate's own frame its faces lie on the grid. Therefore the chosen frame is the frame with the largest
 * total area of such plates. Without plates, it is the most frequent frame. */
#include "kernel/arrange/cluster_frame.h"

#include "kernel/cluster.h"

#include <math.h>

enum { CANDIDATES = 64 };

/* A possible frame: directions r, their inverse `back`, and the length `unit` of a step along each axis. The number
 * `votes` counts the leaves with this frame; `plates` is the total area of the thin plates whose faces lie on its
 * grid. */
typedef struct { double r[3][3], back[3][3], unit[3]; double plates; uint32_t votes; } candidate;

/* Splits the linear part of a placement into the lengths of its columns (scale) and their directions (r). Returns false
 * if the columns nearly lie in one plane. */
static bool split(const vs_affine *a, double r[3][3], double scale[3]) {
  for (int j = 0; j < 3; j++) {
    int nonzero = 0;
    double one = 0;
    for (int i = 0; i < 3; i++)
      if (a->m[i][j] != 0) nonzero++, one = fabs(a->m[i][j]);
    scale[j] = nonzero == 1 ? one : sqrt(a->m[0][j] * a->m[0][j] + a->m[1][j] * a->m[1][j] + a->m[2][j] * a->m[2][j]);
    if (fabs(scale[j] - 1) < 1e-13) scale[j] = 1;
    if (!(scale[j] > 0) || !isfinite(scale[j])) return false;
    for (int i = 0; i < 3; i++) r[i][j] = a->m[i][j] / scale[j];
  }
  return true;
}

/* Computes the inverse of r. If the columns are orthogonal to 1e-12, the inverse is the transpose, and *rigid is set to
 * true. Returns false if the columns nearly lie in one plane, because such a frame would make the grid coarse. */
static bool invert(double r[3][3], double back[3][3], bool *rigid) {
  bool orthogonal = true;
  for (int j = 0; j < 3; j++) {
    int l = (j + 1) % 3;
    orthogonal = orthogonal && fabs(r[0][j] * r[0][l] + r[1][j] * r[1][l] + r[2][j] * r[2][l]) <= 1e-12;
  }
  *rigid = orthogonal;
  if (!orthogonal) {
    vs_affine a = vs_affine_identity(), inverse;
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++) a.m[i][j] = r[i][j];
    if (fabs(vs_affine_determinant(&a)) < 0.1 || !vs_affine_invert(&a, &inverse)) return false;
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++) back[i][j] = inverse.m[i][j];
    return true;
  }
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) back[i][j] = r[j][i];
  return true;
}

/* Sets p to back * r as an exact signed permutation of the axes. Returns false if back * r is not near such a
 * permutation. */
static bool permutation(double back[3][3], double r[3][3], double p[3][3]) {
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      double x = back[i][0] * r[0][j] + back[i][1] * r[1][j] + back[i][2] * r[2][j];
      double whole = floor(x + 0.5);
      if (fabs(x - whole) > 1e-12) return false;
      p[i][j] = whole;
    }
  return true;
}

/* Returns the area of the leaf, in world units, if it is a very thin plate with few triangles, else 0. */
static double plate_area(const vs_cluster *c, uint32_t leaf) {
  enum { FEW = 64 }; /* Greatest number of triangles of a thin plate. Round shapes have more triangles, and no frame has
                      * all their faces on the grid. */
  static const double THIN = 0x1p-10; /* Greatest ratio of a thin plate's volume to the 3/2 power of its area. A cube
                                       * has .068. */
  const vs_part *part = &c->parts->all.at[c->parts->of_leaf.at[leaf]];
  const vs_affine *a = &c->problem->leaves[leaf].placement;
  const vs_mesh *m = part->mesh;
  double area = 0;
  for (size_t t = 0; t < m->triangle_count; t++) {
    if (m->triangle_count > FEW) return 0;
    const uint32_t *v = m->triangles[t];
    vs_vec3 p = vs_v3_sub(m->vertices[v[1]], m->vertices[v[0]]), q = vs_v3_sub(m->vertices[v[2]], m->vertices[v[0]]);
    area += vs_v3_length(vs_v3_cross(vs_affine_vector(a, p), vs_affine_vector(a, q))) / 2;
  }
  return fabs(part->volume * vs_affine_determinant(a)) < THIN * area * sqrt(area) ? area : 0;
}

bool vs_frame_choose(vs_kernel *k, vs_cluster *c, vs_affine *to_frame) {
  candidate all[CANDIDATES] = {
    { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }, { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }, { 1, 1, 1 }, 0, 0 }
  };
  int count = 1, best = 0;
  double r[3][3], scale[3], p[3][3];
  for (uint32_t i = 0; i < c->leaf_count; i++) {
    if (!split(&c->problem->leaves[c->leaves[i]].placement, r, scale)) continue;
    int j = 0;
    while (j < count && !permutation(all[j].back, r, p)) j++;
    if (j == CANDIDATES) continue;
    if (j == count) {
      bool rigid;
      if (!invert(r, all[j].back, &rigid)) continue;
      double least = fmin(scale[0], fmin(scale[1], scale[2])), most = fmax(scale[0], fmax(scale[1], scale[2]));
      /* Leaves whose common linear part has a shear keep their coordinates unscaled. */
      for (int x = 0; x < 3; x++) all[j].unit[x] = rigid || most > 4 * least ? 1 : scale[x];
      for (int x = 0; x < 3; x++)
        for (int y = 0; y < 3; y++) all[j].r[x][y] = r[x][y];
      all[count].plates = 0;
      all[count++].votes = 0;
    }
    all[j].plates += plate_area(c, c->leaves[i]);
    all[j].votes++;
    if (!vs_kernel_poll(k, 0)) return false;
  }
  for (int j = 1; j < count; j++)
    if (all[j].plates > all[best].plates || (!(all[j].plates < all[best].plates) && all[j].votes > all[best].votes))
      best = j;

  candidate *f = &all[best];
  double det = f->r[0][0] * (f->r[1][1] * f->r[2][2] - f->r[1][2] * f->r[2][1]) -
               f->r[0][1] * (f->r[1][0] * f->r[2][2] - f->r[1][2] * f->r[2][0]) +
               f->r[0][2] * (f->r[1][0] * f->r[2][1] - f->r[1][1] * f->r[2][0]);
  c->grid.framed = best != 0;
  c->grid.frame = vs_affine_identity();
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      if (det < 0 && j == 2) f->r[i][j] = -f->r[i][j], f->back[j][i] = -f->back[j][i];
      c->grid.frame.m[i][j] = f->r[i][j] * f->unit[j];
    }
  for (uint32_t i = 0; i < c->leaf_count; i++) {
    const vs_affine *a = &c->problem->leaves[c->leaves[i]].placement;
    vs_affine *o = &to_frame[i];
    if (!vs_kernel_poll(k, 0)) return false;
    bool member = split(a, r, scale) && permutation(f->back, r, p);
    for (int x = 0; x < 3; x++)
      for (int y = 0; y < 4; y++) {
        if (member && y < 3) o->m[x][y] = p[x][y] * (scale[y] / f->unit[x]);
        else if (!c->grid.framed) o->m[x][y] = a->m[x][y];
        else
          o->m[x][y] = f->back[x][0] * a->m[0][y] + f->back[x][1] * a->m[1][y] + f->back[x][2] * a->m[2][y],
          o->m[x][y] /= f->unit[x];
      }
  }
  return true;
}

vs_vec3 vs_grid_world(const vs_grid *g, const vs_point *p) {
  double x[3];
  for (int i = 0; i < 3; i++) {
    double whole = (double)(p->fixed[i] >> VS_FIXED_BITS),
           part = (double)(p->fixed[i] & (((int64_t)1 << VS_FIXED_BITS) - 1)) / (double)(1 << VS_FIXED_BITS);
    x[i] = (whole + g->offset[i] + part) * g->unit / g->scale;
  }
  vs_vec3 v = vs_v3(x[0], x[1], x[2]);
  return g->framed ? vs_affine_point(&g->frame, v) : v;
}
