/* Declares the search for natives whose calls are compiled to one instruction. They are the rows of inline.def, and the
 * host's procedures that create and read flat records (points and vectors). */
#ifndef VS_VM_COMPILER_INLINE_H
#define VS_VM_COMPILER_INLINE_H

#include "vm/compiler/code.h"

typedef enum {
  VS_WAY_NONE,
  VS_WAY_VALUE,
  VS_WAY_TEST,
  VS_WAY_TYPE,
  VS_WAY_EFFECT,
  VS_WAY_MAKE,
  VS_WAY_GET,
  VS_WAY_FLAT2,
  VS_WAY_RECORD,
  VS_WAY_EACH
} vs_inline_way;
enum { VS_ANY_COUNT = 255 };    /* value of vs_inline_row.args for any number of arguments, at least one */
typedef struct vs_inline_row { const char *name; uint8_t args, way, op, immediate, many; } vs_inline_row;

/* Sets *row to the row number of the native with this name, or to 0 if there is none, and *arg to the native's index in
 * the host's table. */
void vs_inline_find(const vs_scheme *vm, const char *name, size_t length, uint32_t *row, uint32_t *arg);
const vs_inline_row *vs_inline_get(uint32_t row);

#endif
