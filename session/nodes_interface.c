/* Implements the public functions on scene nodes, properties, actions and picks (objects under the mouse). Each calls
 * the corresponding procedure of the language, so that hosts and programs have the same rules and messages. */
#include <stdio.h>
#include <string.h>

#include "bind/scene/node_natives.h"
#include "session/handles.h"
#include "session/host.h"
#include "session/report.h"

/* Calls a procedure of the language with the values of `arguments`. Sets *result to a handle of the procedure's value,
 * or to 0 if the call fails. */
static vs_outcome call(vs_scheme *vm, const char *who, const char *procedure, const vs_handle *arguments, size_t count,
                       vs_handle *result) {
  enum { MOST = 5 };
  vs_session *s = vs_session_of(vm);
  VS_ROOTS(vm, r, MOST + 1);
  if (result) *result = 0;
  if (vs_session_busy(s, who)) return VS_OUTCOME_USAGE;
  for (size_t i = 0; i < count; i++)
    if (!vs_session_held(s, who, arguments[i], &r[i])) return VS_OUTCOME_USAGE;
  vs_outcome outcome = vs_session_invoke(s, procedure, count, r, &r[MOST]);
  if (outcome != VS_OUTCOME_DONE || !result) return outcome;
  *result = vs_session_hold(s, &r[MOST]);
  return *result ? VS_OUTCOME_DONE : VS_OUTCOME_MACHINE;
}

/* Calls a procedure of the language and returns a handle of its value. Returns 0 if the value is #f or the call
 * fails. */
static vs_handle ask(vs_scheme *vm, const char *who, const char *procedure, const vs_handle *arguments, size_t count) {
  vs_handle result;
  if (call(vm, who, procedure, arguments, count, &result) != VS_OUTCOME_DONE || vs_handle_get_boolean(vm, result))
      return result;
  vs_handle_release(vm, result);
  return 0;
}

/* A call about a property. who: the public function; procedure: the procedure of the language that it calls; group:
 * group of the property; name: the property's name. */
typedef struct { const char *who, *procedure; vs_handle group; const char *name; } named;

/* Calls q->procedure with the group, the name as a symbol, and the argument *last (NULL: none). Releases the symbol's
 * handle. */
static vs_outcome call_named(vs_scheme *vm, const named *q, const vs_handle *last, vs_handle *result) {
  vs_handle symbol = vs_handle_symbol(vm, q->name);
  const vs_handle arguments[] = { q->group, symbol, last ? *last : 0 };
  if (result) *result = 0;
  if (!symbol) return VS_OUTCOME_MACHINE;
  vs_outcome outcome = call(vm, q->who, q->procedure, arguments, last ? 3 : 2, result);
  vs_handle_release(vm, symbol);
  return outcome;
}

/* ---- nodes ---- */

vs_handle vs_scene_controller(vs_scheme *vm) { return ask(vm, "vs_scene_controller", "node-controller", NULL, 0); }
vs_handle vs_node_root(vs_scheme *vm) { return ask(vm, "vs_node_root", "node-getroot", NULL, 0); }
vs_handle vs_node_focus(vs_scheme *vm) { return ask(vm, "vs_node_focus", "node-current", NULL, 0); }

vs_handle vs_node_create(vs_scheme *vm, const char *type, const char *name, vs_handle parent) {
  vs_handle kind = vs_handle_symbol(vm, type ? type : "context"), text = name ? vs_handle_text(vm, name)
      : vs_handle_boolean(vm, false);
  vs_handle above = parent ? vs_handle_retain(vm, parent) : vs_handle_boolean(vm, false);
  vs_handle made = kind && text && above ? ask(vm, "vs_node_create", "%node-create", (const vs_handle[]){ kind, text,
      above }, 3) : 0;
  vs_handle_release(vm, kind);
  vs_handle_release(vm, text);
  vs_handle_release(vm, above);
  return made;
}

