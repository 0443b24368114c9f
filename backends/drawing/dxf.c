/* Writes .dxf (AutoCAD 2000, as text). Debian has no C library that writes this format.
 *
 * Lengths are in model units. A point of the first view has its coordinates in the view's plane, so a plan's points
 * have the model's coordinates. The first view's scale determines the size of the paper and of the other views. Every
 * object has a handle. The file contains only the tables and dictionaries that readers require. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "backends/drawing/dxf.h"

typedef struct {
  vs_writer *w;
  const vs_sheet *s;
  double mm;
  vs_sheet_point shift;
  unsigned handle;
  const vs_scene *scene; /* the drawn scene, which has the pens of the layers */
} writing;

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
 * with four hexadecimal digits. A caret is escaped. A backslash is escaped before U+ or M+, where it would begin an
 * escape. Returns the number of bytes; *text moves to the next character. */
static size_t text_character(const char **text, char as[DXF_CHARACTER]) {
  enum { ENOUGH = 16 }; /* number of bytes that suffices for any escaped character */
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

/* Writes as much of *text as fits on a line of the file. *text moves to the first character that is not written. */
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

/* ---- layers of the program ---- */

enum { NAME = 250 };

/* Writes the name of the program's layer `own` as DXF allows: some signs become underscores. The name is cut to the
 * length of a line. */
static const char *own_name(const writing *out, uint32_t own, char name[NAME]) {
  snprintf(name, NAME, "%.*s", (int)vs_character_cut(out->s->layers[own - 1], NAME - 10), out->s->layers[own - 1]);
  for (char *at = name; *at; at++)
    if (strchr("<>/\\\":;?*|=,`", *at) || (unsigned char)*at < ' ') *at = '_';
  return name[0] ? name : strcpy(name, "_");
}

/* Returns the number of the drawing's own layer with this name, or VS_DRAWN_LAYERS if there is none. */
static int drawn_named(const char *name) {
  int i = 0;
  while (i < VS_DRAWN_LAYERS && strcasecmp(vs_drawn_rows[i].name, name) != 0) i++;
  return i;
}

/* Returns true if the program's layer needs a row in the table of layers, because no layer of the drawing and no
 * earlier layer has its name. */
static bool needs_row(const writing *out, uint32_t own) {
  char name[NAME], other[NAME];
  own_name(out, own, name);
  if (drawn_named(name) < VS_DRAWN_LAYERS || strcmp(name, "0") == 0) return false;
  for (uint32_t i = 1; i < own; i++)
    if (strcasecmp(own_name(out, i, other), name) == 0) return false;
  return true;
}

static const vs_scene_pen *own_pen(const writing *out, uint32_t own) {
  return vs_scene_find_pen(out->scene, out->s->layers[own - 1]);
}

/* Returns the pen of the drawing's layer i: the pen that the program sets for a layer with this name, or NULL. */
static const vs_scene_pen *drawn_pen(const writing *out, unsigned i) {
  char name[NAME];
  const vs_scene_pen *pen = NULL;
  for (uint32_t own = 1; own <= out->s->layer_count && !pen; own++)
    if (strcasecmp(own_name(out, own, name), vs_drawn_rows[i].name) == 0) pen = own_pen(out, own);
  return pen;
}

/* Returns the index of the colour in DXF's table that is nearest to the pen's colour. Indices 1 to 9 are pure colours.
 * From 10 on, there are 24 hues in five shades, full and pale. From 250 on, there are greys. */
static int colour_index(const double rgb[3]) {
  static const double pure[9][3] = { { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0, 1, 1 }, { 0, 0, 1 },
                                     { 1, 0, 1 }, { 1, 1, 1 }, { .5, .5, .5 }, { .75, .75, .75 } };
  static const double shades[5] = { 1, 0.65, 0.5, 0.3, 0.15 };
  int best = 7;
  double least = rgb[0] * rgb[0] + rgb[1] * rgb[1] + rgb[2] * rgb[2]; /* black also has index 7, because readers show
                                                                       * index 7 as black on white paper */
  for (int i = 1; i < 256; i++) {
    double c[3];
    for (int k = 0; k < 3; k++) {
      double hue = fmod((i / 10 - 1) * 15 / 60. - 2 * k + 9, 6) - 3; /* distance of the hue from the hue of component k;
                                                                      * 0: the component has its full value */
      double full = fmin(1, fmax(0, 2 - fabs(hue))), shade = shades[i % 10 / 2];
      c[k] = i < 10 ? pure[i - 1][k] : i >= 250 ? 0.2 + 0.16 * (i - 250) : shade * (i % 2 ? (1 + full) / 2 : full);
    }
    double off = (c[0] - rgb[0]) * (c[0] - rgb[0]) + (c[1] - rgb[1]) * (c[1] - rgb[1]) +
                 (c[2] - rgb[2]) * (c[2] - rgb[2]);
    if (off < least - 1e-9) least = off, best = i;
  }
  return best;
}

/* Returns the line weight of DXF, in hundredths of a millimetre, that is nearest to a width in millimetres. */
static int line_weight(double width) {
  static const int weights[] = { 0,  5,  9,  13, 15, 18, 20,  25,  30,  35,  40,  50,
                                 53, 60, 70, 80, 90, 100, 106, 120, 140, 158, 200, 211 };
  int best = 0;
  for (size_t i = 0; i < sizeof weights / sizeof *weights; i++)
    if (fabs(weights[i] - 100 * width) < fabs(best - 100 * width)) best = weights[i];
  return best;
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

/* Writes a row of the table of layers; pen may be NULL. */
static void layer_row(const writing *out, unsigned handle, const char *name, const vs_layer_row *r,
                      const vs_scene_pen *pen) {
  vs_writer *w = out->w;
  code(w, 0, "LAYER");
  code_handle(w, 5, handle);
  code_handle(w, 330, 0x2);
  code(w, 100, "AcDbSymbolTableRecord");
  code(w, 100, "AcDbLayerTableRecord");
  code_text(w, 2, name);
  code_int(w, 70, 0);
  code_int(w, 62, pen && pen->colored ? colour_index(pen->color) : r->colour);
  code(w, 6, r->dash > 0 ? r->name : "CONTINUOUS");
  code_int(w, 370, pen && pen->line > 0 ? line_weight(pen->line) : r->weight);
  code_handle(w, 390, 0xf);
}

static void layers(const writing *out) {
  static const vs_layer_row solid = { "", 0, 0, 0, 0, 0, 7, 0 };
  char name[NAME];
  uint32_t count = (uint32_t)out->s->layer_count, rows = 0;
  for (uint32_t own = 1; own <= count; own++) rows += needs_row(out, own);
  table(out->w, "LAYER", 0x2, VS_DRAWN_LAYERS + 1 + (long)rows);
  layer_row(out, 0x60, "0", &solid, NULL);
  for (unsigned i = 0; i < VS_DRAWN_LAYERS; i++)
    layer_row(out, 0x61 + i, vs_drawn_rows[i].name, &vs_drawn_rows[i], drawn_pen(out, i));
  for (uint32_t own = 1; own <= count; own++)
    if (needs_row(out, own))
      layer_row(out, FIRST_HANDLE + (unsigned)out->s->mark_count + own, own_name(out, own, name),
                &vs_drawn_rows[VS_DRAWN_EDGE], own_pen(out, own));
  end_table(out->w);
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
  layers(out);
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

/* ---- marks: lines, fills and texts of the sheet ---- */

static double across(const writing *out, double x) { return (x + out->shift.x) / out->mm; }
static double up(const writing *out, double y) { return (y + out->shift.y) / out->mm; }

static void entity(writing *out, const char *type, const vs_mark *m, const char *kind) {
  const vs_layer_row *r = &vs_drawn_rows[m->layer];
  char name[NAME];
  code(out->w, 0, type);
  code_handle(out->w, 5, out->handle++);
  code_handle(out->w, 330, MODEL_SPACE);
  code(out->w, 100, "AcDbEntity");
  code_text(out->w, 8, m->own ? own_name(out, m->own, name) : r->name);
  if (m->own && r->dash > 0) code(out->w, 6, r->name);
  const vs_scene_pen *pen = m->own ? own_pen(out, m->own) : NULL;
  bool by_kind = m->own && !(pen && pen->line > 0) && r->weight != vs_drawn_rows[VS_DRAWN_EDGE].weight;
  if (by_kind) code_int(out->w, 370, r->weight);
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
    entity(out, "LINE", m, "AcDbLine");
    for (uint32_t i = 0; i < 2; i++) {
      code_real(out->w, 10 + (int)i, across(out, out->s->points[m->first + i].x));
      code_real(out->w, 20 + (int)i, up(out, out->s->points[m->first + i].y));
      code_real(out->w, 30 + (int)i, 0);
    }
    return;
  }
  entity(out, "LWPOLYLINE", m, "AcDbPolyline");
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
  entity(out, "MTEXT", m, "AcDbMText");
  code_real(w, 10, across(out, m->at.x));
  code_real(w, 20, up(out, m->at.y));
  code_real(w, 30, 0);
  code_real(w, 40, m->size / out->mm);
  code_real(w, 41, 0); /* width of the text box; 0 means no limit */
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
  entity(out, "TEXT", m, "AcDbText");
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
  code_handle(w, 5, FIRST_HANDLE + (unsigned)(out->s->mark_count + out->s->layer_count) + 1);
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
      first->low.y * first->mm - first->at.y }, FIRST_HANDLE, e->scene };
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
