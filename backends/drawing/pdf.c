/* Writes .pdf: the sheet is a page of its true size, and text remains text, in the default font. Uses libharu, which vs
 * loads when it writes the first PDF. */
#define _GNU_SOURCE /* declares memmem */
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "backends/drawing/pdf.h"
#include "backends/drawing/pdf_layers.h"
#include "geometry/dynamic.h"
#include "geometry/text/font.h"
#include "geometry/text/fontfile.h"

static bool load(vs_pdf_library *p, vs_error *e) {
  static const vs_dynamic_name names[] = {
#define PDF_NAME(name) { #name, offsetof(vs_pdf_library, name) },
    VS_PDF_FUNCTIONS(PDF_NAME)
#undef PDF_NAME
  };
  return vs_dynamic_load(VS_LIBRARY_HPDF, "writing .pdf", names, sizeof names / sizeof *names, p, e);
}

static const double point = 72 / 25.4; /* number of points (PDF's unit) in a millimetre */
static HPDF_REAL at(double mm) { return (HPDF_REAL)(mm * point); }

typedef struct {
  const vs_pdf_library *lib;
  HPDF_Page page;
  HPDF_Font font;
  const vs_sheet *s;
  vs_pdf_layers layers;
} writing;

/* Sets line width, colour and grey for a kind of line. pen: pen of the program's layer, or NULL. */
static void set_layer(const writing *w, vs_drawn_layer layer, const vs_scene_pen *pen) {
  const vs_layer_row *r = &vs_drawn_rows[layer];
  w->lib->HPDF_Page_SetLineWidth(w->page, at(pen && pen->line > 0 ? pen->line : r->width));
  if (pen && pen->colored)
    w->lib->HPDF_Page_SetRGBStroke(w->page, (HPDF_REAL)pen->color[0], (HPDF_REAL)pen->color[1],
                                   (HPDF_REAL)pen->color[2]);
  else w->lib->HPDF_Page_SetGrayStroke(w->page, (HPDF_REAL)r->grey);
  w->lib->HPDF_Page_SetGrayFill(w->page, (HPDF_REAL)r->grey);
}

static void outline(const writing *w, uint32_t first, uint32_t count, bool closed) {
  const vs_sheet_point *p = w->s->points + first;
  w->lib->HPDF_Page_MoveTo(w->page, at(p[0].x), at(p[0].y));
  for (uint32_t i = 1; i < count; i++) w->lib->HPDF_Page_LineTo(w->page, at(p[i].x), at(p[i].y));
  if (closed) w->lib->HPDF_Page_ClosePath(w->page);
}

/* Draws the line of a mark as dashes, each a separate line. libharu can dash lines itself, but the unit of its dash
 * lengths differs between its versions. */
static void dashes(const writing *w, const vs_mark *m, const vs_layer_row *r) {
  const double lengths[4] = { r->dash, r->gap, r->dot, r->gap };
  const int turns = r->dot > 0 ? 4 : 2;
  const vs_sheet_point *p = w->s->points + m->first;
  double left = lengths[0];
  int turn = 0;
  w->lib->HPDF_Page_MoveTo(w->page, at(p[0].x), at(p[0].y));
  for (uint32_t i = 0; i + 1 < m->count + (m->closed ? 1 : 0); i++) {
    vs_sheet_point a = p[i], b = p[(i + 1) % m->count];
    double length = hypot(b.x - a.x, b.y - a.y), done = 0;
    while (length - done > left) {
      done += left;
      double x = a.x + (b.x - a.x) * (done / length), y = a.y + (b.y - a.y) * (done / length);
      if (turn % 2 == 0) w->lib->HPDF_Page_LineTo(w->page, at(x), at(y));
      else w->lib->HPDF_Page_MoveTo(w->page, at(x), at(y));
      turn = (turn + 1) % turns;
      left = lengths[turn];
    }
    left -= length - done;
    if (turn % 2 == 0) w->lib->HPDF_Page_LineTo(w->page, at(b.x), at(b.y));
    else w->lib->HPDF_Page_MoveTo(w->page, at(b.x), at(b.y));
  }
}

