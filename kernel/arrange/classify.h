/* Declares the functions of classify.c: the classification. */
#ifndef VS_KERNEL_ARRANGE_CLASSIFY_H
#define VS_KERNEL_ARRANGE_CLASSIFY_H

#include "kernel/cluster.h"

bool vs_classify_faces(vs_kernel *k, vs_cluster *c, vs_expression *e); /* makes kept */
/* low and high are two points. */
int vs_around_axes(vs_points_view view, uint32_t low, uint32_t high, int *x, int *y);
bool vs_around_before(const vs_around *a, const vs_around *b);

#endif
