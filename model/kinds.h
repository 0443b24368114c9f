/* Owns, for model/ alone, the operations on a payload that only its row of prims.def decides. */
#ifndef VS_MODEL_KINDS_H
#define VS_MODEL_KINDS_H

#include "model/node.h"

uint64_t vs_payload_settle(vs_kind kind, void *data); /* settles a new payload: retains its arrays, changes -0 to 0;
                                                       * returns its hash */
bool vs_payload_equal(const vs_kind_info *info, const void *a, const void *b);
void vs_payload_drop(vs_kind kind, vs_store *s, const void *data); /* releases its arrays */
size_t vs_payload_array_bytes(vs_kind kind, const void *data);

/* Returns true if all numbers of a payload and its points lie in [-most, most]; a not-a-number does not. */
bool vs_kind_within(vs_kind kind, const void *data, double most);

#endif
