/* Finds the parts of an edge that lie behind triangles. See hidden_lines.h.
 *
 * Notation. P(s) = p + s (q - p) is a point of the edge, with s in 0..1. A point is behind a triangle if it satisfies
 * four conditions that are linear in s. It lies on the inner side of the three planes through the viewer and a side of
 * the triangle, and behind the triangle's plane. The part of an edge that a triangle hides is therefore an interval of
 * s, which clipping finds. The conditions are planes in space, so this holds for perspective and for parallel views.
 * The union of the intervals is hidden.
 *
 * Contact. Distances up to the slack count as zero. A triangle includes its sides: an edge that runs along a side,
 * farther back, is hidden. The side is then an edge itself, or the surface continues beyond it. An edge in the
 * triangle's plane is never hidden by the triangle. Distances from the plane are measured perpendicular to it, so faces
 * seen nearly edge-on are as accurate as others. Faces seen exactly edge-on hide nothing. The conditions are evaluated
 * where the edge enters and leaves the triangle's box in the picture. Far outside the box, the direction of a short
 * side would be inaccurate.
 *
 * Cost. The triangles that may hide something are in a binary tree of boxes in the picture, each with the least depth
 * below it. The tree is built by halving at the median of the longest of width, height and depth: n log n. An edge is
 * first tested against the triangles that hid the previous edges. The search then visits the nearer half first, skips
 * boxes that are farther away than the edge, and ends when the entire edge is hidden. */
#include "solids/hidden_lines.h"

#include <math.h>

enum { LEAF = 4, STACK = 128, KEPT = 8 };

/* A box around triangles. low, high: its limits in the picture, horizontally and vertically; depth: least depth of its
 * triangles. */
typedef struct { double low[2], high[2], depth; } box;
/* A node of the tree of boxes. first, count: for a leaf, the range of its boxes in `order`; count 0: the node has two
 * children, the next node and the node number `right`. */
typedef struct { box b; uint32_t first, count, right; } node;
/* An interval of an edge's parameter s, within 0 to 1. */
typedef struct { double from, to; } span;

typedef struct {
  const vs_sight_host *host;
  const vs_sight *s;
  box *boxes;        /* boxes, in the picture, of the triangles that may hide an edge */
  uint32_t *number;  /* number[i]: number of the triangle that boxes[i] encloses */
  uint32_t *order;   /* indices of boxes, in the order of the tree's leaves */
  node *nodes;
  size_t count, room, node_count, node_room;
  span *spans;       /* hidden intervals of the current edge, sorted and disjoint */
  size_t span_count, span_room;
  size_t turns;
  uint32_t kept[KEPT]; /* indices of the boxes of the triangles that hid entire edges last, the latest first */
} sight;

static bool going(sight *v) { return (++v->turns & 0xfff) != 0 || vs_job_going(v->host->job, "drawing", -1); }

/* ---- the tree ---- */

static void on_picture(const vs_sight *s, vs_vec3 p, double at[2]) {
  double k = s->perspective ? 1 / p.z : 1;
  at[0] = p.x * k, at[1] = p.y * k;
}

static void widen(box *b, const box *other) {
  for (int i = 0; i < 2; i++) b->low[i] = fmin(b->low[i], other->low[i]), b->high[i] = fmax(b->high[i], other->high[i]);
  b->depth = fmin(b->depth, other->depth);
}

static const box nowhere = { { INFINITY, INFINITY }, { -INFINITY, -INFINITY }, INFINITY };

static box box_of(const vs_sight *s, const vs_vec3 *points, int count) {
  box b = nowhere;
  for (int i = 0; i < count; i++) {
    double at[2];
    on_picture(s, points[i], at);
    widen(&b, &(box){ { at[0], at[1] }, { at[0], at[1] }, points[i].z });
  }
  return b;
}

static void corners_of(const vs_sight *s, uint32_t triangle, vs_vec3 out[3]) {
  for (int k = 0; k < 3; k++) out[k] = s->points[s->triangles[triangle][k]];
}

