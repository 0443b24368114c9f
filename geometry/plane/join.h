/* Owns which open curves meet end to end before they bound a region. */
#ifndef VS_GEOMETRY_PLANE_JOIN_H
#define VS_GEOMETRY_PLANE_JOIN_H

#include "model/node.h"

/* Joins open curves that meet end to end (within 1e-9 of their size) into closed or longer ones, in the order of their
 * first parts. refs holds count curves, closed ones too, which stay; what comes out takes their place, each a reference
 * that the caller releases, and *count becomes how many. False: e says why, and nothing is to be released. */
bool vs_curves_join(vs_store *s, vs_ref *refs, size_t *count, vs_error *e);
bool vs_curve_ends(const vs_node *curve, vs_vec3 *start, vs_vec3 *end, double *size, vs_error *e); /* of an open one */

#endif
