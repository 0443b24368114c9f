/* Contains the back-ends of the drawing formats .svg, .pdf and .dxf, which write the same sheet (sheet.h). */
#include "backends/drawing/choose_views.h"
#include "backends/drawing/dxf.h"
#include "backends/drawing/pdf.h"
#include "backends/drawing/sheet.h"
#include "backends/drawing/svg.h"

static bool begin(vs_emitter *e) { return vs_loose_begin(e); }
static bool end(vs_emitter *e) { return !e->out->failed; }

static bool draw(vs_emitter *e, bool (*write)(vs_emitter *e, const vs_sheet *s)) {
  vs_flat_view *views = NULL;
  size_t count = 0, room = 0;
  vs_sheet sheet = { .name = "" };
  vs_flat_whole whole = { .made = false };
  bool ok = vs_drawing_choose(e, &views, &count, &room);
  for (size_t i = 0; ok && i < count; i++) ok = vs_flat_view_make(e, &views[i], e->state, &whole);
  size_t shown = 0;
  for (size_t i = 0; ok && i < count; i++) shown += views[i].point_count > 0;
  if (ok && shown == 0) ok = vs_error_set(e->error, VS_ERROR_MODEL, NULL,
      "the view \"%.80s\" shows nothing of the model", views[0].spec.name);
  sheet.layers = whole.layers, sheet.layer_count = whole.layer_count;
  ok = ok && vs_sheet_make(e, &sheet, views, count) && write(e, &sheet);
  if (ok) {
    char text[240];
    vs_sheet_describe(&sheet, text, sizeof text);
    vs_job_note(e->job, text);
  }
  vs_sheet_free(e, &sheet);
  vs_solid_free(&whole.solid);
  vs_emit_release(e, whole.layers, whole.layer_room, sizeof *whole.layers);
  for (size_t i = 0; i < count; i++) vs_flat_view_free(e, &views[i]);
  vs_emit_release(e, views, room, sizeof *views);
  return ok;
}

static bool svg_solid(vs_emitter *e, const vs_solid *none) { return (void)none, draw(e, vs_sheet_write_svg); }
static bool pdf_solid(vs_emitter *e, const vs_solid *none) { return (void)none, draw(e, vs_sheet_write_pdf); }
static bool dxf_solid(vs_emitter *e, const vs_solid *none) { return (void)none, draw(e, vs_sheet_write_dxf); }

#define DRAWING .begin = begin, .end = end, .numbers = VS_NUMBERS_DOUBLE, .objects = true, \
                VS_LOOSE_SHAPES(VS_DRAWS | VS_NAMES)
const vs_backend vs_backend_svg = { DRAWING, .solid = svg_solid };
const vs_backend vs_backend_pdf = { DRAWING, .solid = pdf_solid };
const vs_backend vs_backend_dxf = { DRAWING, .solid = dxf_solid };
