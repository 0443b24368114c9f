/* Declares, for use in geometry/ alone, the triangles between the sections of a sweep, for all steps together or in
 * groups of some steps. */
#ifndef VS_GEOMETRY_PROFILES_SWEPT_MESH_H
#define VS_GEOMETRY_PROFILES_SWEPT_MESH_H

#include "geometry/profiles/overturn.h"
#include "geometry/profiles/swept.h"

bool vs_swept_mesh(const vs_swept *s, vs_mesh *out); /* appends the triangles of the sweep s to out; returns false when
                                                      * memory is out */

/* Sets *turns to true if a part of the profile goes backwards in any step of the sweep. Returns false when memory is
 * out. */
bool vs_swept_turns(const vs_swept *s, bool *turns);

/* Makes closed meshes (runs) of the given number of steps each, whose union is the solid. Each run also has one step in
 * common with the next run: if two runs only touched in a wall, rounding of corners would make a crack. The winding
 * number of a run is above 0 exactly in the places through which the profile passes in its steps. The sections must be
 * across a path. The caller frees the meshes and their array. Returns false, without meshes, when memory is out. */
bool vs_swept_runs(const vs_swept *s, size_t steps, vs_mesh **runs, size_t *count);

/* Writes at most `most` random points from the steps in which a part of the profile goes backwards (overturn.h) to out.
 * *count: their number. Returns false when memory is out. */
bool vs_swept_samples(const vs_swept *s, vs_step_point *out, size_t most, size_t *count);

/* Appends triangles that fill a region or closed profile, in its plane, to out. Returns false when memory is out. */
bool vs_outline_mesh(const vs_outline *o, vs_mesh *out);

#endif
