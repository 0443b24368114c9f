/* Owns the search for places where the exact surface touches itself (touching.h).
 *
 * Sheets that look the same way are not tried against each other (self_contacts.c), since there is another one between
 * them, unless the surface meets itself. It does so where two corners are one place: there the sheet between two others
 * may end, and rounding the corners around it tilts thin triangles of these two into each other. */
#include "kernel/round/touching.h"

#include <string.h>

static uint64_t place_hash(vs_vec3 p) {
  uint64_t bits[3], h = 0;
  vs_vec3 q = vs_v3(p.x + 0.0, p.y + 0.0, p.z + 0.0); /* -0 is 0 */
  memcpy(bits, &q, sizeof bits);
  for (int i = 0; i < 3; i++) h = (h ^ bits[i]) * 0x9e3779b97f4a7c15u, h ^= h >> 32;
  return h;
}

/* Does the triangle lie in a plane across an axis that is one of the storeys? */
static bool is_level(const vs_rounding *s, uint32_t t) {
  const uint32_t *v = s->m->triangles[t];
  vs_vec3 a = s->m->vertices[v[0]], b = s->m->vertices[v[1]], c = s->m->vertices[v[2]];
  int axis = a.x == b.x && a.x == c.x ? 0 : a.y == b.y && a.y == c.y ? 1 : 2;
  double value = axis == 0 ? a.x : axis == 1 ? a.y : a.z;
  if (axis == 2 && (a.z != b.z || a.z != c.z)) return false;
  size_t storey = vs_rounding_storey(s, axis, value);
  return storey < s->storeys.count && s->storeys.at[storey].axis == axis && s->storeys.at[storey].value == value;
}

bool vs_rounding_suspect_touching(vs_rounding *s) {
  const vs_mesh *m = s->m;
  VS_LIST(uint32_t) slots = { 0 }; /* a vertex and 1, by its place; 0: free */
  VS_LIST(uint8_t) touches = { 0 };
  size_t size = 16, any = 0;
  while (size < 2 * m->vertex_count) size *= 2;
  bool ok = VS_ROOM(s->k, slots.at, slots.room, size) && VS_ROOM(s->k, touches.at, touches.room, m->vertex_count + 1);
  if (ok) memset(slots.at, 0, size * sizeof *slots.at);
  if (ok) memset(touches.at, 0, m->vertex_count);
  for (uint32_t v = 0; ok && v < m->vertex_count; v++) {
    size_t at = place_hash(m->vertices[v]) & (size - 1);
    while (slots.at[at] && !vs_v3_equal(m->vertices[slots.at[at] - 1], m->vertices[v])) at = (at + 1) & (size - 1);
    if (slots.at[at]) touches.at[v] = touches.at[slots.at[at] - 1] = 1, any++;
    else slots.at[at] = v + 1;
    ok = vs_kernel_poll(s->k, 1);
  }
  for (uint32_t t = 0; ok && any && t < m->triangle_count; t++) {
    const uint32_t *v = m->triangles[t];
    bool at_touch = touches.at[v[0]] || touches.at[v[1]] || touches.at[v[2]];
    if (at_touch && !is_level(s, t) && !s->changed.at[t]) s->changed.at[t] = VS_SUSPECT;
    ok = vs_kernel_poll(s->k, 1);
  }
  VS_DROP(s->k, slots);
  VS_DROP(s->k, touches);
  return ok;
}
