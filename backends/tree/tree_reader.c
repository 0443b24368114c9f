/* Reads tree dumps. The table of kinds determines the text, as it does when a dump is written: a node's fields are in
 * the table's order, then its children follow. Nodes whose list is not closed yet are on an explicit stack, so deep
 * trees need memory, but no space on the C stack. */
#include "backends/tree/tree_reader.h"
#include "model/store/array.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

enum { TREE_PAYLOAD_ROOM = 256, TREE_WORD_ROOM = 64 };

typedef struct {
  const vs_kind_info *info;
  vs_kind kind;
  size_t first_child; /* index of the node's first child in tree_reader.children */
  _Alignas(max_align_t) unsigned char payload[TREE_PAYLOAD_ROOM];
} tree_open_node;

typedef struct {
  vs_scene *scene;
  vs_error *error;
  const char *at, *end;
  uint32_t line;
  char *copy;              /* copy of the text with a final NUL, which strtod needs */
  tree_open_node *open;
  size_t open_count, open_room;
  vs_ref *children;        /* complete children of the nodes that are still being read */
  size_t child_count, child_room;
  vs_ref *templates;       /* templates[n - 1]: the node that the dump defines as tn */
  size_t template_count, template_room;
} tree_reader;

static bool tree_fail(tree_reader *r, const char *what) {
  return vs_error_set(r->error, VS_ERROR_MODEL, NULL, "tree, line %lu: %s", (unsigned long)r->line, what);
}

static bool tree_no_memory(tree_reader *r) {
  return vs_error_set(r->error, VS_ERROR_MEMORY, NULL, "out of memory while reading a tree");
}

static bool tree_grow(tree_reader *r, void *array, size_t *room, size_t need, size_t size) {
  return need <= *room || vs_room_grow(array, room, need, size) || tree_no_memory(r);
}

/* ---- tokens ---- */

static int tree_peek(tree_reader *r) {
  while (r->at < r->end && (*r->at == ' ' || *r->at == '\n' || *r->at == '\t' || *r->at == '\r'))
    r->line += *r->at++ == '\n';
  return r->at < r->end ? (unsigned char)*r->at : -1;
}

static bool tree_expect(tree_reader *r, char c) {
  if (tree_peek(r) != c) return tree_fail(r, c == '(' ? "( is expected here" : ") is expected here");
  r->at++;
  return true;
}

static bool tree_word(tree_reader *r, char out[TREE_WORD_ROOM]) {
  tree_peek(r);
  size_t length = 0;
  while (r->at < r->end && strchr(" \n\t\r()\"", *r->at) == NULL && length + 1 < TREE_WORD_ROOM)
    out[length++] = *r->at++;
  out[length] = '\0';
  return length > 0 || tree_fail(r, "a word is expected here");
}

static bool tree_number(tree_reader *r, double *out) {
  char *after;
  tree_peek(r);
  *out = strtod(r->at, &after);
  if (after == r->at) return tree_fail(r, "a number is expected here");
  r->at = after;
  return true;
}

static bool tree_numbers(tree_reader *r, double *out, size_t count) {
  for (size_t i = 0; i < count; i++)
    if (!tree_number(r, &out[i])) return false;
  return true;
}

static bool tree_string(tree_reader *r, const char **out) {
  if (tree_peek(r) != '"') return tree_fail(r, "a string is expected here");
  char *text = r->copy + (r->at - r->copy); /* replaces escapes in place, because the result is never longer */
  size_t length = 0;
  for (r->at++; r->at < r->end && *r->at != '"'; r->at++) {
    char c = *r->at;
    if (c == '\\' && r->at + 1 < r->end) c = *++r->at == 'n' ? '\n' : *r->at;
    text[length++] = c;
  }
  if (r->at >= r->end) return tree_fail(r, "this string does not end");
  r->at++;
  *out = vs_store_text(r->scene->store, text, length);
  return *out != NULL || tree_no_memory(r);
}

/* ---- fields ---- */

static bool tree_points(tree_reader *r, vs_field_points *out) {
  vs_vec3 *at = NULL;
  size_t count = 0, room = 0;
  bool ok = true;
  while (ok && tree_peek(r) == '(') {
    double xyz[3];
    ok = tree_grow(r, &at, &room, count + 1, sizeof *at) && tree_expect(r, '(') && tree_numbers(r, xyz, 3) &&
         tree_expect(r, ')');
    if (ok) at[count++] = vs_v3(xyz[0], xyz[1], xyz[2]);
  }
  if (ok && (*out = vs_points_new(r->scene->store, at, count)) == NULL) ok = tree_no_memory(r);
  free(at);
  return ok;
}

