/* Divides faces into shells: sets of faces that are connected by common edges. */
#include "geometry/files/face_shells.h"

#include <stdlib.h>
#include <string.h>

#include "model/assert.h"
#include "model/store/array.h"
#include "model/store/disjoint.h"

/* A side of a face. low, high: indices of the points at its ends, the lower index first. */
typedef struct { uint32_t low, high, face; } shell_side;

static int compare_sides(const void *a, const void *b) {
  const shell_side *s = a, *t = b;
  if (s->low != t->low) return s->low < t->low ? -1 : 1;
  if (s->high != t->high) return s->high < t->high ? -1 : 1;
  return s->face < t->face ? -1 : s->face > t->face;
}

/* Lists the sides of all faces, except sides that begin and end at one point. Returns the number of listed sides. */
static size_t list_sides(const vs_face_list *l, shell_side *sides) {
  size_t count = 0;
  for (uint32_t f = 0; f < l->face_count; f++)
    for (uint32_t c = l->starts[f], end = l->starts[f + 1]; c < end; c++) {
      uint32_t a = l->corners[c], b = l->corners[c + 1 < end ? c + 1 : l->starts[f]];
      if (a != b) sides[count++] = (shell_side){ a < b ? a : b, a < b ? b : a, f };
    }
  return count;
}

bool vs_face_list_shells(vs_store *s, const vs_face_list *l, uint32_t *shell, unsigned char *open, vs_error *e) {
  size_t n = l->face_count;
  VS_ASSERT(n < UINT32_MAX);
  if (!n) return true;
  shell_side *sides = vs_fresh(l->corner_count + 1, sizeof *sides);
  if (!sides) return vs_error_memory(e, NULL);
  size_t count = list_sides(l, sides);
  qsort(sides, count, sizeof *sides, compare_sides);
  vs_disjoint(shell, (uint32_t)n);
  memset(open, 0, n);
  bool ok = vs_store_going(s, (uint32_t)(count & UINT32_MAX), e);
  for (size_t i = 0, end; ok && i < count; i = end) {
    for (end = i + 1; end < count && sides[end].low == sides[i].low && sides[end].high == sides[i].high; end++)
      vs_unite(shell, sides[i].face, sides[end].face);
    if ((end - i) % 2) open[sides[i].face] = 1;
  }
  for (uint32_t f = 0; ok && f < n; f++) { /* open[f] is now 1 for some faces of each shell that is not closed; this
                                            * loop also sets it for the shell's first face */
    uint32_t root = vs_find(shell, f);
    if (open[f] && root != f) open[root] = 1;
  }
  for (uint32_t f = 0; ok && f < n; f++) shell[f] = vs_find(shell, f);
  for (uint32_t f = 0; ok && f < n; f++)
    if (shell[f] != f) open[f] = 0;
  free(sides);
  return ok;
}
