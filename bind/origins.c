/* Computes the origins of objects and warnings: the place of a call and its callers. */
#include "bind/origins.h"

#include <string.h>

#include "bind/call/take.h"
#include "bind/state.h"
#include "vm/front/source.h"
#include "vm/machine/activation.h"
#include "vm/values/text.h"

/* Greatest number of callers in an origin (a call's place and its callers, innermost first). Eight callers suffice to
 * reach the user's own text, and limit the work for each object. A hash of the calls finds an origin that is already
 * known; the places of a new origin are interned one by one. */

enum { CHAIN = 8 };

uint32_t vs_bind_file_count(vs_scheme *vm) {
  vs_value files = vm->at.files;
  uint32_t n = vs_is_vector(files) ? (uint32_t)vs_as_vector(files)->length : 0;
  while (n > 1 && !vs_is_string(vs_as_vector(files)->at[n - 1])) n--; /* skips unused elements at the end of the
                                                                       * vector */
  return n;
}

bool vs_bind_is_library(vs_bind *b, uint32_t number) {
  if (number < b->library_files) return true;
  vs_text name;
  vs_text_open(b->vm, &name, 0);
  bool shipped = vs_source_name(b->vm, number, &name) && vs_source_is_shipped(name.at);
  vs_text_close(&name);
  return shipped;
}

const char *vs_bind_file_name(vs_bind *b, vs_pos place) {
  vs_value files = b->vm->at.files;
  uint32_t number = vs_pos_file(place);
  if (number == 0 || vs_bind_is_library(b, number) || !vs_is_vector(files) || number >= vs_as_vector(files)->length)
    return NULL;
  vs_value name = vs_as_vector(files)->at[number];
  char *text;
  size_t bytes;
  if (!vs_is_string(name) || !vs_bind_take_text(b->vm, name, &text, &bytes)) return NULL;
  const char *kept = vs_store_text(b->store, text, bytes - 1);
  vs_mem(b->vm, text, bytes, 0);
  return kept;
}

static const vs_origin *intern_chain(vs_bind *b, const vs_pos *place, size_t n) {
  const vs_origin *o = NULL;
  for (size_t i = n; i-- > 0;) {
    const char *file = vs_bind_file_name(b, place[i]);
    const vs_origin *next =
        file ? vs_store_origin(b->store, file, vs_pos_line(place[i]), vs_pos_col(place[i]), o) : NULL;
    if (next) o = next;
  }
  return o;
}

const vs_origin *vs_bind_origin(vs_bind *b) {
  uint64_t key = vs_call_key(b->vm, CHAIN);
  size_t slot = key % (sizeof b->recent / sizeof *b->recent);
  if (b->recent_collection != b->vm->collections) { /* the cache's hashes use addresses, which a garbage collection
                                                     * changes */
    memset(b->recent, 0, sizeof b->recent);
    b->recent_collection = b->vm->collections;
  }
  if (b->recent[slot].key != key || !b->recent[slot].origin) {
    vs_pos place[CHAIN];
    size_t n = vs_call_places(b->vm, place, CHAIN);
    b->recent[slot].origin = intern_chain(b, place, n);
    b->recent[slot].key = key;
  }
  return b->recent[slot].origin;
}