static bool tree_faces(tree_reader *r, vs_field_faces *out) {
  uint32_t *starts = NULL, *corners = NULL;
  size_t count = 0, start_room = 0, corner_count = 0, corner_room = 0;
  bool ok = tree_grow(r, &starts, &start_room, 1, sizeof *starts);
  if (ok) starts[0] = 0;
  while (ok && tree_peek(r) == '(') {
    ok = tree_expect(r, '(');
    while (ok && tree_peek(r) != ')') {
      double index;
      ok = tree_number(r, &index) && tree_grow(r, &corners, &corner_room, corner_count + 1, sizeof *corners);
      if (ok && !(index >= 0 && index < UINT32_MAX)) ok = tree_fail(r, "this is no index");
      if (ok) corners[corner_count++] = (uint32_t)index;
    }
    ok = ok && tree_expect(r, ')') && tree_grow(r, &starts, &start_room, count + 2, sizeof *starts);
    if (ok) starts[++count] = (uint32_t)corner_count;
  }
  if (ok && (*out = vs_faces_new(r->scene->store, starts, count, corners, corner_count)) == NULL)
    ok = tree_no_memory(r);
  free(starts);
  free(corners);
  return ok;
}

static bool tree_pattern(tree_reader *r, vs_material_pattern *out) {
  const char *name;
  double n[5];
  if (!tree_string(r, &name)) return false;
  if (!vs_pattern_find(name, &out->kind)) return tree_fail(r, "there is no such pattern");
  if (!tree_numbers(r, n, 5)) return false;
  out->red = n[0], out->green = n[1], out->blue = n[2], out->size = n[3], out->angle = n[4];
  return true;
}

static bool tree_material(tree_reader *r, vs_field_material *out) {
  vs_material m = { .name = "" };
  double n[7];
  if (!tree_string(r, &m.name) || !tree_numbers(r, n, 7)) return false;
  if (tree_peek(r) == '"' && !tree_pattern(r, &m.pattern)) return false;
  m.red = n[0], m.green = n[1], m.blue = n[2], m.roughness = n[3], m.metallic = n[4], m.transparency = n[5],
  m.ior = n[6];
  *out = vs_store_material(r->scene->store, &m);
  return *out != NULL || tree_no_memory(r);
}

static bool tree_value(tree_reader *r, vs_field_type type, void *at) {
  char word[TREE_WORD_ROOM];
  double number;
  switch (type) {
  case VS_FIELD_real: return tree_numbers(r, at, 1);
  case VS_FIELD_point: case VS_FIELD_vector: return tree_numbers(r, at, 3);
  case VS_FIELD_affine: return tree_numbers(r, at, 12);
  case VS_FIELD_integer:
    if (!tree_number(r, &number)) return false;
    if (!(number >= INT32_MIN && number <= INT32_MAX)) return tree_fail(r, "this integer is too large");
    *(vs_field_integer *)at = (vs_field_integer)number;
    return true;
  case VS_FIELD_boolean:
    if (!tree_word(r, word)) return false;
    *(vs_field_boolean *)at = strcmp(word, "#t") == 0;
    return *(vs_field_boolean *)at || strcmp(word, "#f") == 0 || tree_fail(r, "#t or #f is expected here");
  case VS_FIELD_points: return tree_points(r, at);
  case VS_FIELD_faces: return tree_faces(r, at);
  case VS_FIELD_text: return tree_string(r, at);
  case VS_FIELD_ticket:
    if (!tree_number(r, &number)) return false;
    if (!(number >= 0 && number <= UINT32_MAX)) return tree_fail(r, "this number is too large");
    *(vs_field_ticket *)at = vs_ticket_new(r->scene->store, (uint32_t)number);
    return *(vs_field_ticket *)at != NULL || tree_no_memory(r);
  case VS_FIELD_material: return tree_material(r, at);
  }
  return false;
}

static bool tree_field(tree_reader *r, const vs_field_info *f, unsigned char *payload) {
  char word[TREE_WORD_ROOM];
  if (!tree_expect(r, '(') || !tree_word(r, word)) return false;
  if (strcmp(word, f->argument) != 0)
    return vs_error_set(r->error, VS_ERROR_MODEL, NULL, "tree, line %lu: %s is expected here, not %s",
                        (unsigned long)r->line, f->argument, word);
  return tree_value(r, f->type, payload + f->offset) && tree_expect(r, ')');
}

/* ---- nodes ---- */

static void tree_drop(tree_reader *r, const tree_open_node *n) {
  for (size_t i = 0; i < n->info->field_count; i++) {
    const void *at = n->payload + n->info->fields[i].offset;
    if (n->info->fields[i].type == VS_FIELD_points && *(const vs_field_points *)at != NULL)
      vs_points_release(r->scene->store, *(const vs_field_points *)at);
    if (n->info->fields[i].type == VS_FIELD_faces && *(const vs_field_faces *)at != NULL)
      vs_faces_release(r->scene->store, *(const vs_field_faces *)at);
    if (n->info->fields[i].type == VS_FIELD_ticket && *(const vs_field_ticket *)at != NULL)
      vs_ticket_release(r->scene->store, *(const vs_field_ticket *)at);
  }
}

static bool tree_push(tree_reader *r, vs_ref ref) {
  if (tree_grow(r, &r->children, &r->child_room, r->child_count + 1, sizeof *r->children)) {
    r->children[r->child_count++] = ref;
    return true;
  }
  vs_node_release(ref.node);
  return false;
}

