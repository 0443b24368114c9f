/* Owns the conversion of text to data: whole files with positions, and single data from ports.
 *
 * Data from source files consist of located pairs: the first pair of a list has the place of its parenthesis, every
 * further pair the place of its element. Therefore an atom's place follows from its pair (vs_form_pos in expand.h).
 * `#:name` reads as the symbol "#:name". Nothing recurses on the C stack. */
#ifndef VS_VM_FRONT_READER_H
#define VS_VM_FRONT_READER_H

#include "vm/machine/native.h"

/* A text to read: its bytes, without NUL, and the number of its first line in its file. */
typedef struct vs_passage { const char *at; size_t size; uint32_t line; } vs_passage;

/* Sets *number to the number of a source file in positions; the same name has the same number. */
bool vs_file_number(vs_scheme *vm, const char *name, size_t bytes, uint32_t *number);

/* Returns false with the error set, at the first bad byte, if the text is not UTF-8. */
bool vs_check_utf8(vs_scheme *vm, const char *text, size_t size, uint32_t file, uint32_t line);

/* Reads all data of a text, in order, as one located list. A text with mistakes gives one condition of kind `read` for
 * the first; its payload is a list of (place . message) of the others, in order. fold: as after #!fold-case. */
bool vs_read_all(vs_scheme *vm, const vs_passage *text, uint32_t file, bool fold, vs_value *forms);

/* Does vs_number_parse in radix 10; reports a number that is too large at its place. */
bool vs_read_number(vs_scheme *vm, const char *s, size_t n, vs_pos place, vs_value *out);

/* Reads the first datum of a text, without positions, or VS_EOF. *used: bytes up to its end. */
bool vs_read_datum(vs_scheme *vm, const char *text, size_t size, vs_value *out, size_t *used);

#endif
