/* Implements the model's values in Scheme: objects (references to nodes) and paints (materials). */
#include "bind/objects.h"

#include "bind/origins.h"
#include "bind/print.h"
#include "bind/print_looks.h"
#include "bind/state.h"

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
  return vs_bind_print_material(object, put, to);
}
const vs_foreign_type vs_paint_type = { "a material", paint_release, NULL, NULL, paint_print, NULL, false };
