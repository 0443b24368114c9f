/* Converts the translation of a script, a sequence of items (words and brackets), to Scheme data.
 *
 * Items are processed from the last to the first. Data are kept on a stack, which is a Scheme list; a closing bracket
 * pushes a mark. At an opening bracket, the data above the mark are already the list between the brackets, in order.
 * This list is separated from the stack without copying. A pair has the place of its datum; the first pair of a list
 * has the place of the list. */
#include "vm/javascript/read_script.h"

#include <stdio.h>
#include <string.h>

#include "languages/javascript/parser.h"
#include "vm/front/environment.h"
#include "vm/front/expand.h"
#include "vm/front/reader.h"
#include "vm/javascript/statements.h"
#include "vm/values/heap.h"

static void *resize(void *context, void *at, size_t used, size_t fresh) { return vs_mem(context, at, used, fresh); }

static vs_pos place(uint32_t file, uint32_t line, uint32_t column) { return vs_pos_make(file, line, column); }

/* ---- Scheme text inside a script ---- */

typedef struct {
  vs_scheme *vm;
  const vs_scopes *k;
  uint32_t scope;
} native_names;

/* Returns true if the symbol in native text (Scheme inside a script) names a variable of the script that is visible
 * there. Other symbols have their meaning in Scheme. */
static bool is_variable(const native_names *n, vs_value symbol) {
  const char *text = vs_as_symbol(symbol)->name;
  uint32_t name = vs_script_name_known(n->k->s, text, strlen(text));
  return name && vs_scopes_resolve(n->k, n->scope, name);
}

/* Renames the script's variables in the data, in place. The data are new, so that nothing else refers to them. A list
 * contains the pairs that are still to be visited. */
static bool rename_names(const native_names *n, vs_value forms) {
  vs_scheme *vm = n->vm;
  VS_ROOTS(vm, r, 5); /* roots of the garbage collector: pairs to visit, the pair, a name, its alias, the aliases (one
                       * for each name) */
  if (!vs_cons(vm, forms, VS_NIL, &r[0]) || !vs_idtable_new(vm, &r[4])) return false;
  while (vs_is_pair(r[0])) {
    r[1] = vs_car(r[0]);
    r[0] = vs_cdr(r[0]);
    for (; vs_is_pair(r[1]); r[1] = vs_cdr(r[1])) {
      for (int i = 0; i < 2; i++) {
        vs_value v = i ? vs_cdr(r[1]) : vs_car(r[1]);
        if (!i && vs_is_pair(v)) {
          if (!vs_cons(vm, v, r[0], &r[0])) return false;
          continue;
        }
        if (!vs_is_symbol(v) || vs_as_symbol(v)->name[0] == '#' || is_variable(n, v)) continue;
        r[2] = v;
        r[3] = vs_idtable_get(r[4], r[2]);
        if (r[3] == VS_VACANT &&
            (!vs_make_alias(vm, r[2], vm->at.core, &r[3]) || !vs_idtable_put(vm, &r[4], r[2], r[3])))
          return false;
        vs_pair *p = vs_as_pair(r[1]);
        vs_gc_store(vm, p, i ? &p->cdr : &p->car, r[3]);
      }
    }
  }
  return true;
}

/* Reads the data of a native text (Scheme inside a script) with their places. Blanks are put before the text, so that
 * its first character has the right column. */
static bool native_data(const native_names *n, const vs_item *item, uint32_t file, vs_value *forms) {
  size_t indent = item->column + 2, size = indent + item->b;
  char *text = vs_mem(n->vm, NULL, 0, size + 1);
  if (!text) return false;
  memset(text, ' ', indent);
  memcpy(text + indent, n->k->s->texts + item->a, item->b);
  text[size] = 0;
  bool ok = vs_read_all(n->vm, &(vs_passage){ text, size, item->line }, file, false, forms);
  vs_mem(n->vm, text, size + 1, 0);
  return ok && rename_names(n, *forms);
}

/* ---- building data ---- */

static bool symbol_of(vs_scheme *vm, const vs_script *s, const vs_item *item, vs_value *out) {
  char small[200];
  size_t n = 0;
  const char *text = item->word;
  switch ((vs_item_kind)item->kind) {
  case VS_ITEM_WORD: return vs_intern(vm, text, strlen(text), out);
  case VS_ITEM_MADE:
    n = (size_t)snprintf(small, sizeof small, "%s%u", text, item->a);
    return vs_intern(vm, small, n, out);
  case VS_ITEM_KEY: return vs_intern(vm, s->texts + item->a, item->b, out);
  default: break;
  }
  text = vs_script_spelling(s, item->a, &n);
  if (item->kind == VS_ITEM_NAME) return vs_intern(vm, text, n, out);
  char *long_name = vs_mem(vm, NULL, 0, n + 1);
  if (!long_name) return false;
  memcpy(long_name + 1, text, n);
  long_name[0] = ':';
  bool ok = vs_intern(vm, long_name, n + 1, out);
  vs_mem(vm, long_name, n + 1, 0);
  return ok;
}

/* Removes the data above the topmost mark from the stack, and returns them as a list. */
static vs_value take_list(vs_scheme *vm, vs_value *stack, vs_pos pos) {
  vs_value head = *stack, last = VS_NIL, at = head, tail = VS_NIL;
  for (; vs_car(at) != VS_VACANT && vs_car(at) != VS_ABSENT; at = vs_cdr(at)) last = at;
  vs_value rest = vs_cdr(at);
  if (vs_car(at) == VS_ABSENT) tail = vs_car(rest), rest = vs_cdr(rest);
  *stack = rest;
  if (last == VS_NIL) return tail;
  vs_gc_store(vm, vs_as_pair(last), &vs_as_pair(last)->cdr, tail);
  ((vs_located_pair *)(void *)vs_object_of(head))->pos = pos;
  return head;
}

