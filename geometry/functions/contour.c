/* Implements dual contouring (contour.h).
 *
 * Plan. The box, with a margin of half a cell, is a grid of cubic cells. The value there is the larger of the tape's
 * and of the distance to the box's inside: everything on the grid's border is outside, and the mesh closes.
 *   1. The search for blocks of 8 x 8 x 8 cells starts from the whole grid. Where the bounds of the value (enclosure.h)
 *      do not contain 0, it skips the block. The others are sampled.
 *   2. A cell whose corners differ in sign is kept, with the edges at its lowest corner that the surface crosses. On
 *      each of those edges the root and its gradient are computed.
 *   3. The crossed edges of a cell, joined through its faces, make one ring or several; each is a piece of the surface
 *      and gets its own point. If a face has four crossings and both cells have them on one ring, the face is joined
 *      the other way, which separates both rings: otherwise two sheets would share an edge (R. Wenger, Isosurfaces,
 *      2013, chapter 3).
 *   4. A ring's point is the best intersection of the planes through its crossings (T. Ju and others, Dual contouring
 *      of Hermite data, 2002), limited to the cell: edges and corners stay sharp. Then the surface is sampled once more
 *      beside that point; this finds curved edges, too.
 *   5. Each crossed edge becomes a face between the four rings around it, cut along the diagonal that passes nearer to
 *      the crossing.
 *   6. Where the surface is flat enough, cells are merged to larger ones of an octree (octree.h), and the faces are
 *      made again from the remaining rings.
 *
 * Notation. Corner c of a cell lies at (c & 1, c >> 1 & 1, c >> 2). Edge 4 a + s of a cell runs along axis a; the two
 * bits of s are its position along the next two axes. Face 2 a + s is perpendicular to axis a, low or high. */
#include "geometry/functions/contour.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/functions/enclosure.h"
#include "geometry/functions/octree.h"
#include "geometry/functions/sampling.h"
#include "model/store/array.h"

/* FLAT: a point lies in a plane if its distance from the plane is less than this fraction of a cell. */
#define FLAT 1e-4

enum { BLOCK = 8, CORNERS = (BLOCK + 1) * (BLOCK + 1) * (BLOCK + 1), NONE = -1, TURNS = 40 };

typedef struct {
  int32_t at[3];
  uint8_t below;   /* signs at the cell's corners: bit c is set if the value at corner c is below 0 */
  uint8_t flips;   /* bit f is set if face f of the cell has four crossings that are joined in the second of two
                    * possible ways (step 3 of the plan) */
  bool sharp;      /* true if the cell contains a sharp edge or corner of the surface */
  uint32_t rings;  /* two bits for each edge of the cell: the number of the ring (piece of the surface) that contains
                    * the edge's crossing */
  uint32_t first;  /* index of the point of the cell's first ring (piece of the surface); the points of its other rings
                    * follow */
  int32_t edge[3]; /* edge[a]: index of the edge along axis a that begins at the cell's lowest corner; NONE if the
                    * surface does not cross this edge */
} cell;

typedef struct {
  uint32_t cell;
  uint8_t axis;
  bool rises; /* true if the function's value rises from below 0 to above 0 along the edge */
  double v0, v1;
} crossing;

typedef struct {
  const vs_tape *t; /* the function's tape combined with the box: its value is the larger of the function's value and of
                     * the distance to the box's inside */
  vs_sampler *values, *slopes;
  double origin[3], size;
  int32_t n[3]; /* number of cells of the grid along each axis */
  double p[3], q[3];
  cell *cells;
  size_t cell_count, cell_room;
  uint32_t *index; /* hash table that maps the position of a cell to its index plus 1 */
  size_t slots, slot_room;
  crossing *edges;
  size_t edge_count, edge_room;
  vs_vec3 *roots, *normals; /* roots[i], normals[i]: point where the surface crosses edge i, and the surface's normal
                             * there */
  size_t root_room, normal_room;
  uint32_t (*around)[4]; /* around[i]: indices of the four points around edge i, counter-clockwise as seen from its end
                          * where the value is above 0 */
  size_t around_room;
  vs_enclosure *work;
  size_t work_room;
  vs_long_work host;
  vs_contour *out;
} contour;

void vs_contour_free(vs_contour *c) {
  free(c->points);
  free(c->triangles);
  *c = (vs_contour){ 0 };
}

static double place(const contour *c, int axis, int32_t i) { return c->origin[axis] + c->size * i; }

/* ---- the tape, combined with the box ---- */

static vs_tape *boxed(const vs_tape *t, const double *p, const double *q) {
  vs_tape *c = vs_tape_compact(t);
  if (!c) return NULL;
  uint32_t all = c->output[0];
  for (uint32_t a = 0; a < 3; a++) {
    uint32_t x = vs_tape_input(c, a);
    all = vs_tape_add(c, VS_TAPE_MAX, all, vs_tape_add(c, VS_TAPE_SUB, vs_tape_constant(c, p[a]), x, 0), 0);
    all = vs_tape_add(c, VS_TAPE_MAX, all, vs_tape_add(c, VS_TAPE_SUB, x, vs_tape_constant(c, q[a]), 0), 0);
  }
  if (all == UINT32_MAX) return vs_tape_free(c), NULL;
  c->output[0] = all, c->outputs = 1;
  return c;
}

/* ---- blocks of cells ---- */

