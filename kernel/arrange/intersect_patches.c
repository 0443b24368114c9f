/* Intersects patches: it finds every pair that touches, and records the segments or point that a pair shares in both
 * facets.
 *
 * Two patches in different planes can touch only on the line of these planes. Each patch covers an interval of this
 * line, from one of its corners or edges to another. They share the intersection of the two intervals. Heights over a
 * plane and positions along the line are doubles with a bound on their error. Integers decide cases within the bound.
 * Therefore pairs that do not touch rarely need wide integers, and a segment well inside a lid gets no points. A
 * contact that is already a corner or an entire boundary edge of a patch is not new for that patch. If patches in one
 * plane touch, their facets are united to a group. Patches of one leaf are treated like any others, unless the leaf is
 * a star on the grid. Such a leaf may intersect itself, or rounding may have folded it.
 *
 * Threads find and test pairs in independent chunks. Points are numbered afterwards, chunk by chunk. Therefore the
 * result is the same for any number of threads. */
#include "kernel/arrange/intersect_patches.h"

#include "kernel/arrange/cull.h"
#include "kernel/cluster.h"
#include "kernel/threads.h"

#include <math.h>
#include <string.h>

/* A segment that two patches share, or the part of such a segment between two corners on it. */
typedef struct {
  uint32_t a, b, p, q; /* a, b: indices of the patches; p, q: numbers of the points at the segment's ends; a number with
                        * the bit FRESH is a new point of the chunk */
  uint32_t cut;        /* Bit 0: the segment is new in patch a; bit 1: it is new in patch b. 0: the patches lie in one
                        * plane and touch, so their facets are united to a group. */
} contact;
#define FRESH (UINT32_C(1) << 31)

/* A cached point where an edge crosses a patch. The two triangles beside the edge both need it. */
typedef struct {
  uint32_t low, high, patch; /* low, high: points at the ends of the edge; patch: index of the patch that the edge
                              * crosses */
  uint32_t fresh;            /* index of this point among the new points of the task, or VS_NONE */
} crossing;
enum { CROSSINGS = 1 << 12 };

/* Memory that one thread reuses for all its pairs of patches. */
typedef struct {
  VS_LIST(double) heights[2];     /* heights[i]: heights of the corners of patch i of the pair over the plane of the
                                   * other patch, in grid steps times the length of that plane's normal */
  VS_LIST(crossing) crossings;    /* hash table of the points that were computed most recently */
  VS_LIST(vs_patch_corner) line;  /* corners of the patches that lie on their shared segment, in order along it */
} working;

typedef struct {
  vs_kernel *k;
  const vs_cluster *c;
  working *w;
  VS_LIST(contact) contacts;
  VS_LIST(vs_fresh_point) fresh;
  VS_LIST(vs_edge) edges;         /* edges[i]: an edge of the input that contains the new point i of the chunk */
  size_t asked;                   /* number of segments for which the thread tested whether a convex leaf hides them
                                   * entirely */
  size_t left, looked, hidden;    /* left: number of segments that no single convex leaf hides entirely; looked: number
                                   * of these segments whose middle was tested; hidden: number of the tested middles
                                   * that a leaf hides */
} chunk;

static const vs_patch_corner *corners(const vs_cluster *c, const vs_patch *p) { return c->patch_corners.at + p->first; }

static int orient2(const int32_t a[3], const int32_t b[3], const int32_t c[3], const vs_plane *p) {
  int64_t ax = (int64_t)b[p->u] - a[p->u], ay = (int64_t)b[p->v] - a[p->v], bx = (int64_t)c[p->u] - a[p->u],
          by = (int64_t)c[p->v] - a[p->v];
  return vs_sign128((vs_i128)ax * by - (vs_i128)ay * bx);
}

static bool corner_of(const vs_cluster *c, const vs_patch *p, uint32_t id) {
  const vs_patch_corner *x = corners(c, p);
  for (uint32_t i = 0; i < p->count; i++)
    if (x[i].point == id) return true;
  return false;
}

/* Returns the index of the edge of patch x between the corners p and q, or VS_NONE if there is none. */
static uint32_t edge_of(const vs_cluster *c, const vs_patch *x, uint32_t p, uint32_t q) {
  const vs_patch_corner *at = corners(c, x);
  for (uint32_t i = 0; i < x->count; i++) {
    uint32_t a = at[i].point, b = at[i + 1 == x->count ? 0 : i + 1].point;
    if ((a == p && b == q) || (a == q && b == p)) return i;
  }
  return VS_NONE;
}

