/* Implements the formats that a host defines (vs_register_format). Each is a back-end like those of the library; its
 * emit functions call the host's callbacks.
 *
 * As for every format, the driver visits the nodes of the drawing, and replaces a node whose kind has no callback by
 * simpler nodes. Placements, materials, layers and unions need no callback: each object is passed to the host with its
 * placement, material and layer. */
#include "session/own_formats.h"

#include <string.h>

#include "backends/backend.h"
#include "session/session.h"

struct vs_own_format {
  vs_backend backend; /* must be the first member: an emitter's pointer to it is converted to vs_own_format */
  vs_format format;
  vs_format_kind kinds[VS_KIND_COUNT]; /* kinds[k]: callbacks for kind k; `write` is NULL if the host has none */
  bool (*begin)(void *context, vs_output *out);
  bool (*end)(void *context, vs_output *out);
  void *context;
  vs_own_format *next;
};

/* The emitter's state while it writes a format of the host. */
typedef struct {
  const char **layers; /* names of the open layers, outermost first */
  size_t layer_count, layer_room;
  const vs_ref *now;   /* the object that is being written, whose place an error message shows */
} own_state;

/* Converts an output to its emitter: vs_output is the emitter's type in the public interface. */
static vs_emitter *own_emitter(vs_output *out) { return (vs_emitter *)(void *)out; }
static vs_output *own_output(vs_emitter *e) { return (vs_output *)(void *)e; }
static const vs_own_format *own_format(const vs_emitter *e) { return (const vs_own_format *)(const void *)e->backend; }

/* ---- functions that the host's callbacks may call ---- */

bool vs_output_write(vs_output *out, const void *bytes, size_t count) {
  return vs_put(own_emitter(out)->out, bytes, count);
}
bool vs_output_print(vs_output *out, const char *text) { return vs_puts(own_emitter(out)->out, text); }
bool vs_output_number(vs_output *out, double x) { return vs_put_number(own_emitter(out)->out, x); }

bool vs_output_fail(vs_output *out, const char *message) {
  vs_emitter *e = own_emitter(out);
  const own_state *s = e->state;
  return vs_emit_fail(e, s != NULL ? s->now : NULL, message);
}

static const vs_field_info *own_field(const vs_node *n, const char *name) {
  const vs_kind_info *info = vs_kind_get((vs_kind)n->kind);
  for (size_t i = 0; i < info->field_count; i++)
    if (!strcmp(info->fields[i].argument, name)) return &info->fields[i];
  return NULL;
}

size_t vs_thing_numbers(const vs_thing *t, const char *field, double *out, size_t room) {
  const vs_node *n = ((const vs_ref *)t->thing)->node;
  const vs_field_info *f = own_field(n, field);
  if (f == NULL) return 0;
  const char *at = (const char *)vs_node_data(n) + f->offset;
  double one;
  const double *from = &one;
  size_t count = vs_field_reals[f->type];
  if (f->type == VS_FIELD_integer) one = (double)*(const vs_field_integer *)(const void *)at, count = 1;
  else if (f->type == VS_FIELD_boolean) one = *(const vs_field_boolean *)(const void *)at ? 1 : 0, count = 1;
  else if (f->type == VS_FIELD_points) {
    const vs_points *points = *(const vs_field_points *)(const void *)at;
    from = &points->at[0].x, count = 3 * (size_t)points->count;
  } else if (count > 0) from = (const double *)(const void *)at;
  for (size_t i = 0; i < count && i < room; i++) out[i] = from[i];
  return count;
}

const char *vs_thing_text(const vs_thing *t, const char *field) {
  const vs_node *n = ((const vs_ref *)t->thing)->node;
  const vs_field_info *f = own_field(n, field);
  if (f == NULL || f->type != VS_FIELD_text) return NULL;
  return *(const vs_field_text *)(const void *)((const char *)vs_node_data(n) + f->offset);
}

