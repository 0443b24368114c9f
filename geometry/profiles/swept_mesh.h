/* Declares the triangles between the sections of a sweep, for use in geometry/ alone: of all steps together, or of
 * groups of steps. */
#ifndef VS_GEOMETRY_PROFILES_SWEPT_MESH_H
#define VS_GEOMETRY_PROFILES_SWEPT_MESH_H

#include "geometry/profiles/overturn.h"
#include "geometry/profiles/swept.h"

bool vs_swept_mesh(const vs_swept *s, vs_mesh *out); /* appends the triangles of the sweep s to out; returns false when
                                                      * memory is out */

/* Sets *turns to true if a part of the profile goes backwards in any step of the sweep. Returns false when memory is
 * out. */
bool vs_swept_turns(const vs_swept *s, bool *turns);

/* Divides the sweep into runs of the given number of steps, and makes a closed mesh of each. The meshes overlap by one
 * step, and their union is the solid. s->across must be true. The caller frees the meshes and their array. Returns
 * false, without meshes, when memory is out. */
bool vs_swept_runs(const vs_swept *s, size_t steps, vs_mesh **runs, size_t *count);

/* Writes at most `most` random points to out, from the steps in which a part of the profile goes backwards
 * (overturn.h). *count: number of points. Returns false when memory is out. */
bool vs_swept_samples(const vs_swept *s, vs_step_point *out, size_t most, size_t *count);

/* Appends triangles that fill a region or closed profile, in its plane, to out. Returns false when memory is out. */
bool vs_outline_mesh(const vs_outline *o, vs_mesh *out);

#endif