/* ---- a pair of patches, within a chunk ---- */

/* A patch (convex facet or triangle), and its position relative to the plane of another patch. */
typedef struct {
  const vs_patch *of, *other;
  double *height;                /* height[i]: height of the patch's corner i over the other patch's plane; its sign is
                                  * exact, and 0 is exactly 0 */
  double error;                  /* upper bound for the error of each height that is not 0 */
  uint32_t on, first_on, last_on; /* on: number of the patch's corners that lie in the other patch's plane; first_on,
                                   * last_on: indices of the first and the last of these corners */
  bool above, below;             /* above: true if the patch has corners above the other patch's plane; below: true if
                                  * it has corners below it */
} facing;

static vs_i128 height(const vs_plane *p, const int32_t at[3]) {
  return (vs_i128)p->n[0] * at[0] + (vs_i128)p->n[1] * at[1] + (vs_i128)p->n[2] * at[2] - p->d;
}

/* Sets f->height: the heights of a patch's corners over the other patch's plane, as doubles, relative to a corner of
 * the other patch. The relative errors of all operations sum to less than 2^-50 of the products' sizes. The error is
 * zero if these sizes are below 2^53. */
static void face_to(const vs_cluster *c, facing *f) {
  const vs_plane *p = &c->planes.all.at[f->other->plane];
  const vs_patch_corner *x = corners(c, f->of);
  const int32_t *from = corners(c, f->other)->at;
  const double n[3] = { (double)p->n[0], (double)p->n[1], (double)p->n[2] };
  double reach = 0;
  for (uint32_t i = 0; i < f->of->count; i++)
    for (int a = 0; a < 3; a++) reach = fmax(reach, fabs((double)x[i].at[a] - from[a]));
  double most = (fabs(n[0]) + fabs(n[1]) + fabs(n[2])) * reach, error = most < 0x1p53 ? 0 : most * 0x1p-50;
  f->error = error;
  f->on = 0;
  f->above = f->below = false;
  for (uint32_t i = 0; i < f->of->count; i++) {
    double h = n[0] * ((double)x[i].at[0] - from[0]) + n[1] * ((double)x[i].at[1] - from[1]) +
               n[2] * ((double)x[i].at[2] - from[2]);
    if (fabs(h) <= error) h = (double)height(p, x[i].at);
    f->height[i] = h;
    f->above |= h > 0;
    f->below |= h < 0;
    if (h != 0) continue;
    if (!f->on++) f->first_on = i;
    f->last_on = i;
  }
}

/* Returns the entry of the hash table for the point where the edge from point p to point q crosses the patch. The
 * number of entries is a power of two. */
static crossing *crossing_of(chunk *m, uint32_t p, uint32_t q, uint32_t patch) {
  uint32_t low = p < q ? p : q, high = p < q ? q : p;
  uint64_t hash = (((uint64_t)low << 32 | high) ^ (uint64_t)patch * 0xd6e8feb86659fd93u) * 0x9e3779b97f4a7c15u;
  crossing *x = &m->w->crossings.at[hash >> 40 & (m->w->crossings.count - 1)];
  VS_ASSERT(p != q && (m->w->crossings.count & (m->w->crossings.count - 1)) == 0);
  if (x->low != low || x->high != high || x->patch != patch) *x = (crossing){ low, high, patch, VS_NONE };
  return x;
}

/* An end of the interval in which a patch covers the line of two planes. The end is at a corner of the patch, or
 * between a corner and the next. */
typedef struct {
  const facing *f;
  uint32_t corner, next; /* the end lies on the edge from `corner` to the corner `next` of the patch; if the two are
                          * equal, it lies at this corner */
  double at, error;      /* at: coordinate of the end along the line's main axis, in steps; error: upper bound for its
                          * error */
} end;

static bool is_corner(const end *e) { return e->corner == e->next; }

/* Computes the exact position of an end that lies between two corners. */
static bool end_place(const vs_cluster *c, const end *e, vs_homogeneous *out) {
  const vs_patch_corner *x = corners(c, e->f->of);
  VS_ASSERT(e->corner != e->next);
  return vs_meet_edge(x[e->corner].at, x[e->next].at, &c->planes.all.at[e->f->other->plane], out);
}

