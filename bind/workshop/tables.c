/* Implements the natives of tables of quantities: the kind, layer and material of an object, and the length of the
 * model's unit. */

#include <string.h>

#include "bind/call/context.h"
#include "bind/call/positional.h"
#include "bind/call/scratch.h"
#include "geometry/parts.h"
#include "model/scene.h"
#include "vm/values/heap.h"

static bool add_text(vs_args *f, const char *text, vs_value *list) {
  vs_scheme *vm = vs_call_vm(f);
  VS_ROOTS(vm, r, 1);
  text = text ? text : "";
  return vs_string_from_utf8(vm, text, strlen(text), &r[0]) && vs_cons(vm, r[0], *list, list);
}

/* (%schedule-looks o): returns a list of the object's kind, layer, material, and the length of the model unit in
 * metres. A missing name is "". If several layers or materials surround the whole object, the innermost is returned. */
vs_status vs_p_schedule_looks(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  const vs_node *n = vs_arg_ref(f, 0).node;
  const char *layer = NULL, *material = NULL;
  for (; vs_is_wrapper(n); n = n->children[0].node) {
    if (n->kind == VS_LAYER) layer = VS_AS(layer, n)->name;
    if (n->kind == VS_MATERIAL) material = VS_AS(material, n)->material->name;
  }
  const char *kind = n->kind == VS_CUSTOM ? VS_AS(custom, n)->name : vs_kind_get((vs_kind)n->kind)->name;
  VS_ROOTS(vm, r, 1);
  r[0] = VS_NIL;
  bool ok = vs_cons(vm, vs_flonum(vs_scene_metres(vs_bind_scene(vm))), r[0], &r[0]) && add_text(f, material, &r[0]) &&
            add_text(f, layer, &r[0]) && add_text(f, kind, &r[0]);
  *out = r[0];
  return ok ? VS_OK : VS_ERROR;
}
