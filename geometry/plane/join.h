/* Declares the joining of open curves end to end before they bound a region. */
#ifndef VS_GEOMETRY_PLANE_JOIN_H
#define VS_GEOMETRY_PLANE_JOIN_H

#include "model/node.h"

/* Joins open curves whose ends coincide within 1e-9 of their size. refs has *count curves; the joined curves replace
 * their parts in refs, *count becomes the new number, and the caller releases them. Returns false and sets e on
 * failure; the caller then releases nothing. */
bool vs_curves_join(vs_store *s, vs_ref *refs, size_t *count, vs_error *e);
bool vs_curve_ends(const vs_node *curve, vs_vec3 *start, vs_vec3 *end, double *size, vs_error *e); /* finds the ends and
                                                                                                    * the size of a
                                                                                                    * curve, which must
                                                                                                    * be open; returns
                                                                                                    * false and sets e
                                                                                                    * on failure */

#endif
