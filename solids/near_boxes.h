/* Declares the search for boxes that are near each other. */
#ifndef VS_SOLIDS_NEAR_BOXES_H
#define VS_SOLIDS_NEAR_BOXES_H

#include "kernel/mesh/bvh.h"
#include "model/model_error.h"
#include "model/vec.h"

/* Calls `visit` once for each pair of boxes whose distance is at most `apart`, 0 or more, and for some pairs that are
 * farther apart by 2^-26 of the size of all boxes. Empty boxes are near no box. options may be NULL. Returns false and
 * sets e if memory is out or the caller interrupts; `visit` returns false when memory is out. */
bool vs_near_boxes(const vs_bounds *boxes, uint32_t count, double apart, const vs_kernel_options *options,
                   vs_bvh_pair_fn *visit, void *context, vs_error *e);

#endif