static vs_contour_outcome block(contour *c, const int32_t *from) {
  double x[3][CORNERS], v[CORNERS];
  int32_t size[3], corners[3];
  for (int a = 0; a < 3; a++) {
    size[a] = c->n[a] - from[a] < BLOCK ? c->n[a] - from[a] : BLOCK;
    corners[a] = size[a] + 1;
  }
  int count = 0;
  for (int32_t k = 0; k < corners[2]; k++)
    for (int32_t j = 0; j < corners[1]; j++)
      for (int32_t i = 0; i < corners[0]; i++, count++)
        x[0][count] = place(c, 0, from[0] + i), x[1][count] = place(c, 1, from[1] + j),
        x[2][count] = place(c, 2, from[2] + k);
  vs_sample(c->values, (const double *const[]){ x[0], x[1], x[2] }, (size_t)count, (double *const[]){ v });
  for (int i = 0; i < count; i++) {
    if (v[i] == v[i]) continue;
    bool outside = false;
    for (int a = 0; a < 3; a++) outside = outside || x[a][i] < c->p[a] || x[a][i] > c->q[a];
    if (!outside) return c->out->at = vs_v3(x[0][i], x[1][i], x[2][i]), VS_CONTOUR_NO_NUMBER;
    v[i] = INFINITY;
  }
  int row = corners[0], layer = corners[0] * corners[1];
  for (int32_t k = 0; k < size[2]; k++)
    for (int32_t j = 0; j < size[1]; j++)
      for (int32_t i = 0; i < size[0]; i++) {
        const double *corner = v + k * layer + j * row + i;
        const int step[3] = { 1, row, layer };
        unsigned below = 0;
        for (int b = 0; b < 8; b++)
          below |= (unsigned)(corner[(b & 1) + (b >> 1 & 1) * row + (b >> 2) * layer] < 0) << b;
        if (below == 0 || below == 255) continue;
        if (!VS_GROW(c->cells, c->cell_room, c->cell_count + 1)) return VS_CONTOUR_MEMORY;
        cell *made = &c->cells[c->cell_count++];
        *made = (cell){ .at = { from[0] + i, from[1] + j, from[2] + k },
                        .below = (uint8_t)below,
                        .edge = { NONE, NONE, NONE } };
        for (int a = 0; a < 3; a++) {
          if ((below & 1) == (below >> (1 << a) & 1)) continue;
          if (c->out->most && 2 * (c->edge_count + 1) > c->out->most) return VS_CONTOUR_MANY; /* each edge that the
                                                                                               * surface crosses becomes
                                                                                               * two triangles of the
                                                                                               * mesh */
          if (!VS_GROW(c->edges, c->edge_room, c->edge_count + 1)) return VS_CONTOUR_MEMORY;
          made->edge[a] = (int32_t)c->edge_count;
          c->edges[c->edge_count++] =
              (crossing){ (uint32_t)c->cell_count - 1, (uint8_t)a, below & 1, corner[0], corner[step[a]] };
        }
      }
  return VS_CONTOUR_DONE;
}

typedef struct {
  int32_t from[3], to[3];
} span; /* a box of blocks (of 8 by 8 by 8 cells): along each axis, a range of block numbers */

/* Visits all blocks of cells that may contain a crossing of the surface. It divides the grid into smaller and smaller
 * boxes, and skips boxes without a crossing. */
static vs_contour_outcome blocks(contour *c) {
  span *todo = NULL;
  size_t count = 1, room = 0, looked = 0;
  vs_contour_outcome outcome = VS_CONTOUR_DONE;
  if (!VS_GROW(todo, room, 1)) return VS_CONTOUR_MEMORY;
  todo[0] = (span){ { 0, 0, 0 }, { 0, 0, 0 } };
  double whole = 1, done = 0;
  for (int a = 0; a < 3; a++) todo[0].to[a] = (c->n[a] + BLOCK - 1) / BLOCK, whole *= todo[0].to[a];
  while (outcome == VS_CONTOUR_DONE && count) {
    span s = todo[--count];
    vs_enclosure in[3];
    double blocks_in = 1;
    int longest = 0;
    for (int a = 0; a < 3; a++) {
      int32_t end = s.to[a] * BLOCK < c->n[a] ? s.to[a] * BLOCK : c->n[a];
      in[a] = (vs_enclosure){ place(c, a, s.from[a] * BLOCK), place(c, a, end), false };
      blocks_in *= s.to[a] - s.from[a];
      if (s.to[a] - s.from[a] > s.to[longest] - s.from[longest]) longest = a;
    }
    vs_enclosure v = vs_enclose_tape(c->t, in, c->work);
    bool single = blocks_in < 1.5;
    if (!v.partial && (v.low > 0 || v.high < 0))
      done += blocks_in;
    else if (single) {
      const int32_t from[3] = { s.from[0] * BLOCK, s.from[1] * BLOCK, s.from[2] * BLOCK };
      outcome = block(c, from);
      done += 1;
    } else if (!VS_GROW(todo, room, count + 2))
      outcome = VS_CONTOUR_MEMORY;
    else {
      int32_t middle = (s.from[longest] + s.to[longest]) / 2;
      span low = s, high = s;
      low.to[longest] = high.from[longest] = middle;
      todo[count++] = high, todo[count++] = low;
    }
    if (outcome == VS_CONTOUR_DONE && ++looked % 32 == 0 && !c->host.going(c->host.context, .5 * done / whole))
      outcome = VS_CONTOUR_STOPPED;
  }
  free(todo);
  return outcome;
}

/* ---- roots ---- */

typedef struct {
  double a, va, b, vb, first, x;
  uint32_t edge;
  int8_t side;
} search;

/* Returns the larger absolute value of the function at the two ends of the edge. Ignores an infinite value, which an
 * end beside a pole may have. */
static double finite_size(const crossing *e) {
  double a = fabs(e->v0), b = fabs(e->v1);
  return isfinite(a) && isfinite(b) ? fmax(a, b) : fmin(a, b);
}

static bool in_box(const contour *c, double x, double y, double z) {
  return x >= c->p[0] && x <= c->q[0] && y >= c->p[1] && y <= c->q[1] && z >= c->p[2] && z <= c->q[2];
}

/* Finds the point on every crossed edge where the function is 0, by the Illinois method of false position. Each
 * iteration evaluates all edges together. Every third iteration and all late ones bisect, which also finds jumps. Then
 * computes the gradients at these points. */
