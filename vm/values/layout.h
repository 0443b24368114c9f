/* Declares which words of each type of object contain Scheme values, for the garbage collector and the image writer. */
#ifndef VS_VM_VALUES_LAYOUT_H
#define VS_VM_VALUES_LAYOUT_H

#include "vm/values/value.h"

enum { VS_LAYOUT_END = 255 };
static const struct { uint8_t first, count; } vs_layout[VS_T_COUNT] = {
#define END VS_LAYOUT_END
#define VS_OBJECT(name, noun, first, count) {first, count},
#include "vm/values/object.def"
#undef VS_OBJECT
#undef END
};

/* Returns the first slot of an object that contains a Scheme value, and sets *n to the number of such slots. The header
 * must be set, and the object must have at least the words before this slot. */
static inline vs_value *vs_layout_slots(vs_object *o, size_t *n) {
  unsigned first = vs_layout[o->type].first, count = vs_layout[o->type].count;
  VS_ASSERT(o->type < VS_T_COUNT && first <= o->words);
  *n = first == 0 ? 0 : count == VS_LAYOUT_END ? o->words - first : count;
  return (vs_value *)(void *)o + first;
}

#endif
