/* Computes straight skeletons (skeleton.h): checks the outline, moves its edges inwards (the wave front of
 * skeleton_wave.h), and makes the faces from the borders that the front has recorded. */
#include "geometry/plane/skeleton.h"

#include <math.h>
#include <string.h>

#include "geometry/plane/skeleton_wave.h"
#include "model/store/array.h"

#define RESOLUTION 1e-10L /* distance below which points coincide, as a fraction of the outline's size */

void vs_skeleton_free(vs_skeleton *s) {
  free(s->at), free(s->corner), free(s->face);
  *s = (vs_skeleton){ 0 };
}

/* ---- the outline ---- */

/* The corners of all loops. next[i], last[i]: the corners after and before corner i in its loop; loop[i]: number of the
 * loop. */
typedef struct {
  uint32_t *next, *last, *loop;
  size_t count;
} rings;

static void rings_free(rings *r) { free(r->next), free(r->last), free(r->loop); }

static bool rings_make(const vs_skeleton_outline *o, rings *r) {
  for (size_t l = 0; l < o->loop_count; l++) r->count += o->size[l];
  if (!VS_FRESH(r->next, r->count) || !VS_FRESH(r->last, r->count) || !VS_FRESH(r->loop, r->count)) return false;
  size_t first = 0;
  for (size_t l = 0; l < o->loop_count; first += o->size[l], l++)
    for (size_t k = 0; k < o->size[l]; k++) {
      r->next[first + k] = (uint32_t)(first + (k + 1) % o->size[l]);
      r->last[first + k] = (uint32_t)(first + (k + o->size[l] - 1) % o->size[l]);
      r->loop[first + k] = (uint32_t)l;
    }
  return true;
}

static vs_wave_point wide(vs_vec2 p) { return (vs_wave_point){ p.x, p.y }; }

/* Returns twice the signed area of the triangle a b c. */
static long double side(vs_vec2 a, vs_vec2 b, vs_vec2 c) {
  return vs_wave_cross(vs_wave_sub(wide(b), wide(a)), vs_wave_sub(wide(c), wide(a)));
}

/* Returns the distance of the point p from the segment from a to b. */
static long double distance(vs_vec2 p, vs_vec2 a, vs_vec2 b) {
  vs_wave_point d = vs_wave_sub(wide(b), wide(a)), v = vs_wave_sub(wide(p), wide(a));
  long double along = fminl(1, fmaxl(0, vs_wave_dot(v, d) / vs_wave_dot(d, d)));
  return hypotl(v.x - along * d.x, v.y - along * d.y);
}

/* Returns true if the edges i and j of the outline touch at a place other than a common corner. least: distance below
 * which points coincide. */
static bool touch(const vs_skeleton_outline *o, const rings *r, uint32_t i, uint32_t j, long double least) {
  vs_vec2 a = o->at[i], b = o->at[r->next[i]], c = o->at[j], d = o->at[r->next[j]];
  if (fmax(a.x, b.x) + least < fmin(c.x, d.x) || fmax(c.x, d.x) + least < fmin(a.x, b.x)) return false;
  if (fmax(a.y, b.y) + least < fmin(c.y, d.y) || fmax(c.y, d.y) + least < fmin(a.y, b.y)) return false;
  bool follows = r->next[i] == j, leads = r->next[j] == i;
  if (follows || leads) /* neighbouring edges touch if they have opposite directions, so that one lies on the other */
    return (follows && (distance(d, a, b) <= least || distance(a, c, d) <= least)) ||
           (leads && (distance(c, a, b) <= least || distance(b, c, d) <= least));
  if (distance(a, c, d) <= least || distance(b, c, d) <= least || distance(c, a, b) <= least ||
      distance(d, a, b) <= least)
    return true;
  return (side(a, b, c) > 0) != (side(a, b, d) > 0) && (side(c, d, a) > 0) != (side(c, d, b) > 0);
}

static bool crosses(const vs_skeleton_outline *o, const rings *r, long double least, size_t where[2]) {
  for (uint32_t i = 0; i < r->count; i++) {
    where[0] = i, where[1] = i;
    vs_wave_point d = vs_wave_sub(wide(o->at[r->next[i]]), wide(o->at[i]));
    if (hypotl(d.x, d.y) <= least) return true;
    for (uint32_t j = i + 1; j < r->count; j++)
      if (where[1] = j, touch(o, r, i, j, least)) return true;
  }
  return false;
}

/* Returns true if loop l has the wrong direction: clockwise although it is no hole, or counter-clockwise although it is
 * a hole. */
