/* Draws the tables of a sheet. Columns of numbers are aligned to the right, other columns to the left. */
#include <math.h>
#include <stdlib.h>

#include "backends/drawing/notes.h"
#include "backends/drawing/sheet_tables.h"

/* Lengths in mm. For cells: cap is the height of capitals, row that of a row, side the space at both sides of a text.
 * For a title: title_cap is the height of capitals, title_row that of the title with its space. The distance between
 * tables is `apart`. */
static const double cap = 2, title_cap = 2.5, row = 4.6, title_row = 6, side = 1.6, apart = 6;

static const char *cell(const vs_scene_table *t, size_t r, size_t c) { return t->cells[r * t->columns + c]; }

static bool is_number(const char *text) {
  char *end;
  (void)strtod(text, &end);
  return end != text && *end == '\0';
}

/* Returns true if each cell of the column below its head is a number or empty, and at least one is a number. */
static bool is_numeric(const vs_scene_table *t, size_t column) {
  size_t numbers = 0;
  for (size_t r = 1; r < t->rows; r++) {
    if (is_number(cell(t, r, column))) numbers++;
    else if (*cell(t, r, column)) return false;
  }
  return numbers > 0;
}

static double column_width(const vs_scene_table *t, size_t column) {
  double most = 4;
  for (size_t r = 0; r < t->rows; r++) most = fmax(most, vs_sheet_text_width(cell(t, r, column), cap));
  return most + 2 * side;
}

static double table_width(const vs_scene_table *t) {
  double sum = 0;
  for (size_t c = 0; c < t->columns; c++) sum += column_width(t, c);
  return fmax(sum, t->title ? vs_sheet_text_width(t->title, title_cap) : 0);
}

static double table_height(const vs_scene_table *t) { return (double)t->rows * row + (t->title ? title_row : 0); }

vs_sheet_point vs_sheet_tables_size(const vs_scene *scene) {
  vs_sheet_point size = { 0, 0 };
  for (size_t i = 0; i < scene->table_count; i++) {
    size.x = fmax(size.x, table_width(&scene->tables[i]));
    size.y += table_height(&scene->tables[i]) + (i ? apart : 0);
  }
  return size;
}

static bool write(const vs_sheet_pen *pen, double x, double y, double size, double align, const char *text) {
  return !*text || vs_sheet_text(pen, &(vs_sheet_words){ .text = text, .at = { x, y }, .size = size, .align = align });
}

static bool put_column(const vs_sheet_pen *pen, const vs_scene_table *t, size_t column, double x, double top) {
  const bool numeric = is_numeric(t, column);
  const double at = numeric ? x + column_width(t, column) - side : x + side;
  bool ok = true;
  for (size_t r = 0; ok && r < t->rows; r++)
    ok = write(pen, at, top - (double)(r + 1) * row + (row - cap) / 2, cap, numeric ? 1 : 0, cell(t, r, column));
  return ok;
}

/* Draws a table whose upper left corner is (left, top), without its title. */
static bool put_cells(const vs_sheet_pen *pen, const vs_scene_table *t, double left, double top) {
  double x = left, wide = 0, low = top - (double)t->rows * row;
  bool ok = true;
  for (size_t c = 0; ok && c < t->columns; c++) {
    ok = put_column(pen, t, c, x, top);
    x += column_width(t, c);
    if (ok && c + 1 < t->columns)
      ok = vs_sheet_stroke(pen, VS_DRAWN_DIMENSION, (vs_sheet_point){ x, low }, (vs_sheet_point){ x, top });
  }
  wide = x - left;
  for (size_t r = 1; ok && r < t->rows; r++) {
    const double y = top - (double)r * row;
    ok = vs_sheet_stroke(pen, r == 1 ? VS_DRAWN_SHEET : VS_DRAWN_DIMENSION, (vs_sheet_point){ left, y },
                         (vs_sheet_point){ left + wide, y });
  }
  return ok && vs_sheet_rectangle(pen, VS_DRAWN_SHEET, (vs_sheet_point){ left, low },
                                  (vs_sheet_point){ left + wide, top });
}

bool vs_sheet_tables(const vs_sheet_pen *pen, vs_sheet_point corner) {
  const vs_scene *scene = pen->e->scene;
  const vs_sheet_point size = vs_sheet_tables_size(scene);
  const double left = corner.x - size.x;
  double top = corner.y + size.y;
  for (size_t i = 0; i < scene->table_count; i++) {
    const vs_scene_table *t = &scene->tables[i];
    if (t->title && !write(pen, left, top - title_row + 2.2, title_cap, 0, t->title)) return false;
    if (!put_cells(pen, t, left, top - (t->title ? title_row : 0))) return false;
    top -= table_height(t) + apart;
  }
  return true;
}