/* Returns true if triangle i can hide something: the viewer sees its front, or it belongs to no solid. */
static bool may_hide(const vs_sight *s, uint32_t i) {
  vs_vec3 c[3];
  corners_of(s, i, c);
  vs_vec3 n = vs_v3_cross(vs_v3_sub(c[1], c[0]), vs_v3_sub(c[2], c[0]));
  double length = vs_v3_length(n), far = s->perspective ? vs_v3_length(c[0]) : 1;
  if (!(length > 0)) return false;
  double towards = -vs_v3_dot(n, s->perspective ? c[0] : vs_v3(0, 0, 1)) / (length * far);
  return towards > 1e-9 || (towards < -1e-9 && i >= s->closed);
}

static double middle(const sight *v, uint32_t i, int axis) {
  const box *b = &v->boxes[i];
  return axis == 2 ? b->depth : b->low[axis] + b->high[axis];
}

/* Reorders order[first] to order[first + count - 1], so that the first half has the boxes with the smaller centres
 * along the axis (0: width, 1: height, 2: depth). */
static void split(sight *v, size_t first, size_t count, int axis) {
  size_t low = first, high = first + count - 1, want = first + count / 2;
  uint32_t *o = v->order;
  while (low < high) {
    double pivot = middle(v, o[low + (high - low) / 2], axis);
    size_t i = low, j = high;
    for (;;) {
      while (middle(v, o[i], axis) < pivot) i++;
      while (middle(v, o[j], axis) > pivot) j--;
      if (i >= j) break;
      uint32_t swap = o[i];
      o[i++] = o[j];
      o[j--] = swap;
    }
    if (j >= want) high = j;
    else low = j + 1;
  }
}

/* Builds the tree of boxes. A node's left child follows it in the array, and its right child has the number that it
 * stores. Returns false if memory is out. */
static bool build(sight *v) {
  struct { uint32_t first, count, parent; } stack[STACK];
  size_t depth = 0;
  if (v->count == 0) return true;
  v->node_room = 4 * (v->count / LEAF) + 8;
  v->nodes = vs_store_realloc(v->host->store, NULL, 0, v->node_room * sizeof *v->nodes);
  if (!v->nodes) return false;
  stack[depth].first = 0, stack[depth].count = (uint32_t)v->count, stack[depth++].parent = UINT32_MAX;
  while (depth > 0) {
    depth--;
    uint32_t first = stack[depth].first, count = stack[depth].count, parent = stack[depth].parent,
        here = (uint32_t)v->node_count++;
    node *n = &v->nodes[here];
    if (parent != UINT32_MAX) v->nodes[parent].right = here;
    *n = (node){ nowhere, first, count, 0 };
    double deepest = -INFINITY;
    for (uint32_t i = 0; i < count; i++) {
      widen(&n->b, &v->boxes[v->order[first + i]]);
      deepest = fmax(deepest, v->boxes[v->order[first + i]].depth);
    }
    if (count <= LEAF) continue;
    n->count = 0;
    double wide = n->b.high[0] - n->b.low[0], high = n->b.high[1] - n->b.low[1], deep = deepest - n->b.depth;
    if (v->s->perspective) deep /= deepest;
    split(v, first, count, deep > wide && deep > high ? 2 : wide < high);
    uint32_t half = count / 2;
    stack[depth].first = first + half, stack[depth].count = count - half, stack[depth++].parent = here;
    stack[depth].first = first, stack[depth].count = half, stack[depth++].parent = UINT32_MAX;
  }
  return true;
}

static bool gather(sight *v) {
  const vs_sight *s = v->s;
  v->room = s->triangle_count + 1;
  v->boxes = vs_store_realloc(v->host->store, NULL, 0, v->room * sizeof *v->boxes);
  v->number = vs_store_realloc(v->host->store, NULL, 0, v->room * sizeof *v->number);
  v->order = vs_store_realloc(v->host->store, NULL, 0, v->room * sizeof *v->order);
  if (!v->boxes || !v->number || !v->order) return false;
  for (size_t i = 0; i < s->triangle_count; i++) {
    vs_vec3 c[3];
    if (!may_hide(s, (uint32_t)i)) continue;
    corners_of(s, (uint32_t)i, c);
    v->boxes[v->count] = box_of(s, c, 3);
    v->number[v->count] = (uint32_t)i;
    v->order[v->count] = (uint32_t)v->count;
    v->count++;
  }
  return true;
}

/* ---- an edge and a triangle ---- */

