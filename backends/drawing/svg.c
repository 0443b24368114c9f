/* Writes .svg: the sheet in millimetres, with a group for each layer, which contains a group for each view. The layers
 * of the program follow those of the drawing. Text remains text. Inkscape and other programs show the groups as
 * layers. */
#include <string.h>

#include "backends/drawing/svg.h"

static void number(vs_writer *w, double x) { vs_put_number(w, (double)(long long)(x * 1000 + (x < 0 ? -0.5 :
    0.5)) / 1000); } /* rounds the number to thousandths of a millimetre */

static void pair(vs_writer *w, const vs_sheet *s, vs_sheet_point p) {
  number(w, p.x);
  vs_puts(w, " ");
  number(w, s->height - p.y);
}

static void outline(vs_writer *w, const vs_sheet *s, uint32_t first, uint32_t count, bool closed) {
  for (uint32_t i = 0; i < count; i++) {
    vs_puts(w, i == 0 ? "M" : i == 1 ? "L" : " ");
    pair(w, s, s->points[first + i]);
  }
  vs_puts(w, closed ? "Z\n" : "\n");
}

static void colour(vs_writer *w, const char *name, double grey) {
  unsigned level = (unsigned)(255 * grey + 0.5);
  vs_putf(w, " %s=\"#%02x%02x%02x\"", name, level, level, level);
}

static void painted(vs_writer *w, const char *name, const double color[3]) {
  vs_putf(w, " %s=\"#%02x%02x%02x\"", name, (unsigned)(255 * color[0] + 0.5), (unsigned)(255 * color[1] + 0.5),
          (unsigned)(255 * color[2] + 0.5));
}

static void text(vs_writer *w, const vs_sheet *s, const vs_mark *m) {
  static const char *const anchors[] = { "start", "middle", "end" };
  vs_puts(w, "<text x=\"");
  number(w, m->at.x);
  vs_puts(w, "\" y=\"");
  number(w, s->height - m->at.y);
  vs_puts(w, "\" font-size=\"");
  number(w, m->size / 0.729); /* font size: the height of capitals divided by 0.729, the ratio of the two in the font
                               * DejaVu */
  vs_putf(w, "\" text-anchor=\"%s\"", anchors[m->align < 0.25 ? 0 : m->align < 0.75 ? 1 : 2]);
  if (m->angle != 0) {
    vs_puts(w, " transform=\"rotate(");
    number(w, -m->angle);
    vs_puts(w, " ");
    pair(w, s, m->at);
    vs_puts(w, ")\"");
  }
  vs_puts(w, ">");
  vs_put_xml(w, m->text);
  vs_puts(w, "</text>\n");
}

/* Writes the marks of one layer that belong to one view. Lines are joined in paths of at most about 2000 points,
 * because programs limit the length of a path. */
static void group(vs_writer *w, const vs_sheet *s, const uint32_t *order, size_t from, size_t to) {
  size_t open = 0;
  for (size_t i = from; i < to && !w->failed; i++) {
    const vs_mark *m = &s->marks[order[i]];
    if (open > 0 && (m->kind != VS_MARK_LINE || open > 2000)) vs_puts(w, "\"/>\n"), open = 0;
    switch (m->kind) {
    case VS_MARK_LINE:
      if (open == 0) vs_puts(w, "<path d=\"");
      open += m->count;
      outline(w, s, m->first, m->count, m->closed);
      break;
    case VS_MARK_FILL:
      vs_puts(w, "<path");
      if (m->layer == VS_DRAWN_FAULT) painted(w, "fill", vs_fault_color);
      else colour(w, "fill", m->grey);
      vs_puts(w, " d=\"");
      for (uint32_t l = m->first; l < m->first + m->count; l++) outline(w, s, s->loops[l].first, s->loops[l].count,
          true);
      vs_puts(w, "\"/>\n");
      break;
    case VS_MARK_TEXT: text(w, s, m); break;
    }
  }
  if (open > 0) vs_puts(w, "\"/>\n");
}

/* The marks of one kind of line in one layer of the program: order[from] to order[to - 1]. */
typedef struct {
  const uint32_t *order;
  size_t from, to;
} chosen;

