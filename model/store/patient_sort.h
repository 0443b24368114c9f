/* Owns sorting that can be interrupted. */
#ifndef VS_MODEL_STORE_PATIENT_SORT_H
#define VS_MODEL_STORE_PATIENT_SORT_H

#include "model/store/store.h"

/* As qsort, but checks for interrupts; equal elements get any order. Returns false when memory is out, or on an
 * interrupt; the order is then undefined. */
bool vs_store_sort(vs_store *s, void *at, size_t count, size_t size, int (*compare)(const void *, const void *),
                   vs_error *e);

#endif
