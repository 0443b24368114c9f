/* Contains the table of natives whose calls are compiled to one instruction. */
#include "vm/compiler/inline.h"

#include "vm/values/flat.h"

/* Converts the column "with immediate" of inline.def to an opcode. In rows of kind TYPE, this column is a type of
 * objects. */
#define IMMEDIATE_VALUE(x) VS_O_##x
#define IMMEDIATE_TEST(x) VS_O_##x
#define IMMEDIATE_EFFECT(x) VS_O_##x
#define IMMEDIATE_TYPE(x) VS_T_##x
#define IMMEDIATE_RECORD(x) VS_O_##x
#define IMMEDIATE_EACH(x) x
#define ANY VS_ANY_COUNT

static const vs_inline_row rows[] = {
  {NULL, 0, VS_WAY_NONE, VS_O_NONE, VS_O_NONE, VS_O_NONE},
#define VS_INLINE(name, args, way, op, immediate, many)                                                                \
  { name, args, VS_WAY_##way, VS_O_##op, IMMEDIATE_##way(immediate), VS_O_##many },
#include "vm/compiler/inline.def"
#undef VS_INLINE
  {"make", 0, VS_WAY_MAKE, VS_O_MAKEFLAT, VS_O_NONE, VS_O_NONE},
  {"get", 1, VS_WAY_GET, VS_O_FLATREF, VS_O_NONE, VS_O_NONE},
  {"unary", 1, VS_WAY_GET, VS_O_FLAT1, VS_O_NONE, VS_O_NONE},
  {"binary", 2, VS_WAY_FLAT2, VS_O_FLAT2, VS_O_NONE, VS_O_NONE},
};
enum { ROWS = sizeof rows / sizeof rows[0], MAKE = ROWS - 4, GET, UNARY, BINARY };

const vs_inline_row *vs_inline_get(uint32_t row) { return &rows[row < ROWS ? row : 0]; }

void vs_inline_find(const vs_scheme *vm, const char *name, size_t length, uint32_t *row, uint32_t *arg) {
  *row = *arg = 0;
  for (uint32_t i = 1; i < MAKE; i++)
    if (strlen(rows[i].name) == length && memcmp(rows[i].name, name, length) == 0) { *row = i; return; }
  if (!vm->flat) return;
#define FIND(table, count, number) \
  for (int i = 0; i < vm->flat->count; i++) \
    if (strlen(vm->flat->table[i].name) == length && memcmp(vm->flat->table[i].name, name, length) == 0) { \
      *row = number, *arg = (uint32_t)i; \
      return; \
    }
  FIND(maker, makers, MAKE)
  FIND(getter, getters, GET)
  FIND(unary, unaries, UNARY)
  FIND(binary, binaries, BINARY)
#undef FIND
}