/* Compares the ends a and b along the axis. Returns -1, 1, or 0 if they are one point. */
static int compare(const vs_cluster *c, const end *a, const end *b, int axis) {
  double d = a->at - b->at, error = a->error + b->error;
  if (fabs(d) > error || error <= 0) return (d > 0) - (d < 0);
  vs_homogeneous p, q;
  for (int i = 0; i < 2; i++) {
    const end *e = i ? b : a;
    vs_homogeneous *to = i ? &q : &p;
    if (is_corner(e)) vs_homogeneous_integer(corners(c, e->f->of)[e->corner].at, to);
    else end_place(c, e, to);
  }
  return vs_homogeneous_compare(&p, &q, axis);
}

/* Returns the position of end e on its edge, from 0 at `corner` to 1 at `next`. */
static double fraction(const end *e) {
  double u = e->f->height[e->corner], v = e->f->height[e->next];
  return is_corner(e) ? 0 : u / (u - v);
}

/* Computes the interval of the line that the patch covers. On an edge whose ends have the heights u and v, the interval
 * ends at the fraction t = u / (u - v) of the edge. The error of t is below 3 errors of a height / |u - v|. Rounding
 * adds errors below 2^-18 steps. */
static void cover(const vs_cluster *c, const facing *f, int axis, end *low, end *high) {
  const vs_patch_corner *x = corners(c, f->of);
  const double *h = f->height;
  bool begun = false;
  for (uint32_t i = 0, n = f->of->count; i < n; i++) {
    uint32_t j = i + 1 == n ? 0 : i + 1;
    if (h[i] != 0 && h[i] * h[j] >= 0) continue;
    end e = { f, i, h[i] != 0 ? j : i, x[i].at[axis], 0 };
    double d = (double)x[e.next].at[axis] - x[i].at[axis];
    if (d != 0) {
      e.at += fraction(&e) * d;
      e.error = 0x1p-18 + 4 * f->error * fabs(d) / fabs(h[i] - h[j]);
    }
    if (!begun) *low = *high = e;
    else if (compare(c, &e, low, axis) < 0) *low = e;
    else if (compare(c, &e, high, axis) > 0) *high = e;
    begun = true;
  }
}

/* Returns a coordinate axis that is not perpendicular to the intersection line of the planes p and q. */
static int axis_of(const vs_plane *p, const vs_plane *q) {
  double most = 0, bound = 0;
  int best = 0;
  for (int i = 0; i < 3; i++) {
    int u = (i + 1) % 3, v = (i + 2) % 3;
    double s = (double)p->n[u] * (double)q->n[v], t = (double)p->n[v] * (double)q->n[u];
    if (fabs(s) + fabs(t) > bound) bound = fabs(s) + fabs(t);
    if (fabs(s - t) > most) most = fabs(s - t), best = i;
  }
  if (most > bound * 0x1p-50) return best;
  for (best = 0; best < 2; best++) { /* The planes are not parallel. Therefore at least one component of the line's
                                      * direction is not zero. */
    int u = (best + 1) % 3, v = (best + 2) % 3;
    if ((vs_i128)p->n[u] * q->n[v] != (vs_i128)p->n[v] * q->n[u]) break;
  }
  return best;
}

/* Computes the position of end e in steps. Returns false if its error is too large to decide whether a convex leaf
 * hides it. */
static bool end_at(const vs_cluster *c, const end *e, double at[3]) {
  const vs_patch_corner *x = corners(c, e->f->of);
  const double *h = e->f->height;
  double t = fraction(e), length = 0;
  for (int i = 0; i < 3; i++) {
    double d = (double)x[e->next].at[i] - x[e->corner].at[i];
    at[i] = x[e->corner].at[i] + t * d;
    length = fmax(length, fabs(d));
  }
  return is_corner(e) || 4 * e->f->error * length <= 0.25 * fabs(h[e->corner] - h[e->next]);
}

