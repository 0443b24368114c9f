/* Declares the search for untouched triangles, `plain` in the code: triangles that no other triangle touches. */
#ifndef VS_KERNEL_ARRANGE_UNTOUCHED_TRIANGLES_H
#define VS_KERNEL_ARRANGE_UNTOUCHED_TRIANGLES_H

#include "kernel/cluster.h"

bool vs_plain_find(vs_kernel *k, vs_cluster *c);                       /* sets c->fate[t] for each triangle t: the
                                                                        * kernel cuts it, removes it as hidden, or
                                                                        * leaves it unchanged because nothing touches
                                                                        * it; returns false on an error */
bool vs_plain_regions(vs_kernel *k, vs_cluster *c);                    /* makes the regions of untouched triangles, and
                                                                        * their faces and boundary edges; returns false
                                                                        * on an error */
/* vs_plain_kept returns the number of untouched triangles in the result. vs_plain_copy appends these triangles to out.
 * number[p]: index, in out, of the vertex at the cluster's point p. */
size_t vs_plain_kept(const vs_cluster *c);
bool vs_plain_copy(vs_kernel *k, vs_cluster *c, vs_mesh *out, const uint32_t *number);

#endif