bool vs_thing_triangles(vs_output *out, const vs_thing *t, vs_triangles *result) {
  vs_emitter *e = own_emitter(out);
  const vs_ref *ref = t->thing;
  *result = (vs_triangles){ 0 };
  if (ref->node->class_ == VS_CURVE) return vs_emit_fail(e, ref, "a curve has no triangles");
  const vs_solid *m = vs_emit_mesh(e, ref);
  if (m == NULL || !vs_emit_triangles(e, m->mesh.triangle_count)) return false;
  result->points = (const double (*)[3])(const void *)m->mesh.vertices, result->point_count = m->mesh.vertex_count;
  result->corners = (const uint32_t (*)[3])m->mesh.triangles, result->count = m->mesh.triangle_count;
  return true;
}

/* ---- the back-end that calls the host's callbacks ---- */

static bool own_begin(vs_emitter *e) {
  own_state *s = vs_store_realloc(e->scene->store, NULL, 0, sizeof *s);
  if (s == NULL) return vs_emit_no_memory(e);
  *s = (own_state){ 0 };
  e->state = s;
  const vs_own_format *f = own_format(e);
  return f->begin == NULL || f->begin(f->context, own_output(e));
}

static bool own_end(vs_emitter *e) {
  const vs_own_format *f = own_format(e);
  ((own_state *)e->state)->now = NULL;
  return (f->end == NULL || f->end(f->context, own_output(e))) && !e->out->failed;
}

static void own_close(vs_emitter *e) {
  own_state *s = e->state;
  if (s == NULL) return;
  vs_emit_release(e, s->layers, s->layer_room, sizeof *s->layers);
  vs_emit_release(e, s, 1, sizeof *s);
  e->state = NULL;
}

static bool own_layer(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  own_state *s = e->state;
  if (ref->node->kind != VS_LAYER) return true;
  if (phase == VS_PHASE_LEAVE) return s->layer_count--, true;
  if (!vs_emit_grow(e, &s->layers, &s->layer_room, s->layer_count + 1, sizeof *s->layers)) return false;
  s->layers[s->layer_count++] = VS_AS(layer, ref->node)->name;
  return true;
}

static vs_emit_status own_status(vs_emitter *e, vs_kind_status status, vs_phase phase) {
  switch (status) {
  case VS_KIND_WRITTEN: return e->out->failed ? VS_FAILED : VS_EMITTED;
  case VS_KIND_WHOLE: return e->out->failed ? VS_FAILED : phase == VS_PHASE_ENTER ? VS_WHOLE : VS_EMITTED;
  case VS_KIND_SIMPLER: return VS_LOWER;
  case VS_KIND_FAILED: break;
  }
  if (e->error->kind == VS_ERROR_NONE) vs_output_fail(own_output(e), "the host's format failed");
  return VS_FAILED;
}

static vs_emit_status own_emit(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  const vs_own_format *f = own_format(e);
  const vs_format_kind *row = &f->kinds[ref->node->kind];
  own_state *s = e->state;
  const char *layer = s->layer_count > 0 ? s->layers[s->layer_count - 1] : "";
  if (!own_layer(e, ref, phase)) return VS_FAILED;
  if (row->write == NULL) return VS_EMITTED; /* without a callback, the node can only be a placement, material, layer or
                                              * union, whose children are emitted next */
  static const vs_thing_phase phases[] = { [VS_PHASE_LEAF] = VS_THING_LEAF, [VS_PHASE_ENTER] = VS_THING_ENTER,
      [VS_PHASE_LEAVE] = VS_THING_LEAVE };
  const vs_material *m = e->material;
  vs_thing t = { .kind = vs_kind_get((vs_kind)ref->node->kind)->name, .phase = phases[phase], .layer = layer,
                 .child_count = phase == VS_PHASE_ENTER ? e->child_count : 0,
                 .material = m != NULL ? m->name : "", .painted = m != NULL, .thing = ref };
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 4; k++) t.place[i][k] = e->placement.m[i][k];
  if (m != NULL) t.color[0] = m->red, t.color[1] = m->green, t.color[2] = m->blue, t.color[3] = 1 - m->transparency;
  if (ref->origin != NULL) t.file = ref->origin->file, t.line = ref->origin->line, t.column = ref->origin->column;
  s->now = ref;
  return own_status(e, row->write(f->context, own_output(e), &t), phase);
}