vs_handle vs_node_find(vs_scheme *vm, const char *name) {
  vs_handle text = vs_handle_text(vm, name), found = text ? ask(vm, "vs_node_find", "node-find", &text, 1) : 0;
  vs_handle_release(vm, text);
  return found;
}

/* Returns a handle of a part of a node, or 0 if the node lacks this part. Runs no program, and is therefore allowed at
 * any time. If `node` is no node, fails with the error of the language's procedure. */
static vs_handle part_of(vs_scheme *vm, const char *who, const char *procedure, vs_node_part part, vs_handle node) {
  vs_session *s = vs_session_of(vm);
  VS_ROOTS(vm, r, 2);
  if (!vs_session_held(s, who, node, &r[0])) return 0;
  if (vs_node_read(vm, r[0], part, &r[1])) return r[1] == VS_FALSE ? 0 : vs_session_hold(s, &r[1]);
  return ask(vm, who, procedure, &node, 1);
}

vs_handle vs_node_parent(vs_scheme *vm, vs_handle node) {
  return part_of(vm, "vs_node_parent", "node-getparent", VS_NODE_PARENT, node);
}
vs_handle vs_node_children(vs_scheme *vm, vs_handle node) {
  return part_of(vm, "vs_node_children", "node-getchildren", VS_NODE_CHILDREN, node);
}
vs_handle vs_node_object(vs_scheme *vm, vs_handle node) { return ask(vm, "vs_node_object", "node-object", &node, 1); }

const char *vs_node_name(vs_scheme *vm, vs_handle node) {
  vs_handle text = part_of(vm, "vs_node_name", "node-getname", VS_NODE_NAME, node);
  const char *name = text ? vs_handle_get_text(vm, text) : NULL;
  vs_handle_release(vm, text);
  return name;
}

vs_outcome vs_node_add_child(vs_scheme *vm, vs_handle parent, vs_handle child) {
  return call(vm, "vs_node_add_child", "node-addchild", (const vs_handle[]){ parent, child }, 2, NULL);
}
vs_outcome vs_node_remove_child(vs_scheme *vm, vs_handle parent, vs_handle child) {
  return call(vm, "vs_node_remove_child", "node-removechild", (const vs_handle[]){ parent, child }, 2, NULL);
}
vs_outcome vs_node_set_drawing(vs_scheme *vm, vs_handle node, vs_handle drawing) {
  return call(vm, "vs_node_set_drawing", "node-setdrawing", (const vs_handle[]){ node, drawing }, 2, NULL);
}
vs_outcome vs_node_begin(vs_scheme *vm, vs_handle node) {
  return call(vm, "vs_node_begin", "node-begin", &node, 1, NULL);
}
vs_outcome vs_node_end(vs_scheme *vm) { return call(vm, "vs_node_end", "node-end", NULL, 0, NULL); }

vs_outcome vs_node_place(vs_scheme *vm, vs_handle node, const double *translate, const double *degrees,
    const double *scale) {
  const struct { const double *at; const char *procedure; } parts[] = {
    { translate, "node-translate" }, { degrees, "node-rotate" }, { scale, "node-scale" }
  };
  vs_outcome outcome = VS_OUTCOME_DONE;
  for (size_t i = 0; i < 3 && outcome == VS_OUTCOME_DONE; i++) {
    if (!parts[i].at) continue;
    vs_handle v = vs_handle_vector(vm, parts[i].at[0], parts[i].at[1], parts[i].at[2]);
    if (!v) return VS_OUTCOME_MACHINE;
    outcome = call(vm, "vs_node_place", parts[i].procedure, (const vs_handle[]){ node, v }, 2, NULL);
    vs_handle_release(vm, v);
  }
  return outcome;
}

bool vs_node_matrix(vs_scheme *vm, vs_handle node, bool world, double out[16]) {
  vs_handle m = ask(vm, "vs_node_matrix", world ? "node-worldtransform" : "node-gettransform", &node, 1);
  bool ok = m && vs_handle_get_numbers(vm, m, out, 16) == 16;
  vs_handle_release(vm, m);
  return ok;
}

