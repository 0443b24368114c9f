/* Declares the counts of how often each form of a program runs. The compiler emits the instruction COVER at the start
 * of each form; the instruction adds 1 to the form's count. */
#ifndef VS_VM_COMPILER_COVERAGE_H
#define VS_VM_COMPILER_COVERAGE_H

#include "vm/values/gc.h"

/* A form that was compiled: its place, and the number of times that it has run. */
typedef struct { vs_pos pos; uint64_t count; } vs_covered;

typedef struct vs_cover_table {
  bool on;                   /* whether the compiler counts the forms that it compiles now */
  uint32_t first_file;       /* number of the first file that is not part of the library, whose forms do not count */
  vs_covered *forms; size_t count, room;
} vs_cover_table;

/* Starts the counting of forms that are compiled later, without those of files below number first_file. Returns false
 * when memory is out. vs_cover_end ends the counting; the counts remain until vs_cover_close. */
bool vs_cover_begin(vs_scheme *vm, uint32_t first_file);
void vs_cover_end(vs_scheme *vm);
void vs_cover_close(vs_scheme *vm);
/* Adds the form at this place, and sets *index to its index. Returns false when memory is out. */
bool vs_cover_form(vs_scheme *vm, vs_pos pos, uint32_t *index);
/* Returns whether the compiler counts the form at this place: it is a form of the program, not of the library. */
bool vs_covers(const vs_scheme *vm, vs_pos pos);

#endif