/* Returns true if the coplanar patches a and b overlap or touch at more than their common corners and edges. */
static bool overlap(const vs_cluster *c, const vs_patch *a, const vs_patch *b) {
  const vs_plane *plane = &c->planes.all.at[a->plane];
  const vs_patch *t[2] = { a, b };
  bool apart = false;
  for (int s = 0; s < 2; s++) {
    const vs_patch_corner *x = corners(c, t[s]), *y = corners(c, t[!s]);
    int turn = t[s]->flip ? -1 : 1;
    for (uint32_t i = 0; i < t[s]->count; i++) {
      uint32_t j = i + 1 == t[s]->count ? 0 : i + 1;
      bool outside = true, trivial = true;
      for (uint32_t e = 0; outside && e < t[!s]->count; e++) {
        int side = orient2(x[i].at, x[j].at, y[e].at, plane) * turn;
        outside = side <= 0;
        if (side == 0 && y[e].point != x[i].point && y[e].point != x[j].point) trivial = false;
      }
      if (outside && trivial) return false;
      apart = apart || outside;
    }
  }
  return !(apart && a->facet == b->facet);
}

/* Returns true if triangles a and b of one leaf, in different planes, share only a corner or an edge, as neighbours do.
 * Returns false if this quick test does not decide. */
static bool only_neighbours(const vs_cluster *c, const vs_patch *a, const vs_patch *b) {
  if (a->count != 3 || b->count != 3) return false;
  const vs_patch_corner *x = corners(c, a), *y = corners(c, b);
  uint32_t in_a = 0, in_b = 0; /* in_a: bit i is set if corner i of triangle a is also a corner of triangle b; in_b: the
                                * same for the corners of b */
  for (uint32_t i = 0; i < 3; i++)
    for (uint32_t j = 0; j < 3; j++) {
      uint32_t same = x[i].point == y[j].point;
      in_a |= same << i, in_b |= same << j;
    }
  static const uint8_t edge[8] = { [3] = 1, [6] = 2, [5] = 4 }; /* bit of the edge between two corners of a triangle;
                                                                 * the index has the bits of these two corners */
  if (edge[in_a]) return !(a->inner & edge[in_a]) && !(b->inner & edge[in_b]);
  if (!in_a) return false;
  for (int side = 0; side < 2; side++) {
    const vs_plane *p = &c->planes.all.at[side ? b->plane : a->plane];
    const vs_patch_corner *at = side ? x : y;
    uint32_t own = side ? in_a : in_b, i = own == 1 ? 1 : 0, j = own == 4 ? 1 : 2;
    if (vs_sign128(height(p, at[i].at)) * vs_sign128(height(p, at[j].at)) > 0) return true;
  }
  return false;
}

/* Returns true if the segment from p to q is new for patch x: neither a corner nor an edge of its facet. */
static bool is_new(const vs_cluster *c, const vs_patch *x, uint32_t p, uint32_t q) {
  if (p == q) return !corner_of(c, x, p);
  uint32_t edge = edge_of(c, x, p, q);
  return edge == VS_NONE || (edge < 3 && (x->inner >> edge & 1));
}

/* Returns true if the patch touches the other patch's plane only in a corner or edge that belongs to both patches. */
static bool only_touches(const vs_cluster *c, const facing *f) {
  if ((f->above && f->below) || f->on > 2) return false;
  const vs_patch_corner *x = corners(c, f->of);
  uint32_t p = x[f->first_on].point, q = x[f->last_on].point;
  return !is_new(c, f->other, p, q) && !is_new(c, f->of, p, q);
}

/* Sets *id to the number of the point at end e. Makes the point if it does not exist. */
static bool end_point(chunk *m, const end *e, uint32_t *id) {
  const vs_patch_corner *p = &corners(m->c, e->f->of)[e->corner], *q = &corners(m->c, e->f->of)[e->next];
  *id = p->point;
  if (p == q) return true;
  crossing *known = crossing_of(m, p->point, q->point, (uint32_t)(e->f->other - m->c->patches.at));
  if (known->fresh == VS_NONE) {
    vs_fresh_point made;
    if (!end_place(m->c, e, &made.at)) return VS_BROKEN(m->k, "an edge and a plane do not meet");
    vs_fresh_fill(&made);
    known->fresh = (uint32_t)m->fresh.count;
    vs_edge edge = { known->low, known->high };
    if (!VS_PUSH(m->k, m->fresh, made) || !VS_PUSH(m->k, m->edges, edge)) return false;
  }
  *id = FRESH | known->fresh;
  return true;
}

/* Inserts into `line` the corners of f's patch between the ends low and high. If such a corner is at the same place as
 * an end, it replaces the end. */
