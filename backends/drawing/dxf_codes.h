/* Contains functions that write group codes of .dxf, and rows of its tables, blocks and dictionaries. A group is a code
 * and a value, each on a line. */
#ifndef VS_BACKENDS_DRAWING_DXF_CODES_H
#define VS_BACKENDS_DRAWING_DXF_CODES_H

#include <string.h>

#include "backends/writer.h"

/* FIRST_HANDLE: first handle (number of an object in the file) of a drawn object; tables have lower handles. */
enum { FIRST_HANDLE = 0x100, MODEL_SPACE = 0x1f, PAPER_SPACE = 0x1e, ROOT = 0xc, GROUPS = 0xd };

void vs_dxf_text(vs_writer *w, int number, const char *text); /* writes a text, shortened to a line of the file */
bool vs_dxf_text_is_short(const char *text);                  /* returns true if the text fits on one line of the
                                                               * file */
/* Writes the text of an MTEXT. Each line has the group code 3, except the last. */
void vs_dxf_long_text(vs_writer *w, const char *text);
/* Replaces, in place, characters that a name of DXF cannot contain by underscores. Returns the name. */
char *vs_dxf_name(char *name);
/* Returns the index of the colour in DXF's table that is nearest to the colour rgb. */
int vs_dxf_colour_index(const double rgb[3]);
long vs_dxf_unit(const char *unit); /* returns the value of $INSUNITS for a unit's name, or 0 for an unknown unit */

/* ---- groups ---- */

static inline void code(vs_writer *w, int number, const char *text) {
  vs_putf(w, "%3d\n", number);
  vs_puts(w, text);
  vs_puts(w, "\n");
}
static inline void code_real(vs_writer *w, int number, double x) {
  vs_putf(w, "%3d\n", number);
  vs_put_number(w, x);
  vs_puts(w, "\n");
}
static inline void code_int(vs_writer *w, int number, long x) { vs_putf(w, "%3d\n%ld\n", number, x); }
static inline void code_handle(vs_writer *w, int number, unsigned handle) { vs_putf(w, "%3d\n%X\n", number, handle); }

/* ---- rows ---- */

static inline void table(vs_writer *w, const char *name, unsigned handle, long count) {
  code(w, 0, "TABLE");
  code(w, 2, name);
  code_handle(w, 5, handle);
  code_int(w, 330, 0);
  code(w, 100, "AcDbSymbolTable");
  code_int(w, 70, count);
}
static inline void row(vs_writer *w, const char *type, unsigned handle, unsigned owner, const char *kind,
                       const char *name) {
  code(w, 0, type);
  code_handle(w, strcmp(type, "DIMSTYLE") == 0 ? 105 : 5, handle);
  code_handle(w, 330, owner);
  code(w, 100, "AcDbSymbolTableRecord");
  code(w, 100, kind);
  code(w, 2, name);
}
static inline void end_table(vs_writer *w) { code(w, 0, "ENDTAB"); }

static inline void begin_block(vs_writer *w, const char *name, unsigned record, unsigned handle) {
  code(w, 0, "BLOCK");
  code_handle(w, 5, handle);
  code_handle(w, 330, record);
  code(w, 100, "AcDbEntity");
  if (record == PAPER_SPACE) code_int(w, 67, 1);
  code(w, 8, "0");
  code(w, 100, "AcDbBlockBegin");
  code(w, 2, name);
  code_int(w, 70, 0);
  for (int i = 10; i <= 30; i += 10) code_real(w, i, 0);
  code(w, 3, name);
  code(w, 1, "");
}
static inline void end_block(vs_writer *w, unsigned record, unsigned handle) {
  code(w, 0, "ENDBLK");
  code_handle(w, 5, handle);
  code_handle(w, 330, record);
  code(w, 100, "AcDbEntity");
  if (record == PAPER_SPACE) code_int(w, 67, 1);
  code(w, 8, "0");
  code(w, 100, "AcDbBlockEnd");
}

static inline void dictionary(vs_writer *w, unsigned handle, unsigned owner) {
  code(w, 0, "DICTIONARY");
  code_handle(w, 5, handle);
  code_handle(w, 330, owner);
  code(w, 100, "AcDbDictionary");
  code_int(w, 281, 1);
}

#endif
