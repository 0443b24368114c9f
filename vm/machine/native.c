/* Owns the registration of natives: signatures, procedure objects, and the flat record types of the host; and the calls
 * that natives ask the run loop for. */
#include "vm/machine/native.h"

#include <float.h>
#include <math.h>
#include <stdio.h>

#include "vm/compiler/inline.h"
#include "vm/values/number.h"
#include "vm/machine/signature.h"

/* ---- signatures ---- */
vs_signature_kind vs_signature_next(const char **at, int *depth, const char **name, size_t *length) {
  const char *s = *at;
  bool rest = false;
  for (;; s++) {
    if (*s == '[') ++*depth;
    else if (*s == ']') --*depth;
    else if (*s == '.' && s[1] == ' ') rest = true;
    else if (*s != ' ') break;
  }
  bool keyword = s[0] == '#' && s[1] == ':';
  if (keyword) s += 2;
  size_t n = 0;
  while (s[n] && s[n] != ' ' && s[n] != '[' && s[n] != ']') n++;
  *name = s; *length = n; *at = s + n;
  return n == 0       ? VS_SIG_END
         : keyword    ? VS_SIG_KEYWORD
         : rest       ? VS_SIG_REST
         : *depth > 0 ? VS_SIG_OPTIONAL
                      : VS_SIG_REQUIRED;
}

vs_signature vs_signature_read(const char *text) {
  vs_signature g = {0, 0, 0, false};
  int depth = 0;
  const char *name;
  size_t length;
  for (;;)
    switch (vs_signature_next(&text, &depth, &name, &length)) {
      case VS_SIG_END: return g;
      case VS_SIG_REQUIRED: g.required++; break;
      case VS_SIG_OPTIONAL: g.optional++; break;
      case VS_SIG_KEYWORD: g.keywords++; break;
      case VS_SIG_REST: g.rest = true; break;
    }
}

void vs_signature_parameter(const char *text, int arg, char *name, size_t size) {
  int depth = 0;
  const char *at;
  size_t length;
  for (int i = 0;; i++) {
    vs_signature_kind kind = vs_signature_next(&text, &depth, &at, &length);
    if (kind == VS_SIG_END) break;
    if (i == arg && kind != VS_SIG_REST) {
      snprintf(name, size, "%s%.*s", kind == VS_SIG_KEYWORD ? "#:" : "", (int)length, at);
      return;
    }
  }
  snprintf(name, size, "argument %d", arg + 1);
}

/* ---- procedures ---- */
/* symbol: which of the names of def this one goes by; errors say it */
static bool native_make(vs_scheme *vm, const vs_native_def *def, vs_value symbol, vs_value *out) {
  VS_ROOTS(vm, r, 2);
  vs_signature g = vs_signature_read(def->signature);
  r[0] = symbol; r[1] = VS_FALSE;
  if (g.keywords && !vs_make_vector(vm, g.keywords, VS_FALSE, &r[1])) return false;
  const char *text = def->signature, *name;
  size_t length;
  int depth = 0;
  uint32_t k = 0;
  for (vs_signature_kind kind; (kind = vs_signature_next(&text, &depth, &name, &length)) != VS_SIG_END;)
    if (kind == VS_SIG_KEYWORD) {
      vs_value keyword;
      if (!vs_intern(vm, name, length, &keyword)) return false;
      vs_gc_store(vm, vs_as_vector(r[1]), &vs_as_vector(r[1])->at[k++], keyword);
    }
  vs_native *n = (vs_native *)(void *)vs_gc_alloc_old(vm, VS_T_NATIVE, VS_WORDS(vs_native));
  if (!n) return false;
  n->def = def;
  n->min = g.required;
  n->max = g.rest ? UINT32_MAX : g.required + g.optional;
  n->name = r[0]; n->keywords = r[1];
  vs_inline_find(vm, def->name, strcspn(def->name, " "), &n->inlined, &n->inlined_arg);
  *out = vs_from_object(n);
  return true;
}

bool vs_native_define(vs_scheme *vm, const vs_native_table *table,
                      bool (*define)(vs_scheme *vm, void *context, vs_value symbol, vs_value procedure),
                      void *context) {
  VS_ROOTS(vm, r, 2);
  for (const vs_native_def *def = table->defs; def->name; def++) {
    for (const char *s = def->name; *s;) {
      size_t n = strcspn(s, " ");
      if (!vs_intern(vm, s, n, &r[1]) || !native_make(vm, def, r[1], &r[0]) || !define(vm, context, r[1], r[0]))
        return false;
      s += n;
      while (*s == ' ') s++;
    }
  }
  return true;
}

