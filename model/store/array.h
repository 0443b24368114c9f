/* Allocates arrays by the number and size of their elements: arrays that grow, and arrays of fixed size. Arrays with
 * a memory budget use other functions: vs_store_grow for objects of a store, VS_ROOM of kernel/memory.h for the
 * kernel. */
#ifndef VS_MODEL_STORE_ARRAY_H
#define VS_MODEL_STORE_ARRAY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include "model/assert.h"

/* Makes room for `need` elements of `size` bytes (above 0) in the array whose address is in *slot. *room: number of
 * elements for which the array has memory; it at least doubles when it grows. Returns false when memory is out, and
 * then changes nothing. The caller frees the array. */
bool vs_room_grow(void *slot, size_t *room, size_t need, size_t size);

#define VS_GROW(array, room, need) ((need) <= (room) || vs_room_grow(&(array), &(room), need, sizeof *(array)))

/* Allocates n elements of `size` bytes (one element if n is 0), with undefined contents. Returns NULL when memory is
 * out or the size exceeds a size_t. The caller frees the array. */
static inline void *vs_fresh(size_t n, size_t size) {
  VS_ASSERT(size > 0);
  return n <= SIZE_MAX / size ? malloc((n ? n : 1) * size) : NULL;
}
/* Allocates n elements of `size` bytes (one element if n is 0), all bytes zero. Returns NULL when memory is out. The
 * caller frees the array. */
static inline void *vs_zeros(size_t n, size_t size) { return calloc(n ? n : 1, size); }

/* Allocates n elements for the pointer `array`, whose old value is not freed. The value of the expression is false, and
 * the pointer NULL, when memory is out. */
#define VS_FRESH(array, n) (((array) = vs_fresh((n), sizeof *(array))) != NULL)

#endif
