/* Implements checked calls. Converts the arguments of a native to C data by its row in procedures.def, or sets an error
 * that names the fault.
 *
 * A call handles the form's parameters one after another. It allocates memory only if an argument is a list. This
 * memory belongs to the call's vs_args, and is freed when the call ends, even after an error. */
#include "bind/call/contract.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bind/build.h"
#include "bind/call/call.h"
#include "bind/call/convert.h"
#include "bind/call/procedure.h"
#include "bind/call/refuse.h"
#include "bind/call/reorder.h"
#include "bind/call/scratch.h"
#include "bind/call/take.h"
#include "bind/constructors/regroup.h"
#include "bind/print.h"
#include "bind/records.h"
#include "bind/state.h"
#include "vm/library/kept.h"
#include "vm/machine/arguments.h"
#include "vm/machine/fail.h"
#include "vm/numbers/dual.h"
#include "vm/numbers/number.h"

_Static_assert((int)VS_MAX_ARGUMENTS <= (int)VS_CALL_ARGUMENTS && (int)VS_MAX_KEYS <= (int)VS_CALL_KEYS,
               "a call has room for each row of the table");

static vs_vec3 vec_of(const double *d) { return vs_v3(d[0], d[1], d[2]); }
static bool finite3(const double *d) { return isfinite(d[0]) && isfinite(d[1]) && isfinite(d[2]); }

vs_status vs_convert(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  static vs_convert_fn *const converters[] = {
#define VS_CONTRACT(name, noun, condition, convert) convert,
#include "bind/call/contracts.def"
#undef VS_CONTRACT
  };
  out->given = true, out->value = v;
  return converters[p->contract](f, p, v, out);
}

/* ---- choosing the form of a call ---- */

/* Returns true if v is of the kind that the contract requires. Tests only contracts that distinguish a procedure's
 * forms; for other contracts returns true. Sets no error. */
static bool looks_like(vs_args *f, vs_contract c, vs_value v) {
  vs_arg unused;
  if (c == VS_C_POINT) return vs_is_flat(v, VS_FLAT_POINT);
  if (c == VS_C_VECTOR || c == VS_C_DIRECTION) return vs_is_flat(v, VS_FLAT_VECTOR);
  if (c == VS_C_AXIS) return vs_bind_take_axis(v, &unused);
  if (c == VS_C_REAL || c == VS_C_RADIUS || c == VS_C_POSITIVE || c == VS_C_ANGLE)
    return vs_bind_take_number(f->vm, v, &unused.real);
  return true;
}

static size_t append(char *text, size_t room, size_t at, const char *more) {
  int n = snprintf(text + at, room - at, "%s", more);
  return n < 0 ? at : at + (size_t)n < room ? at + (size_t)n : room - 1;
}

void vs_bind_forms(const vs_procedure *procedure, const char *name, char *text, size_t room) {
  size_t at = append(text, room, 0, "takes ");
  for (int i = 0; i < VS_MAX_FORMS && procedure->form[i].used; i++) {
    if (i) at = append(text, room, at, " or ");
    at = append(text, room, append(text, room, at, "("), name);
    for (const vs_bind_param *p = procedure->form[i].at; p->mode != VS_ARG_END; p++) {
      at = append(text, room, at, p->mode == VS_ARG_OPTIONAL ? " [" : " ");
      at = append(text, room, at, p->name);
      at = append(text, room, at, p->mode == VS_ARG_OPTIONAL ? "]" : p->mode == VS_ARG_REST ? " ..." : "");
    }
    at = append(text, room, at, ")");
  }
}

/* Refuses a call with a wrong number of arguments. The error shows all forms of the call. If three numbers were given
 * for a box, it also shows the corner points that were probably meant. */