static vs_contour_outcome roots(contour *c) {
  size_t n = c->edge_count, room = 0, x_room[3] = { 0, 0, 0 }, v_room = 0, s_room[3] = { 0, 0, 0 };
  search *s = NULL;
  double *x[3] = { NULL, NULL, NULL }, *v = NULL, *slope[3] = { NULL, NULL, NULL };
  bool ok = VS_GROW(s, room, n) && VS_GROW(v, v_room, n) && VS_GROW(c->roots, c->root_room, n) &&
            VS_GROW(c->normals, c->normal_room, n);
  for (int a = 0; ok && a < 3; a++) ok = VS_GROW(x[a], x_room[a], n) && VS_GROW(slope[a], s_room[a], n);
  vs_contour_outcome outcome = ok ? VS_CONTOUR_DONE : VS_CONTOUR_MEMORY;
  size_t left = ok ? n : 0;
  for (size_t i = 0; i < left; i++) {
    const crossing *e = &c->edges[i];
    const cell *at = &c->cells[e->cell];
    double low = place(c, e->axis, at->at[e->axis]), high = place(c, e->axis, at->at[e->axis] + 1);
    s[i] = (search){ low, e->v0, high, e->v1, finite_size(e), low, (uint32_t)i, 0 };
    c->roots[i] = vs_v3(place(c, 0, at->at[0]), place(c, 1, at->at[1]), place(c, 2, at->at[2]));
  }
  for (int turn = 0; outcome == VS_CONTOUR_DONE && left && turn < TURNS; turn++) {
    for (size_t i = 0; i < left; i++) {
      search *e = &s[i];
      bool halve = turn % 3 == 2 || turn > 12 || !isfinite(e->va) || !isfinite(e->vb) || e->va == e->vb;
      double m = halve ? .5 * (e->a + e->b) : (e->a * e->vb - e->b * e->va) / (e->vb - e->va);
      if (!(m > e->a && m < e->b)) m = .5 * (e->a + e->b);
      e->x = m;
      const vs_vec3 *at = &c->roots[e->edge];
      x[0][i] = at->x, x[1][i] = at->y, x[2][i] = at->z;
      x[c->edges[e->edge].axis][i] = m;
    }
    vs_sample(c->values, (const double *const[]){ x[0], x[1], x[2] }, left, (double *const[]){ v });
    size_t kept = 0;
    for (size_t i = 0; i < left; i++) {
      search e = s[i];
      if (v[i] != v[i]) { /* a value of NaN is a fault inside the box; it is allowed only outside */
        if (in_box(c, x[0][i], x[1][i], x[2][i])) {
          c->out->at = vs_v3(x[0][i], x[1][i], x[2][i]), outcome = VS_CONTOUR_NO_NUMBER;
          break;
        }
        v[i] = INFINITY;
      }
      if ((v[i] < 0) == (e.va < 0)) {
        if (e.side == 1) e.vb *= .5;
        e.a = e.x, e.va = v[i], e.side = 1;
      } else {
        if (e.side == -1) e.va *= .5;
        e.b = e.x, e.vb = v[i], e.side = -1;
      }
      bool narrow = e.b - e.a <= 1e-7 * c->size;
      if (narrow || fabs(v[i]) <= 1e-9 * e.first || turn == TURNS - 1) {
        double *to = c->edges[e.edge].axis == 0   ? &c->roots[e.edge].x
                     : c->edges[e.edge].axis == 1 ? &c->roots[e.edge].y
                                                  : &c->roots[e.edge].z;
        *to = e.x;
        if (narrow && fabs(v[i]) > 1e3 * e.first && in_box(c, x[0][i], x[1][i], x[2][i])) {
          c->out->at = c->roots[e.edge], outcome = VS_CONTOUR_POLE;
          break;
        }
      } else
        s[kept++] = e;
    }
    left = kept;
    bool going = outcome != VS_CONTOUR_DONE || c->host.going(c->host.context, .5 + .2 * turn / TURNS);
    if (!going) outcome = VS_CONTOUR_STOPPED;
  }
  if (outcome == VS_CONTOUR_DONE) {
    for (size_t i = 0; i < n; i++) x[0][i] = c->roots[i].x, x[1][i] = c->roots[i].y, x[2][i] = c->roots[i].z;
    vs_sample_slopes(c->slopes, (const double *const[]){ x[0], x[1], x[2] }, n, (double *const[]){ v }, slope);
    for (size_t i = 0; i < n; i++) {
      vs_vec3 g = vs_v3(slope[0][i], slope[1][i], slope[2][i]);
      double length = vs_v3_length(g);
      const crossing *e = &c->edges[i];
      double along = e->rises ? 1 : -1;
      c->normals[i] = length > 0 && isfinite(length)
                          ? vs_v3_scale(g, 1 / length)
                          : vs_v3(e->axis == 0 ? along : 0, e->axis == 1 ? along : 0, e->axis == 2 ? along : 0);
    }
  }
  free(s), free(v);
  for (int a = 0; a < 3; a++) free(x[a]), free(slope[a]);
  return outcome;
}

/* ---- the table of cells ---- */

static uint64_t hash_place(const int32_t *at) {
  uint64_t h = (uint64_t)at[0] << 42 ^ (uint64_t)at[1] << 21 ^ (uint64_t)at[2];
  h = (h ^ h >> 31) * UINT64_C(0xBF58476D1CE4E5B9);
  h = (h ^ h >> 27) * UINT64_C(0x94D049BB133111EB);
  return h ^ h >> 31;
}

static bool index_cells(contour *c) {
  for (c->slots = 64; c->slots < 2 * c->cell_count;) c->slots *= 2;
  if (!VS_GROW(c->index, c->slot_room, c->slots)) return false;
  memset(c->index, 0, c->slots * sizeof *c->index);
  for (size_t i = 0; i < c->cell_count; i++) {
    size_t k = hash_place(c->cells[i].at) & (c->slots - 1);
    while (c->index[k]) k = (k + 1) & (c->slots - 1);
    c->index[k] = (uint32_t)i + 1;
  }
  return true;
}

/* Returns the cell at the position (i, j, k), or NULL if the surface does not cross it. */
static cell *cell_at(const contour *c, int32_t i, int32_t j, int32_t k) {
  const int32_t at[3] = { i, j, k };
  if (i < 0 || j < 0 || k < 0) return NULL;
  for (size_t h = hash_place(at) & (c->slots - 1); c->index[h]; h = (h + 1) & (c->slots - 1)) {
    cell *found = &c->cells[c->index[h] - 1];
    if (found->at[0] == i && found->at[1] == j && found->at[2] == k) return found;
  }
  return NULL;
}

/* ---- rings ---- */

/* Returns the number of the cell's edge between its corners a and b, which differ in one bit. */
static int edge_between(int a, int b) {
  int bit = a ^ b, axis = bit == 1 ? 0 : bit == 2 ? 1 : 2, low = a & b;
  VS_ASSERT(bit == 1 || bit == 2 || bit == 4);
  return 4 * axis + (low >> (axis + 1) % 3 & 1) + 2 * (low >> (axis + 2) % 3 & 1);
}

/* Sets at[0] to at[3] to the corners of a face of a cell, in order around it. face: 0 to 5. */
static void face_corners(int face, int *at) {
  int axis = face / 2, b = 1 << (axis + 1) % 3, c = 1 << (axis + 2) % 3, low = face & 1 ? 1 << axis : 0;
  VS_ASSERT(face >= 0 && face < 6);
  at[0] = low, at[1] = low | b, at[2] = low | b | c, at[3] = low | c;
}