vs_outcome vs_node_eval(vs_scheme *vm, vs_handle node, const char *text, vs_handle *result) {
  vs_handle source = vs_handle_text(vm, text);
  if (result) *result = 0;
  if (!source) return VS_OUTCOME_MACHINE;
  vs_outcome outcome = call(vm, "vs_node_eval", "%node-eval-text", (const vs_handle[]){ node, source }, 2, result);
  vs_handle_release(vm, source);
  return outcome;
}

/* ---- properties ---- */

vs_handle vs_property_of(vs_scheme *vm, vs_handle group, const char *name) {
  vs_handle property;
  call_named(vm, &(named){ "vs_property_of", "property-ref", group, name }, NULL, &property);
  return property;
}
vs_outcome vs_property_get(vs_scheme *vm, vs_handle group, const char *name, vs_handle *value) {
  return call_named(vm, &(named){ "vs_property_get", "property-get", group, name }, NULL, value);
}
vs_outcome vs_property_put(vs_scheme *vm, vs_handle group, const char *name, vs_handle value) {
  return call_named(vm, &(named){ "vs_property_put", "property-put!", group, name }, &value, NULL);
}

uint64_t vs_property_subscribe(vs_scheme *vm, vs_handle property, vs_host_fn *fn, void *context) {
  double id = 0;
  vs_handle procedure = vs_host_procedure(vm, "a subscriber of the host's", fn, context);
  vs_handle number = procedure ? ask(vm, "vs_property_subscribe", "property-subscribe", (const vs_handle[]){ property,
      procedure }, 2) : 0;
  if (number) vs_handle_get_numbers(vm, number, &id, 1), vs_handle_release(vm, number);
  vs_handle_release(vm, procedure);
  return (uint64_t)id;
}

vs_outcome vs_property_unsubscribe(vs_scheme *vm, vs_handle property, uint64_t id) {
  vs_handle number = vs_handle_integer(vm, (int64_t)id);
  if (!number) return VS_OUTCOME_MACHINE;
  vs_outcome outcome = call(vm, "vs_property_unsubscribe", "property-unsubscribe", (const vs_handle[]){ property,
      number }, 2, NULL);
  vs_handle_release(vm, number);
  return outcome;
}

/* ---- actions and picks ---- */

vs_outcome vs_action_apply(vs_scheme *vm, const char *action, vs_handle node) {
  vs_handle symbol = vs_handle_symbol(vm, action);
  if (!symbol) return VS_OUTCOME_MACHINE;
  vs_outcome outcome = call(vm, "vs_action_apply", "action-apply", (const vs_handle[]){ symbol, node }, 2, NULL);
  vs_handle_release(vm, symbol);
  return outcome;
}

vs_outcome vs_scene_frame(vs_scheme *vm, double seconds) {
  vs_handle number = vs_handle_number(vm, seconds);
  if (!number) return VS_OUTCOME_MACHINE;
  vs_outcome outcome = call(vm, "vs_scene_frame", "node-frame", &number, 1, NULL);
  vs_handle_release(vm, number);
  return outcome;
}

/* Passes an intersection of the mouse ray, which %pick-for-host has found, to the callback. `hit` is a list (distance
 * point node path file line column); the last three items are #f if unknown. */
