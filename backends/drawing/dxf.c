/* Writes .dxf (AutoCAD 2000, as text). Debian has no C library that writes this format.
 *
 * A drawing is in model units. A point of the first view has its coordinates in the view's plane, so a plan's points
 * have the model's coordinates. The first view's scale decides the size of the paper around it and of other views.
 * Every object has a handle. The file contains only the tables and dictionaries that readers require. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "backends/drawing/dxf.h"

typedef struct { vs_writer *w; const vs_sheet *s; double mm; vs_sheet_point shift; unsigned handle; } writing;

/* FIRST_HANDLE: first handle of a drawn object; tables have lower handles. */
enum { FIRST_HANDLE = 0x100, MODEL_SPACE = 0x1f, PAPER_SPACE = 0x1e, ROOT = 0xc, GROUPS = 0xd };

static void code(vs_writer *w, int number, const char *text) {
  vs_putf(w, "%3d\n", number);
  vs_puts(w, text);
  vs_puts(w, "\n");
}
static void code_real(vs_writer *w, int number, double x) {
  vs_putf(w, "%3d\n", number);
  vs_put_number(w, x);
  vs_puts(w, "\n");
}
static void code_int(vs_writer *w, int number, long x) { vs_putf(w, "%3d\n%ld\n", number, x); }
static void code_handle(vs_writer *w, int number, unsigned handle) { vs_putf(w, "%3d\n%X\n", number, handle); }

enum { DXF_CHARACTER = 12, DXF_LINE = 250 /* greatest number of bytes of text on a line; a longer text is an MTEXT */ };

/* Writes the character at *text into `as`, as this DXF version spells it. A character outside ASCII becomes \U+00E9,
 * with room for four digits. A caret is escaped. A backslash is escaped before U+ or M+, where it would begin an
 * escape. Returns the number of bytes; *text moves to the next character. */
static size_t text_character(const char **text, char as[DXF_CHARACTER]) {
  enum { ENOUGH = 16 }; /* number of bytes that suffices for any character */
  char spelled[VS_SPELLED_ROOM + 1];
  uint32_t point = 0xFFFD;
  size_t count = vs_spell_line(text, *text + strnlen(*text, ENOUGH), spelled);
  spelled[count] = '\0';
  vs_character_read(spelled, count, &point);
  bool escape = point == '\\' && (**text == 'U' || **text == 'M') && (*text)[1] == '+';
  int length = escape         ? snprintf(as, DXF_CHARACTER, "\\U+005C")
               : point < 0x80 ? snprintf(as, DXF_CHARACTER, point == '^' ? "^ " : "%c", (int)point)
                              : snprintf(as, DXF_CHARACTER, "\\U+%04X", point < 0x10000 ? (unsigned)point : 0xFFFDu);
  return (size_t)length;
}

/* Returns true if the text fits on one line of the file. */
static bool text_is_short(const char *text) {
  char as[DXF_CHARACTER];
  size_t bytes = 0;
  while (*text != '\0' && bytes <= DXF_LINE) bytes += text_character(&text, as);
  return bytes <= DXF_LINE;
}

/* Writes as much of *text as fits on a line of the file; *text moves to the first character not written. */
static void text_line(vs_writer *w, const char **text) {
  char as[DXF_CHARACTER];
  for (size_t bytes = 0; **text != '\0';) {
    const char *next = *text;
    size_t n = text_character(&next, as);
    bytes += n;
    if (bytes > DXF_LINE) break;
    vs_put(w, as, n);
    *text = next;
  }
  vs_puts(w, "\n");
}

static void code_text(vs_writer *w, int number, const char *text) {
  vs_putf(w, "%3d\n", number);
  text_line(w, &text);
}

/* Writes the text of an MTEXT. Each line has the group code 3, except the last. */
static void code_long_text(vs_writer *w, const char *text) {
  while (!text_is_short(text)) {
    vs_putf(w, "%3d\n", 3);
    text_line(w, &text);
  }
  code_text(w, 1, text);
}

/* ---- tables ---- */

