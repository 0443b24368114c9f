/* Decides which bends the result may lose.
 *
 * The grid may split a planar facet of the input into several planes. Each cut through it then bends where it passes
 * from one plane to the next. A sheet is such a facet. All its corners lie within one step of its middle plane. The
 * directions of its triangles differ from its normal by at most 2.6 degrees. The faces of a sheet are merged like
 * coplanar faces, and the cuts between merged faces lose their bends, under three conditions.
 *
 * (1) No other facet lies in a plane of the sheet. Every edge at the border of its faces has two triangles, at an angle
 * of at least 11 degrees. Otherwise the sheet keeps its bends.
 *
 * (2) All bends of the cut lie within 8 steps of the line between the cut's ends. The angle between the two faces at
 * the cut is at least 14 degrees. A band around the line is half a step wider than the largest distance of a bend from
 * the line. No other corner of a face in either plane or sheet lies in this band. Otherwise the bends of this cut stay.
 *
 * (3) As seen along the sheet's normal, the borders of the merged faces intersect and touch only at their ends. No new
 * triangle turns away from the sheet's normal. Otherwise the sheet keeps its bends, and the result is made again.
 *
 * In the plane of the face on the other side of the cut, only the band changes, and it contains nothing else. An edge
 * that enters the space between the line and the bends must end there, or leave through the straight line. By (3) a
 * merged face is a single layer over its plane, within a step of it, and its direction differs by less than 2.6
 * degrees. By (1) and (2) any face that shares an edge with it is steeper. Faces without a common edge that were within
 * two steps of each other may intersect afterwards. The caller checks for this (round/self_contacts.c), and makes the
 * result again with all bends if necessary. */
#include "kernel/mesh/straighten.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kernel/threads.h"

static const double OFF = 1, ALIKE = 0.999, WEDGE = -0.98, SHALLOW = 0.97, FAR = 8, BESIDE = 0.5;

typedef struct {
  double n[3], at[3]; /* middle plane of the sheet, a planar facet that the grid has split into several. n: its unit
                       * normal, outwards; at: a point of the plane, in grid steps */
  uint32_t corners, bends;
  bool merged, fresh;       /* merged: true if the sheet's faces are merged into one; fresh: true if this merging was
                             * given up since the last check of the cuts */
  _Atomic bool given_up;
} sheet;

typedef struct {
  uint32_t p, q, edge, keys[2], sheets[2]; /* A cut from point p to point q, without the corners between them (bends),
                                            * which are dropped. Its first edge is `edge`. On its two sides are faces
                                            * with the representative planes `keys`, in the sheets `sheets` (planar
                                            * facets that the grid has split). */
  double wide;
} cut;
typedef struct { double at; uint32_t point; } placed;
typedef struct { uint32_t near, point; } corner;

struct vs_sheets {
  VS_LIST(sheet) all;
  VS_LIST(uint32_t) of;       /* of[f]: number of the sheet (planar facet that the grid has split) that contains facet
                               * f, or VS_NONE */
  VS_LIST(uint32_t) of_face;  /* of_face[f]: number of the sheet (planar facet that the grid has split) that contains
                               * face f, or VS_NONE */
  VS_LIST(uint32_t) face_key; /* face_key[f]: number of the plane that represents face f's plane; if the grid has split
                               * a planar facet into several planes, one of them represents all; VS_NONE if unknown */
  VS_LIST(cut) cuts;
  VS_LIST(uint32_t) cut_of;   /* cut_of[p]: index of the cut along which the corner at point p is to be dropped */
  VS_LIST(uint32_t) key;      /* key[p]: number of the plane that represents plane p and all other planes that the grid
                               * has split from one planar facet */
  VS_LIST(uint32_t) near;     /* near[p]: index in the array `first` of plane p, if it is a representative plane and has
                               * cuts; otherwise VS_NONE */
  VS_LIST(uint32_t) first;    /* first[i]: position in `corners` of the first corner for the representative plane with
                               * the index i; corners are sorted by x; an extra element marks the end */
  VS_LIST(placed) corners;
  VS_LIST(corner) hits;       /* corners of faces, before they are sorted by plane into `corners` */
  VS_LIST(uint8_t) free;      /* free[i]: 1 if the band around the straightened cut i contains no corner except those of
                               * the cut itself */
  size_t near_count, room;  /* near_count: number of representative planes with cuts; room: size of this structure in
                             * bytes */
  bool kept;                /* true if the current round of checks found bends (corners of a cut) that must stay */
  bool looked;              /* true if the bands around all cuts have been checked; later rounds check only the bands
                             * beside faces that are no longer merged */
  _Atomic bool spoiled;
};