static void text(const writing *w, const vs_mark *m) {
  double angle = m->angle * (3.14159265358979323846 / 180), c = cos(angle), n = sin(angle);
  w->lib->HPDF_Page_SetFontAndSize(w->page, w->font, (HPDF_REAL)(m->size / 0.729 * point));
      /* x: left end of the text, by its alignment. The font size is the height of the capitals divided by 0.729, which
       * is the ratio of the two in DejaVu. */
  double wide = (double)w->lib->HPDF_Page_TextWidth(w->page, m->text) * m->align, x = m->at.x * point - wide * c,
      y = m->at.y * point - wide * n;
  w->lib->HPDF_Page_BeginText(w->page);
  w->lib->HPDF_Page_SetTextMatrix(w->page, (HPDF_REAL)c, (HPDF_REAL)n, (HPDF_REAL)-n, (HPDF_REAL)c, (HPDF_REAL)x,
      (HPDF_REAL)y);
  w->lib->HPDF_Page_ShowText(w->page, m->text);
  w->lib->HPDF_Page_EndText(w->page);
}

static void put_mark(const writing *w, const vs_mark *m) {
  switch (m->kind) {
  case VS_MARK_LINE:
    if (vs_drawn_rows[m->layer].dash > 0) dashes(w, m, &vs_drawn_rows[m->layer]);
    else outline(w, m->first, m->count, m->closed);
    w->lib->HPDF_Page_Stroke(w->page);
    break;
  case VS_MARK_FILL:
    if (m->layer == VS_DRAWN_FAULT)
      w->lib->HPDF_Page_SetRGBFill(w->page, (HPDF_REAL)vs_fault_color[0], (HPDF_REAL)vs_fault_color[1],
                                   (HPDF_REAL)vs_fault_color[2]);
    else w->lib->HPDF_Page_SetGrayFill(w->page, (HPDF_REAL)m->grey);
    for (uint32_t l = m->first; l < m->first + m->count; l++) outline(w, w->s->loops[l].first, w->s->loops[l].count,
        true);
    w->lib->HPDF_Page_Eofill(w->page);
    break;
  case VS_MARK_TEXT: text(w, m); break;
  }
}

static bool has_marks(const vs_sheet *s, vs_drawn_layer layer, uint32_t own) {
  for (size_t i = 0; i < s->mark_count; i++)
    if (s->marks[i].layer == layer && s->marks[i].own == own) return true;
  return false;
}

/* Draws the marks of one kind of line (layer) that belong to layer number `own` of the program, or to none if own is
 * 0. */
static bool put_marks(vs_emitter *e, const writing *w, vs_drawn_layer layer, uint32_t own) {
  set_layer(w, layer, own ? vs_scene_find_pen(e->scene, w->s->layers[own - 1]) : NULL);
  for (size_t i = 0; i < w->s->mark_count; i++) {
    if (w->s->marks[i].layer == layer && w->s->marks[i].own == own) put_mark(w, &w->s->marks[i]);
    if (!vs_emit_going(e, i + 1)) return false;
  }
  return true;
}

/* Draws all marks. Each kind of line is a layer of the file, and so is each layer of the program. If libharu fails,
 * libharu's error is set and the function returns true. */
static bool put_all(vs_emitter *e, writing *w) {
  for (uint32_t own = 0; own <= w->s->layer_count; own++) {
    bool open = false;
    for (int l = 0; l < VS_DRAWN_LAYERS; l++) {
      if (!has_marks(w->s, (vs_drawn_layer)l, own)) continue;
      if (!open && !vs_pdf_layer_begin(&w->layers, own ? w->s->layers[own - 1] : vs_drawn_rows[l].name)) return true;
      open = own != 0;
      if (!put_marks(e, w, (vs_drawn_layer)l, own)) return false;
      if (!open && !vs_pdf_layer_end(&w->layers)) return true;
    }
    if (open && !vs_pdf_layer_end(&w->layers)) return true;
  }
  return true;
}

/* Repairs the table by which a reader of the .pdf converts letters to Unicode, because readers ignore libharu's form of
 * the table with a warning. Overwrites the table in place, so no position in the file changes. */
static void mend_unicode(char *file, size_t size) {
  static const char table[] = "/CIDInit /ProcSet findresource begin\n12 dict begin\nbegincmap\n"
                              "/CMapName /UTF-8 def\n/CMapType 2 def\n"
                              "1 begincodespacerange\n<0000> <FFFF>\nendcodespacerange\n"
                              "1 beginbfrange\n<0000> <FFFF> <0000>\nendbfrange\nendcmap\nend\nend\n";
  static const char kind[] = "/Type /CMap\n/CMapName /UTF-8\n", packed[] = "/Filter [ /FlateDecode ]",
                    begin[] = "stream\r\n", close[] = "\nendstream";
  const size_t length = sizeof table - 1;
  char *at = memmem(file, size, kind, sizeof kind - 1), *past = file + size;
  char *filter = at ? memmem(at, (size_t)(past - at), packed, sizeof packed - 1) : NULL;
  char *from = filter ? memmem(filter, (size_t)(past - filter), begin, sizeof begin - 1) : NULL;
  char *to = from ? memmem(from, (size_t)(past - from), close, sizeof close - 1) : NULL;
  if (!to || filter - at > 400 || from - filter > 60) return;
  from += sizeof begin - 1;
  if ((size_t)(to - from) < length) return;
  memset(filter, ' ', sizeof packed - 1);
  memcpy(from, table, length);
  memset(from + length, '\n', (size_t)(to - from) - length);
}