typedef struct { vs_vec3 p, d; double low[2], high[2], far, length, slack; double from, to; } line;
    /* Returns the point p + s d of line l, where p and d are members of l. */

static vs_vec3 place(const line *l, double s) { return vs_v3_add(l->p, vs_v3_scale(l->d, s)); }

/* Clips the interval l->from to l->to of line l to where a linear function is not negative. `at_from`, `at_to`: values
 * of the function at both ends of the interval; absolute values up to slack count as 0. Returns false if at most a
 * point remains. */
static bool keep(line *l, double at_from, double at_to, double slack) {
  if (fabs(at_from) <= slack) at_from = 0;
  if (fabs(at_to) <= slack) at_to = 0;
  if ((at_from < 0 && at_to <= 0) || (at_from <= 0 && at_to < 0)) return false;
  double wide = l->to - l->from;
  if (at_from < 0) l->from += wide * (at_from / (at_from - at_to));
  else if (at_to < 0) l->to -= wide * (at_to / (at_to - at_from));
  return l->from < l->to;
}

/* Returns the distance of p from a side of a triangle's box in the picture, the line at the coordinate `bound`. In a
 * perspective view, the distance is multiplied by the depth. */
static double beside(const vs_sight *s, vs_vec3 p, int axis, double bound) { return (axis ? p.y :
    p.x) - bound * (s->perspective ? p.z : 1); }

static bool keep_in_box(const vs_sight *s, line *l, const box *b) {
  for (int axis = 0; axis < 2; axis++) {
    vs_vec3 p = place(l, l->from), q = place(l, l->to);
    double low = b->low[axis], high = b->high[axis];
    if (!keep(l, beside(s, p, axis, low), beside(s, q, axis, low), s->slack)) return false;
    p = place(l, l->from), q = place(l, l->to);
    if (!keep(l, -beside(s, p, axis, high), -beside(s, q, axis, high), s->slack)) return false;
  }
  return true;
}

/* Returns the unit normal of the plane through the viewer and the triangle's side from a to b. Returns the zero vector
 * if a and b are at one place in the picture. */
static vs_vec3 side_normal(const vs_sight *s, vs_vec3 a, vs_vec3 b) {
  vs_vec3 n = s->perspective ? vs_v3_cross(a, b) : vs_v3(a.y - b.y, b.x - a.x, 0);
  double length = vs_v3_length(n);
  return length > 0 ? vs_v3_scale(n, 1 / length) : vs_v3(0, 0, 0);
}

/* Returns true if, in the picture, the triangle with the corners c lies entirely on one side of the line from a to b.
 * This is so for most triangles whose boxes the line intersects. */
static bool passes(const vs_sight *s, const vs_vec3 c[3], const double a[2], const double b[2], double slack) {
  double across = b[0] - a[0], up = b[1] - a[1], least = INFINITY, most = -INFINITY;
  for (int k = 0; k < 3; k++) {
    double at[2];
    on_picture(s, c[k], at);
    double off = (at[0] - a[0]) * up - (at[1] - a[1]) * across;
    least = fmin(least, off), most = fmax(most, off);
  }
  slack *= fabs(across) + fabs(up);
  return least > slack || most < -slack;
}

/* Computes the part of edge l that the triangle hides: from l->from to l->to. Returns false if the triangle hides
 * nothing of the edge. */
static bool hides(const vs_sight *s, const vs_vec3 c[3], const box *b, line *l) {
  vs_vec3 n = vs_v3_unit(vs_v3_cross(vs_v3_sub(c[1], c[0]), vs_v3_sub(c[2], c[0])));
  if (vs_v3_dot(n, s->perspective ? c[0] : vs_v3(0, 0, 1)) < 0) n = vs_v3_scale(n, -1);
      /* n is the triangle's normal, turned away from the viewer, so that distances behind the plane are positive */
  double far_p = vs_v3_dot(n, vs_v3_sub(l->p, c[0])), far_q = far_p + vs_v3_dot(n, l->d);
  if (far_p <= l->slack && far_q <= l->slack) return false;
  l->from = 0, l->to = 1;
  if (!keep(l, far_p - l->slack, far_q - l->slack, 0) || !keep_in_box(s, l, b)) return false;
  for (int k = 0; k < 3; k++) {
    vs_vec3 side = side_normal(s, c[k], c[(k + 1) % 3]), inner = vs_v3_sub(c[(k + 2) % 3], c[k]);
    vs_vec3 base = s->perspective ? vs_v3(0, 0, 0) : c[k];
    if (vs_v3_dot(side, inner) < 0) side = vs_v3_scale(side, -1);
    double p = vs_v3_dot(side, vs_v3_sub(place(l, l->from), base)), q = vs_v3_dot(side, vs_v3_sub(place(l, l->to),
        base));
    if (!keep(l, p, q, s->slack)) return false;
  }
  return true;
}

