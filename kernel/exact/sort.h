/* Declares a sort of items by integer keys. It is faster than a sort that calls a function for each comparison. */
#ifndef VS_KERNEL_EXACT_SORT_H
#define VS_KERNEL_EXACT_SORT_H

#include <stddef.h>
#include <stdint.h>

typedef struct { int64_t key; uint32_t item; } vs_keyed;

/* Sorts `count` items by key. Items with equal keys keep their order. scratch: an array of `count` elements. */
void vs_sort_keyed(vs_keyed *at, vs_keyed *scratch, size_t count);

#endif