static bool hand_over(vs_emitter *e, const vs_pdf_library *lib, HPDF_Doc doc) {
  const size_t size = lib->HPDF_GetStreamSize(doc);
  char *file = vs_store_realloc(e->scene->store, NULL, 0, size + 1);
  if (!file) return vs_emit_no_memory(e);
  lib->HPDF_ResetStream(doc);
  HPDF_UINT32 count = (HPDF_UINT32)size;
  lib->HPDF_ReadFromStream(doc, (HPDF_BYTE *)file, &count); /* at the end of the stream, the returned status is no
                                                             * failure */
  mend_unicode(file, count);
  const bool ok = vs_put(e->out, file, count);
  vs_store_realloc(e->scene->store, file, size + 1, 0);
  return ok;
}

/* Returns true if a page of PDF can be as large as the sheet. Only views without a sheet can be larger. */
static bool check_size(const vs_emitter *e, const vs_sheet *s) {
  static const double most = 5080; /* 200 inches in mm, the limit for pages of PDF */
  if (fmax(s->width, s->height) <= most) return true;
  return vs_error_set(e->error, VS_ERROR_MODEL, NULL,
      "the drawing is %.0f x %.0f mm, and a page of .pdf is at most %g x %g mm; give the view a #:scale, or write .svg "
      "or .dxf", s->width, s->height, most, most);
}

bool vs_sheet_write_pdf(vs_emitter *e, const vs_sheet *s) {
  vs_pdf_library lib;
  char path[1024];
  if (!check_size(e, s) || !load(&lib, e->error)) return false;
  e->error->kind = VS_ERROR_NONE;
  if (!vs_font_file("", path, sizeof path, e->error))
    return e->error->kind != VS_ERROR_NONE ? false : vs_error_set(e->error, VS_ERROR_FILE, NULL,
        "cannot write .pdf: no font is installed; install the package fonts-dejavu-core");
  HPDF_Doc doc = lib.HPDF_NewEx(NULL, NULL, NULL, 0, NULL);
  if (!doc) return vs_emit_no_memory(e);
  writing w = { .lib = &lib, .s = s };
  lib.HPDF_SetCompressionMode(doc, HPDF_COMP_ALL);
  lib.HPDF_UseUTFEncodings(doc);
  lib.HPDF_SetInfoAttr(doc, HPDF_INFO_CREATOR, "VisualScheme");
  const char *name = lib.HPDF_LoadTTFontFromFile(doc, path, HPDF_TRUE);
  w.font = name ? lib.HPDF_GetFont(doc, name, "UTF-8") : NULL;
  w.page = w.font ? lib.HPDF_AddPage(doc) : NULL;
  bool ok = false;
  if (w.page) {
    lib.HPDF_Page_SetWidth(w.page, at(s->width));
    lib.HPDF_Page_SetHeight(w.page, at(s->height));
    lib.HPDF_Page_SetLineCap(w.page, HPDF_ROUND_END);
    lib.HPDF_Page_SetLineJoin(w.page, HPDF_ROUND_JOIN);
    ok = vs_pdf_layers_begin(&w.layers, &lib, doc, w.page) && put_all(e, &w) &&
        lib.HPDF_GetError(doc) == HPDF_OK && lib.HPDF_SaveToStream(doc) == HPDF_OK && hand_over(e, &lib, doc);
  }
  unsigned long problem = (unsigned long)lib.HPDF_GetError(doc);
  lib.HPDF_Free(doc);
  if (ok || e->error->kind != VS_ERROR_NONE || e->out->failed) return ok;
  if (problem == HPDF_FAILD_TO_ALLOC_MEM) return vs_emit_no_memory(e);
  return vs_error_set(e->error, VS_ERROR_FILE, NULL, "writing .pdf: libharu failed with %#lx", problem);
}