static bool is_ambiguous(unsigned below, int face) {
  int k[4];
  face_corners(face, k);
  unsigned a = below >> k[0] & 1, b = below >> k[1] & 1, c = below >> k[2] & 1, d = below >> k[3] & 1;
  return a == c && b == d && a != b;
}

static int root_of(const int8_t *parent, int e) {
  while (parent[e] != e) e = parent[e];
  return e;
}

/* Finds the pairs of crossed edges that the surface connects in a face of cell c, and returns their number. If four
 * edges are crossed, two ways to pair them are possible; c->flips chooses. */
static int face_pairs(const cell *c, int face, int (*pair)[2]) {
  int k[4], crossed[4], count = 0;
  face_corners(face, k);
  for (int i = 0; i < 4; i++)
    if ((c->below >> k[i] & 1) != (c->below >> k[(i + 1) % 4] & 1))
      crossed[count++] = edge_between(k[i], k[(i + 1) % 4]);
  if (count == 2) return pair[0][0] = crossed[0], pair[0][1] = crossed[1], 1;
  if (count == 0) return 0;
  /* Crossing i of the face lies on the edge between its corners i and i + 1. Therefore the edges at corner i have the
   * numbers i - 1 and i. */
  int corner = ((c->below >> k[0] & 1) != (c->flips >> face & 1)) ? 0 : 1;
  for (int i = 0; i < 2; i++) pair[i][0] = crossed[(corner + 2 * i + 3) % 4], pair[i][1] = crossed[corner + 2 * i];
  return 2;
}

/* Joins the crossed edges of a cell into rings (pieces of the surface), and numbers the rings. Returns their number. */
static int join_rings(cell *c) {
  int8_t parent[12];
  uint32_t used = 0;
  for (int e = 0; e < 12; e++) parent[e] = (int8_t)e;
  for (int face = 0; face < 6; face++) {
    int pair[2][2];
    for (int i = face_pairs(c, face, pair); i-- > 0;) {
      used |= 1u << pair[i][0] | 1u << pair[i][1];
      parent[root_of(parent, pair[i][0])] = (int8_t)root_of(parent, pair[i][1]);
    }
  }
  int8_t number[12];
  int count = 0;
  memset(number, NONE, sizeof number);
  c->rings = 0;
  for (int e = 0; e < 12; e++) {
    if (!(used >> e & 1)) continue;
    int root = root_of(parent, e);
    if (number[root] == NONE) number[root] = (int8_t)count++;
    c->rings |= (uint32_t)number[root] << 2 * e;
  }
  return count;
}

static unsigned ring_of(const cell *c, int edge) { return c->rings >> 2 * edge & 3; }

/* Returns true if all four crossings of the face of cell c belong to one ring (piece of the surface). */
static bool on_one_ring(const cell *c, int face) {
  int pair[2][2];
  return face_pairs(c, face, pair) == 2 && ring_of(c, pair[0][0]) == ring_of(c, pair[1][0]);
}

/* Flips some faces (joins their crossings in the other way), so that the two pairs of crossings in the face belong to
 * separate rings. A flipped face changes only the rings of the two cells beside it, so one pass suffices. */
static void part_sheets(contour *c) {
  for (size_t i = 0; i < c->cell_count; i++) join_rings(&c->cells[i]);
  for (size_t i = 0; i < c->cell_count; i++)
    for (int a = 0; a < 3; a++) {
      cell *here = &c->cells[i];
      if (!is_ambiguous(here->below, 2 * a + 1)) continue;
      cell *next = cell_at(c, here->at[0] + (a == 0), here->at[1] + (a == 1), here->at[2] + (a == 2));
      if (!next || !on_one_ring(here, 2 * a + 1) || !on_one_ring(next, 2 * a)) continue;
      here->flips |= (uint8_t)(1 << (2 * a + 1)), next->flips |= (uint8_t)(1 << 2 * a);
      join_rings(here);
      join_rings(next);
    }
}

/* ---- points of rings ---- */

/* Computes the eigenvalues of the symmetric matrix m by Jacobi's rotations, and stores them in the diagonal of m. The
 * columns of v become the eigenvectors. */
static void eigen(double m[3][3], double v[3][3]) {
  memset(v, 0, 9 * sizeof **v);
  v[0][0] = v[1][1] = v[2][2] = 1;
  bool turned = true;
  for (int sweep = 0; turned && sweep < 12; sweep++) {
    turned = false;
    for (int p = 0; p < 2; p++)
      for (int q = p + 1; q < 3; q++) {
        if (fabs(m[p][q]) <= 1e-15 * (fabs(m[p][p]) + fabs(m[q][q]))) continue;
        turned = true;
        double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
        double t = (theta >= 0 ? 1 : -1) / (fabs(theta) + sqrt(theta * theta + 1)), c = 1 / sqrt(t * t + 1), s = t * c;
        for (int k = 0; k < 3; k++) {
          double a = m[k][p], b = m[k][q];
          m[k][p] = c * a - s * b, m[k][q] = s * a + c * b;
        }
        for (int k = 0; k < 3; k++) {
          double a = m[p][k], b = m[q][k];
          m[p][k] = c * a - s * b, m[q][k] = s * a + c * b;
          a = v[k][p], b = v[k][q];
          v[k][p] = c * a - s * b, v[k][q] = s * a + c * b;
        }
      }
  }
}

/* If the scalar product of two unit normals is below SHARP, the surface has a sharp edge between them. If a normal has
 * a component above CORNER outside the plane of the others, it has a corner. */
#define SHARP .9
#define CORNER .42

/* Returns the number of independent directions among the n normals of a piece of the surface: 1 in a smooth surface, 2
 * at an edge, 3 at a corner. n > 0. */
static int rank_of(const vs_vec3 *normal, int n) {
  double m[3][3] = { { 0 } }, v[3][3], alike = 1, leans = 0;
  VS_ASSERT(n > 0);
  for (int i = 0; i < n; i++) {
    const double d[3] = { normal[i].x, normal[i].y, normal[i].z };
    for (int r = 0; r < 3; r++)
      for (int s = 0; s < 3; s++) m[r][s] += d[r] * d[s];
    for (int k = 0; k < i; k++) alike = fmin(alike, vs_v3_dot(normal[i], normal[k]));
  }
  if (alike > SHARP) return 1;
  eigen(m, v);
  int least = m[0][0] < m[1][1] ? 0 : 1;
  if (m[2][2] < m[least][least]) least = 2;
  for (int i = 0; i < n; i++)
    leans = fmax(leans, fabs(vs_v3_dot(normal[i], vs_v3(v[0][least], v[1][least], v[2][least]))));
  return leans > CORNER ? 3 : 2;
}

