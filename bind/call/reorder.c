/* Implements advice for arguments in a wrong order: for (make-sphere 3 p), suggests (make-sphere p 3). */
#include "bind/call/reorder.h"

#include <stdio.h>
#include <string.h>

#include "bind/call/context.h"
#include "bind/call/contract.h"
#include "bind/call/procedure.h"
#include "bind/call/refuse.h"
#include "bind/objects.h"
#include "vm/machine/native.h"
#include "vm/values/heap.h"
#include "vm/values/printer.h"
#include "vm/values/text.h"

enum {
  MOST = 5,  /* greatest number of arguments for which orders are tried; five arguments have 120 orders */
  SHOWN = 40 /* greatest number of bytes of an argument that the advice shows */
};

typedef struct {
  const vs_bind_param *param[MOST];
  bool fits[MOST][MOST]; /* fits[p][a]: whether argument a fulfils the contract of parameter p */
  int order[MOST], count; /* order[p]: number of the argument for parameter p, in the first order in which all arguments
                           * fit; count: number of arguments */
  int found;              /* number of orders in which all arguments fit; 2 means two or more */
} orders;

/* Sets o->param[i] to the parameter of argument i. Returns false if this form does not accept n arguments. */
static bool place_parameters(const vs_form *form, int n, orders *o) {
  const vs_bind_param *p = form->at;
  o->count = n;
  for (int i = 0; i < n; i++) {
    if (p->mode == VS_ARG_END) return false;
    o->param[i] = p;
    if (p->mode != VS_ARG_REST) p++;
  }
  return p->mode != VS_ARG_REQUIRED;
}

/* Tries all orders of the arguments that begin with order[0..at). order[at] is chosen next. */
static void try_orders(orders *o) {
  int order[MOST] = {0}, at = 0;
  for (order[0] = -1; at >= 0 && o->found < 2;) {
    int next = order[at] + 1;
    for (bool used = true; next < o->count && used; next += used) {
      used = !o->fits[at][next];
      for (int i = 0; i < at; i++) used = used || order[i] == next;
    }
    if (next >= o->count) {
      at--;
      continue;
    }
    order[at] = next;
    if (at + 1 < o->count) {
      order[++at] = -1;
      continue;
    }
    if (!o->found++) memcpy(o->order, order, sizeof order);
  }
}

static bool put_argument(vs_scheme *vm, const vs_bind_param *p, vs_value v, vs_text *t) {
  vs_text shown;
  vs_text_open(vm, &shown, SHOWN);
  bool quoted = vs_is_symbol(v) || vs_is_pair(v);
  bool ok = vs_print(vm, v, VS_PRINT_WRITE, &shown) && vs_text_puts(t, " ");
  bool whole = ok && !shown.cut && !vs_bind_take_ref(v).node && !vs_is_procedure(v);
  ok = ok && (whole ? (!quoted || vs_text_puts(t, "'")) && vs_text_put(t, shown.at ? shown.at : "", shown.count)
                    : vs_text_puts(t, p->name));
  vs_text_close(&shown);
  return ok;
}

static bool put_order(vs_args *f, const vs_value *a, const orders *o, vs_text *t) {
  char name[64];
  vs_bind_own_name(f, name);
  bool ok = vs_text_puts(t, "the order is (") && vs_text_puts(t, name);
  for (int i = 0; ok && i < o->count; i++) ok = vs_text_puts(t, " ") && vs_text_puts(t, o->param[i]->name);
  ok = ok && vs_text_puts(t, ")");
  if (o->found > 1 || !ok) return ok;
  ok = vs_text_puts(t, ": (") && vs_text_puts(t, name);
  for (int i = 0; ok && i < o->count; i++) ok = put_argument(f->vm, o->param[i], a[o->order[i]], t);
  return ok && vs_text_puts(t, ")");
}

void vs_bind_reorder(vs_args *f, const vs_value *a, int n) {
  vs_scheme *vm = f->vm;
  VS_ROOTS(vm, r, 2);
  r[0] = vm->condition;
  if (n < 2 || n > MOST || !vs_is(r[0], VS_T_CONDITION) || vs_as_condition(r[0])->kind != vm->sym.type ||
      vs_as_condition(r[0])->payload != VS_FALSE) return;
  orders o = {.found = 0};
  vs_job *job = vs_bind_job(vm), before = *job;
  job->warn = NULL; /* while orders are tried, conversions must not give warnings */
  for (int form = 0; form < VS_MAX_FORMS && f->procedure->form[form].used && !o.found; form++) {
    if (!place_parameters(&f->procedure->form[form], n, &o)) continue;
    for (int i = 0; i < n; i++)
      for (int j = 0; j < n; j++) {
        vs_arg unused;
        o.fits[i][j] = vs_convert(f, o.param[i], a[j], &unused);
      }
    try_orders(&o);
  }
  job->warn = before.warn;
  if (o.found) {
    vs_text t;
    vs_text_open(vm, &t, 400);
    if (put_order(f, a, &o, &t) && vs_text_end(&t) && vs_string_from_utf8(vm, t.at, t.count, &r[1]))
      vs_gc_store(vm, vs_as_condition(r[0]), &vs_as_condition(r[0])->payload, r[1]);
    vs_text_close(&t);
  }
  vm->condition = r[0];
}