static bool push(vs_scheme *vm, vs_value v, vs_value *stack, vs_pos pos) {
  return vs_cons_at(vm, v, *stack, pos, stack);
}

static bool push_native(vs_scheme *vm, const vs_translation *t, const vs_item *item, uint32_t file, vs_value *stack) {
  VS_ROOTS(vm, r, 3);
  native_names names = { vm, t->k, item->scope };
  r[2] = *stack;
  if (!native_data(&names, item, file, &r[0])) return false;
  for (r[1] = VS_NIL; vs_is_pair(r[0]); r[0] = vs_cdr(r[0])) /* reverses the data, so that the first is on top of the
                                                              * stack */
    if (!vs_cons_at(vm, vs_car(r[0]), r[1], vs_pair_pos(r[0]), &r[1])) return false;
  for (; vs_is_pair(r[1]); r[1] = vs_cdr(r[1]))
    if (!vs_cons_at(vm, vs_car(r[1]), r[2], vs_pair_pos(r[1]), &r[2])) return false;
  *stack = r[2];
  return true;
}

static bool build(vs_scheme *vm, const vs_translation *t, uint32_t file, vs_value *forms) {
  VS_ROOTS(vm, r, 3); /* roots of the garbage collector: the stack, a datum, and a temporary value */
  r[0] = VS_NIL;
  bool ok = true;
  for (size_t i = t->count; ok && i--;) {
    const vs_item *item = &t->items[i];
    vs_pos pos = place(file, item->line, item->column);
    if ((i & 1023) == 0 && !vs_poll(vm, 1024)) return false;
    switch ((vs_item_kind)item->kind) {
    case VS_ITEM_CLOSE: ok = push(vm, VS_VACANT, &r[0], pos); break;
    case VS_ITEM_OPEN:
      r[1] = take_list(vm, &r[0], pos);
      ok = push(vm, r[1], &r[0], pos);
      break;
    case VS_ITEM_NUMBER: ok = push(vm, vs_flonum(item->number), &r[0], pos); break;
    case VS_ITEM_COUNT: ok = push(vm, vs_fix(item->a), &r[0], pos); break;
    case VS_ITEM_STRING:
      ok = vs_string_from_utf8(vm, t->s->texts + item->a, item->b, &r[1]) && push(vm, r[1], &r[0], pos);
      break;
    case VS_ITEM_NATIVE: ok = push_native(vm, t, item, file, &r[0]); break;
    case VS_ITEM_WORD:
      if (!strcmp(item->word, ".")) { /* the datum on top becomes the tail of a dotted list; the list's mark is below
                                       * it */
        r[1] = vs_car(r[0]);
        r[0] = vs_cdr(vs_cdr(r[0]));
        ok = push(vm, r[1], &r[0], pos) && push(vm, VS_ABSENT, &r[0], pos);
        break;
      }
      ok = symbol_of(vm, t->s, item, &r[1]) && push(vm, r[1], &r[0], pos);
      break;
    case VS_ITEM_NAME:
    case VS_ITEM_DIRECT:
    case VS_ITEM_MADE:
    case VS_ITEM_KEY: ok = symbol_of(vm, t->s, item, &r[1]) && push(vm, r[1], &r[0], pos); break;
    }
  }
  *forms = r[0];
  return ok;
}

/* Finds names that are assigned but not declared: they may be variables of a script that ran earlier in the session. */
static bool find_elsewhere(vs_scheme *vm, vs_scopes *k) {
  for (uint32_t i = k->scopes[1].first; i; i = k->variables[i].next) {
    vs_variable *v = &k->variables[i];
    vs_value name;
    if (v->kind != VS_VARIABLE_UNDECLARED) continue;
    if (!vs_intern(vm, k->s->texts + k->s->names[v->name].text, k->s->names[v->name].length, &name)) return false;
    if (!vs_is(vm->at.program, VS_T_ENVIRONMENT)) return true;
    vs_meaning m = vs_environment_find(vm->at.program, name);
    v->elsewhere = m.kind == VS_MEANS_CELL && !m.foreign && vs_as_cell(m.value)->value != VS_UNDEFINED;
    if (v->elsewhere) v->kind = VS_VARIABLE_VAR;
  }
  return true;
}

bool vs_read_script(vs_scheme *vm, const char *text, size_t size, uint32_t file, uint32_t line, vs_value *forms) {
  vs_script s;
  vs_scopes k = { .s = &s };
  vs_translation t = { .s = &s, .k = &k, .numbers = 1 };
  bool ok = vs_script_parse(&s, text, size, resize, vm) && vs_scopes_find(&k, &s) && find_elsewhere(vm, &k) &&
            vs_translate_script(&t) && build(vm, &t, file, forms);
  if (!ok && *s.trouble)
    vs_fail_at(vm, vm->sym.read, place(file, line - 1 + s.trouble_at.line, s.trouble_at.column), VS_NIL, "%s",
               s.trouble);
  else if (!ok && s.no_memory)
    vs_fail_memory(vm);
  if (t.items) vs_mem(vm, t.items, t.room * sizeof *t.items, 0);
  vs_scopes_close(&k);
  vs_script_close(&s);
  return ok;
}