/* Returns the point nearest to the n > 0 planes with the given places and normals. In directions that the planes do not
 * determine, it is as near to `from` as possible. Along axes whose bits are set in `fixed`, it keeps the coordinates of
 * `from`. */
static vs_vec3 best_point(const vs_vec3 *place, const vs_vec3 *normal, int n, vs_vec3 from, int rank, unsigned fixed) {
  double m[3][3] = { { 0 } }, v[3][3], b[3] = { 0, 0, 0 }, x[3] = { 0, 0, 0 };
  VS_ASSERT(rank >= 0 && rank <= 3 && n > 0);
  for (int i = 0; i < n; i++) {
    const double d[3] = { fixed & 1 ? 0 : normal[i].x, fixed & 2 ? 0 : normal[i].y, fixed & 4 ? 0 : normal[i].z };
    double height = vs_v3_dot(normal[i], vs_v3_sub(place[i], from));
    for (int r = 0; r < 3; r++) {
      b[r] += d[r] * height;
      for (int s = 0; s < 3; s++) m[r][s] += d[r] * d[s];
    }
  }
  eigen(m, v);
  int order[3] = { 0, 1, 2 }; /* indices of the eigenvalues, in descending order */
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 2; k++)
      if (m[order[k]][order[k]] < m[order[k + 1]][order[k + 1]]) {
        int t = order[k];
        order[k] = order[k + 1], order[k + 1] = t;
      }
  for (int i = 0; i < rank; i++) {
    int k = order[i];
    if (!(m[k][k] > 1e-3 * m[order[0]][order[0]])) continue;
    double along = (v[0][k] * b[0] + v[1][k] * b[1] + v[2][k] * b[2]) / m[k][k];
    for (int r = 0; r < 3; r++) x[r] += along * v[r][k];
  }
  return vs_v3_add(from, vs_v3(x[0], x[1], x[2]));
}

/* State of the search for the point of a ring (piece of the surface in a cell), with the limits of that point. */
typedef struct {
  double low[3], high[3];
  uint32_t point;
  int count, rank;
  vs_vec3 normal[12];
} ring_point;

static double held(double x, double low, double high) { return x < low ? low : x > high ? high : x; }

static vs_vec3 held_in(const ring_point *r, vs_vec3 p) {
  return vs_v3(held(p.x, r->low[0], r->high[0]), held(p.y, r->low[1], r->high[1]), held(p.z, r->low[2], r->high[2]));
}

/* Returns the point within the ring's cell that is nearest to the planes through the n places with the given normals.
 * If the nearest point is beyond a side of the cell, computes the nearest point in that side. */
static vs_vec3 best_within(const ring_point *r, const vs_vec3 *place, const vs_vec3 *normal, int n, vs_vec3 from,
                           int rank) {
  vs_vec3 p = from;
  unsigned fixed = 0;
  for (int left = 3; left > 0;) {
    p = best_point(place, normal, n, from, rank < left ? rank : left, fixed);
    vs_vec3 in = held_in(r, p);
    unsigned out = (in.x != p.x ? 1u : 0u) | (in.y != p.y ? 2u : 0u) | (in.z != p.z ? 4u : 0u);
    if (!(out & ~fixed)) break;
    if (out & 1) from.x = in.x;
    if (out & 2) from.y = in.y;
    if (out & 4) from.z = in.z;
    fixed |= out;
    left = 3 - (int)((fixed & 1) + (fixed >> 1 & 1) + (fixed >> 2));
    if (!left) p = from;
  }
  return held_in(r, p);
}

/* Samples the surface near the points of n rings (pieces of the surface), and moves each point. On a smooth piece it
 * goes onto the surface, at a sharp edge to the intersection of the planes on both sides of the edge. Returns false on
 * failure. */
static bool refine(contour *c, ring_point *rings, size_t n) {
  enum { LOOKS = 24, TURNS_OF_LOOKS = 3 };
  static const double reach[TURNS_OF_LOOKS] = { .4, .15, .05 };
  size_t room[7] = { 0 }, most = n * LOOKS;
  double *x[3] = { NULL, NULL, NULL }, *slope[3] = { NULL, NULL, NULL }, *v = NULL;
  bool ok = VS_GROW(v, room[6], most);
  for (int a = 0; ok && a < 3; a++) ok = VS_GROW(x[a], room[a], most) && VS_GROW(slope[a], room[3 + a], most);
  for (int turn = 0; ok && turn < TURNS_OF_LOOKS; turn++) {
    size_t count = 0;
    for (size_t i = 0; i < n; i++) {
      const ring_point *r = &rings[i];
      vs_vec3 p = c->out->points[r->point];
      for (int k = 0; k < (r->rank == 1 ? 1 : 2 * r->count); k++, count++) {
        double far = r->rank == 1 ? 0 : (k % 2 ? 1 : -1) * reach[turn] * c->size;
        vs_vec3 at = vs_v3_add(p, vs_v3_scale(r->normal[k / 2], far));
        x[0][count] = at.x, x[1][count] = at.y, x[2][count] = at.z;
      }
    }
    vs_sample_slopes(c->slopes, (const double *const[]){ x[0], x[1], x[2] }, count, (double *const[]){ v }, slope);
    count = 0;
    for (size_t i = 0; i < n; i++) {
      ring_point *r = &rings[i];
      vs_vec3 *p = &c->out->points[r->point], place[LOOKS], normal[LOOKS];
      int looks = r->rank == 1 ? 1 : 2 * r->count, seen = 0;
      for (int k = 0; k < looks; k++, count++) {
        vs_vec3 g = vs_v3(slope[0][count], slope[1][count], slope[2][count]);
        double length = vs_v3_length(g);
        if (!isfinite(v[count]) || !isfinite(length) || !(length > 0)) continue;
        vs_vec3 at = vs_v3(x[0][count], x[1][count], x[2][count]);
        normal[seen] = vs_v3_scale(g, 1 / length);
        place[seen] = vs_v3_sub(at, vs_v3_scale(normal[seen], v[count] / length));
        seen++;
      }
      if (seen) *p = best_within(r, place, normal, seen, *p, rank_of(normal, seen));
    }
    if (n && rings[0].rank == 1) break;
  }
  free(v);
  for (int a = 0; a < 3; a++) free(x[a]), free(slope[a]);
  return ok;
}

