/* Writes the web page: replaces the marks in backends/page/page.html. The page contains the viewer and the scene.
 *
 * A mark is <!--NAME-->. The texts that replace marks are in the library: the Makefile bundles backends/page/ with
 * three.js into it. The scene is packed (packed.c), compressed (deflate.c) and written in base64, so no text of the
 * user is ever read as HTML or script. */
#include <string.h>

#include "backends/x3d/deflate.h"
#include "backends/x3d/packed.h"

#define ASSET(name) extern const char vs_asset_##name[], vs_asset_##name##_end[];
ASSET(page_html) ASSET(viewer_css) ASSET(viewer_js)
#undef ASSET

/* The writer of the page, and the writers through which the scene passes: `inner` writes to zlib, and `deflated` writes
 * zlib's output through page_encode. The packed notation uses e->state. */
typedef struct {
  vs_writer inner, deflated, *outer;
  vs_deflate *deflate;
  unsigned char left[3];
  size_t left_count;
} page_coder;

static bool page_encode(void *context, const void *bytes, size_t count) {
  page_coder *c = context;
  const unsigned char *at = bytes, *end = at + count;
  while (at < end) {
    if (c->left_count == 0 && end - at >= 3) {
      vs_put_base64(c->outer, at, 3);
      at += 3;
      continue;
    }
    c->left[c->left_count++] = *at++;
    if (c->left_count == 3) {
      vs_put_base64(c->outer, c->left, 3);
      c->left_count = 0;
    }
  }
  return !c->outer->failed;
}

/* Writes code between <script> or <style> tags. Such code has no escapes, but a </ in a string would end it; the
 * function prevents this. */
static void page_code(vs_writer *w, const char *from, const char *end) {
  while (from < end) {
    const char *at = from;
    while (at < end &&
           !(at[0] == '<' && at + 8 <= end && (memcmp(at, "</script", 8) == 0 || memcmp(at, "</style>", 8) == 0)))
      at++;
    vs_put(w, from, (size_t)(at - from));
    if (at < end) {
      vs_puts(w, "<\\/");
      at += 2;
    }
    from = at;
  }
}

/* Writes the page's text from `at` to the mark of the scene, or to the page's end, and replaces other marks in between.
 * Returns the position after the written text. */
static const char *page_until_scene(vs_emitter *e, vs_writer *w, const char *at) {
  const char *end = vs_asset_page_html_end;
  while (at < end) {
    const char *mark = at;
    while (mark < end && !(end - mark > 7 && memcmp(mark, "<!--", 4) == 0)) mark++;
    vs_put(w, at, (size_t)(mark - at));
    if (mark >= end) return end;
    const char *name = mark + 4, *stop = name;
    while (stop < end && *stop != '-') stop++;
    size_t length = (size_t)(stop - name);
    at = stop + 3;
    if (length == 5 && memcmp(name, "scene", 5) == 0) return at;
    if (length == 5 && memcmp(name, "title", 5) == 0) vs_put_xml(w, e->scene->title);
    if (length == 10 && memcmp(name, "viewer.css", 10) == 0) page_code(w, vs_asset_viewer_css, vs_asset_viewer_css_end);
    if (length == 9 && memcmp(name, "viewer.js", 9) == 0) page_code(w, vs_asset_viewer_js, vs_asset_viewer_js_end);
  }
  return end;
}

static bool page_begin(vs_emitter *e) {
  if ((uintptr_t)vs_asset_viewer_js_end - (uintptr_t)vs_asset_viewer_js < 1000)
    return vs_error_set(
        e->error, VS_ERROR_WORKER, NULL,
        "this vs was built without the viewer inside pages: run `npm ci --ignore-scripts` and build again");
  page_coder *c = vs_store_realloc(e->scene->store, NULL, 0, sizeof *c);
  if (c == NULL) return vs_emit_no_memory(e);
  c->outer = e->out;
  c->left_count = 0;
  memset(c->left, 0, sizeof c->left);
  page_until_scene(e, c->outer, vs_asset_page_html);
  vs_writer_init(&c->deflated, page_encode, c);
  c->deflate = vs_deflate_begin(e->scene->store, &c->deflated, e->error);
  vs_writer_init(&c->inner, vs_deflate_put, c->deflate);
  e->out = &c->inner;
  bool ok = c->deflate != NULL && vs_packed_open(e);
  if (c->deflate != NULL && e->state != NULL) return ok; /* if all parts of *c were created, the caller releases them by
                                                          * page_close */
  vs_deflate_end(c->deflate);
  e->out = c->outer;
  vs_emit_release(e, c, 1, sizeof *c);
  return false;
}

static bool page_end(vs_emitter *e) {
  page_coder *c = (page_coder *)e->out; /* e->out points to the first member of a page_coder */
  bool ok = vs_packed_finish(e) && vs_writer_flush(&c->inner) && vs_deflate_finish(c->deflate) &&
            vs_writer_flush(&c->deflated);
  if (c->left_count > 0) {
    memset(c->left + c->left_count, 0, 3 - c->left_count);
    vs_put_base64(c->outer, c->left, c->left_count);
  }
  const char *at = vs_asset_page_html;
  while (at < vs_asset_page_html_end && memcmp(at, "<!--scene-->", 12) != 0) at++;
  page_until_scene(e, c->outer, at + 12);
  return ok && !c->outer->failed;
}

static void page_close(vs_emitter *e) {
  if (e->state == NULL) return;
  page_coder *c = (page_coder *)e->out;
  vs_packed_close(e);
  vs_deflate_end(c->deflate);
  e->out = c->outer;
  vs_emit_release(e, c, 1, sizeof *c);
}

const vs_backend vs_backend_html = { VS_PACKED_BACKEND(page_begin, page_end, page_close, vs_packed_boolean) };
