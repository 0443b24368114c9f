/* Implements scopes: reference counts, copies, hashes of paths, flags, printing. */
#include "bind/rules/scope.h"

#include "model/store/piece.h"

#include <stdio.h>
#include <string.h>

static const struct {
  const char *predicate, *noun, *printed;
} classes[] = {
#define VS_SCOPE(upper, predicate, noun, printed) { predicate, noun, printed },
#include "bind/rules/scopes.def"
#undef VS_SCOPE
};
const char *vs_scope_noun(const vs_scope *s) { return classes[s->class_].noun; }

/* ---- reference counts and copies ---- */

vs_scope *vs_scope_retain(vs_scope *s) {
  if (s) s->refs++;
  return s;
}

static size_t scope_bytes(uint8_t c) {
  size_t tail = c == VS_SCOPE_FFD      ? sizeof((vs_scope *)0)->as.corner
                : c == VS_SCOPE_TURTLE ? sizeof((vs_scope *)0)->as.turtle
                                       : sizeof((vs_scope *)0)->as.box;
  return offsetof(vs_scope, as) + tail;
}
static size_t flags_bytes(uint32_t count) { return sizeof(vs_scope_flags) + count * sizeof(const char *); }
static size_t loops_bytes(uint32_t count) { return sizeof(vs_scope_loops) + (count + (size_t)1) * sizeof(uint32_t); }

void vs_scope_flags_release(vs_store *store, vs_scope_flags *f) {
  if (f && --f->refs == 0) vs_store_piece_free(store, f, flags_bytes(f->count));
}

void vs_scope_loops_release(vs_store *store, vs_scope_loops *l) {
  if (!l || --l->refs) return;
  vs_points_release(store, l->points);
  vs_store_realloc(store, l, loops_bytes(l->count), 0);
}

vs_scope_loops *vs_scope_loops_new(vs_store *store, const vs_vec3 *at, const uint32_t *start, uint32_t count) {
  vs_scope_loops *l = vs_store_realloc(store, NULL, 0, loops_bytes(count));
  if (!l) return NULL;
  l->refs = 1, l->count = count;
  memcpy(l->start, start, (count + (size_t)1) * sizeof *start);
  if ((l->points = vs_points_new(store, at, start[count]))) return l;
  vs_store_realloc(store, l, loops_bytes(count), 0);
  return NULL;
}

void vs_scope_release(vs_scope *s) {
  vs_scope_extra *dead = NULL; /* list of extra data (vs_scope_extra) whose senders must still be released */
  for (;;) {
    while (s && --s->refs == 0) {
      vs_scope *parent = s->parent;
      vs_store *store = s->store;
      vs_scope_flags_release(store, s->flags);
      if (s->extra && --s->extra->refs == 0) s->extra->next = dead, dead = s->extra;
      vs_scope_loops_release(store, s->loops);
      vs_node_release(s->object.node);
      vs_store_piece_free(store, s, scope_bytes(s->class_));
      vs_store_release(store);
      s = parent;
    }
    if (!dead) return;
    if (dead->count) {
      s = dead->from[--dead->count];
      continue;
    }
    vs_scope_extra *e = dead;
    dead = e->next, s = NULL;
    vs_store *store = e->store;
    vs_store_realloc(store, e->from, e->room * sizeof *e->from, 0);
    if (e->mark) vs_ticket_release(store, e->mark);
    vs_store_realloc(store, e, sizeof *e, 0);
    vs_store_release(store);
  }
}

vs_scope *vs_scope_fresh(vs_store *store, vs_scope_class c) {
  size_t bytes = scope_bytes((uint8_t)c);
  vs_scope *s = vs_store_piece(store, bytes);
  if (!s) return NULL;
  memset(s, 0, bytes);
  s->refs = 1, s->class_ = (uint8_t)c, s->count = 1, s->store = vs_store_retain(store);
  return s;
}

