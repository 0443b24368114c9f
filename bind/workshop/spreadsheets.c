/* Implements the native of write-xlsx: workbooks of Excel and LibreOffice, which libxlsxwriter makes. The library is
 * loaded at its first use.
 *
 * libxlsxwriter writes a workbook only into a named file, and keeps its parts in temporary files. Both are in a private
 * folder, which is removed; the workbook's bytes then go through the host's functions, as those of each other file that
 * a program writes. Equal rows give equal bytes, since the date of the workbook is fixed. */
#define _DEFAULT_SOURCE /* declares mkdtemp */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <xlsxwriter.h>

#include "bind/call/positional.h"
#include "bind/call/raise.h"
#include "bind/call/scratch.h"
#include "geometry/dynamic.h"
#include "vm/library/port.h"
#include "vm/machine/fail.h"

#define WORKBOOK_FUNCTIONS(F)                                                                                          \
  F(open, workbook_new_opt, lxw_workbook *, (const char *, lxw_workbook_options *))                                    \
  F(properties, workbook_set_properties, lxw_error, (lxw_workbook *, lxw_doc_properties *))                            \
  F(sheet, workbook_add_worksheet, lxw_worksheet *, (lxw_workbook *, const char *))                                    \
  F(format, workbook_add_format, lxw_format *, (lxw_workbook *))                                                       \
  F(close, workbook_close, lxw_error, (lxw_workbook *))                                                                \
  F(bold, format_set_bold, void, (lxw_format *))                                                                       \
  F(decimals, format_set_num_format, void, (lxw_format *, const char *))                                               \
  F(number, worksheet_write_number, lxw_error, (lxw_worksheet *, lxw_row_t, lxw_col_t, double, lxw_format *))          \
  F(text, worksheet_write_string, lxw_error, (lxw_worksheet *, lxw_row_t, lxw_col_t, const char *, lxw_format *))      \
  F(boolean, worksheet_write_boolean, lxw_error, (lxw_worksheet *, lxw_row_t, lxw_col_t, int, lxw_format *))           \
  F(width, worksheet_set_column, lxw_error, (lxw_worksheet *, lxw_col_t, lxw_col_t, double, lxw_format *))             \
  F(freeze, worksheet_freeze_panes, void, (lxw_worksheet *, lxw_row_t, lxw_col_t))                                     \
  F(why, lxw_strerror, char *, (lxw_error))

VS_DYNAMIC_FUNCTIONS(WORKBOOK_FUNCTIONS);

enum {
  COLUMNS = 16384,                            /* greatest number of columns in a sheet */
  SHEET_MARK = 29, ROW_MARK = 30, CELL_MARK = 31, /* characters before a sheet's name, a row and a cell */
  MOST_WIDTH = 60, LEAST_WIDTH = 8            /* of a column, in characters */
};
#define MADE_AT 315532800 /* 1980-01-01, the date of each workbook, in seconds since 1970 */

typedef struct {
  dynamic_functions call;
  lxw_workbook *book;
  lxw_worksheet *sheet;
  lxw_format *head, *decimals; /* of the first row of a sheet; of numbers that are no exact integers, or NULL */
  lxw_row_t row;               /* number of the next row */
  int column, columns;         /* numbers of the row's next cell, and of the sheet's columns */
  double *widths;              /* the length of the longest text in each column, in characters */
  lxw_error error;             /* first error of the library */
} workbook;

static void note(workbook *w, lxw_error error) {
  if (w->error == LXW_NO_ERROR) w->error = error;
}

/* Ends the sheet: sets the widths of its columns. */
static void end_sheet(workbook *w) {
  for (int i = 0; w->sheet && i < w->columns; i++)
    note(w, w->call.width(w->sheet, (lxw_col_t)i, (lxw_col_t)i, fmin(fmax(w->widths[i], LEAST_WIDTH), MOST_WIDTH) + 1,
                          NULL));
  w->sheet = NULL, w->columns = 0;
}

static void begin_sheet(workbook *w, const char *name) {
  end_sheet(w);
  w->row = 0, w->column = 0;
  w->sheet = w->call.sheet(w->book, *name ? name : NULL);
  if (w->sheet) w->call.freeze(w->sheet, 1, 0);
  else note(w, LXW_ERROR_SHEETNAME_ALREADY_USED);
}

/* Writes the next cell of the row. text: a letter for its kind, then its value; tables.scm writes it. Returns the
 * library's error. */
static lxw_error put_cell(workbook *w, const char *text) {
  lxw_row_t row = w->row - 1;
  lxw_col_t column = (lxw_col_t)w->column;
  lxw_format *look = row == 0 ? w->head : NULL;
  if (!w->sheet || w->column >= COLUMNS) return LXW_ERROR_WORKSHEET_INDEX_OUT_OF_RANGE;
  for (; w->columns <= w->column; w->columns++) w->widths[w->columns] = 0;
  double length = 0;
  for (const char *c = text; *c; c++) length += (*c & 0xC0) != 0x80; /* bytes that begin a character */
  w->widths[column] = fmax(w->widths[column], length);
  w->column++;
  switch (*text) {
    case 'i': return w->call.number(w->sheet, row, column, strtod(text + 1, NULL), look);
    case 'r': return w->call.number(w->sheet, row, column, strtod(text + 1, NULL), look ? look : w->decimals);
    case 'b': return w->call.boolean(w->sheet, row, column, 1, look);
    case 's': return w->call.text(w->sheet, row, column, text + 1, look);
    default: return LXW_NO_ERROR; /* an empty cell */
  }
}

