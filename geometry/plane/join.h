/* Declares the joining of open curves end to end before they bound a region. */
#ifndef VS_GEOMETRY_PLANE_JOIN_H
#define VS_GEOMETRY_PLANE_JOIN_H

#include "model/node.h"

/* Joins open curves that meet end to end (within 1e-9 of their size) into closed or longer ones, in the order of their
 * first parts. refs contains *count curves; closed ones stay. The result replaces them, each a reference that the
 * caller releases, and *count becomes their number. Returns false with the reason in e; the caller then releases
 * nothing. */
bool vs_curves_join(vs_store *s, vs_ref *refs, size_t *count, vs_error *e);
bool vs_curve_ends(const vs_node *curve, vs_vec3 *start, vs_vec3 *end, double *size, vs_error *e); /* open curves */

#endif