static vs_status refuse_count(vs_args *f, const vs_value *a, int n) {
  char name[64], text[512], hint[300];
  vs_bind_forms(f->procedure, vs_bind_own_name(f, name), text, sizeof text);
  double d[3];
  bool two_corners = f->procedure->form[1].used && f->procedure->form[0].at[1].contract == VS_C_POINT &&
      f->procedure->form[0].at[2].mode == VS_ARG_END;
  if (two_corners && n == 3 && vs_bind_take_number(f->vm, a[0], &d[0]) && vs_bind_take_number(f->vm, a[1], &d[1]) &&
      vs_bind_take_number(f->vm, a[2], &d[2])) {
    char x[32], y[32], z[32]; /* the three numbers as text; they were probably meant as the corner opposite to the
                               * origin */
    vs_bind_number_text(x, d[0]), vs_bind_number_text(y, d[1]), vs_bind_number_text(z, d[2]);
    snprintf(hint, sizeof hint, "(%s (xyz 0 0 0) (xyz %s %s %s))", name, x, y, z);
    return vs_fail(f->vm, f->vm->sym.arity, "%s; perhaps %s", text, hint);
  }
  if (vs_bind_grouped(f->vm, f->procedure, &(vs_plain_call){ name, a, n }, hint, sizeof hint))
    return vs_fail(f->vm, f->vm->sym.arity, "%s; perhaps %s", text, hint);
  return vs_fail(f->vm, f->vm->sym.arity, "%s, got %d argument%s", text, n, n == 1 ? "" : "s");
}

/* Returns how many arguments, counted from the first, are of the kinds that the form requires (0 if the procedure has
 * only one form). Returns -1 if the form does not accept n arguments. */
static int form_fits(vs_args *f, const vs_form *form, const vs_value *a, int n) {
  int fits = f->procedure->form[1].used ? 0 : -1;
  const vs_bind_param *p = form->at;
  for (int i = 0; i < n && p->mode != VS_ARG_REST; i++, p++) {
    if (p->mode == VS_ARG_END) return -1;
    if (fits == i && looks_like(f, (vs_contract)p->contract, a[i])) fits++;
  }
  if (p->mode == VS_ARG_REQUIRED) return -1; /* the form requires more arguments; optional parameters come last */
  if (p->mode == VS_ARG_REST && fits >= 0 && fits < n && looks_like(f, (vs_contract)p->contract, a[fits])) fits++;
  return fits < 0 ? 0 : fits;
}

/* Returns the index of the form that fits the n arguments best. If no form accepts n arguments, sets the error and
 * returns -1. */
static int choose_form(vs_args *f, const vs_value *a, int n) {
  int best = -1, best_fits = -1;
  for (int i = 0; i < VS_MAX_FORMS && f->procedure->form[i].used; i++) {
    int fits = form_fits(f, &f->procedure->form[i], a, n);
    if (fits > best_fits) best = i, best_fits = fits;
    if (fits == n) break;
  }
  if (best < 0) refuse_count(f, a, n);
  return best;
}

/* Marks an argument as absent, and clears the members that a procedure's C function may read. No such function reads
 * the matrix of an absent argument, so the matrix is not cleared. */
static inline void set_absent(vs_arg *to) {
  to->given = false, to->value = VS_ABSENT;
  to->line.at = to->line.direction = vs_v3(0, 0, 0);
}

/* Results of testing an argument in enter_quickly, the fast path for calls with points and numbers that fulfil their
 * contracts. enter_quickly chooses the form and converts the arguments at once. For all other calls it returns
 * false, and enter_slowly handles them. QUICK_OTHER: the argument is of another kind, so that looks_like would
 * return false. */
typedef enum { QUICK_FITS, QUICK_OTHER, QUICK_UNSURE } quick;
static inline quick convert_quickly(const vs_bind_param *p, vs_value v, vs_arg *out) {
  out->given = true, out->value = v;
  if (p->contract == VS_C_POINT) {
    if (!vs_is_flat(v, VS_FLAT_POINT)) return QUICK_OTHER;
    out->point = vec_of(vs_as_flat(v)->at);
    return finite3(vs_as_flat(v)->at) ? QUICK_FITS : QUICK_UNSURE;
  }
  if (p->contract != VS_C_REAL && p->contract != VS_C_RADIUS && p->contract != VS_C_POSITIVE) return QUICK_UNSURE;
  if (vs_is_fixnum(v)) out->real = (double)vs_fixnum(v);
  else if (vs_is_double(v)) out->real = vs_double(v);
  else return vs_is(v, VS_T_FLAT) ? QUICK_OTHER : QUICK_UNSURE;
  return isfinite(out->real) && (p->contract == VS_C_REAL || out->real > 0) ? QUICK_FITS : QUICK_UNSURE;
}

