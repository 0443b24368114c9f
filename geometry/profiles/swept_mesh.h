/* Declares, for use in geometry/ alone, the triangles between the sections of a sweep, as a whole and in runs. */
#ifndef VS_GEOMETRY_PROFILES_SWEPT_MESH_H
#define VS_GEOMETRY_PROFILES_SWEPT_MESH_H

#include "geometry/profiles/swept.h"

bool vs_swept_mesh(const vs_swept *s, vs_mesh *out); /* appends; false: out of memory */

/* Does part of the profile go backwards in any step? False: out of memory. */
bool vs_swept_turns(const vs_swept *s, bool *turns);

/* The same solid as closed meshes of so many steps each, and one more that it has in common with the next: a wall that
 * two of them only touched in would be a crack once corners are rounded. Each winds more than 0 times around what the
 * profile passes through in these steps, and the union of all is the solid. The sections stand across a path. The
 * caller frees the meshes, and their array. False: out of memory, and there are none. */
bool vs_swept_runs(const vs_swept *s, size_t steps, vs_mesh **runs, size_t *count);

/* A region or closed profile as triangles in its plane */
bool vs_outline_mesh(const vs_outline *o, vs_mesh *out);

#endif
