/* Declares the division of areas into convex pieces, and the sum of two convex pieces. */
#ifndef VS_GEOMETRY_NETS_CONVEX_PIECES_H
#define VS_GEOMETRY_NETS_CONVEX_PIECES_H

#include "geometry/plane/areas.h"

/* Convex polygons one after the other, counter-clockwise; each begins at the leftmost of its lowest points. */
typedef struct {
  vs_vec2 *at;
  size_t count, room;
  size_t *size; /* number of points of each */
  size_t pieces, piece_room;
} vs_convex_pieces;
void vs_convex_pieces_free(vs_convex_pieces *c);
/* Divides the area into convex pieces, as few as removing sides of triangles leaves. Adds them to out, which the caller
 * frees. Returns false when memory is out. */
bool vs_area_convex_pieces(const vs_area *a, vs_convex_pieces *out);
/* Makes loops of fewer corners that contain the area, and deviate from it by at most `most`. Keeps the area as it is
 * where this would make loops cross. Returns false when memory is out. The caller frees out. */
bool vs_area_outer_corners(const vs_area *a, double most, vs_area *out);

/* Writes to `out`, which has room for n + m points, the sum of two convex polygons whose points are in the order of
 * vs_convex_pieces: the points p + q. Returns the number of points. */
size_t vs_convex_sum(const vs_vec2 *a, size_t n, const vs_vec2 *b, size_t m, vs_vec2 *out);
/* The greatest number of points of the polygon that vs_convex_grow makes of n points. */
static inline size_t vs_convex_grown_most(size_t n) { return n + 34; }
/* Writes to `out` the polygon whose sides are d > 0 further out than those of n points. Its corners are at most 0.5 %
 * of d further from the polygon than d. Returns the number of points. */
size_t vs_convex_grow(const vs_vec2 *at, size_t n, double d, vs_vec2 *out);

#endif