static bool backwards(const vs_skeleton_outline *o, const rings *r, uint32_t l) {
  size_t first = 0;
  while (r->loop[first] != l) first++;
  vs_vec2 p = o->at[first];
  long double area = 0;
  bool hole = false;
  for (size_t i = 0; i < r->count; i++) {
    vs_vec2 a = o->at[i], b = o->at[r->next[i]];
    if (r->loop[i] == l) area += side(p, a, b);
    else if ((a.y > p.y) != (b.y > p.y) && (side(a, b, p) > 0) == (b.y > a.y)) hole = !hole;
  }
  return (area < 0) != hole;
}

static long double extent(const vs_skeleton_outline *o, size_t n) {
  double x[2] = { INFINITY, -INFINITY }, y[2] = { INFINITY, -INFINITY };
  for (size_t i = 0; i < n; i++) {
    x[0] = fmin(x[0], o->at[i].x), x[1] = fmax(x[1], o->at[i].x);
    y[0] = fmin(y[0], o->at[i].y), y[1] = fmax(y[1], o->at[i].y);
  }
  return n ? hypotl((long double)x[1] - x[0], (long double)y[1] - y[0]) : 0;
}

/* Makes a moving line and a start node for each edge of the outline, with the inside on its left. `next[i]`: receives
 * the edge after edge i. `edge_of[i]`: receives the index in the outline of the edge of line i. */
static bool start_wave(const vs_skeleton_outline *o, const rings *r, vs_wave *w, uint32_t *next, uint32_t *edge_of) {
  size_t n = r->count;
  if (!VS_GROW(w->line, w->line_room, n) || !VS_GROW(w->node, w->node_room, n)) return false;
  bool back = false;
  for (uint32_t i = 0; i < n; i++) {
    if (!i || r->loop[i] != r->loop[i - 1]) back = backwards(o, r, r->loop[i]);
    next[i] = back ? r->last[i] : r->next[i];
    edge_of[i] = back ? r->last[i] : i;
    vs_vec2 a = o->at[i], b = o->at[next[i]];
    vs_wave_point d = vs_wave_sub(wide(b), wide(a));
    long double length = hypotl(d.x, d.y);
    vs_wave_line *l = &w->line[i];
    l->along = (vs_wave_point){ d.x / length, d.y / length };
    l->normal = (vs_wave_point){ -l->along.y, l->along.x };
    l->offset = vs_wave_dot(l->normal, wide(a));
    l->speed = o->speed[edge_of[i]];
    w->node[i] = (vs_wave_node){ wide(a), 0 };
  }
  w->line_count = w->node_count = n;
  return true;
}

/* ---- the faces ---- */

static int compare_halves(const void *p, const void *q) {
  const vs_wave_half *a = p, *b = q;
  if (a->line != b->line) return a->line < b->line ? -1 : 1;
  if (a->from != b->from) return a->from < b->from ? -1 : 1;
  return a->to < b->to ? -1 : a->to > b->to;
}

/* Returns the direction of half-edge h in the plane of its face: x is along the line of the face's edge, y upwards. */
static vs_wave_point direction(const vs_wave *w, const vs_wave_half *h) {
  const vs_wave_node *a = &w->node[h->from], *b = &w->node[h->to];
  return (vs_wave_point){ vs_wave_dot(w->line[h->line].along, vs_wave_sub(b->at, a->at)), b->time - a->time };
}

/* Returns the half-edge that follows half-edge h around its face. Searches among the half-edges from index first to end
 * - 1; returns end if there is none. */
static size_t follower(const vs_wave *w, size_t h, size_t first, size_t end, const bool *used) {
  size_t found = end;
  long double least = INFINITY;
  for (size_t i = first; i < end; i++) {
    if (used[i] || w->half[i].from != w->half[h].to) continue;
    long double turn = vs_wave_turn(direction(w, &w->half[h]), direction(w, &w->half[i]));
    if (turn < least) least = turn, found = i;
  }
  return found;
}

/* Returns true if the skeleton's node lies in the plane of the roof face of a moving line. line, node: their
 * numbers. */
static bool in_plane(const vs_wave *w, uint32_t line, uint32_t node, long double tolerance) {
  const vs_wave_line *l = &w->line[line];
  const vs_wave_node *n = &w->node[node];
  return fabsl(vs_wave_dot(l->normal, n->at) - l->offset - l->speed * n->time) <= tolerance;
}

/* Adds the face whose border begins with half-edge h. range: the half-edges of the face's line. Fails if the border
 * does not close, leaves its plane or encloses a hole. */
