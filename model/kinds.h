/* Declares the operations on payloads (the fields of a node) that prims.def defines by its table. Only files of model/
 * include it. */
#ifndef VS_MODEL_KINDS_H
#define VS_MODEL_KINDS_H

#include "model/node.h"

uint64_t vs_payload_settle(vs_kind kind, void *data); /* Prepares the payload of a new node (the struct of its fields):
                                                       * retains the arrays to which it refers, and changes -0 to 0.
                                                       * Returns the payload's hash. */
bool vs_payload_equal(const vs_kind_info *info, const void *a, const void *b);
void vs_payload_drop(vs_kind kind, vs_store *s, const void *data); /* Releases the arrays to which the fields of a
                                                                    * payload refer. */
size_t vs_payload_array_bytes(vs_kind kind, const void *data);

/* Returns true if all numbers and points of the payload lie in [-most, most]. A NaN lies outside. */
bool vs_kind_within(vs_kind kind, const void *data, double most);

#endif
