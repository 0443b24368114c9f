/* Repairs faces over points until they bound a solid.
 *
 * In a closed mesh each edge occurs as often in one direction as in the other. If an edge does not, opposite sides are
 * missing there. In any mesh, as many missing sides leave a point as arrive at it. Therefore the missing sides form
 * loops, and triangles can cover each loop. */
#include "geometry/files/repair.h"

#include <stdlib.h>
#include <string.h>

#include "geometry/frame.h"
#include "geometry/files/polyface.h"
#include "geometry/plane/ear_clipping.h"
#include "model/store/array.h"
#include "model/store/disjoint.h"

bool vs_face_list_compact(vs_face_list *l) {
  uint32_t *place = vs_fresh(l->point_count + 1, sizeof *place),
           *number = vs_fresh(l->point_count + 1, sizeof *number), count = 0;
  bool ok = place && number && vs_polyface_merge(l->points, l->point_count, place);
  if (ok) memset(number, 0xFF, (l->point_count + 1) * sizeof *number);
  for (size_t c = 0; ok && c < l->corner_count; c++) number[place[l->corners[c]]] = 0;
  for (uint32_t i = 0; ok && i < l->point_count; i++) /* removes the points that are in no face; the remaining points
                                                       * keep their order */
    if (number[i] != UINT32_MAX) {
      l->points[count] = l->points[i];
      number[i] = count++;
    }
  for (size_t c = 0; ok && c < l->corner_count; c++) l->corners[c] = number[place[l->corners[c]]];
  if (ok) l->point_count = count;
  free(place);
  free(number);
  return ok;
}

typedef struct { uint32_t low, high, face; bool forward; } repair_side;

static int side_compare(const void *a, const void *b) {
  const repair_side *p = a, *q = b;
  if (p->low != q->low) return p->low < q->low ? -1 : 1;
  if (p->high != q->high) return p->high < q->high ? -1 : 1;
  return p->face < q->face ? -1 : p->face > q->face;
}

/* Returns the sides of all faces, sorted by their two ends. Omits sides of length 0. *count: number of sides. Returns
 * NULL when memory is out. */
static repair_side *list_sides(const vs_face_list *l, size_t *count) {
  repair_side *sides = vs_fresh(l->corner_count + 1, sizeof *sides);
  *count = 0;
  for (uint32_t f = 0; sides && f < l->face_count; f++)
    for (uint32_t c = l->starts[f]; c < l->starts[f + 1]; c++) {
      uint32_t a = l->corners[c], b = l->corners[c + 1 == l->starts[f + 1] ? l->starts[f] : c + 1];
      if (a != b) sides[(*count)++] = (repair_side){ a < b ? a : b, a < b ? b : a, f, a < b };
    }
  if (sides) qsort(sides, *count, sizeof *sides, side_compare);
  return sides;
}

/* Returns the index after the last side of an edge; `at` is the index of its first side. *over: number of its sides
 * that run from the lower point index to the higher, minus the number that run back. */
static size_t edge_end(const repair_side *sides, size_t count, size_t at, long *over) {
  size_t end = at;
  VS_ASSERT(at < count);
  for (*over = 0; end < count && sides[end].low == sides[at].low && sides[end].high == sides[at].high; end++)
    *over += sides[end].forward ? 1 : -1;
  return end;
}

bool vs_face_list_open(vs_store *s, const vs_face_list *l, vs_open_edges *out, vs_error *e) {
  vs_face_list own = { .points = l->points, .point_count = l->point_count };
  uint32_t *place = vs_fresh(l->point_count + 1, sizeof *place),
           *number = vs_fresh(l->face_count + 1, sizeof *number);
  unsigned char *turned = vs_zeros(l->face_count + 1, 1);
  size_t count = 0;
  bool closed, ok = place && number && turned && vs_polyface_merge(l->points, l->point_count, place);
  *out = (vs_open_edges){ 0 };
  vs_error why = { VS_ERROR_NONE, NULL, "" };
  /* Prepares the faces as vs_polyface_make does: equal points become one point, and faces are reversed to agree with
   * their neighbours. */
  for (uint32_t f = 0; ok && f < l->face_count; f++) {
    for (uint32_t c = l->starts[f]; ok && c < l->starts[f + 1]; c++)
      ok = vs_face_list_corner(&own, place[l->corners[c]]);
    number[own.face_count] = f;
    ok = ok && vs_face_list_close(&own);
  }
  vs_polygons merged = vs_polygons_of(&own);
  ok = ok && (!own.face_count || vs_polyface_orient(s, &merged, turned, &closed, &why));
  repair_side *sides = ok ? list_sides(&own, &count) : NULL;
  for (size_t i = 0; sides && i < count; i++) sides[i].forward ^= turned[sides[i].face];
  for (size_t i = 0, end; sides && i < count; i = end) {
    long over;
    end = edge_end(sides, count, i, &over);
    if (over && !out->count++)
      *out = (vs_open_edges){ 1, number[sides[i].face], l->points[sides[i].low], l->points[sides[i].high] };
  }
  ok = sides != NULL;
  if (!ok && why.kind == VS_ERROR_NONE) vs_error_memory(&why, NULL);
  if (!ok && e) *e = why;
  own.points = NULL;
  vs_face_list_free(&own);
  free(sides);
  free(place);
  free(number);
  free(turned);
  return ok;
}