static bool tell_hit(vs_scheme *vm, vs_handle hit, bool (*each)(void *context, vs_scheme *vm, const vs_hit *hit),
    void *context, bool *go_on) {
  enum { DISTANCE, POINT, NODE, PATH, FILE_NAME, LINE, COLUMN, PARTS };
  vs_handle part[PARTS] = { 0 };
  vs_hit told = { .file = NULL };
  double place[2] = { 0, 0 };
  char *file = NULL; /* copies the texts, because the callback may call vs_handle_text, which overwrites the text that
                      * it returned last */
  size_t bytes = 0;
  bool ok = true;
  for (size_t i = 0; ok && i < PARTS; i++) ok = (part[i] = vs_handle_item(vm, hit, i)) != 0;
  if (ok) {
    vs_handle_get_numbers(vm, part[DISTANCE], &told.distance, 1);
    vs_handle_get_numbers(vm, part[POINT], told.point, 3);
    told.node = part[NODE], told.path = part[PATH];
    if (vs_handle_get_boolean(vm, part[FILE_NAME])) {
      const char *text = vs_handle_get_text(vm, part[FILE_NAME]);
      bytes = text ? strlen(text) + 1 : 0;
      file = bytes ? vs_session_memory(vs_session_of(vm), NULL, 0, bytes) : NULL;
      ok = !bytes || file;
      if (file) told.file = memcpy(file, text, bytes);
      vs_handle_get_numbers(vm, part[LINE], &place[0], 1), vs_handle_get_numbers(vm, part[COLUMN], &place[1], 1);
      told.line = (uint32_t)place[0], told.column = (uint32_t)place[1];
    }
    if (ok) *go_on = each(context, vm, &told);
    else vs_session_out_of_memory(vs_session_of(vm));
  }
  if (file) vs_session_memory(vs_session_of(vm), file, bytes, 0);
  for (size_t i = 0; i < PARTS; i++)
    vs_handle_release(vm, part[i]);
  return ok;
}

vs_outcome vs_pick(vs_scheme *vm, const double from[3], const double direction[3],
                   bool (*each)(void *context, vs_scheme *vm, const vs_hit *hit), void *context) {
  vs_handle ray[2] = { vs_handle_point(vm, from[0], from[1], from[2]), vs_handle_vector(vm, direction[0], direction[1],
      direction[2]) };
  vs_handle hits = 0;
  vs_outcome outcome = ray[0] && ray[1] ? call(vm, "vs_pick", "%pick-for-host", ray, 2, &hits) : VS_OUTCOME_MACHINE;
  for (size_t i = 0; i < 2; i++)
    vs_handle_release(vm, ray[i]);
  size_t count = hits && outcome == VS_OUTCOME_DONE ? vs_handle_count(vm, hits) : 0;
  bool go_on = true;
  for (size_t i = 0; i < count && go_on; i++) {
    vs_handle hit = vs_handle_item(vm, hits, i);
    if (!hit || !tell_hit(vm, hit, each, context, &go_on)) outcome = VS_OUTCOME_MACHINE, go_on = false;
    vs_handle_release(vm, hit);
  }
  vs_handle_release(vm, hits);
  return outcome;
}

/* ---- gizmos (handles to drag with the mouse), and input by mouse and keys ---- */

/* Indices in the list by which %gizmos-for-host describes a gizmo: (node kind value low high step size at handles
 * axes). A part that the gizmo lacks is #f. */
enum { NODE, KIND, VALUE, LOW, HIGH, STEP, SIZE, AT, HANDLES, AXES, PARTS };

static size_t numbers_of(vs_scheme *vm, vs_handle list, double out[3][3]) {
  size_t count = vs_handle_count(vm, list);
  for (size_t i = 0; i < count && i < 3; i++) {
    vs_handle item = vs_handle_item(vm, list, i);
    vs_handle_get_numbers(vm, item, out[i], 3);
    vs_handle_release(vm, item);
  }
  return count < 3 ? count : 3;
}

static vs_gizmo_kind kind_of(vs_scheme *vm, vs_handle symbol) {
  const char *name = vs_handle_get_text(vm, symbol);
  if (name && strcmp(name, "slider") == 0) return VS_GIZMO_SLIDER;
  if (name && strcmp(name, "arrow") == 0) return VS_GIZMO_ARROW;
  return name && strcmp(name, "tripod") == 0 ? VS_GIZMO_TRIPOD : VS_GIZMO_TRIGGER;
}

