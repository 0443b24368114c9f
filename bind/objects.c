/* Implements the model's values in Scheme: objects (references to nodes) and paints (materials). */
#include "bind/objects.h"

#include "bind/origins.h"
#include "bind/print.h"
#include "bind/state.h"

#include <stdio.h>

/* ---- objects ---- */

static void shape_release(void *object) { vs_node_release(object); }
static bool shape_equal(const void *a, const void *b) { return vs_node_equal(a, b, NULL); }
static uint64_t shape_hash(const void *a) { return ((const vs_node *)a)->hash; }
static bool shape_print(vs_scheme *vm, const void *a, bool (*put)(void *to, const char *s, size_t n), void *to) {
  (void)vm;
  return vs_bind_print_node(a, put, to);
}
const vs_foreign_type vs_shape_type = { "an object", shape_release, shape_equal, shape_hash, shape_print, NULL, false };

static vs_status wrap(vs_bind *b, vs_ref ref, size_t bytes, vs_value *out) {
  if (!vs_make_foreign(b->vm, &vs_shape_type, ref.node, bytes, out)) return VS_ERROR;
  vs_as_foreign(*out)->with = ref.origin;
  return VS_OK;
}

vs_status vs_bind_give_object(vs_bind *b, vs_node *node, vs_value *out) {
  if (!node) return vs_fail_memory(b->vm);
  return wrap(b, (vs_ref){ node, vs_bind_origin(b) }, node->refs == 1 ? vs_node_bytes(node) : 0, out);
}

vs_status vs_bind_give_ref(vs_bind *b, vs_ref ref, vs_value *out) {
  return wrap(b, (vs_ref){ vs_node_retain(ref.node), ref.origin ? ref.origin : vs_bind_origin(b) }, 0, out);
}

vs_status vs_bind_give_refs(vs_bind *b, const vs_ref *refs, size_t count, vs_value *out) {
  VS_ROOTS(b->vm, r, 2);
  r[0] = VS_NIL;
  for (size_t i = count; i-- > 0;)
    if (!vs_poll(b->vm, 1) || !vs_bind_give_ref(b, refs[i], &r[1]) || !vs_cons(b->vm, r[1], r[0], &r[0]))
      return VS_ERROR;
  *out = r[0];
  return VS_OK;
}

/* ---- paints: interned materials, which exist as long as the store ---- */

static void paint_release(void *object) { (void)object; }
static bool paint_print(vs_scheme *vm, const void *object, bool (*put)(void *to, const char *s, size_t n), void *to) {
  (void)vm;
  const vs_material *m = object;
  const vs_material_pattern *p = &m->pattern;
  char text[1024], c[3][32], v[4][32], q[5][32];
  vs_bind_number_text(c[0], m->red), vs_bind_number_text(c[1], m->green), vs_bind_number_text(c[2], m->blue);
  vs_bind_number_text(v[0], m->roughness), vs_bind_number_text(v[1], m->metallic),
      vs_bind_number_text(v[2], m->transparency), vs_bind_number_text(v[3], m->ior);
  vs_bind_number_text(q[0], p->red), vs_bind_number_text(q[1], p->green), vs_bind_number_text(q[2], p->blue);
  vs_bind_number_text(q[3], vs_pattern_size(p)), vs_bind_number_text(q[4], p->angle);
  int n = snprintf(text, sizeof text,
                   "(make-material #:name \"%.100s\" #:color (list %s %s %s) #:roughness %s #:metallic %s "
                   "#:transparency %s #:ior %s",
                   m->name, c[0], c[1], c[2], v[0], v[1], v[2], v[3]);
  if (n > 0 && (size_t)n < sizeof text && p->picture)
    n += snprintf(text + n, sizeof text - (size_t)n, " #:image \"%.500s\" #:pattern-size %s #:pattern-angle %s",
                  p->picture->path, q[3], q[4]);
  else if (n > 0 && (size_t)n < sizeof text && p->kind != VS_PATTERN_NONE)
    n += snprintf(text + n, sizeof text - (size_t)n,
                  " #:pattern '%s #:pattern-color (list %s %s %s) #:pattern-size %s #:pattern-angle %s",
                  vs_pattern_name(p->kind), q[0], q[1], q[2], q[3], q[4]);
  return n > 0 && put(to, text, (size_t)n < sizeof text ? (size_t)n : sizeof text - 1) && put(to, ")", 1);
}
const vs_foreign_type vs_paint_type = { "a material", paint_release, NULL, NULL, paint_print, NULL, false };