/* ---- welding of nearby points ---- */

typedef struct { int64_t x, y, z; } weld_cell;

/* Returns the slot of cell c of the grid in the hash table, or a free slot if it has none. mask: number of slots, a
 * power of two, minus 1. */
static size_t weld_slot(const uint32_t *slots, size_t mask, const weld_cell *cells, weld_cell c) {
  uint64_t h = (uint64_t)c.x * UINT64_C(0x9E3779B97F4A7C15) ^ (uint64_t)c.y * UINT64_C(0xC2B2AE3D27D4EB4F) ^
               (uint64_t)c.z * UINT64_C(0x165667B19E3779F9);
  size_t at = (size_t)(h ^ h >> 29) & mask;
  VS_ASSERT((mask & (mask + 1)) == 0);
  while (slots[at] != UINT32_MAX && memcmp(&cells[slots[at]], &c, sizeof c)) at = (at + 1) & mask;
  return at;
}

/* Sets place[i] to the first point within `reach` of point i, or to i if there is none. *welded: number of points that
 * were given an earlier point. */
static bool weld(const vs_face_list *l, double reach, uint32_t *place, size_t *welded) {
  size_t room = 16;
  while (room < l->point_count * 2) room *= 2;
  /* next[i]: the next point in the list of points in the grid cell of point i. */
  uint32_t *slots = vs_fresh(room, sizeof *slots), *next = vs_fresh(l->point_count + 1, sizeof *next);
  weld_cell *cells = vs_fresh(l->point_count + 1, sizeof *cells);
  bool ok = slots && next && cells;
  if (ok) memset(slots, 0xFF, room * sizeof *slots);
  for (uint32_t i = 0; ok && i < l->point_count; i++) {
    vs_vec3 p = l->points[i];
    double q[3] = { p.x / (2 * reach), p.y / (2 * reach), p.z / (2 * reach) };
    int64_t low[3], side[3];
    for (int k = 0; k < 3; k++) low[k] = (int64_t)floor(q[k]), side[k] = q[k] - floor(q[k]) < 0.5 ? -1 : 1;
    place[i] = i;
    for (int k = 0; place[i] == i && k < 8; k++) {
      weld_cell c = { low[0] + (k & 1 ? side[0] : 0), low[1] + (k & 2 ? side[1] : 0), low[2] + (k & 4 ? side[2] : 0) };
      for (uint32_t j = slots[weld_slot(slots, room - 1, cells, c)]; j != UINT32_MAX; j = next[j])
        if (vs_v3_length(vs_v3_sub(l->points[j], p)) <= reach) {
          place[i] = j;
          *welded += !vs_v3_equal(l->points[j], p);
          break;
        }
    }
    if (place[i] != i) continue;
    cells[i] = (weld_cell){ low[0], low[1], low[2] };
    size_t at = weld_slot(slots, room - 1, cells, cells[i]);
    next[i] = slots[at];
    slots[at] = i;
  }
  free(slots);
  free(next);
  free(cells);
  return ok;
}

/* ---- removal of faces ---- */

/* Removes corners of a face that repeat the corner before them. Returns the number of remaining corners; with fewer
 * than three, the face vanishes. */
static uint32_t squeeze(uint32_t *at, uint32_t count) {
  uint32_t n = 0;
  for (uint32_t i = 0; i < count; i++) {
    if (n && at[n - 1] == at[i]) continue;
    if (n > 1 && at[n - 2] == at[i]) { /* removes two successive edges of the face if the second is the reverse of the
                                        * first */
      n--;
      continue;
    }
    at[n++] = at[i];
  }
  while (n > 1 && at[n - 1] == at[0]) n--;
  return n < 3 ? 0 : n;
}