static bool tell_gizmo(vs_scheme *vm, vs_handle gizmo, bool (*each)(void *, vs_scheme *, const vs_gizmo *),
                       void *context, bool *go_on) {
  vs_handle part[PARTS] = { 0 };
  vs_gizmo told = { .value_count = 1 };
  bool ok = true;
  for (size_t i = 0; ok && i < PARTS; i++) ok = (part[i] = vs_handle_item(vm, gizmo, i)) != 0;
  if (ok) {
    told.node = part[NODE], told.kind = kind_of(vm, part[KIND]);
    told.value_count = vs_handle_get_numbers(vm, part[VALUE], told.value, 3);
    vs_handle_get_numbers(vm, part[LOW], told.low, 3);
    vs_handle_get_numbers(vm, part[HIGH], told.high, 3);
    if (told.kind == VS_GIZMO_TRIPOD)
      for (int k = 0; k < 3; k++) told.low[k] = -told.high[k];
    vs_handle_get_numbers(vm, part[STEP], &told.step, 1);
    vs_handle_get_numbers(vm, part[SIZE], &told.size, 1);
    vs_handle_get_numbers(vm, part[AT], told.at, 3);
    told.handle_count = numbers_of(vm, part[HANDLES], told.handles);
    numbers_of(vm, part[AXES], told.axes);
    *go_on = each(context, vm, &told);
  }
  for (size_t i = 0; i < PARTS; i++) vs_handle_release(vm, part[i]);
  return ok;
}

vs_outcome vs_gizmos(vs_scheme *vm, bool (*each)(void *context, vs_scheme *vm, const vs_gizmo *gizmo), void *context) {
  vs_handle all = 0;
  vs_outcome outcome = call(vm, "vs_gizmos", "%gizmos-for-host", NULL, 0, &all);
  size_t count = outcome == VS_OUTCOME_DONE ? vs_handle_count(vm, all) : 0;
  bool go_on = true;
  for (size_t i = 0; i < count && go_on; i++) {
    vs_handle gizmo = vs_handle_item(vm, all, i);
    if (!gizmo || !tell_gizmo(vm, gizmo, each, context, &go_on)) outcome = VS_OUTCOME_MACHINE, go_on = false;
    vs_handle_release(vm, gizmo);
  }
  vs_handle_release(vm, all);
  return outcome;
}

vs_outcome vs_input(vs_scheme *vm, vs_input_kind kind, vs_input_button button, const double from[3],
                    const double direction[3], const char *key, vs_handle *node) {
  static const char *const kinds[] = { "press", "drag", "release", "move", "key" };
  static const char *const buttons[] = { "left", "middle", "right", "none" };
  enum { WORDS = 5 };
  bool ok = (unsigned)kind < sizeof kinds / sizeof *kinds && (unsigned)button < sizeof buttons / sizeof *buttons;
  vs_handle words[WORDS] = { vs_handle_symbol(vm, ok ? kinds[kind] : "?"),
                             vs_handle_symbol(vm, ok ? buttons[button] : "?"),
                             from ? vs_handle_point(vm, from[0], from[1], from[2]) : vs_handle_boolean(vm, false),
                             direction ? vs_handle_vector(vm, direction[0], direction[1], direction[2])
                                       : vs_handle_boolean(vm, false),
                             key ? vs_handle_text(vm, key) : vs_handle_boolean(vm, false) };
  vs_handle met = 0;
  vs_outcome outcome = VS_OUTCOME_MACHINE;
  if (words[0] && words[1] && words[2] && words[3] && words[4])
    outcome = call(vm, "vs_input", "node-input", words, WORDS, &met);
  for (size_t i = 0; i < WORDS; i++) vs_handle_release(vm, words[i]);
  bool keeps = node && met && vs_handle_kind_of(vm, met) == VS_HANDLE_NODE;
  if (!keeps) vs_handle_release(vm, met);
  if (node) *node = keeps ? met : 0;
  return outcome;
}