/* ---- flat records ---- */
double vs_flat_length(double x, double y, double z) {
  double sum = x * x + y * y + z * z;
  if (sum > 1e-280 && sum < 1e300) return sqrt(sum);
  double most = fmax(fabs(x), fmax(fabs(y), fabs(z)));
  if (!(most > 0) || !(most <= DBL_MAX)) return most;
  x /= most, y /= most, z /= most;
  return most * sqrt(x * x + y * y + z * z);
}

bool vs_flat_register(vs_scheme *vm, const vs_flat_rules *rules) {
  if (!vm->flat && !(vm->flat = vs_mem(vm, NULL, 0, sizeof *vm->flat))) return false;
  *vm->flat = *rules;
  return true;
}

bool vs_flat_callable(const vs_scheme *vm, const vs_value *a, int n) {
  for (int i = 0; i < n; i++)
    if (vm->flat && vm->flat->call && vs_is(a[i], VS_T_FLAT)) {
      uint32_t tag = vs_as_flat(a[i])->h.flags;
      if (vm->flat->at[VS_OP_ADD][tag][tag].rule == VS_RULE_CALL) return true;
    }
  return false;
}

bool vs_flat_arith(vs_scheme *vm, vs_flat_op op, vs_value a, vs_value b, vs_value *out) {
  double x[VS_FLAT_FIELDS], y[VS_FLAT_FIELDS];
  uint32_t ta = vs_is(a, VS_T_FLAT) ? vs_as_flat(a)->h.flags : 0, tb = vs_is(b, VS_T_FLAT) ? vs_as_flat(b)->h.flags : 0;
  const char *word[] = {"add", "subtract", "multiply", "divide"};
  const char *joint[] = {"and", "from", "and", "by"};
  if (vm->flat && vm->flat->at[op][ta][tb].rule == VS_RULE_CALL) {
    const vs_value both[2] = {a, b};
    return vm->flat->call(vm, (const char *const[]){"+", "-", "*", "/"}[op], both, 2, out);
  }
  double number = 0;   /* the operand that is no record; a ratio or a bignum too */
  vs_value other = ta ? b : a;
  bool numbers = (ta && tb) || (vs_is_number(other) && vs_number_double(vm, other, &number));
  int rule = vm->flat && numbers ? vm->flat->at[op][ta][tb].rule : VS_RULE_NONE;
  if (op == VS_OP_SUB && !ta && a != vs_fix(0)) rule = VS_RULE_NONE;   /* only (- x), which is 0 - x */
  if (rule == VS_RULE_NONE) {
    if (op == VS_OP_SUB) return vs_fail(vm, vm->sym.type, "cannot subtract %s from %s", vs_noun(vm, b), vs_noun(vm, a));
    return vs_fail(vm, vm->sym.type, "cannot %s %s %s %s", word[op], vs_noun(vm, a), joint[op], vs_noun(vm, b));
  }
  if (rule == VS_RULE_DIV && !tb && number == 0) return vs_fail(vm, vm->sym.divide, "division by zero");
  size_t n = ta ? vs_flat_count(vs_as_flat(a)) : vs_flat_count(vs_as_flat(b));
  for (size_t i = 0; i < n; i++) {
    x[i] = ta ? vs_as_flat(a)->at[i] : number;
    y[i] = tb ? vs_as_flat(b)->at[i] : number;
    x[i] = rule == VS_RULE_ADD   ? x[i] + y[i]
           : rule == VS_RULE_SUB ? x[i] - y[i]
           : rule == VS_RULE_MUL ? x[i] * y[i]
                                 : x[i] / y[i];
  }
  return vs_make_flat(vm, vm->flat->at[op][ta][tb].tag, x, n, out);
}

/* ---- natives asking for calls ---- */
void vs_call_begin(vs_scheme *vm, vs_value procedure) {
  vm->call_procedure = procedure;
  vm->call_count = 0;
}

bool vs_call_push(vs_scheme *vm, vs_value v) {
  if (vm->call_count == vm->call_room) {
    size_t room = vm->call_room ? vm->call_room * 2 : 16;
    vs_value *p = vs_mem(vm, vm->call_args, vm->call_room * sizeof *p, room * sizeof *p);
    if (!p) return false;
    vm->call_args = p;
    vm->call_room = room;
  }
  vm->call_args[vm->call_count++] = v;
  return true;
}

static bool prepare(vs_scheme *vm, vs_value procedure, size_t n, const vs_value *argv) {
  vs_call_begin(vm, procedure);
  for (size_t i = 0; i < n; i++)
    if (!vs_call_push(vm, argv[i])) return false;
  return true;
}

vs_status vs_call(vs_scheme *vm, vs_value procedure, size_t n, const vs_value *argv) {
  return prepare(vm, procedure, n, argv) ? VS_CALL : VS_ERROR;
}

vs_status vs_tailcall(vs_scheme *vm, vs_value procedure, size_t n, const vs_value *argv) {
  return prepare(vm, procedure, n, argv) ? VS_TAILCALL : VS_ERROR;
}