/* Writes the sheets that the text describes. Changes the marks in the text to NULs. */
static bool put_sheets(vs_scheme *vm, workbook *w, char *text, int64_t digits) {
  char decimals[32] = "0.";
  for (int64_t i = 0; i < digits; i++) strcat(decimals, "0");
  w->head = w->call.format(w->book);
  w->decimals = digits >= 0 ? w->call.format(w->book) : NULL;
  if (!w->head || (digits >= 0 && !w->decimals)) return vs_fail_memory(vm);
  w->call.bold(w->head);
  if (w->decimals) w->call.decimals(w->decimals, digits == 0 ? "0" : decimals);
  for (char *at = text, *next; *at; at = next) {
    char mark = *at++;
    next = at + strcspn(at, "\x1d\x1e\x1f");
    char last = *next;
    *next = 0;
    if (mark == SHEET_MARK) begin_sheet(w, at);
    else if (mark == ROW_MARK) w->row++, w->column = 0;
    else note(w, put_cell(w, at));
    *next = last;
    if (!vs_poll(vm, 64)) return false;
  }
  end_sheet(w);
  return true;
}

/* Makes the workbook in the file at `path`; its folder has the temporary files. */
static bool make_workbook(vs_args *f, workbook *w, char *path, char *folder, char *text) {
  vs_scheme *vm = vs_call_vm(f);
  lxw_workbook_options options = { .tmpdir = folder };
  lxw_doc_properties properties = { .created = MADE_AT };
  w->widths = vs_bind_scratch(f, COLUMNS * sizeof *w->widths);
  if (!w->widths) return false;
  w->book = w->call.open(path, &options);
  if (!w->book) return vs_fail_memory(vm);
  note(w, w->call.properties(w->book, &properties));
  bool ok = put_sheets(vm, w, text, (int64_t)vs_arg_real(f, 2));
  note(w, w->call.close(w->book)); /* frees the workbook, too */
  return ok && (w->error == LXW_NO_ERROR || vs_fail(vm, vm->sym.file, "%s", w->call.why(w->error)));
}

/* Copies the bytes of the file at `path` to the port. */
static bool copy_file(vs_scheme *vm, const char *path, vs_value port) {
  char bytes[8192];
  size_t count;
  FILE *file = fopen(path, "rb");
  bool ok = file || vs_fail(vm, vm->sym.file, "the temporary file %s cannot be read", path);
  while (ok && (count = fread(bytes, 1, sizeof bytes, file)) > 0)
    ok = vs_port_write(vm, port, bytes, count) && vs_poll(vm, count / 64);
  if (ok && ferror(file)) ok = vs_fail(vm, vm->sym.file, "the temporary file %s cannot be read", path);
  if (file) fclose(file);
  return ok;
}

/* Makes the workbook in a private folder, copies it to the port, and removes the folder. */
static bool write_workbook(vs_args *f, workbook *w, char *text, vs_value port) {
  vs_scheme *vm = vs_call_vm(f);
  const char *base = getenv("TMPDIR");
  if (!base || base[0] != '/') base = "/tmp";
  size_t room = strlen(base) + sizeof "/visualscheme-workbook-XXXXXX/workbook.xlsx";
  char *folder = vs_bind_scratch(f, room), *path = vs_bind_scratch(f, room);
  if (!folder || !path) return false;
  snprintf(folder, room, "%s/visualscheme-workbook-XXXXXX", base);
  if (!mkdtemp(folder)) return vs_fail(vm, vm->sym.file, "no temporary file can be made in %s", base);
  snprintf(path, room, "%s/workbook.xlsx", folder);
  bool ok = make_workbook(f, w, path, folder, text) && copy_file(vm, path, port);
  unlink(path);
  rmdir(folder);
  return ok;
}

/* (%write-xlsx file text digits): writes the workbook that the text describes. Before each sheet's name, row and cell
 * is its mark. digits: the decimals that numbers show, -1 for all. */
vs_status vs_p_write_xlsx(vs_args *f, vs_value *out) {
  (void)out;
  vs_scheme *vm = vs_call_vm(f);
  workbook w = { .error = LXW_NO_ERROR };
  vs_error e = { 0 };
  if (!vs_dynamic_load(VS_LIBRARY_XLSXWRITER, "writing .xlsx", dynamic_names,
                       sizeof dynamic_names / sizeof *dynamic_names, &w.call, &e))
    return vs_bind_error(vm, &e);
  size_t length = vs_arg_text_length(f, 1);
  char *text = vs_bind_scratch(f, length + 1);
  if (!text) return VS_ERROR;
  memcpy(text, vs_arg_text(f, 1), length + 1);
  VS_ROOTS(vm, r, 1);
  if (!vs_port_open_file(vm, vs_arg_value(f, 0), VS_IO_WRITE, VS_PORT_OUTPUT | VS_PORT_BINARY, &r[0])) return VS_ERROR;
  bool ok = write_workbook(f, &w, text, r[0]);
  ok = vs_port_close(vm, r[0]) && ok;
  return ok ? VS_OK : VS_ERROR;
}
