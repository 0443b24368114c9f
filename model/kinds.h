/* Owns, for model/ alone, what can be done with a payload knowing only its row of prims.def. */
#ifndef VS_MODEL_KINDS_H
#define VS_MODEL_KINDS_H

#include "model/node.h"

uint64_t vs_payload_settle(vs_kind kind, void *data); /* of a new node: retains its arrays, -0 becomes 0; its hash */
bool vs_payload_equal(const vs_kind_info *info, const void *a, const void *b);
void vs_payload_drop(vs_kind kind, vs_store *s, const void *data); /* releases its arrays */
size_t vs_payload_array_bytes(vs_kind kind, const void *data);

/* is no number of a payload, or of its points, larger either way, or none at all? */
bool vs_kind_within(vs_kind kind, const void *data, double most);

#endif
