/* Finds places where the exact surface touches itself (touching.h).
 *
 * Parts of the surface that face the same way are not tested against each other (self_contacts.c), because another
 * part, which faces the opposite way, is between them. This is not so where the surface touches itself, at a position
 * that two corners share. The part between may end there. Rounding of the corners around this place may then tilt thin
 * triangles of the two parts into each other.
 *
 * Triangles of a storey, a plane perpendicular to an axis, stay in it when their corners are rounded. But the corners
 * are doubles, and two planes may have become one if they differed by less than doubles can represent. If a thin wedge
 * was between such planes, a triangle now lies on another triangle that faces it, and they share the position of a
 * corner. */
#include "kernel/round/touching.h"

#include <stdlib.h>
#include <string.h>

#include "kernel/mesh/triangles_meet.h"

static uint64_t place_hash(vs_vec3 p) {
  uint64_t bits[3], h = 0;
  vs_vec3 q = vs_v3(p.x + 0.0, p.y + 0.0, p.z + 0.0); /* adding 0 converts -0 to 0, so that equal positions have equal
                                                       * bytes in the hash */
  memcpy(bits, &q, sizeof bits);
  for (int i = 0; i < 3; i++) h = (h ^ bits[i]) * 0x9e3779b97f4a7c15u, h ^= h >> 32;
  return h;
}

enum { NOT_LEVEL = 3 };

/* Returns the axis to which triangle t is perpendicular, or NOT_LEVEL. *up: true if its normal points along the
 * axis. */
static int across(const vs_mesh *m, uint32_t t, bool *up) {
  const uint32_t *v = m->triangles[t];
  vs_vec3 a = m->vertices[v[0]], b = m->vertices[v[1]], c = m->vertices[v[2]];
  int axis = a.x == b.x && a.x == c.x   ? 0
             : a.y == b.y && a.y == c.y ? 1
             : a.z == b.z && a.z == c.z ? 2
                                        : NOT_LEVEL;
  *up = false;
  if (axis == NOT_LEVEL) return axis;
  vs_vec3 n = vs_v3_cross(vs_v3_sub(b, a), vs_v3_sub(c, a));
  *up = (axis == 0 ? n.x : axis == 1 ? n.y : n.z) > 0;
  return axis;
}

/* Returns true if triangle t, which is perpendicular to the axis (0, 1 or 2), lies in a storey of s. */
static bool in_storey(const vs_rounding *s, uint32_t t, int axis) {
  vs_vec3 a = s->m->vertices[s->m->triangles[t][0]];
  double value = axis == 0 ? a.x : axis == 1 ? a.y : a.z;
  size_t storey = vs_rounding_storey(s, axis, value);
  VS_ASSERT(axis >= 0 && axis < 3);
  return storey < s->storeys.count && s->storeys.at[storey].axis == axis && s->storeys.at[storey].value == value;
}

static bool is_level(const vs_rounding *s, uint32_t t) {
  bool up;
  int axis = across(s->m, t, &up);
  return axis != NOT_LEVEL && in_storey(s, t, axis);
}

/* A corner of a triangle in a storey (plane perpendicular to an axis). Such entries are made only at positions where
 * some of these triangles face up along the axis, and others down. */
typedef struct {
  uint32_t place, triangle; /* place: first vertex at the position of the corner; triangle: number of the triangle */
  uint8_t axis;
  bool up;                  /* true if the triangle's normal points along the axis */
} level_corner;

static int by_place(const void *a, const void *b) {
  const level_corner *x = a, *y = b;
  if (x->place != y->place) return x->place < y->place ? -1 : 1;
  if (x->axis != y->axis) return x->axis < y->axis ? -1 : 1;
  if (x->up != y->up) return x->up ? 1 : -1;
  return x->triangle < y->triangle ? -1 : x->triangle > y->triangle;
}

static bool overlap(const vs_rounding *s, uint32_t t, uint32_t u) {
  vs_vec3 a[3], b[3];
  const vs_vec3 *at = s->m->vertices;
  for (int i = 0; i < 3; i++) a[i] = at[s->m->triangles[t][i]], b[i] = at[s->m->triangles[u][i]];
  return !vs_triangle_is_flat(a) && !vs_triangle_is_flat(b) && vs_triangles_meet(a, b) == VS_MEET_CROSS;
}

/* Tests the triangles of one storey (plane perpendicular to an axis) around one position against each other, beginning
 * with those that face down along the axis. If there are very many triangles, marks them without a test. Returns false
 * if interrupted. */
static bool look_around(vs_rounding *s, const level_corner *at, size_t count) {
  enum { MANY = 1 << 12 };
  size_t down = 0;
  while (down < count && !at[down].up) down++;
  for (size_t i = 0; i < down; i++)
    for (size_t j = down; j < count; j++) {
      if (down * (count - down) <= MANY && !overlap(s, at[i].triangle, at[j].triangle)) continue;
      s->changed.at[at[i].triangle] = s->changed.at[at[j].triangle] = VS_SUSPECT;
      if (!vs_kernel_poll(s->k, 1)) return false;
      if (down * (count - down) > MANY && i) break; /* there are too many pairs for a test: the first pass of the outer
                                                     * loop has marked all triangles that face up, and each later pass
                                                     * marks only its own triangle */
    }
  return true;
}