vs_scope *vs_scope_copy(const vs_scope *of) {
  size_t bytes = scope_bytes(of->class_);
  vs_scope *s = vs_store_piece(of->store, bytes);
  if (!s) return NULL;
  memcpy(s, of, bytes);
  s->refs = 1;
  vs_store_retain(s->store);
  vs_scope_retain(s->parent);
  if (s->flags) s->flags->refs++;
  if (s->extra) s->extra->refs++;
  if (s->loops) s->loops->refs++;
  if (s->object.node) vs_node_retain(s->object.node);
  return s;
}

void vs_scope_become(vs_scope *s, const vs_scope *of) {
  memcpy(&s->as, &of->as, scope_bytes(s->class_) - offsetof(vs_scope, as));
  s->closed = of->closed, s->backed = of->backed;
  if ((s->loops = of->loops)) s->loops->refs++;
  if (!s->extra && (s->extra = of->extra)) s->extra->refs++;
  s->object = of->object;
  if (s->object.node) vs_node_retain(s->object.node);
}

void vs_scope_take_path(vs_scope *s, const vs_scope *of) {
  s->depth = of->depth, s->index = of->index, s->count = of->count, s->hash = of->hash;
  s->left = of->left, s->right = of->right, s->rule = of->rule, s->op = of->op, s->origin = of->origin;
  s->parent = vs_scope_retain(of->parent);
  if ((s->flags = of->flags)) s->flags->refs++;
  if ((s->extra = of->extra)) s->extra->refs++;
}

vs_status vs_bind_give_scope(vs_scheme *vm, vs_scope *s, vs_value *out) {
  if (!s) return vs_fail_memory(vm);
  return vs_make_foreign(vm, &vs_scope_type, s, 0, out) ? VS_OK : VS_ERROR;
}

/* ---- paths of scopes ---- */

uint64_t vs_scope_mix(uint64_t hash, uint64_t more) {
  uint64_t z = (hash ^ more) + UINT64_C(0x9E3779B97F4A7C15);
  z = (z ^ z >> 30) * UINT64_C(0xBF58476D1CE4E5B9);
  z = (z ^ z >> 27) * UINT64_C(0x94D049BB133111EB);
  return z ^ z >> 31;
}

void vs_scope_plant(vs_scope *s, vs_vec3 at) {
  const double d[3] = { at.x + 0., at.y + 0., at.z + 0. }; /* adding 0 changes -0 to 0, so that both have one hash */
  uint64_t word;
  for (int i = 0; i < 3; i++) {
    memcpy(&word, &d[i], sizeof word);
    s->hash = vs_scope_mix(s->hash, word + (uint64_t)i);
  }
}

enum { PATH_LEVELS = 400 };

void vs_scope_path_text(const vs_scope *s, char *text, size_t room) {
  const vs_scope *level[PATH_LEVELS]; /* scopes of the path, innermost first */
  size_t n = 0, at = 0, all = 0;
  for (const vs_scope *p = s; p; p = p->parent) {
    if (!p->op) continue;
    all++;
    if (n < PATH_LEVELS) level[n++] = p;
  }
  /* A long path is shown without its beginning: in recursive rules, the end is more useful. */
  size_t shown = n < 12 ? n : 12;
  text[0] = 0;
  if (all > shown) at = (size_t)snprintf(text, room, ".../");
  for (size_t i = shown; i-- > 0 && at < room;) {
    const vs_scope *p = level[i];
    int w = snprintf(text + at, room - at, "%s%s%s.%u%s", p->rule ? p->rule : "", p->rule ? "/" : "", p->op, p->index,
                     i ? "/" : "");
    at += w > 0 ? (size_t)w : 0;
  }
  if (n == 0) snprintf(text, room, "root");
}

static bool scope_print(vs_scheme *vm, const void *object, bool (*put)(void *to, const char *s, size_t n), void *to) {
  const vs_scope *s = object;
  char text[600], path[500];
  (void)vm;
  vs_scope_path_text(s, path, sizeof path);
  int n = snprintf(text, sizeof text, "#<%s %s>", classes[s->class_].printed, path);
  return n > 0 && put(to, text, (size_t)n < sizeof text ? (size_t)n : sizeof text - 1);
}
static void scope_release(void *object) { vs_scope_release(object); }
const vs_foreign_type vs_scope_type = { "a scope", scope_release, NULL, NULL, scope_print, NULL, false };

