/* Declares the search for the faces that bound the result. */
#ifndef VS_KERNEL_ARRANGE_CLASSIFY_H
#define VS_KERNEL_ARRANGE_CLASSIFY_H

#include "kernel/cluster.h"

bool vs_classify_faces(vs_kernel *k, vs_cluster *c, vs_expression *e); /* sets c->kept, which marks each face that
                                                                        * bounds the result of expression e; returns
                                                                        * false on an error */
/* Chooses the coordinate axes *x and *y in which faces are sorted around the edge from point low to point high. Returns
 * 1 if the coordinate of `high` along the third axis is larger than that of `low`, else -1. The two points differ. */
int vs_around_axes(vs_points_view view, uint32_t low, uint32_t high, int *x, int *y);
bool vs_around_before(const vs_around *a, const vs_around *b);

#endif
