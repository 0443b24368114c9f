/* Owns the interface of offset.c: offsets in a plane. */
#ifndef VS_GEOMETRY_PLANE_OFFSET_H
#define VS_GEOMETRY_PLANE_OFFSET_H

#include "geometry/plane/areas.h"

/* in made larger by d > 0 or smaller; round corners by f, or segments facets a turn where that is not 0 */
bool vs_area_offset(const vs_area *in, double d, vs_offset_corners corners, const vs_fineness *f, int segments,
                    vs_area *out, vs_error *e);
/* The open line through n >= 2 points, no two neighbours equal, moved by d to the left (d < 0: right); out is empty
 * where nothing is left of it. ways: its directions at both ends, unit. */
bool vs_line_offset(const vs_vec2 *at, size_t n, const vs_vec2 ways[2], double d, vs_offset_corners corners,
                    const vs_fineness *f, int segments, vs_polyline *out, vs_error *e);
bool vs_offset_round(const vs_node *offset, vs_affine *place, vs_offset_exact *out);
/* The plane that an open line's left is seen in: columns 0 and 1, and 2 its normal, which looks up; of a straight line
 * the plane nearest to level, of an upright one XZ seen from -Y. False: it lies in no plane. */
bool vs_line_frame(const vs_polyline *line, vs_affine *frame, vs_error *e);

#endif