static void style(vs_writer *w, vs_drawn_layer which, const vs_scene_pen *pen) {
  const vs_layer_row *r = &vs_drawn_rows[which];
  if (which == VS_DRAWN_FILL || which == VS_DRAWN_FAULT) {
    vs_puts(w, " stroke=\"none\" fill-rule=\"evenodd\"");
  } else if (which == VS_DRAWN_TEXT) {
    colour(w, "fill", r->grey);
    vs_puts(w, " font-family=\"DejaVu Sans, sans-serif\"");
  } else {
    vs_puts(w, " fill=\"none\"");
    if (pen && pen->colored) painted(w, "stroke", pen->color);
    else colour(w, "stroke", r->grey);
    vs_puts(w, " stroke-width=\"");
    number(w, pen && pen->line > 0 ? pen->line : r->width);
    vs_puts(w, "\" stroke-linecap=\"round\" stroke-linejoin=\"round\"");
  }
  const double dashes[] = { r->dash, r->gap, r->dot, r->gap };
  for (int i = 0; r->dash > 0 && i < (r->dot > 0 ? 4 : 2); i++) {
    vs_puts(w, i == 0 ? " stroke-dasharray=\"" : " ");
    number(w, dashes[i]);
  }
  vs_puts(w, r->dash > 0 ? "\">\n" : ">\n");
}

static void each_view(vs_writer *w, const vs_sheet *s, const chosen *c) {
  for (size_t i = c->from, end; i < c->to; i = end) {
    uint32_t view = s->marks[c->order[i]].view;
    for (end = i; end < c->to && s->marks[c->order[end]].view == view; end++) {}
    if (view < s->view_count) {
      vs_putf(w, "<g class=\"view-%u\"><title>", view + 1);
      vs_put_xml(w, s->views[view].spec.name);
      vs_puts(w, "</title>\n");
    }
    group(w, s, c->order, i, end);
    if (view < s->view_count) vs_puts(w, "</g>\n");
  }
}

/* Writes all marks of one kind of line (`which`) in one layer of the program. own: number of the program's layer; 0:
 * marks in no layer. The first group in a layer of the program opens the group of this layer. */
static bool layer(vs_emitter *e, const vs_sheet *s, uint32_t *order, vs_drawn_layer which, uint32_t own, bool *open) {
  vs_writer *w = e->out;
  chosen c = { order, 0, 0 };
  for (uint32_t view = 0; view <= s->view_count; view++) /* visits all marks again for each view, because there are few
                                                          * views */
    for (size_t i = 0; i < s->mark_count; i++)
      if (s->marks[i].layer == which && s->marks[i].own == own && s->marks[i].view == view)
        order[c.to++] = (uint32_t)i;
  if (c.to == 0) return true;
  const vs_scene_pen *pen = own ? vs_scene_find_pen(e->scene, s->layers[own - 1]) : NULL;
  if (own && !*open) {
    vs_putf(w, "<g id=\"layer-%u\" inkscape:groupmode=\"layer\" inkscape:label=\"", (unsigned)own);
    vs_put_xml(w, s->layers[own - 1]);
    vs_puts(w, "\">\n");
    *open = true;
  }
  if (own) vs_putf(w, "<g class=\"%s\"", vs_drawn_rows[which].name);
  else vs_putf(w, "<g id=\"%s\" inkscape:groupmode=\"layer\" inkscape:label=\"%s\"", vs_drawn_rows[which].name,
               vs_drawn_rows[which].name);
  style(w, which, pen);
  each_view(w, s, &c);
  return vs_puts(w, "</g>\n");
}

bool vs_sheet_write_svg(vs_emitter *e, const vs_sheet *s) {
  vs_writer *w = e->out;
  vs_store *store = e->scene->store;
  uint32_t *order = vs_store_realloc(store, NULL, 0, (s->mark_count + 1) * sizeof *order);
  if (!order) return vs_emit_no_memory(e);
  vs_puts(w, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\""
             " xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\"");
  vs_puts(w, " width=\"");
  number(w, s->width);
  vs_puts(w, "mm\" height=\"");
  number(w, s->height);
  vs_puts(w, "mm\" viewBox=\"0 0 ");
  number(w, s->width);
  vs_puts(w, " ");
  number(w, s->height);
  vs_puts(w, "\">\n<title>");
  vs_put_xml(w, e->scene->title);
  vs_puts(w, "</title>\n");
  if (!s->bare) vs_puts(w, "<rect id=\"paper\" width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n");
  for (uint32_t own = 0; own <= s->layer_count; own++) {
    bool open = false;
    for (int l = 0; l < VS_DRAWN_LAYERS && !w->failed; l++) layer(e, s, order, (vs_drawn_layer)l, own, &open);
    if (open) vs_puts(w, "</g>\n");
  }
  vs_store_realloc(store, order, (s->mark_count + 1) * sizeof *order, 0);
  return vs_puts(w, "</svg>\n");
}
