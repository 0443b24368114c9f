/* Declares a sort that can be interrupted. */
#ifndef VS_MODEL_STORE_PATIENT_SORT_H
#define VS_MODEL_STORE_PATIENT_SORT_H

#include "model/store/store.h"

/* Sorts `count` elements of `size` bytes as qsort does, and checks for interrupts meanwhile. Equal elements may be in
 * any order. On an interrupt or when memory is out, returns false and leaves the elements in an undefined order. */
bool vs_store_sort(vs_store *s, void *at, size_t count, size_t size, int (*compare)(const void *, const void *),
                   vs_error *e);

#endif