static uint32_t place_of(const uint32_t *place, uint32_t v) { return place[v] == UINT32_MAX ? v : place[v]; }

/* For each position, records the directions of the triangles there that are perpendicular to an axis, two bits for each
 * axis. *mixed: true if at some position such triangles face both ways along an axis, which is rare. Returns false if
 * interrupted. */
static bool look_ways(vs_rounding *s, const uint32_t *place, uint8_t *ways, bool *mixed) {
  for (uint32_t t = 0; t < s->m->triangle_count; t++) {
    bool up;
    int axis = across(s->m, t, &up);
    for (int i = 0; axis != NOT_LEVEL && i < 3; i++) {
      uint8_t *to = &ways[place_of(place, s->m->triangles[t][i])];
      *to |= (uint8_t)(1 << (2 * axis + up));
      *mixed = *mixed || (*to >> (2 * axis) & 3) == 3;
    }
    if (!vs_kernel_poll(s->k, 1)) return false;
  }
  return true;
}

/* Marks pairs of triangles of one storey (plane across an axis) that overlap, face each other and share a position.
 * These triangles were in two planes that became one when their corners were rounded to doubles. Returns false on
 * failure. */
static bool suspect_folds(vs_rounding *s, const uint32_t *place) {
  VS_LIST(level_corner) all = { 0 };
  VS_LIST(uint8_t) ways = { 0 };
  bool mixed = false, ok = VS_ROOM(s->k, ways.at, ways.room, s->m->vertex_count + 1);
  if (ok) memset(ways.at, 0, s->m->vertex_count);
  ok = ok && look_ways(s, place, ways.at, &mixed);
  for (uint32_t t = 0; ok && mixed && t < s->m->triangle_count; t++) {
    bool up;
    int axis = across(s->m, t, &up);
    for (int i = 0; ok && axis != NOT_LEVEL && i < 3; i++) {
      uint32_t at = place_of(place, s->m->triangles[t][i]);
      if ((ways.at[at] >> (2 * axis) & 3) == 3 && in_storey(s, t, axis))
        ok = VS_PUSH(s->k, all, ((level_corner){ at, t, (uint8_t)axis, up }));
    }
    ok = ok && vs_kernel_poll(s->k, 1);
  }
  if (ok && all.count) qsort(all.at, all.count, sizeof *all.at, by_place);
  for (size_t i = 0, end; ok && i < all.count; i = end) {
    for (end = i + 1; end < all.count && all.at[end].place == all.at[i].place && all.at[end].axis == all.at[i].axis;)
      end++;
    ok = look_around(s, all.at + i, end - i) && vs_kernel_poll(s->k, 1);
  }
  VS_DROP(s->k, all);
  VS_DROP(s->k, ways);
  return ok;
}

bool vs_rounding_suspect_touching(vs_rounding *s) {
  const vs_mesh *m = s->m;
  VS_LIST(uint32_t) slots = { 0 }; /* hash table of positions: a slot contains the number of a vertex plus 1; 0 marks a
                                    * free slot */
  VS_LIST(uint32_t) places = { 0 }; /* places[v]: first vertex at the position of vertex v if several are there, else
                                     * UINT32_MAX */
  size_t size = 16, any = 0;
  while (size < 2 * m->vertex_count) size *= 2;
  bool ok = VS_ROOM(s->k, slots.at, slots.room, size) && VS_ROOM(s->k, places.at, places.room, m->vertex_count + 1);
  if (ok) memset(slots.at, 0, size * sizeof *slots.at);
  for (uint32_t v = 0; ok && v < m->vertex_count; v++) {
    size_t at = place_hash(m->vertices[v]) & (size - 1);
    while (slots.at[at] && !vs_v3_equal(m->vertices[slots.at[at] - 1], m->vertices[v])) at = (at + 1) & (size - 1);
    places.at[v] = UINT32_MAX;
    if (slots.at[at]) places.at[v] = places.at[slots.at[at] - 1] = slots.at[at] - 1, any++;
    else slots.at[at] = v + 1;
    ok = vs_kernel_poll(s->k, 1);
  }
  for (uint32_t t = 0; ok && any && t < m->triangle_count; t++) {
    const uint32_t *v = m->triangles[t], *place = places.at;
    bool at_touch = place[v[0]] != UINT32_MAX || place[v[1]] != UINT32_MAX || place[v[2]] != UINT32_MAX;
    if (at_touch && !is_level(s, t) && !s->changed.at[t]) s->changed.at[t] = VS_SUSPECT;
    ok = vs_kernel_poll(s->k, 1);
  }
  ok = ok && suspect_folds(s, places.at);
  VS_DROP(s->k, slots);
  VS_DROP(s->k, places);
  return ok;
}