/* ---- the hidden parts of an edge ---- */

/* Adds an interval to the sorted list of hidden intervals. Joins intervals whose distance is less than `gap`. Returns
 * false if memory is out. */
static bool add_span(sight *v, double from, double to, double gap) {
  size_t first = 0, end, count = v->span_count;
  while (first < count && v->spans[first].to < from - gap) first++;
  for (end = first; end < count && v->spans[end].from <= to + gap; end++) {
    from = fmin(from, v->spans[end].from);
    to = fmax(to, v->spans[end].to);
  }
  if (count + 1 > v->span_room && !vs_store_grow(v->host->store, &v->spans, &v->span_room, count + 1,
      sizeof *v->spans)) return false;
  size_t after = count - end;
  for (size_t i = 0; end > first + 1 && i < after; i++) v->spans[first + 1 + i] = v->spans[end + i];
  for (size_t i = after; end == first && i > 0; i--) v->spans[first + i] = v->spans[first + i - 1];
  v->spans[first] = (span){ from, to };
  v->span_count = first + 1 + after;
  return true;
}

static bool meets(const line *l, const box *b, double slack) {
  for (int i = 0; i < 2; i++)
    if (b->low[i] > l->high[i] + slack || b->high[i] < l->low[i] - slack) return false;
  return b->depth < l->far;
}

/* Returns true if, in the picture, the edge from a to b intersects the box x of a triangle. */
static bool crosses(const double a[2], const double b[2], const box *x, double slack) {
  double across = b[0] - a[0], up = b[1] - a[1];
  double mx = (x->low[0] + x->high[0]) / 2 - a[0], my = (x->low[1] + x->high[1]) / 2 - a[1];
  double wide = (x->high[0] - x->low[0]) / 2 + slack, high = (x->high[1] - x->low[1]) / 2 + slack;
  return fabs(mx * up - my * across) <= wide * fabs(up) + high * fabs(across);
}

static void keep_hider(sight *v, uint32_t which) {
  for (int i = KEPT - 1; i > 0; i--) v->kept[i] = v->kept[i - 1];
  v->kept[0] = which;
}

/* Computes the parts of the edge that triangles hide, v->spans. Joins parts whose distance is less than `gap`. *on:
 * false if interrupted. Returns false if memory is out. */
static bool look(sight *v, const vs_sight_edge *edge, double gap, bool *on) {
  const vs_sight *s = v->s;
  line l = { .p = edge->p, .d = vs_v3_sub(edge->q, edge->p), .slack = fmax(edge->slack, s->slack) };
  uint32_t stack[STACK], depth = 0;
  double a[2], b[2], slack = s->slack;
  vs_vec3 c[3];
  on_picture(s, edge->p, a);
  on_picture(s, edge->q, b);
  if (s->perspective) slack /= fmin(edge->p.z, edge->q.z);
  for (int i = 0; i < 2; i++) l.low[i] = fmin(a[i], b[i]), l.high[i] = fmax(a[i], b[i]);
  l.far = fmax(edge->p.z, edge->q.z);
  v->span_count = 0;
  if (v->node_count == 0) return true;
  for (int i = 0; i < KEPT; i++) { /* A triangle often hides several successive edges. Therefore those that hid edges
                                    * last are tested first. */
    uint32_t which = v->kept[i];
    if (!meets(&l, &v->boxes[which], slack)) continue;
    corners_of(s, v->number[which], c);
    if (passes(s, c, a, b, slack) || !hides(s, c, &v->boxes[which], &l) || l.from > gap || l.to < 1 - gap) continue;
    v->kept[i] = v->kept[0], v->kept[0] = which;
    return add_span(v, l.from, l.to, gap);
  }
  stack[depth++] = 0;
  while (depth > 0) {
    const node *n = &v->nodes[stack[--depth]];
    if (!meets(&l, &n->b, slack) || !crosses(a, b, &n->b, slack)) continue;
    if (!going(v)) return *on = false, true;
    if (n->count == 0) {
      uint32_t left = (uint32_t)(n - v->nodes) + 1, right = n->right;
      bool left_nearer = v->nodes[left].b.depth <= v->nodes[right].b.depth;
      stack[depth++] = left_nearer ? right : left;
      stack[depth++] = left_nearer ? left : right;
      continue;
    }
    for (uint32_t i = 0; i < n->count; i++) {
      uint32_t which = v->order[n->first + i];
      if (!meets(&l, &v->boxes[which], slack)) continue;
      corners_of(s, v->number[which], c);
      if (passes(s, c, a, b, slack) || !hides(s, c, &v->boxes[which], &l)) continue;
      if (!add_span(v, l.from, l.to, gap)) return false;
      if (l.from <= gap && l.to >= 1 - gap) keep_hider(v, which);
      if (v->spans[0].from <= gap && v->spans[0].to >= 1 - gap) return true;
    }
  }
  return true;
}

