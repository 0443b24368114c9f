/* Owns the meeting of triangles: finds every pair that touches and leaves in both facets the segment or point they share.
 *
 * Two triangles in different planes share a segment whose ends are corners or edges of one that lie in the other. Each such end is decided by
 * integer predicates before it gets a point, so pairs that only come near cost no wide arithmetic. A contact that is a corner or a whole
 * boundary edge of a triangle already is nothing new for that triangle. Triangles of one plane unite their facets into a group. Triangles of
 * one leaf are treated as any others: a leaf may cross itself, and rounding to the grid may have folded it. */
#include "kernel/cluster.h"

typedef struct {
  vs_kernel *k;
  vs_cluster *c;
  uint32_t *group; /* union-find over facets */
  size_t done;
} meeting;

static int orient2(const int32_t a[3], const int32_t b[3], const int32_t c[3], const vs_plane *p) {
  int64_t ax = (int64_t)b[p->u] - a[p->u], ay = (int64_t)b[p->v] - a[p->v], bx = (int64_t)c[p->u] - a[p->u], by = (int64_t)c[p->v] - a[p->v];
  int64_t s = ax * by - ay * bx;
  return (s > 0) - (s < 0);
}

static bool corner_of(const vs_soup_triangle *t, uint32_t id) { return t->v[0] == id || t->v[1] == id || t->v[2] == id; }

/* Which edge of t runs between the corners p and q; -1: none. */
static int edge_of(const vs_soup_triangle *t, uint32_t p, uint32_t q) {
  for (int i = 0; i < 3; i++)
    if ((t->v[i] == p && t->v[(i + 1) % 3] == q) || (t->v[i] == q && t->v[(i + 1) % 3] == p)) return i;
  return -1;
}

static bool leave(meeting *m, const vs_soup_triangle *t, uint32_t p, uint32_t q, uint32_t plane) {
  if (p == q ? corner_of(t, p) : false) return true;
  int edge = edge_of(t, p, q);
  if (edge >= 0 && !(t->inner >> edge & 1)) return true;
  m->c->facets.at[t->facet].touched = true;
  return VS_PUSH(m->k, m->c->cuts, ((vs_cut){ t->facet, p, q, plane }));
}

/* The ends of a's crossing with b's plane that lie in b. sides: of a's corners against b's plane. */
static bool ends(meeting *m, const vs_soup_triangle *a, int32_t at[3][3], const int sides[3], const vs_soup_triangle *b, int32_t bt[3][3],
                 uint32_t found[6], int *count) {
  const vs_plane *plane = &m->c->planes.all.at[b->plane];
  int turn = b->flip ? -1 : 1;
  for (int i = 0; i < 3; i++) {
    int j = (i + 1) % 3;
    uint32_t id;
    if (sides[i] == 0) {
      id = a->v[i];
      if (!corner_of(b, id)) {
        bool inside = true;
        for (int e = 0; inside && e < 3; e++) inside = orient2(bt[e], bt[(e + 1) % 3], at[i], plane) * turn >= 0;
        if (!inside) continue;
      }
    } else if (sides[i] * sides[j] < 0) {
      int low = 0, high = 0;
      for (int e = 0; e < 3 && low * high == 0; e++) {
        int s = vs_orient3d(at[i], at[j], bt[e], bt[(e + 1) % 3]);
        if (s < 0) low = -1;
        if (s > 0) high = 1;
      }
      if (low * high != 0) continue;
      vs_homogeneous h;
      if (!vs_meet_edge(at[i], at[j], plane, &h)) return VS_BROKEN(m->k, "an edge and a plane do not meet");
      if (!vs_points_add(m->k, &m->c->points, &h, &id)) return false;
    } else {
      continue;
    }
    bool known = false;
    for (int x = 0; x < *count; x++) known = known || found[x] == id;
    if (!known) found[(*count)++] = id;
  }
  return true;
}

