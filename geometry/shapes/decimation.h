/* Declares the simplification of closed meshes within a tolerance. */
#ifndef VS_GEOMETRY_SHAPES_DECIMATION_H
#define VS_GEOMETRY_SHAPES_DECIMATION_H

#include "model/long_work.h"
#include "model/mesh.h"

/* Removes corners of a closed mesh, as long as each removed corner is at most `tolerance` away from the remaining mesh.
 * The remaining corners do not move. Also removes corners that no triangle uses. Returns false when memory is out, or
 * the caller interrupts. */
bool vs_mesh_decimate(vs_mesh *m, double tolerance, vs_long_work work);

#endif