/* ---- flags of scopes ---- */

bool vs_scope_flags_have(const vs_scope_flags *flags, const char *name) {
  for (uint32_t i = 0; flags && i < flags->count; i++)
    if (flags->name[i] == name) return true;
  return false;
}
bool vs_scope_has_flag(const vs_scope *s, const char *name) { return vs_scope_flags_have(s->flags, name); }

bool vs_scope_add_flags(vs_scope *s, const char *const *names, size_t count) {
  uint32_t have = s->flags ? s->flags->count : 0, fresh = 0;
  for (size_t i = 0; i < count; i++) fresh += !vs_scope_has_flag(s, names[i]);
  if (!fresh) return true;
  vs_scope_flags *f = vs_store_piece(s->store, flags_bytes(have + fresh));
  if (!f) return false;
  f->refs = 1, f->count = have;
  for (uint32_t i = 0; i < have; i++) f->name[i] = s->flags->name[i];
  for (size_t i = 0; i < count; i++) {
    bool known = false;
    for (uint32_t k = 0; k < f->count; k++) known = known || f->name[k] == names[i];
    if (!known) f->name[f->count++] = names[i];
  }
  uint32_t room = have + fresh;
  while (f->count < room)
    f->name[f->count++] = names[0]; /* skips a name that is already in the array, so that the array may have unused
                                     * elements at its end */
  vs_scope_flags_release(s->store, s->flags);
  s->flags = f;
  return true;
}

/* ---- marks and signals ---- */

/* Returns the extra data of s. If other scopes refer to the same data, first gives s a copy of its own. The copy has no
 * signals, since they were sent to the original scope. Returns NULL when memory is out. */
static vs_scope_extra *own_extra(vs_scope *s) {
  vs_scope_extra *old = s->extra;
  if (old && old->refs == 1) return old;
  vs_scope_extra *e = vs_store_realloc(s->store, NULL, 0, sizeof *e);
  if (!e) return NULL;
  *e = (vs_scope_extra){ .refs = 1, .store = vs_store_retain(s->store) };
  if (old) old->refs--, e->mark = old->mark;
  if (e->mark) ((vs_ticket *)(uintptr_t)e->mark)->refs++;
  return s->extra = e;
}

bool vs_scope_set_mark(vs_scope *s, const vs_ticket *mark) {
  vs_scope_extra *e = own_extra(s);
  if (!e) return false;
  if (e->mark) vs_ticket_release(s->store, e->mark);
  e->mark = mark;
  ((vs_ticket *)(uintptr_t)mark)->refs++;
  return true;
}

bool vs_scope_add_signal(vs_scope *s, vs_scope *from) {
  vs_scope_extra *e = own_extra(s);
  if (!e || !vs_store_grow(s->store, &e->from, &e->room, e->count + (size_t)1, sizeof *e->from)) return false;
  e->from[e->count++] = vs_scope_retain(from);
  return true;
}

/* ---- corners, sizes and frames ---- */

vs_vec3 vs_scope_corner(const vs_scope *s, int i, int j, int k) {
  if (s->class_ == VS_SCOPE_FFD) return s->as.corner[i + 2 * j + 4 * k];
  if (s->class_ == VS_SCOPE_TURTLE) {
    const vs_affine *m = &s->as.turtle.frame;
    if (k == 0 && s->backed) return s->as.turtle.back[i + 2 * j];
    return vs_affine_point(m, vs_v3((i - .5) * s->as.turtle.width, (j - .5) * s->as.turtle.height, 0));
  }
  return vs_affine_point(&s->as.box.frame, vs_v3(i * s->as.box.size.x, j * s->as.box.size.y, k * s->as.box.size.z));
}

void vs_scope_corners(const vs_scope *s, vs_vec3 corner[8]) {
  for (int c = 0; c < 8; c++) corner[c] = vs_scope_corner(s, c & 1, c >> 1 & 1, c >> 2 & 1);
}