static bool add_piece(sight *v, vs_sight_pieces *out, vs_sight_piece piece, double least) {
  if (piece.to - piece.from <= least) return true;
  if (out->count == out->room && !vs_store_grow(v->host->store, &out->at, &out->room, out->count + 1,
      sizeof *out->at)) return false;
  out->at[out->count++] = piece;
  return true;
}

/* Appends the visible parts of an edge, between its hidden intervals, to out. with_hidden: also appends the hidden
 * parts. Omits parts shorter than `least`. Returns false if memory is out. */
static bool cut_up(sight *v, uint32_t edge, bool with_hidden, double least, vs_sight_pieces *out) {
  double at = 0;
  for (size_t i = 0; i < v->span_count; i++) {
    if (!add_piece(v, out, (vs_sight_piece){ edge, at, v->spans[i].from, false }, least)) return false;
    if (with_hidden && !add_piece(v, out, (vs_sight_piece){ edge, v->spans[i].from, v->spans[i].to, true },
        least)) return false;
    at = v->spans[i].to;
  }
  return add_piece(v, out, (vs_sight_piece){ edge, at, 1, false }, least);
}

bool vs_sight_find_visible(const vs_sight_host *host, const vs_sight *s, const vs_sight_edges *edges, bool with_hidden,
                           vs_sight_pieces *out, vs_error *e) {
  sight v = { .host = host, .s = s };
  bool ok = gather(&v) && build(&v), on = true;
  for (size_t i = 0; ok && on && i < edges->count; i++) {
    const vs_sight_edge *edge = &edges->at[i];
    double a[2], b[2];
    on_picture(s, edge->p, a);
    on_picture(s, edge->q, b);
    double length = hypot(b[0] - a[0], b[1] - a[1]) * (s->perspective ? fmin(edge->p.z, edge->q.z) : 1);
    if (length <= 8 * s->slack) continue; /* skips an edge that the viewer sees as a point */
    ok = look(&v, edge, 2 * s->slack / length, &on);
    ok = ok && (!on || cut_up(&v, (uint32_t)i, with_hidden, 8 * s->slack / length, out));
  }
  vs_store_realloc(host->store, v.boxes, v.room * sizeof *v.boxes, 0);
  vs_store_realloc(host->store, v.number, v.room * sizeof *v.number, 0);
  vs_store_realloc(host->store, v.order, v.room * sizeof *v.order, 0);
  vs_store_realloc(host->store, v.nodes, v.node_room * sizeof *v.nodes, 0);
  vs_store_realloc(host->store, v.spans, v.span_room * sizeof *v.spans, 0);
  if (!ok) return vs_error_memory(e, NULL);
  return on || vs_error_set(e, VS_ERROR_INTERRUPT, NULL, "interrupted");
}

void vs_sight_pieces_free(const vs_sight_host *host, vs_sight_pieces *pieces) {
  vs_store_realloc(host->store, pieces->at, pieces->room * sizeof *pieces->at, 0);
  *pieces = (vs_sight_pieces){ 0 };
}