typedef struct { uint32_t face, count; uint64_t key; } face_key;

static int key_compare(const void *a, const void *b) {
  const face_key *p = a, *q = b;
  if (p->key != q->key) return p->key < q->key ? -1 : 1;
  if (p->count != q->count) return p->count < q->count ? -1 : 1;
  return p->face < q->face ? -1 : p->face > q->face;
}

/* Returns 1 if the polygons a and b have equal corners in the same order, -1 if b is a reversed, and 0 otherwise. n >
 * 0: number of corners. */
static int same_ring(const uint32_t *a, const uint32_t *b, uint32_t n) {
  uint32_t shift = 0;
  VS_ASSERT(n > 0);
  while (shift < n && b[shift] != a[0]) shift++;
  if (shift == n) return 0;
  bool same = true, back = true;
  for (uint32_t i = 0; i < n; i++) {
    same = same && a[i] == b[(shift + i) % n];
    back = back && a[i] == b[(shift + n - i) % n];
  }
  return same ? 1 : back ? -1 : 0;
}

/* Keeps only the faces f for which keep[f] is not 0, and removes repeated corners from each. Adds the number of removed
 * faces to *dropped. */
static void keep_faces(vs_face_list *l, const unsigned char *keep, size_t *dropped) {
  uint32_t corners = 0, faces = 0, from = l->face_count ? l->starts[0] : 0;
  for (uint32_t f = 0; f < l->face_count; f++) {
    uint32_t to = l->starts[f + 1], n = keep[f] ? squeeze(l->corners + from, to - from) : 0;
    memmove(l->corners + corners, l->corners + from, n * sizeof *l->corners);
    from = to;
    *dropped += n == 0;
    if (!n) continue;
    corners += n;
    l->starts[++faces] = corners;
  }
  l->face_count = faces;
  l->corner_count = corners;
}

static bool drop_faces(vs_face_list *l, size_t *dropped) {
  size_t n = l->face_count;
  unsigned char *keep = vs_fresh(n + 1, 1);
  face_key *keys = vs_fresh(n + 1, sizeof *keys);
  bool ok = keep && keys;
  if (ok) {
    memset(keep, 1, n);
    keep_faces(l, keep, dropped);
    for (uint32_t f = 0; f < l->face_count; f++) {
      keys[f] = (face_key){ .face = f, .count = l->starts[f + 1] - l->starts[f] };
      for (uint32_t c = l->starts[f]; c < l->starts[f + 1]; c++)
        keys[f].key += (l->corners[c] + UINT64_C(1)) * UINT64_C(0x9E3779B97F4A7C15) ^ (uint64_t)l->corners[c] << 40;
    }
    qsort(keys, l->face_count, sizeof *keys, key_compare);
    for (size_t i = 0; i < l->face_count; i++) {
      if (!keep[keys[i].face]) continue;
      for (size_t j = i + 1; j < l->face_count && keys[j].key == keys[i].key && keys[j].count == keys[i].count; j++) {
        if (!keep[keys[j].face]) continue;
        int same = same_ring(l->corners + l->starts[keys[i].face], l->corners + l->starts[keys[j].face], keys[i].count);
        if (same) keep[keys[j].face] = 0;
        if (same < 0) { /* two faces with equal corners and opposite orientation enclose nothing, so both are removed */
          keep[keys[i].face] = 0;
          break;
        }
      }
    }
    keep_faces(l, keep, dropped);
  }
  free(keep);
  free(keys);
  return ok;
}

/* ---- closing of holes ---- */

/* Covers the loop `ring`, which has n >= 3 points, with triangles. The triangles contain the loop's edges in the
 * direction of the loop. Returns false when memory is out. */
static bool cover(vs_face_list *l, const uint32_t *ring, size_t n) {
  vs_mesh m = { 0 };
  vs_vec2 *flat = vs_fresh(n, sizeof *flat);
  vs_vec3 normal = { 0, 0, 0 }, o = l->points[ring[0]];
  VS_ASSERT(n >= 3);
  for (size_t i = 0; i < n; i++)
    normal =
        vs_v3_add(normal, vs_v3_cross(vs_v3_sub(l->points[ring[i]], o), vs_v3_sub(l->points[ring[(i + 1) % n]], o)));
  vs_affine frame = vs_frame_on_axis(o, vs_v3_length(normal) > 0 ? normal : vs_v3(0, 0, 1)), back;
  bool ok = flat && vs_affine_invert(&frame, &back);
  for (size_t i = 0; ok && i < n; i++) {
    vs_vec3 p = vs_affine_point(&back, l->points[ring[i]]);
    flat[i] = (vs_vec2){ p.x, p.y };
  }
  ok = ok && vs_triangulate(flat, &n, 1, &m, ring, false);
  for (size_t i = 0; ok && i < m.triangle_count; i++) {
    for (int k = 0; ok && k < 3; k++) ok = vs_face_list_corner(l, m.triangles[i][k]);
    ok = ok && vs_face_list_close(l);
  }
  vs_mesh_free(&m);
  free(flat);
  return ok;
}

