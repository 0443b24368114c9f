/* Owns arrays by the count and the size of their elements: growing ones, with a pointer and the number of elements that
 * fit, and those of fixed size. Arrays with a memory budget grow by other functions: objects of a store by
 * vs_store_grow, the kernel's working arrays by VS_ROOM of kernel/memory.h. */
#ifndef VS_MODEL_STORE_ARRAY_H
#define VS_MODEL_STORE_ARRAY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include "model/assert.h"

/* Makes room for `need` elements of `size` bytes in the array whose address is in *slot; *room is in elements, and at
 * least doubles when it changes. Returns false when memory is out; nothing is then changed. The caller frees the array.
 * size is not 0. */
bool vs_room_grow(void *slot, size_t *room, size_t need, size_t size);

#define VS_GROW(array, room, need) ((need) <= (room) || vs_room_grow(&(array), &(room), need, sizeof *(array)))

/* Returns room for n elements of `size` bytes, or for one if n is 0, with undefined contents; NULL when memory is out,
 * or the bytes exceed a size_t. The caller frees it. */
static inline void *vs_fresh(size_t n, size_t size) {
  VS_ASSERT(size > 0);
  return n <= SIZE_MAX / size ? malloc((n ? n : 1) * size) : NULL;
}
/* As vs_fresh, all bytes zero. */
static inline void *vs_zeros(size_t n, size_t size) { return calloc(n ? n : 1, size); }

/* Allocates n elements for an array of fixed size that owns nothing yet. False when memory is out: the array is then
 * NULL. */
#define VS_FRESH(array, n) (((array) = vs_fresh((n), sizeof *(array))) != NULL)

#endif
