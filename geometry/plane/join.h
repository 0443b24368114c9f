/* Owns what has to be known of curves before they bound a region: which open ones meet end to end, and whether any
 * cross. */
#ifndef VS_GEOMETRY_PLANE_JOIN_H
#define VS_GEOMETRY_PLANE_JOIN_H

#include "model/node.h"

/* Joins open curves that meet end to end (within 1e-9 of their size) into closed or longer ones, in the order of their
 * first parts. refs holds count curves, closed ones too, which stay; what comes out takes their place, each a reference
 * that the caller releases, and *count becomes how many. False: e says why, and nothing is to be released. */
bool vs_curves_join(vs_store *s, vs_ref *refs, size_t *count, vs_error *e);
bool vs_curve_ends(const vs_node *curve, vs_vec3 *start, vs_vec3 *end, double *size, vs_error *e); /* of an open one */

typedef struct { size_t a, b; /* which curves; the same one: it crosses itself */ vs_vec3 at; bool found; } vs_crossing;
/* Do closed curves of one plane cross each other, or themselves? Round ones may touch: what is no deeper than the
 * samples can tell is none. */
bool vs_curves_cross(const vs_ref *refs, size_t count, vs_crossing *out, vs_error *e);

#endif