static bool corners_between(chunk *m, const facing *f, int axis, end *low, end *high) {
  const vs_patch_corner *x = corners(m->c, f->of);
  for (uint32_t i = 0; f->on > 2 && i < f->of->count; i++) {
    if (f->height[i] != 0) continue;
    end e = { f, i, i, x[i].at[axis], 0 };
    int above = compare(m->c, &e, low, axis), below = compare(m->c, high, &e, axis);
    if (above == 0) *low = e;
    if (below == 0) *high = e;
    if (above <= 0 || below <= 0) continue;
    size_t to = m->w->line.count;
    if (!VS_PUSH(m->k, m->w->line, x[i])) return false;
    vs_patch_corner *line = m->w->line.at;
    for (; to > 0 && line[to - 1].at[axis] > x[i].at[axis]; to--) line[to] = line[to - 1];
    line[to] = x[i];
    if (to > 0 && line[to - 1].point == x[i].point) { /* the corner that was entered in `line` last is the same point as
                                                       * this corner of the second patch */
      m->w->line.count--;
      memmove(line + to, line + to + 1, (m->w->line.count - to) * sizeof *line);
    }
  }
  return true;
}

/* Returns true if the segment from p to q, on the line of the two planes, is new for f's patch: neither an edge nor a
 * corner of it. */
static bool is_new_on(const vs_cluster *c, const facing *f, uint32_t p, uint32_t q) {
  const vs_patch_corner *x = corners(c, f->of);
  if (f->on > 2) return is_new(c, f->of, p, q);
  if (p == q) return !f->on || (x[f->first_on].point != p && x[f->last_on].point != p);
  if (f->on < 2 || x[f->first_on].point + x[f->last_on].point != p + q ||
      (x[f->first_on].point != p && x[f->last_on].point != p))
    return true;
  uint32_t between = f->last_on - f->first_on, edge = between == 1 ? f->first_on : f->last_on;
  return (between != 1 && between + 1 != f->of->count) || (edge < 3 && (f->of->inner >> edge & 1));
}

/* Returns two bits. Bit 0: the segment from p to q is new in the first patch. Bit 1: it is new in the second patch. */
static uint32_t new_in(const vs_cluster *c, const facing f[2], uint32_t p, uint32_t q) {
  if ((p | q) & FRESH) return 3;
  return (uint32_t)is_new_on(c, &f[0], p, q) | (uint32_t)is_new_on(c, &f[1], p, q) << 1;
}

static bool add_contact(chunk *m, const facing f[2], uint32_t p, uint32_t q) {
  const vs_patch *first = m->c->patches.at;
  uint32_t cut = new_in(m->c, f, p, q);
  return !cut ||
         VS_PUSH(m->k, m->contacts, ((contact){ (uint32_t)(f[0].of - first), (uint32_t)(f[1].of - first), p, q, cut }));
}

static uint32_t corner_point(const vs_cluster *c, const end *e) { return corners(c, e->f->of)[e->corner].point; }