static bool tree_begin_node(tree_reader *r) {
  char word[TREE_WORD_ROOM];
  if (!tree_expect(r, '(') || !tree_word(r, word)) return false;
  int kind = 0;
  while (kind < VS_KIND_COUNT && strcmp(vs_kind_get((vs_kind)kind)->name, word) != 0) kind++;
  if (kind == VS_KIND_COUNT)
    return vs_error_set(r->error, VS_ERROR_MODEL, NULL, "tree, line %lu: there is no kind %s", (unsigned long)r->line,
                        word);
  if (!tree_grow(r, &r->open, &r->open_room, r->open_count + 1, sizeof *r->open)) return false;
  tree_open_node *n = &r->open[r->open_count++];
  memset(n, 0, sizeof *n);
  n->info = vs_kind_get((vs_kind)kind);
  n->kind = (vs_kind)kind;
  n->first_child = r->child_count;
  if (n->info->size > TREE_PAYLOAD_ROOM) return tree_fail(r, "this kind is too large");
  for (size_t i = 0; i < n->info->field_count; i++)
    if (!tree_field(r, &n->info->fields[i], n->payload)) return false;
  return true;
}

static bool tree_end_node(tree_reader *r) {
  tree_open_node *n = &r->open[--r->open_count];
  const vs_origin *origin = vs_store_origin(r->scene->store, r->scene->title, r->line, 1, NULL);
  size_t count = r->child_count - n->first_child;
  vs_node *made =
      origin != NULL ? vs_node_new(r->scene->store, n->kind, n->payload, r->children + n->first_child, count) : NULL;
  tree_drop(r, n);
  while (r->child_count > n->first_child) vs_node_release(r->children[--r->child_count].node);
  return made != NULL ? tree_push(r, (vs_ref){ made, origin }) : tree_no_memory(r);
}

/* Reads a node with its children, and appends the node to r->children. */
static bool tree_node(tree_reader *r) {
  size_t outside = r->open_count;
  do {
    int c = tree_peek(r);
    if (c == 't') {
      char word[TREE_WORD_ROOM];
      if (!tree_word(r, word)) return false;
      unsigned long id = strtoul(word + 1, NULL, 10);
      if (id == 0 || id > r->template_count) return tree_fail(r, "this template is not defined above");
      vs_ref shared = r->templates[id - 1];
      vs_node_retain(shared.node);
      if (!tree_push(r, shared)) return false;
    } else if (c == ')' && r->open_count > outside) {
      r->at++;
      if (!tree_end_node(r)) return false;
    } else if (!tree_begin_node(r)) {
      return false;
    }
  } while (r->open_count > outside);
  return true;
}

static bool tree_item(tree_reader *r) {
  char word[TREE_WORD_ROOM];
  if (!tree_expect(r, '(') || !tree_word(r, word)) return false;
  bool define = strcmp(word, "define") == 0;
  if (!define && strcmp(word, "draw") != 0) return tree_fail(r, "define or draw is expected here");
  if (define && (!tree_word(r, word) || strtoul(word + 1, NULL, 10) != r->template_count + 1))
    return tree_fail(r, "templates are t1, t2 and so on");
  if (!tree_node(r)) return false;
  vs_ref made = r->children[--r->child_count];
  bool ok;
  if (define) {
    ok = tree_grow(r, &r->templates, &r->template_room, r->template_count + 1, sizeof *r->templates);
    if (ok) r->templates[r->template_count++] = made;
    else vs_node_release(made.node);
  } else {
    ok = vs_scene_draw(r->scene, made) || tree_no_memory(r);
    vs_node_release(made.node);
  }
  return ok && tree_expect(r, ')');
}

static bool tree_all(tree_reader *r) {
  char word[TREE_WORD_ROOM];
  double version;
  if (!tree_expect(r, '(') || !tree_word(r, word) || strcmp(word, "tree") != 0 || !tree_number(r, &version) ||
      version != 1)
    return tree_fail(r, "this is not a tree of version 1");
  if (!tree_string(r, &r->scene->title)) return false;
  while (tree_peek(r) == '(')
    if (!tree_item(r)) return false;
  return tree_expect(r, ')');
}

bool vs_tree_read(vs_scene *scene, const char *text, size_t length, vs_error *e) {
  tree_reader r = { .scene = scene, .error = e, .line = 1 };
  r.copy = vs_fresh(length + 1, 1);
  if (r.copy == NULL) return tree_no_memory(&r);
  memcpy(r.copy, text, length);
  r.copy[length] = '\0';
  r.at = r.copy;
  r.end = r.copy + length;
  bool ok = tree_all(&r);
  while (r.open_count > 0) tree_drop(&r, &r.open[--r.open_count]);
  while (r.child_count > 0) vs_node_release(r.children[--r.child_count].node);
  while (r.template_count > 0) vs_node_release(r.templates[--r.template_count].node);
  free(r.open);
  free(r.children);
  free(r.templates);
  free(r.copy);
  return ok;
}