static void table(vs_writer *w, const char *name, unsigned handle, long count) {
  code(w, 0, "TABLE");
  code(w, 2, name);
  code_handle(w, 5, handle);
  code_int(w, 330, 0);
  code(w, 100, "AcDbSymbolTable");
  code_int(w, 70, count);
}
static void row(vs_writer *w, const char *type, unsigned handle, unsigned owner, const char *kind, const char *name) {
  code(w, 0, type);
  code_handle(w, strcmp(type, "DIMSTYLE") == 0 ? 105 : 5, handle);
  code_handle(w, 330, owner);
  code(w, 100, "AcDbSymbolTableRecord");
  code(w, 100, kind);
  code(w, 2, name);
}
static void end_table(vs_writer *w) { code(w, 0, "ENDTAB"); }

static void line_type(const writing *out, unsigned handle, const vs_layer_row *r) {
  vs_writer *w = out->w;
  double dashes[] = { r->dash, -r->gap, r->dot, -r->gap }, sum = 0;
  int count = r->dash > 0 ? r->dot > 0 ? 4 : 2 : 0;
  for (int i = 0; i < count; i++) sum += fabs(dashes[i]) / out->mm;
  row(w, "LTYPE", handle, 0x5, "AcDbLinetypeTableRecord", r->dash > 0 ? r->name : "CONTINUOUS");
  code_int(w, 70, 0);
  code(w, 3, r->dash > 0 ? "dashed" : "Solid line");
  code_int(w, 72, 65);
  code_int(w, 73, count);
  code_real(w, 40, sum);
  for (int i = 0; i < count; i++) {
    code_real(w, 49, dashes[i] / out->mm);
    code_int(w, 74, 0);
  }
}

static void tables(const writing *out) {
  vs_writer *w = out->w;
  static const vs_layer_row solid = { "", 0, 0, 0, 0, 0, 7, 0 };
  code(w, 0, "SECTION");
  code(w, 2, "TABLES");
  table(w, "VPORT", 0x8, 0);
  end_table(w);
  table(w, "LTYPE", 0x5, 3 + VS_DRAWN_LAYERS);
  static const char *const by[] = { "BYBLOCK", "BYLAYER" };
  for (unsigned i = 0; i < 2; i++) {
    row(w, "LTYPE", 0x14 + i, 0x5, "AcDbLinetypeTableRecord", by[i]);
    code_int(w, 70, 0);
    code(w, 3, "");
    code_int(w, 72, 65);
    code_int(w, 73, 0);
    code_real(w, 40, 0);
  }
  line_type(out, 0x16, &solid);
  for (unsigned i = 0; i < VS_DRAWN_LAYERS; i++)
    if (vs_drawn_rows[i].dash > 0) line_type(out, 0x40 + i, &vs_drawn_rows[i]);
  end_table(w);
  table(w, "LAYER", 0x2, VS_DRAWN_LAYERS + 1);
  for (unsigned i = 0; i <= VS_DRAWN_LAYERS; i++) {
    const vs_layer_row *r = i > 0 ? &vs_drawn_rows[i - 1] : &solid;
    row(w, "LAYER", 0x60 + i, 0x2, "AcDbLayerTableRecord", i > 0 ? r->name : "0");
    code_int(w, 70, 0);
    code_int(w, 62, r->colour);
    code(w, 6, r->dash > 0 ? r->name : "CONTINUOUS");
    code_int(w, 370, r->weight);
    code_handle(w, 390, 0xf);
  }
  end_table(w);
  table(w, "STYLE", 0x3, 1);
  row(w, "STYLE", 0x11, 0x3, "AcDbTextStyleTableRecord", "STANDARD");
  code_int(w, 70, 0);
  code_real(w, 40, 0);
  code_real(w, 41, 1);
  code_real(w, 50, 0);
  code_int(w, 71, 0);
  code_real(w, 42, 2.5);
  code(w, 3, "DejaVuSans.ttf");
  code(w, 4, "");
  end_table(w);
  table(w, "VIEW", 0x6, 0);
  end_table(w);
  table(w, "UCS", 0x7, 0);
  end_table(w);
  table(w, "APPID", 0x9, 1);
  row(w, "APPID", 0x12, 0x9, "AcDbRegAppTableRecord", "ACAD");
  code_int(w, 70, 0);
  end_table(w);
  table(w, "DIMSTYLE", 0xa, 1);
  code(w, 100, "AcDbDimStyleTable");
  row(w, "DIMSTYLE", 0x13, 0xa, "AcDbDimStyleTableRecord", "STANDARD");
  code_int(w, 70, 0);
  end_table(w);
  table(w, "BLOCK_RECORD", 0x1, 2);
  row(w, "BLOCK_RECORD", MODEL_SPACE, 0x1, "AcDbBlockTableRecord", "*Model_Space");
  row(w, "BLOCK_RECORD", PAPER_SPACE, 0x1, "AcDbBlockTableRecord", "*Paper_Space");
  end_table(w);
  code(w, 0, "ENDSEC");
}

