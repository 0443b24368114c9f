/* Implements vs_mesh_net (net.h): removes pairs of triangles that coincide and have opposite orientations. */
#include "model/net.h"

#include <stdlib.h>

#include "model/store/array.h"

typedef struct { uint32_t v[3]; int32_t times; } face; /* v: vertex numbers of a triangle in ascending order; times:
                                                        * number of occurrences in this orientation minus the number in
                                                        * the opposite orientation */

static face face_of(const uint32_t t[3]) {
  face f = { { t[0], t[1], t[2] }, 1 };
  for (int i = 0; i < 3; i++) { /* three comparisons of neighbours suffice to sort three numbers */
    int j = i % 2;
    if (f.v[j] <= f.v[j + 1]) continue;
    uint32_t swap = f.v[j];
    f.v[j] = f.v[j + 1];
    f.v[j + 1] = swap;
    f.times = -f.times;
  }
  return f;
}

static int by_corners(const void *a, const void *b) {
  const face *p = a, *q = b;
  for (int i = 0; i < 3; i++)
    if (p->v[i] != q->v[i]) return p->v[i] < q->v[i] ? -1 : 1;
  return 0; /* equal triangles may be in any order, because only the sum of their `times` matters */
}

bool vs_mesh_net(vs_mesh *m, size_t first) {
  face *at = NULL;
  size_t count = 0;
  if (m->triangle_count == first) return true;
  if (!VS_FRESH(at, m->triangle_count - first)) return false;
  for (size_t t = first; t < m->triangle_count; t++) {
    face f = face_of(m->triangles[t]);
    if (f.v[0] != f.v[1] && f.v[1] != f.v[2]) at[count++] = f;
  }
  qsort(at, count, sizeof *at, by_corners);
  m->triangle_count = first;
  for (size_t i = 0, end; i < count; i = end) { /* there are at most as many triangles as before, so they fit into the
                                                 * mesh's array */
    const uint32_t *v = at[i].v;
    int32_t times = 0;
    for (end = i; end < count && by_corners(&at[i], &at[end]) == 0; end++) times += at[end].times;
    for (; times > 0; times--) vs_mesh_add_triangle(m, v[0], v[1], v[2]);
    for (; times < 0; times++) vs_mesh_add_triangle(m, v[0], v[2], v[1]);
  }
  free(at);
  return true;
}