static vs_skeleton_outcome add_face(const vs_wave *w, size_t h, const size_t range[2], bool *used, vs_skeleton *s) {
  vs_skeleton_face face = { .first = s->corner_count };
  long double tolerance = 1e4L * w->least, area = 0, reach = 0;
  const vs_wave_node *start = &w->node[w->half[h].from];
  vs_wave_point last = { 0, 0 };
  size_t i = h;
  do {
    vs_wave_half b = w->half[i];
    if (!in_plane(w, b.line, b.from, tolerance)) return VS_SKELETON_FAILED;
    vs_wave_point p = { vs_wave_dot(w->line[b.line].along, vs_wave_sub(w->node[b.from].at, start->at)),
                        w->node[b.from].time - start->time };
    area += vs_wave_cross(last, p), last = p, reach = fmaxl(reach, fabsl(p.x) + fabsl(p.y));
    if (!VS_GROW(s->corner, s->corner_room, s->corner_count + 1)) return VS_SKELETON_MEMORY;
    s->corner[s->corner_count++] = b.from;
    used[i] = true;
    if (w->half[i].to == w->half[h].from) break;
    i = follower(w, i, range[0], range[1], used);
  } while (i < range[1]);
  if (i == range[1]) return VS_SKELETON_FAILED;
  if (area < -tolerance * reach) return VS_SKELETON_RING;
  face.count = s->corner_count - face.first;
  if (face.count < 3) {
    s->corner_count = face.first;
    return VS_SKELETON_DONE;
  }
  face.edge = w->half[h].line;
  if (!VS_GROW(s->face, s->face_room, s->face_count + 1)) return VS_SKELETON_MEMORY;
  s->face[s->face_count++] = face;
  return VS_SKELETON_DONE;
}

static int compare_faces(const void *p, const void *q) {
  const vs_skeleton_face *a = p, *b = q;
  if (a->edge != b->edge) return a->edge < b->edge ? -1 : 1;
  return a->first < b->first ? -1 : a->first > b->first;
}

static vs_skeleton_outcome make_faces(vs_wave *w, const uint32_t *edge_of, size_t edges, vs_skeleton *s) {
  bool *used = vs_zeros(w->half_count, sizeof *used);
  vs_skeleton_outcome outcome = used ? VS_SKELETON_DONE : VS_SKELETON_MEMORY;
  if (w->half_count) qsort(w->half, w->half_count, sizeof *w->half, compare_halves);
  size_t range[2] = { 0, 0 };
  for (size_t h = 0; outcome == VS_SKELETON_DONE && h < w->half_count; h++) {
    if (h == range[1]) {
      range[0] = h;
      while (range[1] < w->half_count && w->half[range[1]].line == w->half[h].line) range[1]++;
    }
    if (!used[h]) outcome = add_face(w, h, range, used, s);
  }
  free(used);
  for (size_t i = 0; i < s->face_count; i++)
    s->face[i].edge = s->face[i].edge < edges ? edge_of[s->face[i].edge] : VS_SKELETON_STEP;
  if (s->face_count) qsort(s->face, s->face_count, sizeof *s->face, compare_faces);
  if (outcome != VS_SKELETON_DONE) return outcome;
  if (!VS_GROW(s->at, s->room, w->node_count)) return VS_SKELETON_MEMORY;
  for (size_t i = 0; i < w->node_count; i++)
    s->at[i] = vs_v3((double)w->node[i].at.x, (double)w->node[i].at.y, (double)w->node[i].time);
  s->count = w->node_count;
  return VS_SKELETON_DONE;
}

vs_skeleton_outcome vs_skeleton_make(const vs_skeleton_outline *o, vs_long_work work, vs_skeleton *out,
                                     size_t where[2]) {
  rings r = { 0 };
  vs_wave w = { 0 };
  uint32_t *next = NULL, *edge_of = NULL;
  vs_skeleton_outcome outcome = VS_SKELETON_MEMORY;
  *out = (vs_skeleton){ 0 };
  if (rings_make(o, &r) && VS_FRESH(next, r.count) && VS_FRESH(edge_of, r.count)) {
    w.least = RESOLUTION * extent(o, r.count);
    if (crosses(o, &r, w.least, where)) outcome = VS_SKELETON_CROSSES;
    else if (start_wave(o, &r, &w, next, edge_of)) outcome = vs_wave_run(&w, next, work);
    if (outcome == VS_SKELETON_DONE) outcome = make_faces(&w, edge_of, r.count, out);
  }
  rings_free(&r), vs_wave_free(&w), free(next), free(edge_of);
  if (outcome != VS_SKELETON_DONE) vs_skeleton_free(out);
  return outcome;
}