typedef struct { uint32_t from, to; } missing_side;

static int missing_compare(const void *a, const void *b) {
  const missing_side *p = a, *q = b;
  if (p->from != q->from) return p->from < q->from ? -1 : 1;
  return p->to < q->to ? -1 : p->to > q->to;
}

static bool close_holes(vs_face_list *l, vs_repair_notes *notes) {
  size_t count, missing = 0;
  repair_side *sides = list_sides(l, &count);
  missing_side *at = vs_fresh(count + 1, sizeof *at);
  uint32_t *first = vs_zeros(l->point_count + 2, sizeof *first), *ring = vs_fresh(count + 1, sizeof *ring),
           *seen = vs_fresh(l->point_count + 1, sizeof *seen);
  bool ok = sides && at && first && ring && seen;
  for (size_t i = 0, end; ok && i < count; i = end) {
    long over;
    end = edge_end(sides, count, i, &over);
    for (; over > 0; over--) at[missing++] = (missing_side){ sides[i].high, sides[i].low };
    for (; over < 0; over++) at[missing++] = (missing_side){ sides[i].low, sides[i].high };
  }
  if (ok && missing) {
    qsort(at, missing, sizeof *at, missing_compare);
    for (size_t i = 0; i < missing; i++) first[at[i].from + 1]++;
    for (size_t i = 0; i <= l->point_count; i++) first[i + 1] += first[i];
    memset(seen, 0xFF, (l->point_count + 1) * sizeof *seen);
  }
  /* Walks along the edges where a side is missing. When the walk reaches a point again, the edges since the first visit
   * form a loop. first[p]: index of the next unused edge that begins at point p. */
  size_t length = 0;
  for (size_t start = 0; ok && start < missing; start++) {
    uint32_t p = at[start].from;
    for (;;) {
      if (seen[p] != UINT32_MAX) {
        size_t from = seen[p], n = length - from;
        for (size_t i = from; i < length; i++) seen[ring[i]] = UINT32_MAX;
        if (n > 2) {
          ok = cover(l, ring + from, n);
          notes->holes++;
          if (n > notes->largest) notes->largest = n;
        }
        length = from;
        if (!ok) break;
      }
      uint32_t next = first[p];
      if (next >= missing || at[next].from != p) break; /* no unused edge begins at this point, so the walk has returned
                                                         * to its start */
      first[p]++;
      seen[p] = (uint32_t)length;
      ring[length++] = p;
      p = at[next].to;
    }
    for (size_t i = 0; i < length; i++) seen[ring[i]] = UINT32_MAX;
    length = 0;
  }
  free(sides);
  free(at);
  free(first);
  free(ring);
  free(seen);
  return ok;
}

/* ---- turning of faces ---- */

/* Reverses the order of the corners of face f. */
static void turn_face(vs_face_list *l, uint32_t f) {
  VS_ASSERT(f < l->face_count);
  for (uint32_t a = l->starts[f], b = l->starts[f + 1]; a + 1 < b; a++) {
    uint32_t swap = l->corners[a];
    l->corners[a] = l->corners[--b];
    l->corners[b] = swap;
  }
}

static bool agree(vs_store *s, vs_face_list *l, size_t *turned, vs_error *e) {
  unsigned char *turn = vs_zeros(l->face_count + 1, 1);
  vs_polygons faces = vs_polygons_of(l);
  bool closed, ok = turn && vs_polyface_orient(s, &faces, turn, &closed, e);
  for (uint32_t f = 0; ok && f < l->face_count; f++)
    if (turn[f]) turn_face(l, f), ++*turned;
  free(turn);
  return ok;
}

/* Returns six times the volume between the point o and the triangles into which face f is divided. *angle: half of the
 * solid angle of the face, seen from o. */