/* For every 16th cut (segment that two patches share), tests whether a convex leaf hides its middle in the result. */
static void look_whether_hidden(chunk *m, uint32_t place, const double p[3], const double q[3]) {
  enum { ONE_IN = 16 };
  if (++m->left % ONE_IN) return;
  double middle[3] = { (p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2 };
  m->looked++;
  m->hidden += vs_cull_point(m->c, place, middle);
}

/* Intersects patches a and b, which lie in different planes. Records the segments or the point that they share. */
static bool share(chunk *m, const vs_patch *a, const vs_patch *b) {
  const vs_cluster *c = m->c;
  const vs_patch *t[2] = { a, b };
  facing f[2];
  end low[2], high[2];
  for (int i = 0; i < 2; i++) {
    int which = (t[1]->count < t[0]->count) ^ i; /* Begins with the patch that has fewer corners. Its heights over the
                                                  * other plane are cheaper to compute, and mostly show that the pair
                                                  * does not touch. */
    if (!VS_ROOM(m->k, m->w->heights[which].at, m->w->heights[which].room, t[which]->count)) return false;
    f[which] = (facing){ .of = t[which], .other = t[!which], .height = m->w->heights[which].at };
    face_to(c, &f[which]);
    if ((!f[which].on && !(f[which].above && f[which].below)) || only_touches(c, &f[which])) return true;
  }
  int axis = axis_of(&c->planes.all.at[t[0]->plane], &c->planes.all.at[t[1]->plane]);
  for (int i = 0; i < 2; i++) cover(c, &f[i], axis, &low[i], &high[i]);
  int below = compare(c, &low[0], &low[1], axis), above = compare(c, &high[1], &high[0], axis);
  end from = low[below < 0 || (below == 0 && !is_corner(&low[0]))],
      to = high[above < 0 || (above == 0 && !is_corner(&high[0]))];
  int length = compare(c, &to, &from, axis);
  if (length < 0) return true;
  if (length == 0 && !is_corner(&from)) from = to; /* the shared segment is a single point: uses the end that is a
                                                    * corner of a patch, if there is one */
  if (length == 0) to = from;
  if (is_corner(&from) && is_corner(&to) && !new_in(c, f, corner_point(c, &from), corner_point(c, &to))) return true;
  if (t[0]->place != t[1]->place) {
    double p[3], q[3];
    m->asked++;
    if (end_at(c, &from, p) && end_at(c, &to, q)) {
      if (vs_cull_segment(c, t[0]->place, t[1]->place, p, q)) return true;
      look_whether_hidden(m, t[0]->place, p, q);
    }
  }
  m->w->line.count = 0;
  for (int i = 0; length && i < 2; i++)
    if (!corners_between(m, &f[i], axis, &from, &to)) return false;
  uint32_t p, q;
  if (!end_point(m, &from, &p)) return false;
  if (!length) return add_contact(m, f, p, p);
  for (size_t i = 0; i < m->w->line.count; i++, p = q) {
    q = m->w->line.at[i].point;
    if (!add_contact(m, f, p, q)) return false;
  }
  return end_point(m, &to, &q) && add_contact(m, f, p, q);
}

static bool meet(void *context, uint32_t first, uint32_t second) {
  chunk *m = context;
  const vs_cluster *c = m->c;
  if (first > second) { /* The order of points p and q must not depend on the order in which the tree of boxes returns
                         * pairs. */
    uint32_t t = first;
    first = second;
    second = t;
  }
  const vs_patch *a = &c->patches.at[first], *b = &c->patches.at[second];
  if (!vs_kernel_poll(m->k, 0.1)) return false;
  if (a->plane == b->plane)
    return !overlap(c, a, b) || VS_PUSH(m->k, m->contacts, ((contact){ first, second, 0, 0, 0 }));
  return (a->place == b->place && only_neighbours(c, a, b)) || share(m, a, b);
}

/* ---- union of the chunks' results ---- */

typedef struct {
  vs_kernel *k;
  vs_cluster *c;
  uint32_t *group; /* group[f]: parent of facet f in a union-find structure of coplanar facets that touch */
  VS_LIST(uint32_t) ids;  /* ids[i]: number in the cluster of new point i of a task */
  chunk chunks[VS_PIPELINE_WINDOW];
  working *works; /* array with the working memory of each thread */
  size_t chunk_count;
  size_t asked, left, looked, hidden; /* sums, over the chunks so far, of their members `asked`, `left`, `looked` and
                                       * `hidden` */
} meeting;

static bool leave(meeting *m, const vs_patch *t, uint32_t p, uint32_t q, uint32_t plane) {
  m->c->facets.at[t->facet].touched = true;
  return VS_PUSH(m->k, m->c->cuts, ((vs_facet_cut){ t->facet, p, q, plane }));
}

/* Returns true if the chunks so far have very many cuts and the result hides nearly all of them. The solids should then
 * be united two by two. */
static bool most_is_hidden(const meeting *m, size_t index) {
  enum { SURE = 500, EACH = 32, LEAST = 20000 };
  const vs_cluster *c = m->c;
  double asked = (double)m->asked, shown = (double)m->left * (1 - (double)m->hidden / (double)(m->looked + 1));
  if (c->crowd <= 2 || c->layered || m->asked < SURE || shown > asked / 4) return false;
  return asked * (double)m->chunk_count > (double)(index + 1) * (EACH * (double)c->facets.count + LEAST);
}

static bool absorb(vs_kernel *k, void *context, size_t index) {
  meeting *m = context;
  vs_cluster *c = m->c;
  const chunk *from = &m->chunks[index % VS_PIPELINE_WINDOW];
  if (!VS_ROOM(k, m->ids.at, m->ids.room, from->fresh.count + 1) ||
      !vs_points_add_all(k, &c->points, NULL, from->fresh.at, from->fresh.count, m->ids.at) ||
      !VS_ROOM(k, c->edge_of.at, c->edge_of.room, c->points.all.count))
    return false;
  for (; c->edge_of.count < c->points.all.count;) c->edge_of.at[c->edge_of.count++] = (vs_edge){ 0, 0 };
  for (size_t i = 0; i < from->fresh.count; i++) c->edge_of.at[m->ids.at[i]] = from->edges.at[i];
  m->asked += from->asked;
  m->left += from->left;
  m->looked += from->looked;
  m->hidden += from->hidden;
  if (vs_too_many(c, c->cuts.count) || most_is_hidden(m, index)) return c->crowded = true, false;
  if (!vs_kernel_on_the_way(k, c->cuts.count)) return false;
  for (size_t i = 0; i < from->contacts.count; i++) {
    const contact *x = &from->contacts.at[i];
    const vs_patch *a = &c->patches.at[x->a], *b = &c->patches.at[x->b];
    if (!x->cut) {
      c->facets.at[a->facet].touched = c->facets.at[b->facet].touched = true;
      vs_unite(m->group, a->facet, b->facet);
      continue;
    }
    uint32_t p = x->p & FRESH ? m->ids.at[x->p & ~FRESH] : x->p, q = x->q & FRESH ? m->ids.at[x->q & ~FRESH] : x->q;
    if ((x->cut & 1 && !leave(m, a, p, q, b->plane)) || (x->cut & 2 && !leave(m, b, p, q, a->plane))) return false;
  }
  return true;
}

enum { CHUNK = 64 }; /* Number of blocks of the tree of boxes in which one task searches pairs of patches. */

static bool meet_chunk(vs_kernel *k, void *context, size_t index) {
  meeting *all = context;
  chunk *m = &all->chunks[index % VS_PIPELINE_WINDOW];
  m->k = k;
  m->c = all->c;
  m->w = &all->works[k->worker];
  m->contacts.count = m->fresh.count = m->edges.count = m->asked = m->left = m->looked = m->hidden = 0;
  uint32_t first = (uint32_t)index * CHUNK, blocks = vs_bvh_blocks(&all->c->bvh) - first;
  size_t crossings = 64;
  while (crossings < CROSSINGS && crossings < 32 * (size_t)blocks) crossings *= 2;
  if (!VS_ROOM(k, m->w->crossings.at, m->w->crossings.room, crossings)) return false;
  /* Clears the thread's cache of crossings, so that the results of a chunk depend only on the chunk. */
  memset(m->w->crossings.at, 0xff, crossings * sizeof *m->w->crossings.at);
  m->w->crossings.count = crossings;
  return vs_bvh_pairs(k, &all->c->bvh, first, first + CHUNK, meet, m) && vs_kernel_report(k, 0.1);
}

bool vs_meet_patches(vs_kernel *k, vs_cluster *c) {
  meeting m = { .k = k, .c = c, .chunk_count = ((size_t)vs_bvh_blocks(&c->bvh) + CHUNK - 1) / CHUNK };
  size_t room = 0, works = 0;
  bool ok = VS_ROOM(k, m.group, room, c->facets.count + 1) && VS_ROOM(k, m.works, works, k->threads);
  if (ok) memset(m.works, 0, works * sizeof *m.works);
  if (ok) vs_disjoint(m.group, (uint32_t)c->facets.count);
  ok = ok && vs_kernel_pipeline(k, m.chunk_count, meet_chunk, absorb, &m);
  for (uint32_t i = 0; ok && i < c->facets.count; i++) c->facets.at[i].group = vs_find(m.group, i);
  for (int i = 0; i < VS_PIPELINE_WINDOW; i++) {
    VS_DROP(k, m.chunks[i].contacts);
    VS_DROP(k, m.chunks[i].fresh);
    VS_DROP(k, m.chunks[i].edges);
  }
  for (size_t i = 0; i < works; i++) {
    for (int side = 0; side < 2; side++) VS_DROP(k, m.works[i].heights[side]);
    VS_DROP(k, m.works[i].line);
    VS_DROP(k, m.works[i].crossings);
  }
  VS_FREE(k, m.works, works);
  VS_DROP(k, m.ids);
  VS_FREE(k, m.group, room);
  return ok;
}
