/* Declares functions that return single members of vs_bind: the job, the scene and others. A native that needs no other
 * member includes this header instead of state.h. */
#ifndef VS_BIND_CALL_CONTEXT_H
#define VS_BIND_CALL_CONTEXT_H

#include "model/job.h"
#include "model/scene.h"
#include "vm/machine/native.h"

typedef struct vs_derivation vs_derivation;

/* Returns the limits, progress and warnings of the running program's computations. */
vs_job *vs_bind_job(vs_scheme *vm);
vs_scene *vs_bind_scene(vs_scheme *vm);
/* Returns true while a drawing function (defined by the program) is running. The scene must not change then. */
bool vs_bind_handing(vs_scheme *vm);
/* Returns the greatest number of triangles in an output; 0: no limit. */
size_t vs_bind_most_triangles(vs_scheme *vm);
/* Returns the number of refused allocations so far. If it has grown during a search, the result 'not found' may mean
 * that memory is out. */
size_t vs_bind_refused(vs_scheme *vm);
/* Returns the derivation in which the running rule is applied, or NULL. */
vs_derivation *vs_bind_growing(vs_scheme *vm);

#endif
