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
/* Divides the area a into convex pieces, and adds them to out, which the caller frees. Returns false when memory is
 * out. */
bool vs_area_convex_pieces(const vs_area *a, vs_convex_pieces *out);
/* Sets out to a simpler area that contains the area a: its loops have fewer corners and deviate from those of a by at
 * most `most`, in hollows and holes by at most `hollow`. With most = 0, out equals a. Returns false when memory is out.
 * The caller frees out. */
bool vs_area_outer_corners(const vs_area *a, double most, double hollow, vs_area *out);

/* Writes to `out` the sum of the convex polygons a and b, of n and m points: all p + q with p in a and q in b. Each
 * begins at the leftmost of its lowest points. Returns the number of points, at most n + m. */
size_t vs_convex_sum(const vs_vec2 *a, size_t n, const vs_vec2 *b, size_t m, vs_vec2 *out);
/* Returns the greatest number of points of the polygon that vs_convex_grow makes of n points. */
static inline size_t vs_convex_grown_most(size_t n) { return n + 34; }
/* Offsets a convex polygon of n points outwards by d > 0, with rounded corners, and writes it to `out`. A rounded
 * corner is at most 0.5 % too far out. Returns the number of points. */
size_t vs_convex_grow(const vs_vec2 *at, size_t n, double d, vs_vec2 *out);

#endif
