/* Declares the sort of items by integer keys, for sorts in which a call for each comparison would cost more than the
 * rest. */
#ifndef VS_KERNEL_EXACT_SORT_H
#define VS_KERNEL_EXACT_SORT_H

#include <stddef.h>
#include <stdint.h>

typedef struct { int64_t key; uint32_t item; } vs_keyed;

/* Sorts stably; scratch is another array of the same length. */
void vs_sort_keyed(vs_keyed *at, vs_keyed *scratch, size_t count);

#endif
