/* Declares areas, for use in geometry/ alone: closed loops in the coordinates of a plane, which the library GEOS
 * combines. */
#ifndef VS_GEOMETRY_PLANE_AREAS_H
#define VS_GEOMETRY_PLANE_AREAS_H

#include "geometry/plane/outline.h"
#include "geometry/tolerance.h"
#include "geometry/plane/ear_clipping.h"

/* The loops of an area, one after another. Outer loops are counter-clockwise. Each is followed by its holes, which are
 * clockwise. An area without loops is empty. */
typedef struct {
  vs_vec2 *at;
  size_t count, room;
  size_t *size; /* size[l]: number of points of loop l */
  bool *hole;
  size_t loop_count, loop_room;
} vs_area;

void vs_area_free(vs_area *a);
bool vs_area_point(vs_area *a, double x, double y);  /* adds the point (x, y) to the current loop; returns false when
                                                      * memory is out */
bool vs_area_loop(vs_area *a, bool hole);            /* ends the current loop, as a hole if `hole` is true; drops it if
                                                      * it has fewer than three points */

typedef enum {
  VS_AREA_UNION,
  VS_AREA_INTERSECTION,
  VS_AREA_DIFFERENCE /* the part of the first area that lies in none of the following areas */
} vs_area_operation;
/* Combines areas of one plane. out must be empty. purpose: the feature that needs GEOS, for the message if GEOS is
 * missing. Returns false and sets e on failure. */
bool vs_area_combine(vs_area_operation operation, const vs_area *operands, size_t count, const char *purpose,
                     vs_area *out, vs_error *e);

/* Makes the area of all points with a winding number other than 0 in the directed edges, which may intersect. As many
 * edges begin as end at each point. purpose: the feature that needs GEOS, for error messages. Returns false and sets e
 * on failure. */
bool vs_area_of_chain(const vs_vec2 (*edges)[2], size_t count, const char *purpose, vs_area *out, vs_error *e);
/* Finds the centre *at and the radius of the largest circle within area a, to a thousandth of the area's size. The
 * radius is 0 if the area is empty. purpose: the feature that needs GEOS, for error messages. */
bool vs_area_middle(const vs_area *a, const char *purpose, vs_vec2 *at, double *radius, vs_error *e);
/* Returns true if the point (x, y) is inside area a, or within 1e-9 of the area's size from its border. */
bool vs_area_holds(const vs_area *a, double x, double y);

/* Makes the Delaunay triangulation of at least two points. *out: counter-clockwise triangles, as indices of points,
 * which the caller frees; *count: their number, 0 if all points lie on one line. Returns false and sets e on
 * failure. */
bool vs_points_delaunay(const vs_vec2 *at, size_t n, uint32_t (**out)[3], size_t *count, vs_error *e);

/* ---- implemented in offset.c ---- */
/* VS_OFFSET_FACETS: round, with facets that turn by a whole part of a circle each; the last one takes the rest. */
typedef enum { VS_OFFSET_MITRE, VS_OFFSET_ROUND, VS_OFFSET_SQUARE, VS_OFFSET_FACETS } vs_offset_corners;

/* A circle or arc that is the exact offset of a circle or arc, found by vs_offset_round. A circle is stored as an arc
 * from 0 to 2 pi. */
typedef struct { bool circle; struct vs_arc arc; } vs_offset_exact;

/* Converts the loops of an outline to an area in the coordinates of `frame`, whose columns 0 and 1 span the plane. */
bool vs_area_of_outline(const vs_outline *o, const vs_affine *frame, vs_area *out);
/* Converts area a, in the coordinates of `frame`, to an outline in space. */
bool vs_area_outline(const vs_area *a, const vs_affine *frame, vs_outline *out);

#endif
