/* Declares the comparison of a sweep's mesh with the sections of its profile, at tight bends. */
#ifndef VS_SOLIDS_ASTRAY_H
#define VS_SOLIDS_ASTRAY_H

#include "geometry/tessellate.h"
#include "model/job.h"

/* Input of vs_sweep_astray. `node`: a sweep or pipe; `bends`: its sections, from which the mesh was made; `mesh`:
 * its mesh without overlaps; `tolerance`: tolerance of the mesh; `job`: job that may stop the search; NULL: it never
 * stops. */
typedef struct {
  const vs_node *node;
  const vs_bends *bends;
  const vs_mesh *mesh;
  double tolerance;
  vs_job *job;
} vs_astray;

/* Tests random points near tight bends. `*count`: number of those at which the mesh differs from the exact sections by
 * more than some tolerances. `*at`: the first of these points. `marked[r]`: set to true if step r contains such a
 * point, else not changed. Equal sweeps give equal answers. Returns false, with e set, if memory is out or the job
 * stops. */
bool vs_sweep_astray(const vs_astray *s, bool *marked, size_t *count, vs_vec3 *at, vs_error *e);

#endif
