/* Declares contour lines: the lines in which a plane cuts an open mesh. */
#ifndef VS_GEOMETRY_NETS_CONTOUR_LINES_H
#define VS_GEOMETRY_NETS_CONTOUR_LINES_H

#include "geometry/plane/outline.h"
#include "model/mesh.h"

/* A function that receives the points of one contour line, which the caller keeps. Returns false on failure. */
typedef struct {
  bool (*put)(void *context, const vs_polyline *line);
  void *context;
} vs_line_put;

/* Computes the contour lines in which the plane through `point`, perpendicular to `normal`, cuts mesh m, and calls
 * `put` for each. Vertices with equal positions count as one. Returns false if `put` has returned false, or memory is
 * out. */
bool vs_mesh_contour(const vs_mesh *m, vs_vec3 point, vs_vec3 normal, const vs_line_put *put);

#endif
