/* Separates points at which a solid touches itself. A corner in this file is a corner of a single face. A fan is the
 * set of all corners at a point that are connected by edges. If a point has several fans, the solid touches itself
 * there, as two cones with a common apex do. Each fan then gets a point of its own, moved a step towards the fan's
 * neighbours. If one fan lies inside another, the narrower fan moves farther, so they do not cross.
 *
 * Two faces with a common edge are connected. If four or more faces have an edge in common, they are sorted around
 * the edge, and two are connected if a wedge of solid lies between them. The points move in doubles, because only
 * OpenSCAD's tolerance matters. If the separation fails, the mesh stays unchanged. The time is proportional to n log
 * n. */
#include "backends/openscad/touching_corners.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/files/polyface.h"
#include "model/store/array.h"
#include "model/store/disjoint.h"

/* The edge from a corner to the next corner of its face. */
typedef struct { uint32_t low, high, corner; bool forward; double angle; } side;
typedef struct {
  uint32_t place, first, edges; /* first: first corner of the fan; place: number of the point at which the fan is */
  vs_vec3 towards, out;         /* towards: sum of the directions along the fan's edges, finally a unit vector; out: sum
                                 * of the normals of the fan's faces */
  double narrow;                /* how well the directions of the fan's edges agree: 1 if all are equal, 0 if they point
                                 * all around in a plane */
} fan;

typedef struct {
  const vs_vec3 *points;
  const uint32_t *starts, *corners;
  size_t face_count, corner_count, point_count;
  /* All arrays have an element for each corner c. place[c]: number of its point. group: disjoint sets of corners.
   * of[c]: for the first corner of a set, the number of its fan. */
  uint32_t *place, *next, *face, *group, *of;
  side *sides;
  fan *fans;
} apart;

static uint32_t place_of(const apart *a, uint32_t corner) { return a->place[a->corners[corner]]; }

static void join_sides(apart *a, const side *s, const side *t) {
  vs_unite(a->group, s->corner, a->next[t->corner]);
  vs_unite(a->group, a->next[s->corner], t->corner);
}

static int compare_edges(const void *p, const void *q) {
  const side *s = p, *t = q;
  if (s->low != t->low) return s->low < t->low ? -1 : 1;
  if (s->high != t->high) return s->high < t->high ? -1 : 1;
  return s->corner < t->corner ? -1 : s->corner > t->corner;
}
static int compare_angles(const void *p, const void *q) {
  const side *s = p, *t = q;
  return s->angle < t->angle ? -1 : s->angle > t->angle ? 1 : s->corner < t->corner ? -1 : 1;
}
static int compare_fans(const void *p, const void *q) {
  const fan *s = p, *t = q;
  if (s->place != t->place) return s->place < t->place ? -1 : 1;
  if (s->narrow != t->narrow) return s->narrow < t->narrow ? -1 : 1;
  return s->first < t->first ? -1 : s->first > t->first;
}

static vs_vec3 face_normal(const apart *a, uint32_t face) {
  vs_vec3 sum = vs_v3(0, 0, 0), first = a->points[a->corners[a->starts[face]]];
  for (uint32_t k = a->starts[face] + 1; k + 1 < a->starts[face + 1]; k++)
    sum = vs_v3_add(
        sum, vs_v3_cross(vs_v3_sub(a->points[a->corners[k]], first), vs_v3_sub(a->points[a->corners[k + 1]], first)));
  return vs_v3_unit(sum);
}

/* Connects the faces around an edge that more than two faces have in common. The faces are sorted counter-clockwise, as
 * seen along the edge. Space after a face is empty if the face uses the edge forwards, and solid if backwards. */
static bool join_many(apart *a, side *s, size_t count) {
  vs_vec3 along = vs_v3_unit(vs_v3_sub(a->points[s->high], a->points[s->low]));
  vs_vec3 x = vs_v3_unit(vs_v3_cross(along, fabs(along.z) < 0.5 ? vs_v3(0, 0, 1) : vs_v3(1, 0, 0))),
          y = vs_v3_cross(along, x);
  for (size_t i = 0; i < count; i++) {
    vs_vec3 inwards = vs_v3_cross(face_normal(a, a->face[s[i].corner]), s[i].forward ? along : vs_v3_scale(along, -1));
    s[i].angle = atan2(vs_v3_dot(inwards, y), vs_v3_dot(inwards, x));
  }
  qsort(s, count, sizeof *s, compare_angles);
  size_t begin = s[0].forward ? 1 : 0;
  for (size_t i = 0; i < count; i++)
    if (s[(begin + i) % count].forward != (i % 2 == 1)) return false;
  for (size_t i = 0; i < count; i += 2) join_sides(a, &s[begin + i], &s[(begin + i + 1) % count]);
  return true;
}

/* Connects the faces at all edges. Returns false if the mesh is not closed. */
static bool join_all(apart *a) {
  for (uint32_t f = 0; f < a->face_count; f++)
    for (uint32_t c = a->starts[f]; c < a->starts[f + 1]; c++) {
      a->face[c] = f, a->group[c] = c;
      a->next[c] = c + 1 == a->starts[f + 1] ? a->starts[f] : c + 1;
      uint32_t p = place_of(a, c), q = place_of(a, a->next[c]);
      a->sides[c] = (side){ p < q ? p : q, p < q ? q : p, c, p < q, 0 };
    }
  qsort(a->sides, a->corner_count, sizeof *a->sides, compare_edges);
  for (size_t i = 0, end; i < a->corner_count; i = end) {
    for (end = i + 1;
         end < a->corner_count && a->sides[end].low == a->sides[i].low && a->sides[end].high == a->sides[i].high;)
      end++;
    if (end - i == 2 && a->sides[i].forward != a->sides[i + 1].forward) join_sides(a, &a->sides[i], &a->sides[i + 1]);
    else if (!join_many(a, a->sides + i, end - i)) return false;
  }
  return true;
}

