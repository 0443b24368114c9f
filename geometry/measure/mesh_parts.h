/* Declares the parts of a closed mesh: solids that do not touch each other. */
#ifndef VS_GEOMETRY_MEASURE_MESH_PARTS_H
#define VS_GEOMETRY_MEASURE_MESH_PARTS_H

#include "model/mesh.h"

typedef struct {
  uint32_t *of;   /* of[t]: number of the part that contains triangle t; parts are numbered by their first triangle */
  uint32_t count; /* number of parts */
} vs_mesh_parts;

/* Divides a closed mesh into parts. Triangles with a common point are in one part, and the wall of a cavity is in the
 * part around it. Returns false when memory is out. The caller frees out in either case. */
bool vs_mesh_parts_find(const vs_mesh *m, vs_mesh_parts *out);
void vs_mesh_parts_free(vs_mesh_parts *p);
/* Copies the triangles of one part, with the vertices that they use, to `to`, which must be empty. Returns false when
 * memory is out. */
bool vs_mesh_parts_copy(const vs_mesh *m, const vs_mesh_parts *parts, uint32_t part, vs_mesh *to);

#endif
