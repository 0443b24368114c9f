/* Declares the division of areas into convex pieces, and the sum of two convex pieces. */
#ifndef VS_GEOMETRY_NETS_CONVEX_PIECES_H
#define VS_GEOMETRY_NETS_CONVEX_PIECES_H

#include "geometry/plane/areas.h"

/* Convex polygons, one after another, counter-clockwise. Each begins at the leftmost of its lowest points. */
typedef struct {
  vs_vec2 *at;
  size_t count, room;
  size_t *size; /* size[i]: number of points of polygon i */
  size_t pieces, piece_room;
} vs_convex_pieces;
void vs_convex_pieces_free(vs_convex_pieces *c);
/* Divides the area a into convex pieces, as few as removing sides of triangles leaves. Adds them to out, which the
 * caller frees. Returns false when memory is out. */
bool vs_area_convex_pieces(const vs_area *a, vs_convex_pieces *out);
/* Makes loops with fewer corners that contain the area a, and deviate from it by at most `most`. Keeps the area
 * unchanged if the new loops would cross. Returns false when memory is out. The caller frees out. */
bool vs_area_outer_corners(const vs_area *a, double most, vs_area *out);

/* Writes to `out` the sum of the convex polygons a (n points) and b (m points): the convex polygon of all points p + q.
 * The points of a and b are in the order of vs_convex_pieces. out has room for n + m points. Returns the number of
 * points. */
size_t vs_convex_sum(const vs_vec2 *a, size_t n, const vs_vec2 *b, size_t m, vs_vec2 *out);
/* Returns the greatest number of points of the polygon that vs_convex_grow makes of n points. */
static inline size_t vs_convex_grown_most(size_t n) { return n + 34; }
/* Writes to `out` the polygon whose sides are d > 0 farther out than those of a convex polygon of n points. Its corners
 * are at most 0.5 % of d farther than d from the polygon. Returns the number of points. */
size_t vs_convex_grow(const vs_vec2 *at, size_t n, double d, vs_vec2 *out);

#endif
