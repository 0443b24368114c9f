/* Owns, for geometry/ alone, areas: closed loops in one plane's own coordinates, and what GEOS does with them. */
#ifndef VS_GEOMETRY_PLANE_AREAS_H
#define VS_GEOMETRY_PLANE_AREAS_H

#include "geometry/plane/outline.h"
#include "geometry/tolerance.h"
#include "geometry/plane/ear_clipping.h"

/* Loops one behind the other: outer ones counter-clockwise, each followed by its holes, clockwise. No loops: the empty
 * area. */
typedef struct {
  vs_vec2 *at;
  size_t count, room;
  size_t *size; /* of the loops */
  bool *hole;
  size_t loop_count, loop_room;
} vs_area;

void vs_area_free(vs_area *a);
bool vs_area_point(vs_area *a, double x, double y);  /* of the loop that is being given; false: out of memory */
bool vs_area_loop(vs_area *a, bool hole);            /* ends that loop; one of fewer than three points goes */

typedef enum {
  VS_AREA_UNION,
  VS_AREA_INTERSECTION,
  VS_AREA_DIFFERENCE /* the first less the others */
} vs_area_operation;
/* Areas of one plane; out is empty before. purpose: what needs it, for the message where GEOS is missing. */
bool vs_area_combine(vs_area_operation operation, const vs_area *operands, size_t count, const char *purpose,
                     vs_area *out, vs_error *e);

/* Directed edges that close: as many begin in each point as end there. The area that they wind round, whichever way
 * they cross or lie on each other. */
bool vs_area_of_chain(const vs_vec2 (*edges)[2], size_t count, const char *purpose, vs_area *out, vs_error *e);
/* Is the point in the area or on its border (within 1e-9 of its size)? */
bool vs_area_holds(const vs_area *a, double x, double y);

/* The Delaunay triangulation of two points or more, counter-clockwise triangles of their numbers, which the caller
 * frees; none where all lie on one line. Of points at one place the first counts. */
bool vs_points_delaunay(const vs_vec2 *at, size_t n, uint32_t (**out)[3], size_t *count, vs_error *e);

/* ---- offset.c ---- */
typedef enum { VS_OFFSET_MITRE, VS_OFFSET_ROUND, VS_OFFSET_SQUARE } vs_offset_corners;

/* The offset of a circle or arc that placements have only turned, moved and made larger or smaller, through any number
 * of offsets: the circle or arc that it is (a circle as an arc from 0 to 2 pi) and where that stands. False: it is no
 * such thing, or nothing. */
typedef struct { bool circle; struct vs_arc arc; } vs_offset_exact;

/* An outline's loops in the coordinates of frame (columns 0 and 1 span its plane), and back into space. */
bool vs_area_of_outline(const vs_outline *o, const vs_affine *frame, vs_area *out);
bool vs_area_outline(const vs_area *a, const vs_affine *frame, vs_outline *out);

#endif
