/* Declares lofts that follow a path or guides. */
#ifndef VS_GEOMETRY_PROFILES_LOFT_GUIDED_H
#define VS_GEOMETRY_PROFILES_LOFT_GUIDED_H

#include "geometry/profiles/loft.h"

bool vs_loft_along_guides(const vs_node *n, const vs_loft *l, const vs_fineness *f, vs_loft_rows *out, vs_error *e);
bool vs_loft_along_path(const vs_node *n, const vs_loft *l, const vs_fineness *f, vs_loft_rows *out, vs_error *e);

#endif