static void block(vs_writer *w, const char *name, unsigned record, unsigned handle) {
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
  code(w, 0, "ENDBLK");
  code_handle(w, 5, handle + 1);
  code_handle(w, 330, record);
  code(w, 100, "AcDbEntity");
  if (record == PAPER_SPACE) code_int(w, 67, 1);
  code(w, 8, "0");
  code(w, 100, "AcDbBlockEnd");
}

/* ---- marks ---- */

static double across(const writing *out, double x) { return (x + out->shift.x) / out->mm; }
static double up(const writing *out, double y) { return (y + out->shift.y) / out->mm; }

static void entity(writing *out, const char *type, vs_drawn_layer layer, const char *kind) {
  code(out->w, 0, type);
  code_handle(out->w, 5, out->handle++);
  code_handle(out->w, 330, MODEL_SPACE);
  code(out->w, 100, "AcDbEntity");
  code(out->w, 8, vs_drawn_rows[layer].name);
  code(out->w, 100, kind);
}

static void corners(const writing *out, uint32_t first, uint32_t count) {
  for (uint32_t i = 0; i < count; i++) {
    code_real(out->w, 10, across(out, out->s->points[first + i].x));
    code_real(out->w, 20, up(out, out->s->points[first + i].y));
  }
}

static void put_line(writing *out, const vs_mark *m) {
  if (m->count == 2) {
    entity(out, "LINE", m->layer, "AcDbLine");
    for (uint32_t i = 0; i < 2; i++) {
      code_real(out->w, 10 + (int)i, across(out, out->s->points[m->first + i].x));
      code_real(out->w, 20 + (int)i, up(out, out->s->points[m->first + i].y));
      code_real(out->w, 30 + (int)i, 0);
    }
    return;
  }
  entity(out, "LWPOLYLINE", m->layer, "AcDbPolyline");
  code_int(out->w, 90, (long)m->count);
  code_int(out->w, 70, m->closed);
  corners(out, m->first, m->count);
}

/* Returns the colour index of a fill's grey, from 250 (dark) to 255 (white). */
static long grey_index(double grey) { return 250 + lround(5 * grey); }

static void put_fill(writing *out, const vs_mark *m) {
  vs_writer *w = out->w;
  code(w, 0, "HATCH");
  code_handle(w, 5, out->handle++);
  code_handle(w, 330, MODEL_SPACE);
  code(w, 100, "AcDbEntity");
  code(w, 8, vs_drawn_rows[m->layer].name);
  code_int(w, 62, grey_index(m->grey));
  code(w, 100, "AcDbHatch");
  for (int i = 10; i <= 30; i += 10) code_real(w, i, 0);
  code_real(w, 210, 0);
  code_real(w, 220, 0);
  code_real(w, 230, 1);
  code(w, 2, "SOLID");
  code_int(w, 70, 1);
  code_int(w, 71, 0);
  code_int(w, 91, (long)m->count);
  for (uint32_t l = m->first; l < m->first + m->count; l++) {
    code_int(w, 92, 2);
    code_int(w, 72, 0);
    code_int(w, 73, 1);
    code_int(w, 93, (long)out->s->loops[l].count);
    corners(out, out->s->loops[l].first, out->s->loops[l].count);
    code_int(w, 97, 0);
  }
  code_int(w, 75, 0);
  code_int(w, 76, 1);
  code_int(w, 98, 0);
}

/* Writes a text that is too long for one line of the file. Its lower edge is on the base line. It is therefore higher
 * than other text by the depth of the letter p. */