enum { AT_ONCE = 512 };

/* The points where the surface crosses a cell's edges, and the normals there, grouped by ring. */
typedef struct {
  vs_vec3 root[4][12], normal[4][12];
  int count[4], rings;
} crossings;

static void collect(const contour *c, const cell *here, crossings *out) {
  memset(out->count, 0, sizeof out->count);
  out->rings = 0;
  for (int e = 0; e < 12; e++) {
    int axis = e / 4, b = (axis + 1) % 3, d = (axis + 2) % 3;
    int low = (e & 1 ? 1 << b : 0) | (e & 2 ? 1 << d : 0);
    if ((here->below >> low & 1) == (here->below >> (low | 1 << axis) & 1)) continue;
    const cell *owner =
        low ? cell_at(c, here->at[0] + (low & 1), here->at[1] + (low >> 1 & 1), here->at[2] + (low >> 2)) : here;
    int32_t edge = owner ? owner->edge[axis] : NONE;
    if (edge == NONE) continue;
    unsigned ring = ring_of(here, e);
    out->root[ring][out->count[ring]] = c->roots[edge], out->normal[ring][out->count[ring]++] = c->normals[edge];
    if ((int)ring >= out->rings) out->rings = (int)ring + 1;
  }
}

/* Returns the mean of the n >= 1 points `at`. */
static vs_vec3 middle_of(const vs_vec3 *at, int n) {
  vs_vec3 middle = { 0, 0, 0 };
  VS_ASSERT(n > 0);
  for (int k = 0; k < n; k++) middle = vs_v3_add(middle, vs_v3_scale(at[k], 1. / n));
  return middle;
}

/* Returns true if a sharp edge of the surface probably passes through a cell although all crossings of the cell lie on
 * one side of it. *p: the point where the planes of this cell and a neighbouring cell intersect. */
static bool goes_on(const contour *c, const cell *here, const crossings *own, ring_point *r, vs_vec3 *p) {
  for (int face = 0; face < 6; face++) {
    int axis = face / 2, way = face & 1 ? 1 : -1;
    const cell *next = cell_at(c, here->at[0] + (axis == 0 ? way : 0), here->at[1] + (axis == 1 ? way : 0),
                               here->at[2] + (axis == 2 ? way : 0));
    crossings theirs;
    if (!next || !next->sharp) continue;
    collect(c, next, &theirs);
    if (theirs.rings != 1) continue;
    vs_vec3 root[24], normal[24], from = middle_of(own->root[0], own->count[0]);
    int n = own->count[0];
    memcpy(root, own->root[0], (size_t)n * sizeof *root), memcpy(normal, own->normal[0], (size_t)n * sizeof *normal);
    for (int k = 0; k < theirs.count[0]; k++)
      if (vs_v3_dot(theirs.normal[0][k], own->normal[0][0]) < SHARP)
        root[n] = theirs.root[0][k], normal[n++] = theirs.normal[0][k];
    int rank = rank_of(normal, n);
    vs_vec3 to = best_point(root, normal, n, from, rank, 0);
    if (rank < 2 || vs_v3_length(vs_v3_sub(held_in(r, to), to)) > 0) continue;
    r->rank = rank, r->count = 0;
    for (int k = own->count[0] - 1; k < n && r->count < 12; k++) r->normal[r->count++] = normal[k];
    *p = to;
    return true;
  }
  return false;
}

static bool points(contour *c) {
  vs_contour *out = c->out;
  ring_point *some[2] = { NULL, NULL }; /* Lists of rings (pieces of the surface in cells) whose points are refined
                                         * together. some[0]: rings on a smooth surface; some[1]: rings with sharp
                                         * edges. */
  size_t room[2] = { 0, 0 }, count_of[2] = { 0, 0 };
  bool ok = VS_GROW(some[0], room[0], AT_ONCE) && VS_GROW(some[1], room[1], AT_ONCE);
  crossings own;
  for (size_t i = 0; ok && i < c->cell_count; i++) {
    collect(c, &c->cells[i], &own);
    for (int r = 0; r < own.rings; r++)
      if (own.count[r] && rank_of(own.normal[r], own.count[r]) > 1) c->cells[i].sharp = true;
  }
  for (size_t i = 0; ok && i < c->cell_count; i++) {
    cell *here = &c->cells[i];
    collect(c, here, &own);
    here->first = (uint32_t)out->point_count;
    if (out->point_count + 4 > UINT32_MAX ||
        !VS_GROW(out->points, out->point_room, out->point_count + (size_t)own.rings)) {
      ok = false;
      break;
    }
    for (int r = 0; ok && r < own.rings; r++) {
      int n = own.count[r];
      ring_point made = { .point = (uint32_t)out->point_count, .count = n, .rank = rank_of(own.normal[r], n) };
      double inset = 1e-4 * c->size; /* smallest distance of a ring's point from the sides of its cell, so that points
                                      * of two cells are never equal */
      for (int a = 0; a < 3; a++)
        made.low[a] = place(c, a, here->at[a]) + inset, made.high[a] = place(c, a, here->at[a] + 1) - inset;
      memcpy(made.normal, own.normal[r], (size_t)n * sizeof *made.normal);
      vs_vec3 p = middle_of(own.root[r], n);
      if (n && !(own.rings == 1 && made.rank == 1 && goes_on(c, here, &own, &made, &p)))
        p = best_within(&made, own.root[r], own.normal[r], n, p, made.rank);
      out->points[out->point_count++] = p;
      if (!n) continue;
      int sharp = made.rank > 1;
      some[sharp][count_of[sharp]++] = made;
      if (count_of[sharp] == AT_ONCE) ok = refine(c, some[sharp], AT_ONCE), count_of[sharp] = 0;
    }
  }
  for (int sharp = 0; sharp < 2; sharp++) {
    ok = ok && (!count_of[sharp] || refine(c, some[sharp], count_of[sharp]));
    free(some[sharp]);
  }
  return ok;
}

/* ---- faces ---- */

/* Returns a measure of the distance of p from the triangle a b c: the square of its height above the triangle's plane,
 * plus the square of its largest distance beyond a side. Returns INFINITY if the triangle has no area. */