/* Lists the fans (sets of corners at a point that edges connect) by point, with the flattest fan of a point first, and
 * returns their number. Sets *touches to true if a point has two fans. */
static size_t list_fans(apart *a, bool *touches) {
  size_t count = 0;
  for (uint32_t c = 0; c < a->corner_count; c++) { /* the number of a set of corners is that of its first corner, the
                                                    * smallest */
    uint32_t first = vs_find(a->group, c);
    if (first == c)
      a->of[c] = (uint32_t)count, a->fans[count++] = (fan){ place_of(a, c), c, 0, vs_v3(0, 0, 0), vs_v3(0, 0, 0), 0 };
    fan *f = &a->fans[a->of[first]];
    f->towards =
        vs_v3_add(f->towards, vs_v3_unit(vs_v3_sub(a->points[a->corners[a->next[c]]], a->points[a->corners[c]])));
    f->out = vs_v3_add(f->out, face_normal(a, a->face[c]));
    f->edges++;
  }
  for (size_t i = 0; i < count; i++) {
    fan *f = &a->fans[i];
    f->narrow = vs_v3_length(f->towards) / (double)f->edges;
    f->towards = vs_v3_unit(f->narrow > 0.01 ? f->towards : vs_v3_scale(f->out, -1));
  }
  qsort(a->fans, count, sizeof *a->fans, compare_fans);
  *touches = false;
  for (size_t i = 0; i + 1 < count; i++) *touches = *touches || a->fans[i].place == a->fans[i + 1].place;
  return count;
}

/* Returns the distance by which fans (sets of corners at a point that edges connect) are moved. OpenSCAD merges points
 * closer than 2^-20 units, regardless of the model's size. */
static double apart_step(const apart *a) {
  vs_bounds all = vs_bounds_empty();
  for (size_t i = 0; i < a->point_count; i++) vs_bounds_add(&all, a->points[i]);
  return fmax(0x1p-16, 0x1p-20 * vs_bounds_diagonal(&all));
}

static bool apart_fill(apart *a, vs_apart *out, size_t fan_count) {
  out->points = vs_fresh(a->point_count + fan_count, sizeof *out->points);
  out->corners = vs_fresh(a->corner_count, sizeof *out->corners);
  if (!out->points || !out->corners) return false;
  memcpy(out->points, a->points, a->point_count * sizeof *out->points);
  memcpy(out->corners, a->corners, a->corner_count * sizeof *out->corners);
  out->count = a->point_count;
  double step = apart_step(a);
  uint32_t *point = a->of; /* point[c]: if c is the first corner of a fan, the new point of the fan */
  for (size_t i = 0; i < a->corner_count; i++) point[i] = UINT32_MAX;
  for (size_t i = 0, end; i < fan_count; i = end) {
    for (end = i + 1; end < fan_count && a->fans[end].place == a->fans[i].place;) end++;
    for (size_t k = i; k < end && end - i > 1; k++) {
      uint32_t at = k == i ? a->fans[i].place : (uint32_t)out->count++;
      out->points[at] =
          vs_v3_add(a->points[a->fans[i].place], vs_v3_scale(a->fans[k].towards, step * (double)(k - i + 1)));
      point[a->fans[k].first] = at;
    }
  }
  for (uint32_t c = 0; c < a->corner_count; c++) {
    uint32_t at = point[vs_find(a->group, c)];
    if (at != UINT32_MAX) out->corners[c] = at;
  }
  return true;
}

bool vs_apart_make(const struct vs_polyface_mesh *mesh, vs_apart *out) {
  *out = (vs_apart){ 0 };
  const uint32_t *starts = vs_faces_starts(mesh->faces);
  size_t n = starts[mesh->faces->count], points = mesh->points->count;
  if (n == 0 || points == 0) return true;
  apart a = { mesh->points->at,
              starts,
              vs_faces_corners(mesh->faces),
              mesh->faces->count,
              n,
              points,
              vs_fresh(points, sizeof *a.place),
              vs_fresh(n, sizeof *a.next),
              vs_fresh(n, sizeof *a.face),
              vs_fresh(n, sizeof *a.group),
              vs_fresh(n, sizeof *a.of),
              vs_fresh(n, sizeof *a.sides),
              vs_fresh(n, sizeof *a.fans) };
  bool touches = false, ok = a.place && a.next && a.face && a.group && a.of && a.sides && a.fans &&
                             vs_polyface_merge(a.points, points, a.place);
  if (ok && join_all(&a)) {
    size_t fans = list_fans(&a, &touches);
    if (touches) ok = apart_fill(&a, out, fans);
  }
  free(a.place), free(a.next), free(a.face), free(a.group), free(a.of), free(a.sides), free(a.fans);
  if (!ok) vs_apart_free(out);
  return ok;
}

void vs_apart_free(vs_apart *a) {
  free(a->points);
  free(a->corners);
  *a = (vs_apart){ 0 };
}
