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

/* Pointers have 4 or 8 bytes; the first value of an object is at the same word with either, and a struct fills whole
 * words. VS_TRACED: struct vs_<type>, its row, its first member that holds a value. */
enum {
#define VS_OBJECT(name, noun, first, count) VS_FIRST_##name = first,
#include "vm/values/object.def"
#undef VS_OBJECT
  VS_FIRST_END
};
#define VS_TRACED(type, name, member)                                                                                  \
  _Static_assert(offsetof(vs_##type, member) == 8 * (size_t)VS_FIRST_##name && sizeof(vs_##type) % 8 == 0,             \
                 "layout of vs_" #type);
VS_TRACED(pair, PAIR, car) VS_TRACED(string, STRING, store) VS_TRACED(vector, VECTOR, at) VS_TRACED(ratio, RATIO, num)
VS_TRACED(closure, CLOSURE, code) VS_TRACED(case, CASE, clause) VS_TRACED(native, NATIVE, name)
VS_TRACED(continuation, CONTINUATION, stack) VS_TRACED(parameter, PARAMETER, value) VS_TRACED(code, CODE, name)
VS_TRACED(cell, CELL, value) VS_TRACED(box, BOX, value) VS_TRACED(values, VALUES, at)
VS_TRACED(record_type, RECORD_TYPE, name) VS_TRACED(record, RECORD, type) VS_TRACED(dual, DUAL, level)
VS_TRACED(table, TABLE, entries) VS_TRACED(port, PORT, buffer) VS_TRACED(promise, PROMISE, done)
VS_TRACED(condition, CONDITION, kind) VS_TRACED(stack, STACK, under) VS_TRACED(environment, ENVIRONMENT, name)
VS_TRACED(macro, MACRO, kind) VS_TRACED(alias, ALIAS, name) VS_TRACED(keywords, KEYWORDS, name)
VS_TRACED(symbol, SYMBOL, h) VS_TRACED(bytes, BYTES, h) VS_TRACED(bignum, BIGNUM, h) VS_TRACED(flat, FLAT, h)
VS_TRACED(foreign, FOREIGN, h)
#undef VS_TRACED

/* Returns the first slot of an object that contains a Scheme value, and sets *n to the number of such slots. The header
 * must be set, and the object must have at least the words before this slot. */
static inline vs_value *vs_layout_slots(vs_object *o, size_t *n) {
  unsigned first = vs_layout[o->type].first, count = vs_layout[o->type].count;
  VS_ASSERT(o->type < VS_T_COUNT && first <= o->words);
  *n = first == 0 ? 0 : count == VS_LAYOUT_END ? o->words - first : count;
  return (vs_value *)(void *)o + first;
}

#endif
