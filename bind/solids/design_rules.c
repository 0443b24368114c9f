/* Implements the native that records a rule of a design, for library/visualscheme/building/design_rules.scm. A broken
 * rule causes a warning, a row in the list of the sheet, and marks on objects. */
#include "bind/solids/design_rules.h"

#include <stdio.h>
#include <string.h>

#include "bind/call/context.h"
#include "bind/call/positional.h"
#include "bind/origins.h"
#include "bind/parameters.h"
#include "bind/warnings.h"
#include "vm/machine/fail.h"

enum { COLUMNS = 3 };
static const char list_title[] = "Rules not met";

/* Returns the interned text of argument i; NULL when memory is out. */
static const char *text_of(const vs_args *f, int i) {
  return vs_store_text(vs_call_store(f), vs_arg_text(f, i), vs_arg_text_length(f, i));
}

/* Adds the rule to the list on the sheet. Returns false when memory is out. */
static bool list_rule(vs_scene *scene, const vs_design_rule *r) {
  static const char *const head[COLUMNS] = { "Rule", "Condition", "Found" };
  const char *row[COLUMNS] = { r->name, r->condition, r->found };
  size_t i = 0;
  while (i < scene->table_count && (!scene->tables[i].title || strcmp(scene->tables[i].title, list_title) != 0)) i++;
  vs_scene_table t = { .title = list_title, .columns = COLUMNS, .rows = 1 };
  const char *cells[COLUMNS];
  for (size_t k = 0; k < COLUMNS; k++)
    if (!(cells[k] = vs_store_text(scene->store, head[k], strlen(head[k])))) return false;
  t.cells = cells;
  return (i < scene->table_count || vs_scene_add_table(scene, &t)) && vs_scene_add_row(scene, list_title, row);
}

/* Warns of a broken rule, lists it, and marks the objects. Returns false when memory is out. */
static bool break_rule(vs_args *f, const vs_design_rule *r) {
  vs_bind *b = vs_call_bind(f);
  vs_scene *scene = vs_bind_scene(vs_call_vm(f));
  vs_arg_ref_list marked = vs_arg_refs(f, 4);
  const char *joint = *r->found ? ", where " : "";
  char text[512]; /* also the kind of the warning: a loop warns of each of its rules */
  snprintf(text, sizeof text, "rule \"%.80s\" is not met: %.200s%s%.200s", r->name, r->condition, joint, r->found);
  vs_bind_warn(b, text, "%s", text);
  if (!list_rule(scene, r)) return false;
  for (size_t i = 0; i < marked.count; i++) {
    vs_ref ref = { marked.at[i].node, r->origin };
    if (!(ref.node->flags & VS_NODE_ENDLESS) && !vs_scene_add_fault(scene, ref)) return false;
  }
  return true;
}

/* (%design-rule name condition found shortfall at): records the rule for the host. */
vs_status vs_p_design_rule(vs_args *f, vs_value *out) {
  vs_bind *b = vs_call_bind(f);
  vs_scheme *vm = vs_call_vm(f);
  vs_design_rule r = { text_of(f, 0), text_of(f, 1), text_of(f, 2), vs_arg_real(f, 3), vs_bind_origin(b) };
  (void)out;
  if (vs_bind_handing(vm)) return VS_OK;
  if (!r.name || !r.condition || !r.found || !vs_bind_keep_rule(b, &r)) return vs_fail_memory(vm);
  return r.shortfall == 0 || break_rule(f, &r) ? VS_OK : vs_fail_memory(vm);
}