static double face_volume(const vs_face_list *l, uint32_t f, vs_vec3 o, double *angle) {
  double six = 0;
  vs_vec3 a = vs_v3_sub(l->points[l->corners[l->starts[f]]], o);
  VS_ASSERT(f < l->face_count);
  for (uint32_t c = l->starts[f] + 1; c + 1 < l->starts[f + 1]; c++) {
    vs_vec3 b = vs_v3_sub(l->points[l->corners[c]], o), d = vs_v3_sub(l->points[l->corners[c + 1]], o);
    double volume = vs_v3_dot(a, vs_v3_cross(b, d)), la = vs_v3_length(a), lb = vs_v3_length(b), ld = vs_v3_length(d);
    six += volume;
    if (angle)
      *angle += atan2(volume, la * lb * ld + vs_v3_dot(a, b) * ld + vs_v3_dot(b, d) * la + vs_v3_dot(d, a) * lb);
  }
  return six;
}

/* Turns shells (connected faces) with a negative volume outwards, except cavities, which lie inside another shell.
 * *turned: number of turned faces. Returns false when memory is out or the run is interrupted. */
static bool turn_shells(vs_store *store, vs_face_list *l, size_t *turned, vs_error *e) {
  size_t count, n = l->face_count;
  repair_side *sides = list_sides(l, &count);
  uint32_t *shell = vs_fresh(n + 1, sizeof *shell);
  double *volume = vs_zeros(n + 1, sizeof *volume);
  unsigned char *turn = vs_zeros(n + 1, 1);
  bool ok = sides && shell && volume && turn;
  if (ok) vs_disjoint(shell, (uint32_t)n);
  for (size_t i = 1; ok && i < count; i++)
    if (sides[i].low == sides[i - 1].low && sides[i].high == sides[i - 1].high)
      vs_unite(shell, sides[i].face, sides[i - 1].face);
  for (uint32_t f = 0; ok && f < n; f++)
    volume[vs_find(shell, f)] += face_volume(l, f, l->points[l->corners[l->starts[vs_find(shell, f)]]], NULL);
  for (uint32_t s = 0; ok && s < n; s++) {
    if (shell[s] != s || !(volume[s] < 0)) continue;
    double angle = 0;
    vs_vec3 o = l->points[l->corners[l->starts[s]]];
    for (uint32_t f = 0; f < n; f++) {
      double part = 0;
      uint32_t other = vs_find(shell, f);
      ok = vs_store_going(store, 4, e);
      if (!ok) break;
      if (other == s) continue;
      face_volume(l, f, o, &part);
      angle += volume[other] < 0 ? -part : part; /* adds the solid angle of face f, with the sign that it has if its
                                                  * shell faces outwards */
    }
    turn[s] = !(angle > 3.14159265358979323846);
  }
  for (uint32_t f = 0; ok && f < n; f++)
    if (turn[vs_find(shell, f)]) turn_face(l, f), ++*turned;
  free(sides);
  free(shell);
  free(volume);
  free(turn);
  return ok;
}

bool vs_face_list_repair(vs_store *s, vs_face_list *l, vs_repair_notes *notes, vs_error *e) {
  *notes = (vs_repair_notes){ 0 };
  if (!l->face_count) return true;
  vs_error why = { VS_ERROR_NONE, NULL, "" };
  uint32_t *place = vs_fresh(l->point_count + 1, sizeof *place);
  vs_bounds b = vs_bounds_empty();
  for (size_t i = 0; i < l->point_count; i++) vs_bounds_add(&b, l->points[i]);
  double reach = fmax(vs_bounds_diagonal(&b) * 1e-6, 1e-300),
         size = fmax(fmax(fabs(b.min.x), fabs(b.max.x)),
                     fmax(fmax(fabs(b.min.y), fabs(b.max.y)), fmax(fabs(b.min.z), fabs(b.max.z))));
  reach = fmax(reach, size * 1e-15); /* far from the origin, the spacing of doubles may be wider than `reach`, which is
                                      * then increased */
  bool ok = place && weld(l, reach, place, &notes->welded);
  for (size_t i = 0; ok && i < l->corner_count; i++) l->corners[i] = place[l->corners[i]];
  free(place);
  ok = ok && drop_faces(l, &notes->dropped) && agree(s, l, &notes->turned, &why) && close_holes(l, notes) &&
       turn_shells(s, l, &notes->turned, &why) && vs_face_list_compact(l);
  if (!ok && why.kind == VS_ERROR_NONE) vs_error_memory(&why, NULL);
  if (!ok && e) *e = why;
  return ok;
}
