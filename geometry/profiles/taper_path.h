/* Declares extrusions with inclined walls along a bent curve. */
#ifndef VS_GEOMETRY_PROFILES_TAPER_PATH_H
#define VS_GEOMETRY_PROFILES_TAPER_PATH_H

#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"

bool vs_taper_path_mesh(const vs_node *extrude, const vs_fineness *f, vs_mesh *out, vs_error *e);

#endif
