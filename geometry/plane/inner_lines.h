/* Declares the functions of inner_lines.c: the part of an area's border that lies within another area. */
#ifndef VS_GEOMETRY_PLANE_INNER_LINES_H
#define VS_GEOMETRY_PLANE_INNER_LINES_H

#include "geometry/plane/areas.h"

/* Lines one after the other; line i has size[i] points, and is closed or not. */
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

/* Makes the lines of b's border that lie within a, further than `slack` from a's border. purpose: the subject of the
 * message if GEOS is missing. The caller frees out, also when it fails. */
bool vs_area_inner_lines(const vs_area *a, const vs_area *b, double slack, const char *purpose, vs_inner_lines *out,
                         vs_error *e);

#endif