static double apart(vs_vec3 p, vs_vec3 a, vs_vec3 b, vs_vec3 c) {
  vs_vec3 n = vs_v3_cross(vs_v3_sub(b, a), vs_v3_sub(c, a));
  double length = vs_v3_length(n);
  if (!(length > 0)) return INFINITY;
  double height = vs_v3_dot(n, vs_v3_sub(p, a)) / length, out = 0;
  const vs_vec3 corner[3] = { a, b, c };
  for (int i = 0; i < 3; i++) {
    vs_vec3 side = vs_v3_sub(corner[(i + 1) % 3], corner[i]);
    double beyond = -vs_v3_dot(vs_v3_cross(n, side), vs_v3_sub(p, corner[i])) / (length * vs_v3_length(side));
    if (beyond > out) out = beyond;
  }
  return height * height + out * out;
}

/* Finds the four points around each crossed edge. The first of them is in the cell whose lowest corner is the edge's
 * start. Returns false when memory is out. */
static bool find_around(contour *c) {
  if (!VS_GROW(c->around, c->around_room, c->edge_count + 1)) return false;
  for (size_t i = 0; i < c->edge_count; i++) {
    const crossing *e = &c->edges[i];
    const cell *owner = &c->cells[e->cell];
    int b = (e->axis + 1) % 3, d = (e->axis + 2) % 3;
    uint32_t *corner = c->around[i];
    for (int k = 0; k < 4; k++) { /* visits the four cells around the edge, in the order (+ +) (- +) (- -) (+ -) */
      int back = k == 1 || k == 2, down = k >= 2;
      int32_t at[3] = { owner->at[0], owner->at[1], owner->at[2] };
      at[b] -= back, at[d] -= down;
      const cell *there = cell_at(c, at[0], at[1], at[2]); /* the surface crosses the edge, and therefore all four cells
                                                            * around it are in the table */
      corner[k] = there ? there->first + ring_of(there, 4 * e->axis + back + 2 * down) : owner->first;
    }
    if (!e->rises) {
      uint32_t t = corner[1];
      corner[1] = corner[3], corner[3] = t;
    }
  }
  return true;
}

static vs_vec3 face_normal(const vs_vec3 *p, uint32_t a, uint32_t b, uint32_t c) {
  vs_vec3 n = vs_v3_cross(vs_v3_sub(p[b], p[a]), vs_v3_sub(p[c], p[a]));
  double length = vs_v3_length(n);
  return length > 0 ? vs_v3_scale(n, 1 / length) : n;
}

/* Returns true if the diagonal from corner `from` (0 or 1) of a quadrilateral would fold one of its two triangles back
 * over the other. */
static bool folds(const vs_vec3 *p, const uint32_t *corner, int from) {
  vs_vec3 first = face_normal(p, corner[from], corner[from + 1], corner[from + 2]);
  VS_ASSERT(from == 0 || from == 1);
  return vs_v3_dot(first, face_normal(p, corner[from], corner[from + 2], corner[(from + 3) % 4])) < -.9;
}

/* Makes the two triangles around each crossed edge. stands_for[r]: ring whose point replaces the point of ring r; NULL:
 * each ring has its own point. Returns false when memory is out. */
static bool faces(contour *c, const uint32_t *stands_for) {
  vs_contour *out = c->out;
  const vs_vec3 *p = out->points;
  if (!VS_GROW(out->triangles, out->triangle_room, 2 * c->edge_count + 1)) return false;
  out->triangle_count = 0;
  for (size_t i = 0; i < c->edge_count; i++) {
    uint32_t corner[4];
    int n = 0;
    for (int k = 0; k < 4; k++) {
      uint32_t at = stands_for ? stands_for[c->around[i][k]] : c->around[i][k];
      if (!n || at != corner[n - 1]) corner[n++] = at;
    }
    if (n > 1 && corner[n - 1] == corner[0]) n--;
    int from = 0; /* from: number of the corner (0 or 1) at which the diagonal begins */
    if (n == 4) {
      vs_vec3 root = c->roots[i];
      double first = fmin(apart(root, p[corner[0]], p[corner[1]], p[corner[2]]),
                          apart(root, p[corner[0]], p[corner[2]], p[corner[3]]));
      double second = fmin(apart(root, p[corner[1]], p[corner[2]], p[corner[3]]),
                           apart(root, p[corner[1]], p[corner[3]], p[corner[0]]));
      bool first_folds = folds(p, corner, 0);
      from = first_folds != folds(p, corner, 1) ? first_folds : second < first;
    }
    for (int k = 0; k < n - 2; k++) {
      uint32_t *t = out->triangles[out->triangle_count++];
      t[0] = corner[from], t[1] = corner[(from + 1 + k) % n], t[2] = corner[(from + 2 + k) % n];
    }
  }
  return true;
}

/* Measures the distance of the triangles' centres from the surface, to first order. Also finds whether the mesh has
 * faces on the sides of the box. */
static vs_contour_outcome judge(contour *c) {
  enum { BATCH = VS_SAMPLE_BATCH };
  double x[3][BATCH], v[BATCH], slope[3][BATCH];
  vs_contour *out = c->out;
  for (size_t from = 0; from < out->triangle_count; from += BATCH) {
    size_t n = out->triangle_count - from < BATCH ? out->triangle_count - from : BATCH;
    for (size_t i = 0; i < n; i++) {
      const uint32_t *t = out->triangles[from + i];
      vs_vec3 m = vs_v3_scale(vs_v3_add(vs_v3_add(out->points[t[0]], out->points[t[1]]), out->points[t[2]]), 1. / 3);
      x[0][i] = m.x, x[1][i] = m.y, x[2][i] = m.z;
    }
    vs_sample_slopes(c->slopes, (const double *const[]){ x[0], x[1], x[2] }, n, (double *const[]){ v },
                     (double *const[]){ slope[0], slope[1], slope[2] });
    for (size_t i = 0; i < n; i++) {
      double far = fabs(v[i]) / vs_v3_length(vs_v3(slope[0][i], slope[1][i], slope[2][i]));
      if (far > out->deviation && isfinite(far)) out->deviation = far;
      for (int a = 0; a < 3; a++)
        out->capped =
            out->capped || fabs(x[a][i] - c->p[a]) < 1e-6 * c->size || fabs(x[a][i] - c->q[a]) < 1e-6 * c->size;
    }
    if (from % (BATCH * 64) == 0 && !c->host.going(c->host.context, .9)) return VS_CONTOUR_STOPPED;
  }
  return VS_CONTOUR_DONE;
}

