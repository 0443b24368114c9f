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
#include "backends/drawing/dxf_codes.h"

typedef struct {
  vs_writer *w;
  const vs_sheet *s;
  double mm; /* millimetres of paper for a unit of the file's lengths */
  vs_sheet_point shift;
  unsigned handle;
  const vs_scene *scene; /* the drawn scene, which contains the pens of the program's layers */
} writing;

/* ---- layers of the program ---- */

enum { NAME = 250 };

/* Writes the name of the program's layer `own` as DXF allows: underscores replace signs that are not allowed. A name
 * longer than a line of the file is shortened. */
static const char *own_name(const writing *out, uint32_t own, char name[NAME]) {
  snprintf(name, NAME, "%.*s", (int)vs_character_cut(out->s->layers[own - 1], NAME - 10), out->s->layers[own - 1]);
  return vs_dxf_name(name);
}

/* Returns the number of the drawing's own layer (vs_drawn_layer) with this name, or VS_DRAWN_LAYERS if there is
 * none. */
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

/* Returns the pen that the program has set for a layer with the name of the drawing's layer i, or NULL. */
static const vs_scene_pen *drawn_pen(const writing *out, unsigned i) {
  char name[NAME];
  const vs_scene_pen *pen = NULL;
  for (uint32_t own = 1; own <= out->s->layer_count && !pen; own++)
    if (strcasecmp(own_name(out, own, name), vs_drawn_rows[i].name) == 0) pen = own_pen(out, own);
  return pen;
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

/* Writes a row of the table of layers. pen: the program's pen for the layer, or NULL. */
static void layer_row(const writing *out, unsigned handle, const char *name, const vs_layer_row *r,
                      const vs_scene_pen *pen) {
  vs_writer *w = out->w;
  code(w, 0, "LAYER");
  code_handle(w, 5, handle);
  code_handle(w, 330, 0x2);
  code(w, 100, "AcDbSymbolTableRecord");
  code(w, 100, "AcDbLayerTableRecord");
  vs_dxf_text(w, 2, name);
  code_int(w, 70, 0);
  code_int(w, 62, pen && pen->colored ? vs_dxf_colour_index(pen->color) : r->colour);
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
  vs_dxf_text(out->w, 8, m->own ? own_name(out, m->own, name) : r->name);
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
  code_int(w, 62, m->layer == VS_DRAWN_FAULT ? vs_drawn_rows[m->layer].colour : grey_index(m->grey));
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

/* Writes a text that is too long for one line of the file, as MTEXT. Its lower edge is on the base line, so that it is
 * placed higher than other text by the depth of the letter p. */
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
  code_int(w, 72, 1); /* the text runs from left to right */
  vs_dxf_long_text(w, m->text);
  code_real(w, 11, cos(turn));
  code_real(w, 21, sin(turn));
  code_real(w, 31, 0);
}

static void put_text(writing *out, const vs_mark *m) {
  vs_writer *w = out->w;
  int align = m->align < 0.25 ? 0 : m->align < 0.75 ? 1 : 2;
  if (!vs_dxf_text_is_short(m->text)) {
    put_long_text(out, m, align);
    return;
  }
  entity(out, "TEXT", m, "AcDbText");
  code_real(w, 10, across(out, m->at.x));
  code_real(w, 20, up(out, m->at.y));
  code_real(w, 30, 0);
  code_real(w, 40, m->size / out->mm);
  vs_dxf_text(w, 1, m->text);
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
  code(w, 0, "SECTION");
  code(w, 2, "HEADER");
  code(w, 9, "$ACADVER");
  code(w, 1, "AC1015");
  code(w, 9, "$DWGCODEPAGE");
  code(w, 3, "ANSI_1252");
  code(w, 9, "$INSUNITS");
  code_int(w, 70, vs_dxf_unit(e->options->units != NULL ? e->options->units : e->scene->units));
  code(w, 9, "$LWDISPLAY");
  code_int(w, 290, 1);
  code(w, 9, "$HANDSEED");
  code_handle(w, 5, FIRST_HANDLE + (unsigned)(out->s->mark_count + out->s->layer_count) + 1);
  code(w, 0, "ENDSEC");
}

bool vs_sheet_write_dxf(vs_emitter *e, const vs_sheet *s) {
  vs_writer *w = e->out;
  const vs_flat_view *first = &s->views[0];
  writing out = { .w = w, .s = s, .handle = FIRST_HANDLE, .scene = e->scene,
    .mm = first->mm / vs_export_units(e->scene, e->options->units),
    .shift = { first->low.x * first->mm - first->at.x, first->low.y * first->mm - first->at.y } };
  header(e, &out);
  tables(&out);
  code(w, 0, "SECTION");
  code(w, 2, "BLOCKS");
  begin_block(w, "*Model_Space", MODEL_SPACE, 0x20);
  end_block(w, MODEL_SPACE, 0x21);
  begin_block(w, "*Paper_Space", PAPER_SPACE, 0x22);
  end_block(w, PAPER_SPACE, 0x23);
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