/* ---- registering a format ---- */

/* Returns true if the text has 1 to 16 characters, all of them ASCII letters or digits. */
static bool own_suffix(const char *text) {
  static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
  size_t n = text != NULL ? strspn(text, plain) : 0;
  return n > 0 && n <= 16 && text[n] == '\0';
}

static bool own_fill(vs_session *s, vs_own_format *f, const vs_format_own *given) {
  vs_store *store = s->bind.store;
  static const vs_kind through[] = { VS_TRANSFORM, VS_MATERIAL, VS_LAYER, VS_UNION };
  memset(f, 0, sizeof *f);
  f->begin = given->begin, f->end = given->end, f->context = given->context;
  f->backend = (vs_backend){ .begin = own_begin, .end = own_end, .close = own_close };
  for (size_t i = 0; i < given->kind_count; i++) {
    int kind = 0;
    while (kind < VS_KIND_COUNT && strcmp(vs_kind_get((vs_kind)kind)->name, given->kinds[i].kind) != 0) kind++;
    if (kind == VS_KIND_COUNT || given->kinds[i].write == NULL) return false;
    f->kinds[kind] = given->kinds[i];
    f->backend.emit[kind].fn = own_emit;
  }
  if (f->kinds[VS_POLYFACE_MESH].write == NULL) return false; /* the host must provide a callback for polyhedra, because
                                                               * any solid or surface without a callback is replaced by
                                                               * polyhedra */
  if (f->kinds[VS_HULL].write != NULL) f->backend.traits |= VS_SHOWS_HULLS;
  for (size_t i = 0; i < sizeof through / sizeof *through; i++) f->backend.emit[through[i]].fn = own_emit;
  char text[120];
  snprintf(text, sizeof text, "%.40s has no lines: curves are omitted", given->name);
  if (f->kinds[VS_LINE].write == NULL) {
    f->backend.omit[VS_CURVE] = vs_store_text(store, text, strlen(text));
    if (f->backend.omit[VS_CURVE] == NULL) return false;
  }
  const char *doc = given->doc != NULL ? given->doc : "";
  f->format = (vs_format){ .name = vs_store_text(store, given->name, strlen(given->name)),
                           .suffix = vs_store_text(store, given->suffix, strlen(given->suffix)),
                           .doc = vs_store_text(store, doc, strlen(doc)),
                           .binary = given->binary, .backend = &f->backend };
  return f->format.name != NULL && f->format.suffix != NULL && f->format.doc != NULL;
}

bool vs_register_format(vs_scheme *vm, const vs_format_own *given) {
  vs_session *s = vs_session_of(vm);
  if (!own_suffix(given->suffix) || given->name == NULL || given->name[0] == '\0' ||
      vs_export_format_find(given->name) || vs_export_format_find(given->suffix)) return false;
  vs_own_format *f = vs_store_realloc(s->bind.store, NULL, 0, sizeof *f);
  if (f == NULL) return false;
  if (!own_fill(s, f, given)) {
    vs_store_realloc(s->bind.store, f, sizeof *f, 0);
    return false;
  }
  f->next = s->own_formats;
  s->own_formats = f;
  return true;
}

/* Returns true if `text` equals the word, or ends in a dot and the word. */
static bool own_means(const char *text, const char *word) {
  size_t length = strlen(text), end = strlen(word);
  return !strcmp(text, word) || (length > end && text[length - end - 1] == '.' && !strcmp(text + length - end, word));
}

const vs_format *vs_session_own_format(const vs_session *s, const char *text) {
  for (const vs_own_format *f = s->own_formats; f != NULL; f = f->next)
    if (!strcmp(text, f->format.name) || own_means(text, f->format.suffix)) return &f->format;
  return NULL;
}

void vs_session_free_own_formats(vs_session *s) {
  while (s->own_formats != NULL) {
    vs_own_format *f = s->own_formats;
    s->own_formats = f->next;
    vs_store_realloc(s->bind.store, f, sizeof *f, 0);
  }
}
