/* Declares the comparison of a sweep's mesh with the sections of its profile, at tight bends. */
#ifndef VS_SOLIDS_ASTRAY_H
#define VS_SOLIDS_ASTRAY_H

#include "geometry/tessellate.h"
#include "model/job.h"

/* node: a sweep or pipe; bends: its sections as the mesh has them; mesh: its mesh without overlaps; tolerance:
 * tolerance of the mesh; job: job that may stop the search; NULL: it never stops. */
typedef struct {
  const vs_node *node;
  const vs_bends *bends;
  const vs_mesh *mesh;
  double tolerance;
  vs_job *job;
} vs_astray;

/* Finds random points near tight bends at which the mesh differs by more than some tolerances from the exact sections.
 * *count: the number of these points; *at: the first; marked[r]: set to true if one lies in step r, else not changed.
 * The same sweep gives the same answer. Returns false, with e set, if memory is out or the job stops. */
bool vs_sweep_astray(const vs_astray *s, bool *marked, size_t *count, vs_vec3 *at, vs_error *e);

#endif