/* ---- merging of cells ---- */

/* Removes the points of the mesh that no triangle has. */
static bool drop_points(contour *c) {
  vs_contour *out = c->out;
  uint32_t *to = NULL, count = 0;
  size_t room = 0;
  if (!VS_GROW(to, room, out->point_count + 1)) return false;
  memset(to, 0, (out->point_count + 1) * sizeof *to);
  for (size_t i = 0; i < out->triangle_count; i++)
    for (int k = 0; k < 3; k++) to[out->triangles[i][k]] = 1;
  for (size_t i = 0; i < out->point_count; i++)
    if (to[i]) out->points[count] = out->points[i], to[i] = count++;
  for (size_t i = 0; i < out->triangle_count; i++)
    for (int k = 0; k < 3; k++) out->triangles[i][k] = to[out->triangles[i][k]];
  out->point_count = count;
  free(to);
  return true;
}

static bool has_ambiguous_side(const cell *c) {
  for (int face = 0; face < 6; face++)
    if (is_ambiguous(c->below, face)) return true;
  return false;
}

/* Merges cells in which the surface is flat within the tolerance, as long as the centres of the new triangles also are
 * within the tolerance of the surface. A tolerance of 0 means flat within rounding errors. */
static vs_contour_outcome merge_cells(contour *c, double tolerance) {
  enum { TURNS_OF_MERGING = 4 };
  vs_contour *out = c->out;
  int32_t(*place)[3] = NULL;
  bool *barred = NULL;
  uint8_t *axis = NULL;
  uint32_t *stands_for = NULL;
  size_t room[4] = { 0 };
  vs_contour_outcome outcome = VS_CONTOUR_DONE;
  bool ok = VS_GROW(place, room[0], out->point_count) && VS_GROW(barred, room[1], out->point_count) &&
            VS_GROW(stands_for, room[2], out->point_count) && VS_GROW(axis, room[3], c->edge_count);
  for (size_t i = 0; ok && i < c->cell_count; i++) {
    size_t end = i + 1 < c->cell_count ? c->cells[i + 1].first : out->point_count;
    for (size_t r = c->cells[i].first; r < end; r++) {
      memcpy(place[r], c->cells[i].at, sizeof place[r]);
      barred[r] = has_ambiguous_side(&c->cells[i]);
    }
  }
  for (size_t i = 0; ok && i < c->edge_count; i++) axis[i] = c->edges[i].axis;
  double limit = tolerance > 0 ? tolerance : FLAT * c->size, before = out->deviation;
  for (int turn = 0; ok && turn < TURNS_OF_MERGING && outcome == VS_CONTOUR_DONE; turn++, limit /= 2) {
    const vs_octree_leaves leaves = { .rings = out->point_count,
                                      .quads = c->edge_count,
                                      .point = out->points,
                                      .place = (const int32_t(*)[3])place,
                                      .barred = barred,
                                      .around = (const uint32_t(*)[4])c->around,
                                      .axis = axis,
                                      .root = c->roots,
                                      .normal = c->normals,
                                      .size = c->size,
                                      .work = c->host };
    vs_octree_outcome merged = vs_octree_merge(&leaves, limit, stands_for);
    if (merged == VS_OCTREE_STOPPED) outcome = VS_CONTOUR_STOPPED;
    ok = merged != VS_OCTREE_MEMORY;
    if (merged != VS_OCTREE_DONE) break;
    ok = faces(c, stands_for);
    if (!ok || !(tolerance > 0)) break;
    out->deviation = 0;
    outcome = judge(c);
    if (out->deviation <= tolerance) break;
    if (turn == TURNS_OF_MERGING - 1) ok = faces(c, NULL), out->deviation = before; /* no merging kept the triangles
                                                                                     * within the tolerance, so the
                                                                                     * unmerged mesh is restored */
  }
  ok = ok && drop_points(c);
  free(place), free(barred), free(axis), free(stands_for);
  return ok ? outcome : VS_CONTOUR_MEMORY;
}

vs_contour_outcome vs_contour_make(const vs_tape *t, const vs_contour_grid *grid, vs_long_work work, vs_contour *out) {
  vs_vec3 p = grid->p, q = grid->q;
  int cells = grid->cells;
  double tolerance = grid->tolerance;
  contour c = { .p = { p.x, p.y, p.z }, .q = { q.x, q.y, q.z }, .host = work, .out = out };
  VS_ASSERT(cells > 0 && cells <= VS_CONTOUR_CELLS && tolerance >= 0);
  *out = (vs_contour){ .most = out->most };
  double longest = fmax(q.x - p.x, fmax(q.y - p.y, q.z - p.z));
  c.size = longest / (cells > 1 ? cells - 1 : 1);
  for (int a = 0; a < 3; a++) {
    c.n[a] = (int32_t)ceil((c.q[a] - c.p[a]) / c.size - 1e-9) + 1;
    c.origin[a] = .5 * (c.p[a] + c.q[a]) - .5 * c.size * c.n[a];
  }
  vs_tape *both = boxed(t, c.p, c.q);
  c.t = both;
  bool ok = both && (c.values = vs_sampler_new(both, 0)) && (c.slopes = vs_sampler_new(both, 3)) &&
            VS_GROW(c.work, c.work_room, both->count);
  vs_contour_outcome outcome = ok ? blocks(&c) : VS_CONTOUR_MEMORY;
  if (outcome == VS_CONTOUR_DONE && !c.edge_count) outcome = VS_CONTOUR_EMPTY;
  if (outcome == VS_CONTOUR_DONE) outcome = roots(&c);
  if (outcome == VS_CONTOUR_DONE) {
    ok = index_cells(&c);
    if (ok) part_sheets(&c);
    ok = ok && points(&c) && find_around(&c) && faces(&c, NULL);
    outcome = ok ? judge(&c) : VS_CONTOUR_MEMORY;
    bool merges = !(tolerance > 0 && out->deviation > tolerance);
    if (outcome == VS_CONTOUR_DONE && merges) outcome = merge_cells(&c, tolerance);
  }
  vs_sampler_free(c.values), vs_sampler_free(c.slopes);
  vs_tape_free(both);
  free(c.cells), free(c.edges), free(c.index), free(c.roots), free(c.normals), free(c.work), free(c.around);
  return outcome;
}
