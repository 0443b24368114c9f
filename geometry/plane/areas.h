/* Declares, for use in geometry/ alone, areas: closed loops in one plane's coordinates, and their combination by GEOS. */
#ifndef VS_GEOMETRY_PLANE_AREAS_H
#define VS_GEOMETRY_PLANE_AREAS_H

#include "geometry/plane/outline.h"
#include "geometry/tolerance.h"
#include "geometry/plane/ear_clipping.h"

/* Loops one after the other: outer loops counter-clockwise, each followed by its holes, clockwise. No loops: the empty
 * area. */
typedef struct {
  vs_vec2 *at;
  size_t count, room;
  size_t *size; /* points of each loop */
  bool *hole;
  size_t loop_count, loop_room;
} vs_area;

void vs_area_free(vs_area *a);
bool vs_area_point(vs_area *a, double x, double y);  /* of the loop under construction; false: out of memory */
bool vs_area_loop(vs_area *a, bool hole);            /* ends that loop; drops it if it has under three points */

typedef enum {
  VS_AREA_UNION,
  VS_AREA_INTERSECTION,
  VS_AREA_DIFFERENCE /* the first minus the others */
} vs_area_operation;
/* Combines areas of one plane; out is empty before. purpose: the subject of the message if GEOS is missing. */
bool vs_area_combine(vs_area_operation operation, const vs_area *operands, size_t count, const char *purpose,
                     vs_area *out, vs_error *e);

/* Makes the area around which directed edges wind a nonzero number of times. The edges close: in each point as many
 * begin as end. They may intersect or lie on each other. */
bool vs_area_of_chain(const vs_vec2 (*edges)[2], size_t count, const char *purpose, vs_area *out, vs_error *e);
/* Returns true if the point is in the area or on its border (within 1e-9 of its size). */
bool vs_area_holds(const vs_area *a, double x, double y);

/* Makes the Delaunay triangulation of two points or more: counter-clockwise triangles of their indices, which the
 * caller frees; none if all points lie on one line. Of points at one position it uses the first. */
bool vs_points_delaunay(const vs_vec2 *at, size_t n, uint32_t (**out)[3], size_t *count, vs_error *e);

/* ---- offset.c ---- */
typedef enum { VS_OFFSET_MITRE, VS_OFFSET_ROUND, VS_OFFSET_SQUARE } vs_offset_corners;

/* The exact offset of a circle or arc whose placements only rotate, move and scale it uniformly, through any number of
 * offsets. It is a circle (as an arc from 0 to 2 pi) or an arc, and its placement. vs_offset_round returns false if
 * there is no such curve, or the result is empty. */
typedef struct { bool circle; struct vs_arc arc; } vs_offset_exact;

/* Converts an outline's loops to the coordinates of frame (columns 0 and 1 span its plane), and back into space. */
bool vs_area_of_outline(const vs_outline *o, const vs_affine *frame, vs_area *out);
bool vs_area_outline(const vs_area *a, const vs_affine *frame, vs_outline *out);

#endif
