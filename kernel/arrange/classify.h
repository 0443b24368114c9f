/* Declares the classification of faces. */
#ifndef VS_KERNEL_ARRANGE_CLASSIFY_H
#define VS_KERNEL_ARRANGE_CLASSIFY_H

#include "kernel/cluster.h"

bool vs_classify_faces(vs_kernel *k, vs_cluster *c, vs_expression *e); /* makes c->kept, the list of faces that bound
                                                                        * the result; returns false on an error */
/* Chooses the axes *x and *y for the order around the edge from point low to point high, and returns its sign. low and
 * high differ. */
int vs_around_axes(vs_points_view view, uint32_t low, uint32_t high, int *x, int *y);
bool vs_around_before(const vs_around *a, const vs_around *b);

#endif