static void put_long_text(writing *out, const vs_mark *m, int align) {
  enum { BOTTOM_LEFT = 7 };
  vs_writer *w = out->w;
  double turn = m->angle * (acos(-1) / 180);
  entity(out, "MTEXT", m->layer, "AcDbMText");
  code_real(w, 10, across(out, m->at.x));
  code_real(w, 20, up(out, m->at.y));
  code_real(w, 30, 0);
  code_real(w, 40, m->size / out->mm);
  code_real(w, 41, 0); /* width of the text: 0 means no limit */
  code_int(w, 71, BOTTOM_LEFT + align);
  code_int(w, 72, 1); /* direction of the text: from left to right */
  code_long_text(w, m->text);
  code_real(w, 11, cos(turn));
  code_real(w, 21, sin(turn));
  code_real(w, 31, 0);
}

static void put_text(writing *out, const vs_mark *m) {
  vs_writer *w = out->w;
  int align = m->align < 0.25 ? 0 : m->align < 0.75 ? 1 : 2;
  if (!text_is_short(m->text)) {
    put_long_text(out, m, align);
    return;
  }
  entity(out, "TEXT", m->layer, "AcDbText");
  code_real(w, 10, across(out, m->at.x));
  code_real(w, 20, up(out, m->at.y));
  code_real(w, 30, 0);
  code_real(w, 40, m->size / out->mm);
  code_text(w, 1, m->text);
  code_real(w, 50, m->angle);
  if (align > 0) { /* readers use only the second point of aligned text */
    code_int(w, 72, align);
    code_real(w, 11, across(out, m->at.x));
    code_real(w, 21, up(out, m->at.y));
    code_real(w, 31, 0);
  }
  code(w, 100, "AcDbText");
}

static void header(vs_emitter *e, const writing *out) {
  vs_writer *w = out->w;
  static const struct { const char *unit; long insert; } units[] = { { "m", 6 }, { "mm", 4 }, { "cm", 5 },
      { "in", 1 }, { "ft", 2 } };
  long insert = 0;
  for (size_t i = 0; i < sizeof units / sizeof *units; i++)
    if (strcmp(units[i].unit, e->scene->units) == 0) insert = units[i].insert;
  code(w, 0, "SECTION");
  code(w, 2, "HEADER");
  code(w, 9, "$ACADVER");
  code(w, 1, "AC1015");
  code(w, 9, "$DWGCODEPAGE");
  code(w, 3, "ANSI_1252");
  code(w, 9, "$INSUNITS");
  code_int(w, 70, insert);
  code(w, 9, "$LWDISPLAY");
  code_int(w, 290, 1);
  code(w, 9, "$HANDSEED");
  code_handle(w, 5, FIRST_HANDLE + (unsigned)out->s->mark_count + 1);
  code(w, 0, "ENDSEC");
}

static void dictionary(vs_writer *w, unsigned handle, unsigned owner) {
  code(w, 0, "DICTIONARY");
  code_handle(w, 5, handle);
  code_handle(w, 330, owner);
  code(w, 100, "AcDbDictionary");
  code_int(w, 281, 1);
}

bool vs_sheet_write_dxf(vs_emitter *e, const vs_sheet *s) {
  vs_writer *w = e->out;
  const vs_flat_view *first = &s->views[0];
  writing out = { w, s, first->mm, { first->low.x * first->mm - first->at.x,
      first->low.y * first->mm - first->at.y }, FIRST_HANDLE };
  header(e, &out);
  tables(&out);
  code(w, 0, "SECTION");
  code(w, 2, "BLOCKS");
  block(w, "*Model_Space", MODEL_SPACE, 0x20);
  block(w, "*Paper_Space", PAPER_SPACE, 0x22);
  code(w, 0, "ENDSEC");
  code(w, 0, "SECTION");
  code(w, 2, "ENTITIES");
  for (size_t i = 0; i < s->mark_count && !w->failed; i++) {
    const vs_mark *m = &s->marks[i];
    switch (m->kind) {
    case VS_MARK_LINE: put_line(&out, m); break;
    case VS_MARK_FILL: put_fill(&out, m); break;
    case VS_MARK_TEXT: put_text(&out, m); break;
    }
  }
  code(w, 0, "ENDSEC");
  code(w, 0, "SECTION");
  code(w, 2, "OBJECTS");
  dictionary(w, ROOT, 0);
  code(w, 3, "ACAD_GROUP");
  code_handle(w, 350, GROUPS);
  dictionary(w, GROUPS, ROOT);
  code(w, 0, "ENDSEC");
  code(w, 0, "EOF");
  return !w->failed;
}