static bool enter_quickly(vs_args *f, const vs_value *a, int n) {
  for (f->form = 0; f->form < VS_MAX_FORMS && f->procedure->form[f->form].used; f->form++) {
    const vs_bind_param *p = f->procedure->form[f->form].at;
    quick fits = QUICK_FITS;
    int i = 0;
    for (; i < n && fits == QUICK_FITS; i++, p++)
      if (p->mode == VS_ARG_REST) fits = QUICK_UNSURE;
      else fits = p->mode == VS_ARG_END ? QUICK_OTHER : convert_quickly(p, a[i], &f->arg[i]);
    if (fits == QUICK_UNSURE || p->mode == VS_ARG_REST) return false;
    if (fits == QUICK_OTHER || p->mode == VS_ARG_REQUIRED) continue;
    for (; p->mode == VS_ARG_OPTIONAL; i++, p++) set_absent(&f->arg[i]);
    f->count = i;
    return p->mode == VS_ARG_END;
  }
  return false;
}

/* ---- the native that makes checked calls ---- */

/* Chooses the form of the call, then converts the arguments one after the other. Returns false with the error set. */
static bool enter_slowly(vs_args *f, const vs_value *a, int given) {
  f->form = choose_form(f, a, given);
  if (f->form < 0) return false;
  const vs_form *form = &f->procedure->form[f->form];
  for (int i = 0; form->at[i].mode != VS_ARG_END; i++) {
    const vs_bind_param *p = &form->at[i];
    vs_arg *to = &f->arg[i];
    f->count = i + 1;
    if (p->mode == VS_ARG_REST) {
      const vs_value *rest = a + i;
      size_t count = given > i ? (size_t)(given - i) : 0;
      *to = (vs_arg){ .given = true, .value = VS_UNSPECIFIC };
      if (p->contract == VS_C_POINTS) { if (!vs_convert_all_points(f, p, rest, count, to)) return false; }
      else if (p->contract == VS_C_THINGS) { if (!vs_convert_all_things(f, p, rest, count, to)) return false; }
      else if (p->contract == VS_C_ANY) to->values.at = rest, to->values.count = count;
      else if (!vs_convert_all_refs(f, p, rest, count, to)) return false;
      continue;
    }
    if (i >= given) set_absent(to);
    else if (!vs_convert(f, p, a[i], to)) return false;
  }
  return true;
}

static vs_status run(vs_args *f, const vs_bind_columns *table, vs_value *a, int n, vs_value *out) {
  bool keyed = f->procedure->key[0].mode != VS_ARG_END;
  int given = n, places = n;
  /* a[] contains a value for each positional parameter, then one for each keyword. If the native has a rest parameter,
   * a[] has no unused elements between them. */
  if (keyed && f->vm->native->max != UINT32_MAX) {
    places = (int)f->vm->native->max;
    for (given = 0; given < places && a[given] != VS_ABSENT; given++) {}
  }
  f->given = given;
  if (!enter_quickly(f, a, given)) {
    vs_status status;
    bool duals = vs_is_fixnum(vs_lib_get(f->vm, VS_LIB_DUALS)); /* whether the program has differentiated, so that
                                                                 * arguments may be dual numbers */
    if (duals && vs_dual_level(a, (size_t)given) >= 0 &&
        table->differentiate(f->vm, f->function, a, given, out, &status))
      return status;
    if (!enter_slowly(f, a, given)) return vs_bind_reorder(f, a, given), VS_ERROR;
  }
  for (int i = 0; f->procedure->key[i].mode != VS_ARG_END; i++) {
    vs_value v = a[places + i];
    if (v == VS_ABSENT) set_absent(&f->key[i]);
    else if (!vs_convert(f, &f->procedure->key[i], v, &f->key[i])) return VS_ERROR;
  }
  const vs_arg *stand = NULL;
  for (int i = 0; i < VS_MAX_KEYS && f->procedure->key[i].mode != VS_ARG_END; i++)
    if (f->procedure->key[i].contract == VS_C_STAND && f->key[i].given) stand = &f->key[i];
  vs_status status = f->function(f, out);
  return stand && status == VS_OK ? vs_bind_stand(f, stand, out) : status;
}

vs_status vs_bind_call(vs_scheme *vm, const vs_bind_columns *table, vs_value *a, int n, vs_value *out) {
  const vs_native_def *native = vm->native->def;
  const ptrdiff_t i = native - table->natives;
  vs_args f; /* the code below sets members of f one by one: clearing the struct would take longer than most
              * procedures */
  f.vm = vm, f.bind = vs_bind_of(vm), f.store = f.bind ? f.bind->store : NULL, f.scratch = NULL, f.count = 0;
  f.procedure = &table->procedures[i], f.function = table->functions[i], f.names = native->name;
  vs_status s = run(&f, table, a, n, out);
  if (f.scratch) vs_bind_scratch_free(&f);
  return s;
}