static void place(const vs_result_state *w, uint32_t p, double to[3]) {
  const vs_point *at = &w->c->points.all.at[p];
  for (int i = 0; i < 3; i++) to[i] = (double)at->fixed[i] * 0x1p-30;
}
static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static void between(const double a[3], const double b[3], double to[3]) {
  for (int i = 0; i < 3; i++) to[i] = b[i] - a[i];
}
static void cross(const double a[3], const double b[3], double to[3]) {
  for (int i = 0; i < 3; i++) to[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* ---- seams ---- */

bool vs_sheets_begin(vs_result_state *w) {
  const vs_cluster *c = w->c;
  size_t planes = c->planes.all.count;
  bool any = false;
  for (uint32_t f = 0; f < c->sheets.count && !any; f++) any = c->sheets.at[f] != f;
  if (!any) return true;
  if (!VS_ROOM(w->k, w->lone.at, w->lone.room, planes + 1)) return false;
  w->lone.count = planes;
  memset(w->lone.at, 0xff, planes * sizeof *w->lone.at); /* sets every element to VS_NONE */
  for (int twice = 0; twice < 2; twice++)
    for (uint32_t f = 0; f < c->facets.count; f++) {
      uint32_t *lone = &w->lone.at[c->facets.at[f].plane];
      if (!twice) *lone = *lone == VS_NONE ? f : VS_NONE - 1; /* VS_NONE - 1 marks a plane that has more than one
                                                               * facet */
      else if (*lone == VS_NONE - 1) *lone = VS_NONE;
    }
  return vs_kernel_report(w->k, 0.9);
}

bool vs_sheets_seam(const vs_result_state *w, const vs_use *a, const vs_use *b) {
  const vs_cluster *c = w->c;
  const vs_face *f = &c->faces.at[a->face], *g = &c->faces.at[b->face];
  uint32_t x = vs_result_facet(w, f), y = vs_result_facet(w, g);
  if (x == VS_NONE || y == VS_NONE || x == y || c->sheets.at[x] != c->sheets.at[y]) return false;
  bool turned = c->facets.at[x].flip != c->facets.at[y].flip;
  const vs_kernel_problem *p = c->problem;
  return (c->kept.at[a->face] == c->kept.at[b->face]) != turned &&
         (turned ? a->from == b->from : a->from == b->to) &&
         (f->tag == g->tag || (p->paints && p->paints[f->tag] == p->paints[g->tag]));
}

/* Returns the sheet (planar facet that the grid has split) that contains the face, if its faces are merged, else
 * VS_NONE. */
static uint32_t merged_sheet_of(const vs_result_state *w, uint32_t face) {
  uint32_t s = w->sheets->of_face.at[face];
  return s == VS_NONE || !w->sheets->all.at[s].merged ? VS_NONE : s;
}
static void give_up(vs_result_state *w, uint32_t s) {
  if (s != VS_NONE) atomic_store_explicit(&w->sheets->all.at[s].given_up, true, memory_order_relaxed);
}

/* ---- sheets ---- */

static void corners_of(const vs_cluster *c, const vs_grid_triangle *t, double at[3][3]) {
  for (int j = 0; j < 3; j++) {
    int32_t x[3];
    vs_points_grid(&c->points, t->v[j], x);
    for (int i = 0; i < 3; i++) at[j][i] = x[i];
  }
}

static void normal_of(double at[3][3], double n[3]) {
  double a[3], b[3];
  between(at[0], at[1], a);
  between(at[0], at[2], b);
  cross(a, b, n);
}

/* Computes the middle plane of each sheet (planar facet that the grid has split). Gives up merging the faces of a sheet
 * if a corner is more than a grid step away from this plane. */
static bool measure(vs_result_state *w) {
  const vs_cluster *c = w->c;
  vs_sheets *s = w->sheets;
  for (int step = 0; step < 3; step++) { /* step 0 adds normals and positions; step 1 divides them to means; step 2
                                          * checks the distance of the corners */
    for (size_t i = 0; step == 1 && i < s->all.count; i++) {
      sheet *x = &s->all.at[i];
      double length = sqrt(dot(x->n, x->n));
      for (int a = 0; a < 3; a++) x->n[a] /= length, x->at[a] /= x->corners;
    }
    for (size_t i = 0; step != 1 && i < c->triangles.count; i++) {
      uint32_t of = s->of.at[c->triangles.at[i].facet];
      if (!vs_kernel_poll(w->k, 0.9)) return false;
      if (of == VS_NONE) continue;
      sheet *x = &s->all.at[of];
      double at[3][3], n[3], d[3];
      corners_of(c, &c->triangles.at[i], at);
      normal_of(at, n);
      for (int j = 0; step == 0 && j < 3; j++) {
        x->n[j] += n[j], x->corners++;
        for (int a = 0; a < 3; a++) x->at[a] += at[j][a];
      }
      if (step == 0) continue;
      bool holds = dot(n, x->n) >= ALIKE * sqrt(dot(n, n));
      for (int j = 0; j < 3; j++) {
        between(x->at, at[j], d);
        holds = holds && fabs(dot(d, x->n)) <= OFF;
      }
      if (!holds) give_up(w, of);
    }
  }
  return true;
}

/* Returns true if an end of the seam (an edge between two facets of a sheet) is not a corner of a leaf, and so lies on
 * a cut. Without a cut, the seam causes no bend. */
static bool is_cut(const vs_result_state *w, uint32_t seam) {
  const vs_use *u = vs_result_use(w, w->edge_first.at[seam]);
  return u->from >= w->c->corner_points || u->to >= w->c->corner_points;
}

bool vs_sheets_plan(vs_result_state *w) {
  const vs_cluster *c = w->c;
  bool any = false;
  for (size_t i = 0; i < w->seams.count && !any; i++) any = is_cut(w, w->seams.at[i]);
  if (!any) return true;
  size_t room = 0;
  if (!VS_ROOM(w->k, w->sheets, room, 1)) return false;
  vs_sheets *s = w->sheets;
  *s = (vs_sheets){ .room = room };
  size_t facets = c->facets.count, points = c->points.all.count, planes = c->planes.all.count;
  if (!VS_ROOM(w->k, s->of.at, s->of.room, facets + 1) || !VS_ROOM(w->k, s->key.at, s->key.room, planes + 1) ||
      !VS_ROOM(w->k, s->near.at, s->near.room, planes + 1) ||
      !VS_ROOM(w->k, s->cut_of.at, s->cut_of.room, points + 1) ||
      !VS_ROOM(w->k, w->bent.at, w->bent.room, points + 1) ||
      !VS_ROOM(w->k, w->stays.at, w->stays.room, points + 1) ||
      !VS_ROOM(w->k, w->gone.at, w->gone.room, w->edge_first.count))
    return false;
  s->of.count = facets;
  w->bent.count = points;
  memset(w->stays.at, 0, points);
  w->gone.count = w->edge_first.count - 1;
  if (!vs_kernel_report(w->k, 0.9)) return false;
  memset(s->of.at, 0xff, facets * sizeof *s->of.at); /* sets every element to VS_NONE */
  for (size_t i = 0; i < w->seams.count; i++) {
    if (!is_cut(w, w->seams.at[i])) continue;
    uint32_t facet = vs_result_facet(w, &c->faces.at[vs_result_use(w, w->edge_first.at[w->seams.at[i]])->face]);
    uint32_t *of = &s->of.at[c->sheets.at[facet]];
    if (*of != VS_NONE) continue;
    *of = (uint32_t)s->all.count;
    if (!vs_kernel_poll(w->k, 0.9) || !VS_PUSH(w->k, s->all, ((sheet){ .corners = 0 }))) return false;
  }
  for (uint32_t f = 0; f < facets; f++) s->of.at[f] = s->of.at[c->sheets.at[f]]; /* c->sheets.at[f] is the first facet
                                                                                  * of the sheet that contains f, at
                                                                                  * most f itself, so the number of its
                                                                                  * sheet is already known. */
  for (uint32_t p = 0; p < planes; p++) s->key.at[p] = p;
  for (uint32_t f = 0; f < facets; f++) {
    uint32_t first = c->sheets.at[f];
    if (s->of.at[f] == VS_NONE) continue;
    if (w->lone.at[c->facets.at[f].plane] != f) give_up(w, s->of.at[f]);
    else s->key.at[c->facets.at[f].plane] = c->facets.at[first].plane;
  }
  /* Stores the sheet and the representative plane of each face in arrays, because every round reads them for each edge.
   * Faces, planes and facets are scattered in memory, so reading them is slow. */
  if (!VS_ROOM(w->k, s->of_face.at, s->of_face.room, c->faces.count + 1) ||
      !VS_ROOM(w->k, s->face_key.at, s->face_key.room, c->faces.count + 1))
    return false;
  for (size_t i = 0; i < c->faces.count; i++) {
    const vs_face *f = &c->faces.at[i];
    uint32_t facet = vs_result_facet(w, f);
    s->of_face.at[i] = facet == VS_NONE ? VS_NONE : s->of.at[facet];
    s->face_key.at[i] = f->plane == VS_NONE ? VS_NONE : s->key.at[f->plane];
    if (!vs_kernel_poll(w->k, 0.9)) return false;
  }
  return vs_kernel_report(w->k, 0.9) && measure(w);
}

bool vs_sheets_merge(vs_result_state *w, bool *any) {
  const vs_cluster *c = w->c;
  uint32_t faces = (uint32_t)c->faces.count;
  *any = false;
  w->c->straightened = 0;
  atomic_store(&w->sheets->spoiled, false);
  memset(w->gone.at, 0, w->gone.count);
  for (size_t i = 0; i < w->sheets->all.count; i++) {
    sheet *s = &w->sheets->all.at[i];
    bool given = atomic_load(&s->given_up);
    s->fresh = s->fresh || (given && s->merged);
    s->merged = !given;
  }
  for (uint32_t f = 0; f < faces; f++) {
    w->parent.at[f] = vs_find_shared(w->sets.at, f);
    if (!vs_kernel_poll(w->k, 0.9)) return false;
  }
  for (size_t i = 0; i < w->seams.count; i++) {
    uint32_t e = w->seams.at[i];
    const vs_use *a = vs_result_use(w, w->edge_first.at[e]), *b = vs_result_use(w, w->edge_first.at[e] + 1);
    if (!vs_kernel_poll(w->k, 0.9)) return false;
    if (merged_sheet_of(w, a->face) == VS_NONE) continue;
    w->gone.at[e] = 1;
    *any = true;
    vs_unite(w->parent.at, a->face, b->face);
    atomic_store_explicit(&w->whole.at[a->face], 0, memory_order_relaxed);
    atomic_store_explicit(&w->whole.at[b->face], 0, memory_order_relaxed);
  }
  for (uint32_t f = 0; *any && f < faces; f++) {
    w->parent.at[f] = vs_find(w->parent.at, f);
    if (!vs_kernel_poll(w->k, 0.9)) return false;
  }
  return vs_kernel_report(w->k, 0.9);
}

/* ---- the conditions ---- */

static bool is_fresh(const vs_result_state *w, uint32_t face) {
  uint32_t s = w->sheets->of_face.at[face];
  return s != VS_NONE && w->sheets->all.at[s].fresh;
}

/* Sets n to the unit normal of a face. If the face was merged with others of a facet that the grid has split, n is the
 * outward normal of that facet. */
static void look(const vs_result_state *w, uint32_t face, double n[3]) {
  uint32_t s = merged_sheet_of(w, face);
  const vs_plane *p = &w->c->planes.all.at[w->c->faces.at[face].plane];
  bool inward =
      s != VS_NONE && (w->c->kept.at[face] == 2) != w->c->facets.at[vs_result_facet(w, &w->c->faces.at[face])].flip;
  double length = 0, sign = (s != VS_NONE ? inward : w->c->kept.at[face] == 2) ? -1 : 1;
  for (int i = 0; i < 3; i++) n[i] = s != VS_NONE ? w->sheets->all.at[s].n[i] : (double)p->n[i];
  length = sqrt(dot(n, n));
  for (int i = 0; i < 3; i++) n[i] *= sign / length;
}

/* Returns the edge at point `at` that is not `edge`. Exactly two edges end at this point. */
static uint32_t next_edge(const vs_result_state *w, uint32_t edge, uint32_t at) {
  VS_ASSERT(w->edges.at[2 * at] == edge || w->edges.at[2 * at + 1] == edge);
  return w->edges.at[2 * at] == edge ? w->edges.at[2 * at + 1] : w->edges.at[2 * at];
}

/* Returns the distance of point x from the line through p with the unit direction `along`. *t: position of the nearest
 * point on the line, as the distance from p. */
static double away(const double p[3], const double along[3], const double x[3], double *t) {
  double d[3], off[3];
  between(p, x, d);
  *t = dot(d, along);
  for (int i = 0; i < 3; i++) off[i] = d[i] - *t * along[i];
  return sqrt(dot(off, off));
}

/* Marks all corners on the line that begins with `edge` at point p as corners that must not be dropped. */
static void keep_bends(vs_result_state *w, uint32_t edge, uint32_t p) {
  uint32_t at = vs_result_other_end(vs_result_use(w, w->edge_first.at[edge]), p);
  for (; w->degree.at[at] == 4; at = vs_result_other_end(vs_result_use(w, w->edge_first.at[edge]), at)) {
    w->stays.at[at] = w->bent.at[at];
    edge = next_edge(w, edge, at);
  }
  w->sheets->kept = true;
}

/* Follows the line from corner p along `edge` to the next corner that stays. Checks that the line is straight except
 * for corners at which the grid has bent a cut. Adds their number to *bends. */
static bool check_line(vs_result_state *w, uint32_t edge, uint32_t p, size_t *bends) {
  vs_sheets *s = w->sheets;
  uint32_t begin = w->edge_first.at[edge],
           faces[2] = { vs_result_use(w, begin)->face, vs_result_use(w, begin + 1)->face };
  uint32_t q = vs_result_other_end(vs_result_use(w, begin), p), e = edge, bent = 0;
  cut made = { .p = p, .edge = edge, .sheets = { merged_sheet_of(w, faces[0]), merged_sheet_of(w, faces[1]) } };
  for (; w->degree.at[q] == 4; q = vs_result_other_end(vs_result_use(w, w->edge_first.at[e]), q)) {
    bent += w->bent.at[q];
    e = next_edge(w, e, q);
  }
  if (p > q) return true; /* the loop finds this line twice, from each of its ends, so it is ignored from the end with
                           * the greater number */
  made.q = q;
  *bends += bent;
  double from[3], to[3], along[3], n[2][3], x[3], t, last = 0;
  place(w, p, from);
  place(w, q, to);
  between(from, to, along);
  double length = sqrt(dot(along, along));
  bool safe = p != q && length > 0 && made.sheets[0] != made.sheets[1];
  for (int i = 0; i < 3; i++) along[i] /= length > 0 ? length : 1;
  for (int i = 0; i < 2; i++) look(w, faces[i], n[i]);
  double angle = dot(n[0], n[1]);
  safe = safe && angle >= WEDGE;
  bool known = s->looked && !is_fresh(w, faces[0]) && !is_fresh(w, faces[1]), straight = safe && fabs(angle) <= SHALLOW;
  uint32_t number = known ? VS_NONE : (uint32_t)s->cuts.count;
  for (uint32_t at = vs_result_other_end(vs_result_use(w, begin), p), f = edge; straight && bent && at != q;) {
    place(w, at, x);
    double off = away(from, along, x, &t);
    straight = off <= FAR && t > last && t < length;
    last = t;
    made.wide = fmax(made.wide, off);
    s->cut_of.at[at] = number;
    f = next_edge(w, f, at);
    at = vs_result_other_end(vs_result_use(w, w->edge_first.at[f]), at);
  }
  for (int i = 0; i < 2; i++) {
    if (!safe) give_up(w, made.sheets[i]);
    else if (bent && straight && made.sheets[i] != VS_NONE) s->all.at[made.sheets[i]].bends += bent;
    made.keys[i] = s->face_key.at[faces[i]];
  }
  made.wide += BESIDE;
  if (!bent || !safe) return true;
  if (!straight) keep_bends(w, edge, p);
  return !straight || known || VS_PUSH(w->k, s->cuts, made);
}

static bool check_lines(vs_result_state *w, size_t *bends) {
  for (uint32_t e = 0; e < w->gone.count; e++) {
    uint32_t begin = w->edge_first.at[e], count = w->edge_first.at[e + 1] - begin;
    bool any = false, plain = false;
    if (!vs_kernel_poll(w->k, 0.9)) return false;
    if (w->gone.at[e]) continue;
    for (uint32_t i = begin; i < begin + count; i++) {
      uint32_t face = vs_result_use(w, i)->face;
      any = any || merged_sheet_of(w, face) != VS_NONE;
      plain = plain || w->sheets->face_key.at[face] == VS_NONE;
    }
    if (!any) continue;
    bool borders = count == 2 && !plain &&
                   w->parent.at[vs_result_use(w, begin)->face] != w->parent.at[vs_result_use(w, begin + 1)->face];
    for (uint32_t i = begin; !borders && i < begin + count; i++)
      give_up(w, merged_sheet_of(w, vs_result_use(w, i)->face));
    const vs_use *u = vs_result_use(w, begin);
    if (borders && ((w->degree.at[u->from] != 4 && !check_line(w, e, u->from, bends)) ||
                    (w->degree.at[u->to] != 4 && !check_line(w, e, u->to, bends))))
      return false;
  }
  return true;
}

static int by_place(const void *a, const void *b) {
  const placed *x = a, *y = b;
  return x->at < y->at ? -1 : x->at > y->at ? 1 : x->point < y->point ? -1 : x->point > y->point;
}

/* For all planes that have cuts with corners to be dropped, collects the corners of the faces in these planes. */
static bool find_near(vs_result_state *w) {
  vs_sheets *s = w->sheets;
  size_t planes = w->c->planes.all.count;
  s->near_count = 0;
  memset(s->near.at, 0xff, planes * sizeof *s->near.at); /* sets every element to VS_NONE */
  for (size_t i = 0; i < s->cuts.count; i++)
    for (int j = 0; j < 2; j++)
      if (s->near.at[s->cuts.at[i].keys[j]] == VS_NONE) s->near.at[s->cuts.at[i].keys[j]] = (uint32_t)s->near_count++;
  if (!VS_ROOM(w->k, s->first.at, s->first.room, s->near_count + 2)) return false;
  memset(s->first.at, 0, (s->near_count + 2) * sizeof *s->first.at);
  s->hits.count = 0;
  for (uint32_t e = 0; e < w->gone.count; e++)
    for (uint32_t i = w->edge_first.at[e]; !w->gone.at[e] && i < w->edge_first.at[e + 1]; i++) {
      const vs_use *u = vs_result_use(w, i);
      uint32_t key = s->face_key.at[u->face], near = key == VS_NONE ? VS_NONE : s->near.at[key];
      if (!vs_kernel_poll(w->k, 0.9)) return false;
      if (near == VS_NONE) continue;
      s->first.at[near + 2]++;
      if (!VS_PUSH(w->k, s->hits, ((corner){ near, u->from }))) return false;
    }
  for (size_t i = 2; i < s->near_count + 2; i++) s->first.at[i] += s->first.at[i - 1];
  if (!VS_ROOM(w->k, s->corners.at, s->corners.room, s->hits.count + 1)) return false;
  for (size_t i = 0; i < s->hits.count; i++) {
    corner h = s->hits.at[i];
    double x = (double)w->c->points.all.at[h.point].fixed[0] * 0x1p-30;
    s->corners.at[s->first.at[h.near + 1]++] = (placed){ x, h.point };
    if (!vs_kernel_poll(w->k, 0.9)) return false;
  }
  for (size_t i = 0; i < s->near_count; i++) {
    enum { FEW = 24 };
    uint32_t first = s->first.at[i], count = s->first.at[i + 1] - first;
    placed *at = s->corners.at + first;
    if (count > FEW) qsort(at, count, sizeof *at, by_place);
    for (uint32_t j = 1, to; count <= FEW && j < count; j++) {
      placed x = at[j];
      for (to = j; to > 0 && at[to - 1].at > x.at; to--) at[to] = at[to - 1];
      at[to] = x;
    }
    if (!vs_kernel_poll(w->k, 0.9)) return false;
  }
  return true;
}

/* Returns true if the band around a cut contains no other corner of the faces on one of its sides. number: index of the
 * cut; side: 0 or 1. */
static bool is_free(const vs_result_state *w, uint32_t number, int side) {
  const vs_sheets *s = w->sheets;
  const cut *c = &s->cuts.at[number];
  uint32_t near = s->near.at[c->keys[side]], at = s->first.at[near], end = s->first.at[near + 1];
  double p[3], q[3], along[3], x[3], t;
  VS_ASSERT(number < s->cuts.count && (side == 0 || side == 1));
  place(w, c->p, p);
  place(w, c->q, q);
  between(p, q, along);
  double length = sqrt(dot(along, along)), low = fmin(p[0], q[0]) - c->wide, high = fmax(p[0], q[0]) + c->wide;
  for (int i = 0; i < 3; i++) along[i] /= length;
  for (uint32_t stop = end; at < stop;) { /* binary search for the first corner that may lie in the band, by its x
                                           * coordinate */
    uint32_t middle = at + (stop - at) / 2;
    if (s->corners.at[middle].at < low) at = middle + 1;
    else stop = middle;
  }
  for (; at < end && s->corners.at[at].at <= high; at++) {
    uint32_t point = s->corners.at[at].point;
    if (point == c->p || point == c->q || (w->degree.at[point] == 4 && s->cut_of.at[point] == number)) continue;
    place(w, point, x);
    if (away(p, along, x, &t) <= c->wide && t >= -c->wide && t <= length + c->wide) return false;
  }
  return true;
}

enum { CUTS = 1024 };

static bool find_free(vs_kernel *k, void *context, size_t index) {
  const vs_result_state *w = context;
  vs_sheets *s = w->sheets;
  for (size_t i = index * CUTS; i < s->cuts.count && i < (index + 1) * CUTS; i++) {
    s->free.at[i] = is_free(w, (uint32_t)i, 0) && is_free(w, (uint32_t)i, 1);
    if (!vs_kernel_poll(k, 0.9)) return false;
  }
  return true;
}

/* Gives up the merging of faces in a sheet (planar facet that the grid has split) if no corner of the sheet was
 * dropped. Returns true if there was such a sheet whose faces had been merged. */
static bool give_up_idle(vs_result_state *w) {
  bool any = false;
  for (size_t i = 0; i < w->sheets->all.count; i++) {
    sheet *s = &w->sheets->all.at[i];
    if (!s->bends) give_up(w, (uint32_t)i);
    any = any || (s->merged && atomic_load_explicit(&s->given_up, memory_order_relaxed));
  }
  return any;
}

bool vs_sheets_check(vs_result_state *w, bool *again) {
  vs_sheets *s = w->sheets;
  size_t bends = 0, dropped = 0, points = w->c->points.all.count;
  s->cuts.count = 0;
  s->kept = false;
  for (size_t i = 0; i < s->all.count; i++) s->all.at[i].bends = 0;
  memset(s->cut_of.at, 0xff, points * sizeof *s->cut_of.at); /* sets every element to VS_NONE */
  for (size_t p = 0; p < points; p++) dropped += w->bent.at[p];
  if (!vs_kernel_report(w->k, 0.9)) return false;
  w->c->straightened = dropped;
  if (!check_lines(w, &bends)) return false;
  if (bends != dropped) vs_sheets_give_up(w); /* The lines between corners that stay have fewer bends than corners were
                                               * dropped. The other dropped corners thus form closed borders without a
                                               * corner that stays, so all merging of faces is given up. */
  *again = give_up_idle(w) || s->kept;
  if (*again) return true; /* The cuts change in the next round. Therefore the bands around them are checked in that
                            * round. */
  if (!find_near(w)) return false;
  if (!VS_ROOM(w->k, s->free.at, s->free.room, s->cuts.count + 1) ||
      !vs_kernel_run(w->k, (s->cuts.count + CUTS - 1) / CUTS, find_free, w))
    return false;
  for (uint32_t i = 0; i < s->cuts.count; i++)
    if (!s->free.at[i]) keep_bends(w, s->cuts.at[i].edge, s->cuts.at[i].p);
  s->looked = true;
  for (size_t i = 0; i < s->all.count; i++) s->all.at[i].fresh = false;
  *again = s->kept;
  return true;
}

/* ---- checks of the new faces ---- */

static bool spoil(const vs_result_state *w, uint32_t of) {
  atomic_store_explicit(&w->sheets->all.at[of].given_up, true, memory_order_relaxed);
  atomic_store_explicit(&w->sheets->spoiled, true, memory_order_relaxed);
  return false;
}

/* Returns true if the sides a and b have a common place that is not an end of both. */
static bool sides_meet(const vs_sweep *s, const vs_border *a, const vs_border *b) {
  uint32_t x[2] = { a->from, a->to }, y[2] = { b->from, b->to };
  for (int i = 0; i < 2; i++)
    for (int j = 0; j < 2; j++) {
      if (x[i] != y[j]) continue;
      if (x[1 - i] == y[1 - j]) return true;
      if (vs_orient2d(s->points, x[i], x[1 - i], y[1 - j], s->u, s->v) != 0) return false;
      int u = vs_compare(s->points, x[1 - i], x[i], s->u), v = vs_compare(s->points, x[1 - i], x[i], s->v);
      return u ? u == vs_compare(s->points, y[1 - j], x[i], s->u) : v == vs_compare(s->points, y[1 - j], x[i], s->v);
    }
  return vs_orient2d(s->points, x[0], x[1], y[0], s->u, s->v) * vs_orient2d(s->points, x[0], x[1], y[1], s->u, s->v) <=
             0 &&
         vs_orient2d(s->points, y[0], y[1], x[0], s->u, s->v) * vs_orient2d(s->points, y[0], y[1], x[1], s->u, s->v) <=
             0;
}

static int64_t end_of(const vs_sweep *s, const vs_border *side, int axis, bool high) {
  int64_t a = s->points.at[side->from].fixed[axis], b = s->points.at[side->to].fixed[axis];
  return (a > b) == high ? a : b;
}

static bool starts_before(const void *context, uint32_t a, uint32_t b) {
  const vs_triangulation *t = context;
  return end_of(&t->sweep, &t->sides.at[a], t->sweep.u, false) < end_of(&t->sweep, &t->sides.at[b], t->sweep.u, false);
}

bool vs_sheets_simple(const vs_result_state *w, uint32_t face, vs_kernel *k, vs_triangulation *t, bool *simple) {
  const vs_plane *plane = &w->c->planes.all.at[w->c->faces.at[face].plane];
  uint32_t of = merged_sheet_of(w, face), n = (uint32_t)t->sides.count;
  *simple = true;
  if (of == VS_NONE) return true;
  if (!VS_ROOM(k, t->list.at, t->list.room, n + 1) || !VS_ROOM(k, t->scratch.at, t->scratch.room, n + 1)) return false;
  vs_sweep *s = &t->sweep;
  s->points = vs_points_of(&w->c->points);
  s->u = plane->u;
  s->v = plane->v;
  for (uint32_t i = 0; i < n; i++) t->list.at[i] = i;
  vs_kernel_sort(t->list.at, t->scratch.at, n, starts_before, t);
  for (uint32_t i = 0; i < n && *simple; i++) {
    const vs_border *a = &t->sides.at[t->list.at[i]];
    int64_t stop = end_of(s, a, s->u, true), low = end_of(s, a, s->v, false), high = end_of(s, a, s->v, true);
    for (uint32_t j = i + 1; j < n && *simple; j++) {
      const vs_border *b = &t->sides.at[t->list.at[j]];
      if (end_of(s, b, s->u, false) > stop) break;
      if (end_of(s, b, s->v, false) > high || end_of(s, b, s->v, true) < low) continue;
      *simple = !sides_meet(s, a, b);
      if (!vs_kernel_poll(k, 0.9)) return false;
    }
  }
  if (!*simple) spoil(w, of);
  return true;
}

/* Returns true if the triangle with the point numbers v faces in the direction of the normal of sheet s. */
static bool holds(const vs_result_state *w, const sheet *s, const uint32_t v[3]) {
  double at[3][3], n[3];
  for (int j = 0; j < 3; j++) place(w, v[j], at[j]);
  normal_of(at, n);
  return fabs(dot(n, s->n)) >= ALIKE * sqrt(dot(n, n));
}

/* Takes the longest edge of triangle i and the quadrilateral of the two triangles at this edge. Replaces the edge by
 * the other diagonal. Returns false if a new triangle would not face in the direction of the sheet's normal. */
static bool turn_edge(const vs_result_state *w, const sheet *s, vs_triangulation *t, size_t i) {
  uint32_t *v = t->triangles.at[i];
  double at[3][3], d[3], longest = 0;
  int base = 0;
  VS_ASSERT(i < t->triangles.count);
  for (int j = 0; j < 3; j++) place(w, v[j], at[j]);
  for (int j = 0; j < 3; j++) {
    between(at[j], at[(j + 1) % 3], d);
    if (dot(d, d) > longest) longest = dot(d, d), base = j;
  }
  uint32_t a = v[base], b = v[(base + 1) % 3], top = v[(base + 2) % 3];
  for (size_t k = 0; k < t->triangles.count; k++)
    for (int j = 0; j < 3; j++) {
      uint32_t *o = t->triangles.at[k], far = o[(j + 2) % 3], one[3] = { a, far, top }, two[3] = { far, b, top };
      if (o[j] != b || o[(j + 1) % 3] != a) continue;
      const vs_sweep *x = &t->sweep;
      if (vs_orient2d(x->points, a, far, top, x->u, x->v) <= 0 ||
          vs_orient2d(x->points, far, b, top, x->u, x->v) <= 0 || !holds(w, s, one) || !holds(w, s, two))
        return false;
      memcpy(v, one, sizeof one);
      memcpy(o, two, sizeof two);
      return true;
    }
  return false;
}

void vs_sheets_mend(const vs_result_state *w, uint32_t face, vs_triangulation *t) {
  uint32_t of = merged_sheet_of(w, face);
  for (size_t i = 0; of != VS_NONE && i < t->triangles.count; i++)
    if (!holds(w, &w->sheets->all.at[of], t->triangles.at[i]) && !turn_edge(w, &w->sheets->all.at[of], t, i)) {
      spoil(w, of);
      return;
    }
}

bool vs_sheets_spoiled(const vs_result_state *w) { return w->sheets && atomic_load(&w->sheets->spoiled); }

void vs_sheets_give_up(vs_result_state *w) {
  for (size_t i = 0; i < w->sheets->all.count; i++) give_up(w, (uint32_t)i);
}

void vs_sheets_free(vs_kernel *k, vs_result_state *w) {
  vs_sheets *s = w->sheets;
  VS_DROP(k, w->lone);
  VS_DROP(k, w->seams);
  VS_DROP(k, w->gone);
  VS_DROP(k, w->bent);
  VS_DROP(k, w->stays);
  if (!s) return;
  VS_DROP(k, s->all);
  VS_DROP(k, s->of);
  VS_DROP(k, s->of_face);
  VS_DROP(k, s->face_key);
  VS_DROP(k, s->cuts);
  VS_DROP(k, s->cut_of);
  VS_DROP(k, s->key);
  VS_DROP(k, s->near);
  VS_DROP(k, s->first);
  VS_DROP(k, s->corners);
  VS_DROP(k, s->hits);
  VS_DROP(k, s->free);
  size_t room = s->room;
  VS_FREE(k, w->sheets, room);
}