/* Triangles of one plane: do they touch in more than corners and edges that both have? */
static void coplanar(meeting *m, vs_soup_triangle *a, vs_soup_triangle *b) {
  const vs_plane *plane = &m->c->planes.all.at[a->plane];
  vs_soup_triangle *t[2] = { a, b };
  int32_t at[2][3][3];
  uint32_t id[2][3];
  for (int s = 0; s < 2; s++)
    for (int i = 0; i < 3; i++) {
      id[s][i] = t[s]->v[t[s]->flip ? 2 - i : i]; /* both counter-clockwise as seen from the plane's normal */
      vs_points_grid(&m->c->points, id[s][i], at[s][i]);
    }
  bool apart = false;
  for (int s = 0; s < 2; s++)
    for (int i = 0; i < 3; i++) {
      int j = (i + 1) % 3;
      bool outside = true, trivial = true;
      for (int x = 0; outside && x < 3; x++) {
        int side = orient2(at[s][i], at[s][j], at[!s][x], plane);
        outside = side <= 0;
        if (side == 0 && id[!s][x] != id[s][i] && id[!s][x] != id[s][j]) trivial = false;
      }
      if (outside && trivial) return;
      apart = apart || outside;
    }
  if (apart && a->facet == b->facet) return;
  m->c->facets.at[a->facet].touched = m->c->facets.at[b->facet].touched = true;
  vs_unite(m->group, a->facet, b->facet);
}

static bool meet(void *context, uint32_t first, uint32_t second) {
  meeting *m = context;
  if (!vs_kernel_poll(m->k, 0.1)) return false;
  if (first > second) { /* points are numbered in an order that does not depend on the index */
    uint32_t t = first;
    first = second;
    second = t;
  }
  vs_soup_triangle *a = &m->c->triangles.at[first], *b = &m->c->triangles.at[second];
  if (a->plane == b->plane) {
    coplanar(m, a, b);
    return true;
  }
  int shared = corner_of(b, a->v[0]) + corner_of(b, a->v[1]) + corner_of(b, a->v[2]);
  if (shared >= 2) { /* an edge of both; it may run inside the facet of one */
    uint32_t p = corner_of(b, a->v[0]) ? a->v[0] : a->v[1], q = corner_of(b, a->v[2]) ? a->v[2] : a->v[1];
    return leave(m, a, p, q, b->plane) && leave(m, b, p, q, a->plane);
  }
  vs_points_view view = vs_points_of(&m->c->points);
  int sa[3], sb[3], all;
  const vs_plane *pa = &m->c->planes.all.at[a->plane], *pb = &m->c->planes.all.at[b->plane];
  for (int i = 0; i < 3; i++) sb[i] = corner_of(a, b->v[i]) ? 0 : vs_side(view, pa, b->v[i]);
  all = sb[0] + sb[1] + sb[2];
  if (all == 3 || all == -3 || (shared && (all == 2 || all == -2))) return true;
  for (int i = 0; i < 3; i++) sa[i] = corner_of(b, a->v[i]) ? 0 : vs_side(view, pb, a->v[i]);
  all = sa[0] + sa[1] + sa[2];
  if (all == 3 || all == -3 || (shared && (all == 2 || all == -2))) return true;
  int32_t at[3][3], bt[3][3];
  for (int i = 0; i < 3; i++) {
    vs_points_grid(&m->c->points, a->v[i], at[i]);
    vs_points_grid(&m->c->points, b->v[i], bt[i]);
  }
  uint32_t found[6];
  int count = 0;
  if (!ends(m, a, at, sa, b, bt, found, &count) || !ends(m, b, bt, sb, a, at, found, &count)) return false;
  if (count == 0) return true;
  if (count > 2) return VS_BROKEN(m->k, "two triangles meet in more than a segment");
  uint32_t p = found[0], q = found[count - 1];
  return leave(m, a, p, q, b->plane) && leave(m, b, p, q, a->plane);
}

bool vs_meet_triangles(vs_kernel *k, vs_cluster *c) {
  meeting m = { k, c, NULL, 0 };
  size_t room = 0;
  bool ok = VS_ROOM(k, m.group, room, c->facets.count + 1);
  for (uint32_t i = 0; ok && i < c->facets.count; i++) m.group[i] = i;
  ok = ok && vs_bvh_build(k, &c->bvh, c->boxes.at, (uint32_t)c->triangles.count) && vs_bvh_pairs(&c->bvh, meet, &m);
  for (uint32_t i = 0; ok && i < c->facets.count; i++) c->facets.at[i].group = vs_find(m.group, i);
  VS_FREE(k, m.group, room);
  return ok;
}