vs_vec3 vs_scope_size(const vs_scope *s) {
  if (s->class_ == VS_SCOPE_TURTLE) return vs_v3(s->as.turtle.width, s->as.turtle.height, 0);
  if (s->class_ != VS_SCOPE_FFD) return s->as.box.size;
  double sum[3] = { 0, 0, 0 };
  for (int a = 0; a < 3; a++)
    for (int c = 0; c < 8; c++)
      if (!(c >> a & 1)) sum[a] += vs_v3_length(vs_v3_sub(s->as.corner[c | 1 << a], s->as.corner[c])) / 4;
  return vs_v3(sum[0], sum[1], sum[2]);
}

vs_affine vs_scope_frame(const vs_scope *s) {
  if (s->class_ == VS_SCOPE_TURTLE) return s->as.turtle.frame;
  if (s->class_ != VS_SCOPE_FFD) return s->as.box.frame;
  vs_vec3 edge[3] = { { 0, 0, 0 }, { 0, 0, 0 }, { 0, 0, 0 } };
  for (int a = 0; a < 3; a++)
    for (int c = 0; c < 8; c++)
      if (!(c >> a & 1)) edge[a] = vs_v3_add(edge[a], vs_v3_sub(s->as.corner[c | 1 << a], s->as.corner[c]));
  vs_vec3 x = vs_v3_unit(edge[0]), y = vs_v3_unit(vs_v3_sub(edge[1], vs_v3_scale(x, vs_v3_dot(x, edge[1]))));
  return vs_affine_columns(x, y, vs_v3_cross(x, y), s->as.corner[0]);
}

void vs_scope_lay_edge(vs_scope *s, const vs_affine *frame, int up, vs_vec3 from, vs_vec3 to) {
  vs_vec3 d = vs_v3_sub(to, from), x = vs_v3_unit(d), y = vs_affine_column(frame, up);
  if (vs_v3_length(x) == 0) x = vs_affine_column(frame, 0), y = vs_affine_column(frame, 1);
  y = vs_v3_unit(vs_v3_sub(y, vs_v3_scale(x, vs_v3_dot(x, y))));
  s->as.box.frame = vs_affine_columns(x, y, vs_v3_cross(x, y), from);
  s->as.box.size = vs_v3(vs_v3_length(d), 0, 0);
}

bool vs_scope_frame_loops(vs_scope *s) {
  const vs_vec3 *at = s->loops->points->at;
  uint32_t n = s->loops->start[1];
  vs_vec3 area = vs_v3(0, 0, 0), x = vs_v3(0, 0, 0);
  for (uint32_t i = 1; i + 1 < n; i++)
    area = vs_v3_add(area, vs_v3_cross(vs_v3_sub(at[i], at[0]), vs_v3_sub(at[i + 1], at[0])));
  for (uint32_t i = 0; i < n && vs_v3_length(x) == 0; i++) x = vs_v3_sub(at[(i + 1) % n], at[i]);
  vs_vec3 z = vs_v3_unit(area);
  x = vs_v3_unit(vs_v3_sub(x, vs_v3_scale(z, vs_v3_dot(x, z))));
  if (vs_v3_length(z) == 0 || vs_v3_length(x) == 0) return false;
  vs_vec3 y = vs_v3_cross(z, x), low = { INFINITY, INFINITY, 0 }, high = { -INFINITY, -INFINITY, 0 };
  for (uint32_t i = 0; i < n; i++) {
    vs_vec3 d = vs_v3_sub(at[i], at[0]);
    double u = vs_v3_dot(d, x), v = vs_v3_dot(d, y);
    low.x = fmin(low.x, u), low.y = fmin(low.y, v), high.x = fmax(high.x, u), high.y = fmax(high.y, v);
  }
  vs_vec3 corner = vs_v3_add(at[0], vs_v3_add(vs_v3_scale(x, low.x), vs_v3_scale(y, low.y)));
  s->as.box.frame = vs_affine_columns(x, y, z, corner);
  s->as.box.size = vs_v3(high.x - low.x, high.y - low.y, 0);
  return true;
}
