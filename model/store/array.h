/* Owns arrays that grow: a pointer and how many elements it has room for. Arrays with a budget of their own grow by
 * other means: objects of a store by vs_store_grow, the kernel's working arrays by VS_ROOM of kernel/memory.h. */
#ifndef VS_MODEL_STORE_ARRAY_H
#define VS_MODEL_STORE_ARRAY_H

#include <stdbool.h>
#include <stddef.h>

/* Makes room for `need` elements of `size` bytes in the array whose address stands in *slot; *room is in elements, and
 * at least doubles when it changes. False when there is no memory: nothing is changed then. The caller frees the
 * array. */
bool vs_room_grow(void *slot, size_t *room, size_t need, size_t size);

#define VS_GROW(array, room, need) ((need) <= (room) || vs_room_grow(&(array), &(room), need, sizeof *(array)))

/* Allocates n elements for an array that keeps its size and is NULL before. False when there is no memory: it stays
 * NULL then. */
#define VS_FRESH(array, n) vs_room_grow(&(array), &(size_t){ 0 }, (n), sizeof *(array))

#endif
