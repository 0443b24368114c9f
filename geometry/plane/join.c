/* Joins open curves end to end.
 *
 * A chain begins with the first unused curve. Then the first unused curve that has an end at the chain's end is added,
 * repeatedly. The chain's start is extended in the same way. The time is quadratic in the number of curves. */
#include "geometry/plane/join.h"

#include <stdlib.h>

#include "geometry/plane/curve.h"
#include "geometry/plane/planar_evaluation.h"
#include "model/store/array.h"

bool vs_curve_ends(const vs_node *curve, vs_vec3 *start, vs_vec3 *end, double *size, vs_error *e) {
  vs_fineness coarse = { 1, 8 };
  vs_polyline p = { 0 };
  if (!vs_curve_sample(curve, &coarse, &p, e)) return false;
  vs_bounds b = vs_bounds_empty();
  for (size_t i = 0; i < p.count; i++) vs_bounds_add(&b, p.at[i]);
  bool ok = p.count > 0 || vs_error_set(e, VS_ERROR_MODEL, NULL, "a curve has no points");
  if (ok) {
    *start = p.at[0];
    *end = p.at[p.count - 1];
    *size = vs_bounds_diagonal(&b);
  }
  vs_polyline_free(&p);
  return ok;
}

typedef struct { vs_vec3 end[2]; double size; bool used, closed; } vs_join_part;

static bool join_near(vs_vec3 a, vs_vec3 b, double size) { return vs_v3_length(vs_v3_sub(a, b)) <= 1e-9 * size; }

/* Returns the index of the next unused curve that has one end at the point `at`; count if there is none. *far: the
 * other end of that curve. size: size of the curves, which determines the tolerance. */
static size_t join_next(const vs_join_part *parts, size_t count, vs_vec3 at, double size, vs_vec3 *far) {
  for (size_t k = 0; k < count; k++)
    for (int end = 0; end < 2 && !parts[k].used && !parts[k].closed; end++)
      if (join_near(parts[k].end[end], at, fmax(size, parts[k].size))) {
        *far = parts[k].end[1 - end];
        return k;
      }
  return count;
}

bool vs_curves_join(vs_store *s, vs_ref *refs, size_t *count, vs_error *e) {
  size_t n = *count, made = 0;
  vs_join_part *parts = vs_zeros(n, sizeof *parts);
  vs_ref *chain = vs_fresh(2 * n + 1, sizeof *chain), *out = vs_fresh(n, sizeof *out);
  bool ok = (parts && chain && out) || vs_error_memory(e, NULL);
  for (size_t i = 0; ok && i < n; i++) {
    parts[i].closed = refs[i].node->flags & VS_NODE_CLOSED;
    if (!parts[i].closed) ok = vs_curve_ends(refs[i].node, &parts[i].end[0], &parts[i].end[1], &parts[i].size, e);
    if (!ok && e && !e->origin) e->origin = refs[i].origin;
  }
  for (size_t i = 0; ok && i < n; i++) {
    if (parts[i].used) continue;
    parts[i].used = true;
    size_t first = n, last = n + 1; /* the chain of joined curves grows in both directions, so its list is filled from
                                     * the middle of the array */
    chain[n] = refs[i];
    double size = parts[i].size;
    vs_vec3 head = parts[i].end[0], tail = parts[i].end[1], far;
    bool closed = false;
    for (size_t k; !parts[i].closed && !closed;) {
      if (last - first > 1 && join_near(head, tail, size)) closed = true;
      else if ((k = join_next(parts, n, tail, size, &far)) < n) tail = far, chain[last++] = refs[k];
      else if ((k = join_next(parts, n, head, size, &far)) < n) head = far, chain[--first] = refs[k];
      else break;
      if (!closed) {
        parts[k].used = true;
        size = fmax(size, parts[k].size);
      }
    }
    if (last - first == 1) {
      out[made] = refs[i];
      vs_node_retain(out[made++].node);
      continue;
    }
    out[made] = (vs_ref){ vs_node_new(s, VS_JOIN, &(struct vs_join){ .closed = closed }, chain + first, last - first),
                          chain[first].origin };
    ok = out[made].node || vs_error_memory(e, NULL);
    made += ok;
  }
  for (size_t i = 0; i < made && ok; i++) refs[i] = out[i];
  for (size_t i = 0; i < made && !ok; i++) vs_node_release(out[i].node);
  if (ok) *count = made;
  free(parts);
  free(chain);
  free(out);
  return ok;
}
