/* Owns the web page: viewer/page.html with its marks filled in, x3dom and the scene inside, nothing to load.
 *
 * A mark is <!--NAME-->. The parts come from the library itself: the Makefile puts viewer/ and node_modules/x3dom/ into it. */
#include <string.h>

#include "backends/x3d/x3d.h"

#define ASSET(name) extern const char vs_asset_##name[], vs_asset_##name##_end[];
ASSET(page_html) ASSET(viewer_css) ASSET(viewer_js) ASSET(x3dom_js) ASSET(x3dom_css)
#undef ASSET

/* Inside <script> and <style> nothing is escaped, but </ would end them. */
static void page_code(vs_writer *w, const char *from, const char *end) {
  while (from < end) {
    const char *at = from;
    while (at < end && !(at[0] == '<' && at + 8 <= end && (memcmp(at, "</script", 8) == 0 || memcmp(at, "</style>", 8) == 0))) at++;
    vs_put(w, from, (size_t)(at - from));
    if (at < end) {
      vs_puts(w, "<\\/");
      at += 2;
    }
    from = at;
  }
}

static void page_facts(vs_emitter *e) {
  vs_vec3 size = vs_v3_sub(e->bounds.max, e->bounds.min);
  const double xyz[] = { size.x, size.y, size.z };
  for (int i = 0; i < 3; i++) {
    if (i > 0) vs_puts(e->out, " &times; ");
    double steps = xyz[i] >= 100 ? 1 : xyz[i] >= 1 ? 100 : 10000;
    vs_put_number(e->out, round(xyz[i] * steps) / steps);
  }
  vs_puts(e->out, " ");
  vs_put_xml(e->out, e->scene->units != NULL ? e->scene->units : "m");
}

static bool page_scene(vs_emitter *e) {
  vs_x3d *x = e->state;
  vs_puts(e->out, "<x3d id='x3d' width='100%' height='100%' showStat='false' showLog='false' disableDoubleClick='false' keysEnabled='true'>\n<scene>\n");
  x->depth = 1;
  return vs_x3d_scene(e) && vs_puts(e->out, "</scene>\n</x3d>");
}

static bool page_part(vs_emitter *e, const char *name, size_t length) {
  static const struct { const char *name, *from, *end; } code[] = {
    { "viewer.css", vs_asset_viewer_css, vs_asset_viewer_css_end }, { "viewer.js", vs_asset_viewer_js, vs_asset_viewer_js_end },
    { "x3dom.css", vs_asset_x3dom_css, vs_asset_x3dom_css_end }, { "x3dom.js", vs_asset_x3dom_js, vs_asset_x3dom_js_end },
  };
  for (size_t i = 0; i < sizeof code / sizeof *code; i++)
    if (strlen(code[i].name) == length && memcmp(code[i].name, name, length) == 0) page_code(e->out, code[i].from, code[i].end);
  if (length == 5 && memcmp(name, "title", 5) == 0) vs_put_xml(e->out, e->scene->title);
  if (length == 5 && memcmp(name, "facts", 5) == 0) page_facts(e);
  if (length == 5 && memcmp(name, "scene", 5) == 0) return page_scene(e);
  return !e->out->failed;
}

static bool page_begin(vs_emitter *e) {
  if ((uintptr_t)vs_asset_x3dom_js_end - (uintptr_t)vs_asset_x3dom_js < 1000)
    return vs_error_set(e->error, VS_ERROR_WORKER, NULL, "this vs was built without x3dom, the viewer inside pages: run `npm install --ignore-scripts` and build again");
  return vs_x3d_open(e, VS_X3D_PAGE);
}

static bool page_end(vs_emitter *e) {
  const char *at = vs_asset_page_html, *end = vs_asset_page_html_end;
  while (at < end) {
    const char *mark = at;
    while (mark < end && !(end - mark > 7 && memcmp(mark, "<!--", 4) == 0)) mark++;
    vs_put(e->out, at, (size_t)(mark - at));
    if (mark >= end) break;
    const char *name = mark + 4, *stop = name;
    while (stop < end && *stop != '-') stop++;
    if (!page_part(e, name, (size_t)(stop - name))) return false;
    at = stop + 3;
  }
  return !e->out->failed;
}

const vs_backend vs_backend_html = { VS_X3D_BACKEND(page_begin, page_end), .ghosts = VS_MARKS_PAINT };
