/* Declares the reader, which converts text to data: whole files with places, and single data from ports.
 *
 * Data from source files consist of pairs with places. The first pair of a list has the place of its parenthesis, every
 * other pair the place of its element. The place of an atom is therefore found from its pair (vs_form_pos in expand.h).
 * `#:name` becomes the symbol "#:name". The reader does not recurse on the C stack. */
#ifndef VS_VM_FRONT_READER_H
#define VS_VM_FRONT_READER_H

#include "vm/machine/native.h"

/* A text to read: its bytes, without NUL, and the line number of its first line within its file. */
typedef struct vs_passage { const char *at; size_t size; uint32_t line; } vs_passage;

/* Sets *number to the number of a source file, by which places refer to the file. Calls with the same name return the
 * same number. */
bool vs_file_number(vs_scheme *vm, const char *name, size_t bytes, uint32_t *number);

/* Returns true if the text is valid UTF-8. Otherwise sets the error, at the first invalid byte. */
bool vs_check_utf8(vs_scheme *vm, const char *text, size_t size, uint32_t file, uint32_t line);

/* Reads all data of a text as one list. If the text has mistakes, sets an error of kind `read` for the first mistake;
 * its payload is a list of (place . message) for the others. With fold, letters are converted to lower case, as after
 * #!fold-case. */
bool vs_read_all(vs_scheme *vm, const vs_passage *text, uint32_t file, bool fold, vs_value *forms);

/* Reads a number in radix 10, as vs_number_parse does. Reports a number that is too large; `place` is the place of the
 * error. */
bool vs_read_number(vs_scheme *vm, const char *s, size_t n, vs_pos place, vs_value *out);

/* Reads the first datum of a text, without places. If there is none, sets *out to VS_EOF. Sets *used to the number of
 * bytes up to the end of the datum. */
bool vs_read_datum(vs_scheme *vm, const char *text, size_t size, vs_value *out, size_t *used);

#endif
