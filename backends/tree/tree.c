/* Writes the tree dump: the model as nested lists. The table of kinds alone determines the text. tree_reader.c reads
 * it.
 *
 * (tree 1 "house" (define t1 (sweep (twist 0) ... (circle ...) (line ...))) (draw (unite (box (p 0 0 0) (q 1 2 3))
 * t1))) A node is (kind (field value ...) ... child ...). The dump contains every node, including empty nodes, and each
 * shared node once. */
#include "backends/backend.h"

static bool tree_text(vs_writer *w, const char *text) {
  vs_puts(w, "\"");
  char spelled[VS_SPELLED_ROOM];
  for (const char *at = text, *end = text + strlen(text); at < end && !w->failed;) {
    if (*at == '"' || *at == '\\') vs_puts(w, "\\");
    if (*at == '\n') vs_puts(w, "\\n"), at++;
    else vs_put(w, spelled, vs_spell_plain(&at, end, spelled));
  }
  return vs_puts(w, "\"");
}

static bool tree_numbers(vs_writer *w, const double *numbers, size_t count) {
  for (size_t i = 0; i < count; i++) {
    vs_puts(w, " ");
    vs_put_number(w, numbers[i]);
  }
  return !w->failed;
}

static bool tree_material(vs_writer *w, const vs_material *m) {
  const double numbers[] = { m->red, m->green, m->blue, m->roughness, m->metallic, m->transparency, m->ior };
  vs_puts(w, " ");
  tree_text(w, m->name);
  tree_numbers(w, numbers, sizeof numbers / sizeof *numbers);
  if (m->pattern.kind == VS_PATTERN_NONE || m->pattern.picture) return !w->failed;
  const double pattern[] = { m->pattern.red, m->pattern.green, m->pattern.blue, m->pattern.size, m->pattern.angle };
  vs_puts(w, " ");
  tree_text(w, vs_pattern_name(m->pattern.kind));
  return tree_numbers(w, pattern, sizeof pattern / sizeof *pattern);
}

static void tree_field(vs_writer *w, const vs_field_info *f, const void *data) {
  const void *at = (const char *)data + f->offset;
  vs_putf(w, " (%s", f->argument);
  switch (f->type) {
  case VS_FIELD_real: tree_numbers(w, at, 1); break;
  case VS_FIELD_point: case VS_FIELD_vector: tree_numbers(w, at, 3); break;
  case VS_FIELD_affine: tree_numbers(w, at, 12); break;
  case VS_FIELD_integer: vs_putf(w, " %ld", (long)*(const vs_field_integer *)at); break;
  case VS_FIELD_boolean: vs_puts(w, *(const vs_field_boolean *)at ? " #t" : " #f"); break;
  case VS_FIELD_points: {
    const vs_points *points = *(const vs_field_points *)at;
    for (uint32_t i = 0; i < points->count; i++) {
      const double xyz[] = { points->at[i].x, points->at[i].y, points->at[i].z };
      vs_puts(w, " (");
      for (int k = 0; k < 3; k++) {
        if (k > 0) vs_puts(w, " ");
        vs_put_number(w, xyz[k]);
      }
      vs_puts(w, ")");
    }
    break;
  }
  case VS_FIELD_faces: {
    const vs_faces *faces = *(const vs_field_faces *)at;
    const uint32_t *starts = vs_faces_starts(faces), *corners = vs_faces_corners(faces);
    for (uint32_t i = 0; i < faces->count; i++) {
      vs_puts(w, " (");
      for (uint32_t k = starts[i]; k < starts[i + 1]; k++) {
        if (k > starts[i]) vs_puts(w, " ");
        vs_put_u32(w, corners[k]);
      }
      vs_puts(w, ")");
    }
    break;
  }
  case VS_FIELD_text:
    vs_puts(w, " ");
    tree_text(w, *(const vs_field_text *)at);
    break;
  case VS_FIELD_ticket: vs_putf(w, " %lu", (unsigned long)(*(const vs_field_ticket *)at)->id); break;
  case VS_FIELD_material: tree_material(w, *(const vs_field_material *)at); break;
  }
  vs_puts(w, ")");
}

/* Begins a line for a node. The first node of a define or draw stays on its parent's line. */
static void tree_open(vs_emitter *e) {
  if (e->depth > 0) {
    vs_puts(e->out, "\n");
    vs_put_spaces(e->out, 2 + 2 * (e->depth < 60 ? e->depth : 60));
  } else {
    vs_puts(e->out, " ");
  }
}

static vs_emit_status tree_node(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  vs_writer *w = e->out;
  if (phase == VS_PHASE_LEAVE) return vs_puts(w, ")") ? VS_EMITTED : VS_FAILED;
  const vs_kind_info *info = vs_kind_get((vs_kind)ref->node->kind);
  tree_open(e);
  vs_putf(w, "(%s", info->name);
  for (size_t i = 0; i < info->field_count; i++) tree_field(w, &info->fields[i], vs_node_data(ref->node));
  if (phase == VS_PHASE_LEAF) vs_puts(w, ")");
  return w->failed ? VS_FAILED : VS_EMITTED;
}

static bool tree_begin(vs_emitter *e) {
  vs_puts(e->out, "(tree 1 ");
  return tree_text(e->out, e->scene->title);
}

static bool tree_end(vs_emitter *e) { return vs_puts(e->out, ")\n"); }

static bool tree_item(vs_emitter *e, size_t index, bool end) {
  (void)index;
  return vs_puts(e->out, end ? ")" : "\n  (draw");
}

static bool tree_define(vs_emitter *e, uint32_t id, const vs_ref *ref, bool open) {
  (void)ref;
  return open ? vs_putf(e->out, "\n  (define t%lu", (unsigned long)id) : vs_puts(e->out, ")");
}

static bool tree_use(vs_emitter *e, uint32_t id, const vs_ref *ref) {
  (void)ref;
  tree_open(e);
  return vs_puts(e->out, "t") && vs_emit_put_template_number(e, id);
}

const vs_backend vs_backend_tree = {
  .begin = tree_begin, .item = tree_item, .end = tree_end, .define = tree_define, .use = tree_use,
  .traits = VS_VERBATIM | VS_KEEPS_TEXT,
  .emit = {
#define VS_KIND(upper, lower, name, class_, level, role, traits) [VS_##upper] = { tree_node, NULL },
#define VS_FIELD(type, member, argument)
#define VS_KIND_END(upper, lower)
#include "model/prims.def"
  },
};
