/* Declares the computation of the part of an area's border that lies within another area. */
#ifndef VS_GEOMETRY_PLANE_INNER_LINES_H
#define VS_GEOMETRY_PLANE_INNER_LINES_H

#include "geometry/plane/areas.h"

/* Polylines, one after another, in one array of points `at`. Line i has size[i] points. */
typedef struct {
  vs_vec2 *at;
  size_t count, room;
  struct {
    size_t size;
    bool closed;
  } *lines;
  size_t line_count, line_room;
} vs_inner_lines;
void vs_inner_lines_free(vs_inner_lines *l);

/* Computes the parts of b's border that lie within a, farther than `slack` from a's border. purpose: the feature that
 * needs GEOS, for the message if GEOS is missing. Returns false and sets e on failure. The caller frees out, also after
 * a failure. */
bool vs_area_inner_lines(const vs_area *a, const vs_area *b, double slack, const char *purpose, vs_inner_lines *out,
                         vs_error *e);

#endif
