/* Owns sorting that can be interrupted. */
#ifndef VS_MODEL_STORE_PATIENT_SORT_H
#define VS_MODEL_STORE_PATIENT_SORT_H

#include "model/store/store.h"

/* qsort that asks whether to go on; elements that compare as equal may stand in any order. False: out of memory, or
 * interrupted, and the order is any. */
bool vs_store_sort(vs_store *s, void *at, size_t count, size_t size, int (*compare)(const void *, const void *),
                   vs_error *e);

#endif
