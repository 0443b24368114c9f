/* Enlarges arrays. The new number of elements is the largest of: twice the old number, FIRST_ROOM, and the needed
 * number. An array that cannot grow remains unchanged. */
#include "model/store/array.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { FIRST_ROOM = 16 };

bool vs_room_grow(void *slot, size_t *room, size_t need, size_t size) {
  size_t more = *room <= SIZE_MAX / 2 ? 2 * *room : need;
  VS_ASSERT(size > 0);
  if (more < FIRST_ROOM) more = FIRST_ROOM;
  if (more < need) more = need;
  if (more > SIZE_MAX / size) return false;
  void *old, *grown;
  memcpy(&old, slot, sizeof old); /* slot is the address of a pointer whose type is unknown here, so the pointer's bytes
                                   * are copied */
  grown = realloc(old, more * size);
  if (!grown) return false;
  memcpy(slot, &grown, sizeof grown);
  *room = more;
  return true;
}
