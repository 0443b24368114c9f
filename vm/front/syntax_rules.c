/* Implements syntax-rules: matches patterns, expands templates, and renames the names that a template introduces.
 *
 * A rule is #(pattern template variables depths): `variables` is a vector of identifiers, `depths` has the number of
 * ellipses over each variable. Matching works directly on the pattern. The variables of a pattern have slots in the
 * order of matching, so that the variables of a subpattern have consecutive slots. Under an ellipsis, each of these
 * slots contains the list of the variable's values. Recursion is as deep as the pattern or template, which is
 * limited. */
#include "vm/front/syntax_rules.h"

#include "vm/machine/fail.h"
#include "vm/values/equal.h"
#include "vm/front/expand.h"

enum { PATTERN_DEPTH = 200 };
enum { RULE_PATTERN, RULE_TEMPLATE, RULE_VARS, RULE_DEPTHS, RULE_SIZE };
enum { DATA_LITERALS, DATA_ELLIPSIS, DATA_RULES, DATA_SIZE };

typedef struct {
  vs_expansion *x;
  vs_scheme *vm;
  vs_value *r;             /* roots of the garbage collector; R_MACRO and similar constants are their indices */
  vs_pos pos;
  bool underscore_is_literal;
} rules;
enum { R_MACRO, R_ENV /* environment of the macro's use */, R_RULE, R_SLOTS, R_RENAMES, R_DEPTHS, R_FORM, R_COUNT };

static vs_value field(vs_value v, size_t i) { return vs_as_vector(v)->at[i]; }
static vs_value data(const rules *s, size_t i) { return field(vs_as_macro(s->r[R_MACRO])->data, i); }

static bool member(vs_value list, vs_value id) {
  for (; vs_is_pair(list); list = vs_cdr(list)) if (vs_car(list) == id) return true;
  return false;
}

/* Returns true if v is an identifier and no keyword. A keyword such as #:name in a pattern or template is a datum. */
static bool is_name(vs_value v) {
  return vs_is(v, VS_T_ALIAS) ||
         (vs_is_symbol(v) && (vs_as_symbol(v)->length < 3 || memcmp(vs_as_symbol(v)->name, "#:", 2)));
}

static bool is_literal(const rules *s, vs_value id) { return member(data(s, DATA_LITERALS), id); }
/* Returns true if v is the ellipsis that the macro has declared. If it has declared none, returns true for an
 * identifier that means ... where the macro was defined. */
static bool is_ellipsis(const rules *s, vs_value v) {
  if (!vs_is_identifier(v)) return false;
  vs_value own = data(s, DATA_ELLIPSIS);
  if (is_literal(s, v)) return false;
  return own != VS_FALSE ? v == own : vs_is_form(vs_as_macro(s->r[R_MACRO])->env, v, VS_FORM_ellipsis);
}
static bool is_underscore(const rules *s, vs_value v) {
  return vs_is_form(vs_as_macro(s->r[R_MACRO])->env, v, VS_FORM_underscore);
}

/* ---- checking patterns ---- */
/* Adds the variables of a pattern, in the order of matching, to two lists: identifiers to lists[0], their numbers of
 * ellipses to lists[1]. Both lists have the newest element first. */
static bool collect(rules *s, vs_value pattern, vs_value *lists, int64_t ellipses, int depth) {
  vs_scheme *vm = s->vm;
  if (depth > PATTERN_DEPTH) return vs_expand_fail(s->x, s->pos, VS_ABSENT, "this pattern is nested too deeply");
  VS_ROOTS(vm, r, 1);
  r[0] = pattern;
  bool seen = false;
  while (vs_is_pair(r[0])) {
    bool dots = vs_is_pair(vs_cdr(r[0])) && is_ellipsis(s, vs_car(vs_cdr(r[0])));
    if (is_ellipsis(s, vs_car(r[0])))
      return vs_expand_fail(s->x, vs_element_pos(r[0], false, s->pos), VS_ABSENT,
                            "an ellipsis follows nothing in this pattern");
    if (dots && seen)
      return vs_expand_fail(s->x, vs_element_pos(r[0], false, s->pos), VS_ABSENT,
                            "two ellipses in one list of a pattern");
    if (!collect(s, vs_car(r[0]), lists, ellipses + dots, depth + 1)) return false;
    seen = seen || dots;
    r[0] = dots ? vs_cdr(vs_cdr(r[0])) : vs_cdr(r[0]);
  }
  if (is_name(r[0])) {
    if (is_literal(s, r[0]) || is_underscore(s, r[0])) return true;
    if (is_ellipsis(s, r[0]))
      return vs_expand_fail(s->x, s->pos, VS_ABSENT, "an ellipsis follows nothing in this pattern");
    if (member(lists[0], r[0]))
      return vs_expand_fail(s->x, s->pos, VS_ABSENT, "the pattern variable %s comes twice",
                            vs_as_symbol(vs_identifier_symbol(r[0]))->name);
    return vs_cons(vm, r[0], lists[0], &lists[0]) && vs_cons(vm, vs_fix(ellipses), lists[1], &lists[1]);
  }
  if (vs_is_vector(r[0])) {
    VS_ROOTS(vm, l, 1);
    l[0] = VS_NIL;
    for (size_t i = vs_as_vector(r[0])->length; i-- > 0;) if (!vs_cons(vm, field(r[0], i), l[0], &l[0])) return false;
    return collect(s, l[0], lists, ellipses, depth + 1);
  }
  return true;
}

/* ---- checking templates, when the macro is defined, so that mistakes are reported before its first use ---- */
/* Returns the number of ellipses over the pattern variable id, or -1 if id is no pattern variable. lists[0]: the
 * variables; lists[1]: the number of ellipses over each. */
static int64_t ellipses_of(const vs_value *lists, vs_value id) {
  vs_value depths = lists[1];
  for (vs_value l = lists[0]; vs_is_pair(l); l = vs_cdr(l), depths = vs_cdr(depths))
    if (vs_car(l) == id) return vs_fixnum(vs_car(depths));
  return -1;
}

/* Returns true if the subtemplate t contains a variable that has more than `ellipses` ellipses in the pattern. */
static bool repeats(const vs_value *lists, vs_value t, int64_t ellipses, int depth) {
  if (depth > PATTERN_DEPTH) return true;
  for (; vs_is_pair(t); t = vs_cdr(t)) if (repeats(lists, vs_car(t), ellipses, depth + 1)) return true;
  if (vs_is_vector(t))
    for (size_t i = 0; i < vs_as_vector(t)->length; i++)
      if (repeats(lists, field(t, i), ellipses, depth + 1)) return true;
  return vs_is_identifier(t) && ellipses_of(lists, t) > ellipses;
}

static bool no_repetition(rules *s, vs_pos pos) {
  return vs_expand_fail(s->x, pos, VS_ABSENT, "an ellipsis of the template follows nothing that repeats");
}

/* Checks the subtemplate t, over which there are `outside` ellipses. */
static bool check_template(rules *s, const vs_value *lists, vs_value t, bool dots, int64_t outside, vs_pos pos,
                           int depth) {
  if (depth > PATTERN_DEPTH) return vs_expand_fail(s->x, s->pos, VS_ABSENT, "this template is nested too deeply");
  if (dots && vs_is_pair(t) && is_ellipsis(s, vs_car(t))) {
    if (!vs_is_pair(vs_cdr(t)) || vs_cdr(vs_cdr(t)) != VS_NIL)
      return vs_expand_fail(s->x, pos, VS_ABSENT, "(... template) takes one template");
    return check_template(s, lists, vs_car(vs_cdr(t)), false, outside, vs_element_pos(vs_cdr(t), false, pos),
                          depth + 1);
  }
  if (vs_is_vector(t)) {
    size_t n = vs_as_vector(t)->length;
    if (dots && n && is_ellipsis(s, field(t, 0))) return true;   /* a template after an escape, #(... template), is
                                                                  * checked only when the macro is used */
    for (size_t i = 0, next; i < n; i = next) {
      for (next = i + 1; dots && next < n && is_ellipsis(s, field(t, next)); next++) {
        if (!repeats(lists, field(t, i), outside + (int64_t)(next - i - 1), 0)) return no_repetition(s, pos);
      }
      if (!check_template(s, lists, field(t, i), dots, outside + (int64_t)(next - i - 1), pos, depth + 1)) return false;
    }
    return true;
  }
  for (bool first = true; vs_is_pair(t); first = false) {
    if (dots && is_ellipsis(s, vs_car(t)) && !first) break;                         /* the tail is an escaped ellipsis:
                                                                                     * (a . (... b)) */
    int64_t level = 0;
    vs_value rest = vs_cdr(t), sub = vs_car(t);
    vs_pos place = vs_element_pos(t, first, pos);
    while (dots && vs_is_pair(rest) && is_ellipsis(s, vs_car(rest))) { level++; rest = vs_cdr(rest); }
    for (int64_t i = 0; i < level; i++)
      if (!repeats(lists, sub, outside + i, 0)) return no_repetition(s, place);
    if (!check_template(s, lists, sub, dots, outside + level, place, depth + 1)) return false;
    t = rest;
  }
  if (vs_is_pair(t)) return check_template(s, lists, t, dots, outside, pos, depth + 1);
  if (is_name(t) && ellipses_of(lists, t) > outside)
    return vs_expand_fail(s->x, pos, VS_ABSENT, "%s matches a sequence: an ellipsis must follow it in the template",
                          vs_as_symbol(vs_identifier_symbol(t))->name);
  return !vs_is_vector(t) || check_template(s, lists, t, dots, outside, pos, depth + 1);
}

static bool to_vector(vs_scheme *vm, vs_value list_reversed, vs_value *out) {
  VS_ROOTS(vm, r, 1);
  r[0] = list_reversed;
  size_t n = (size_t)vs_list_length(list_reversed);
  if (!vs_make_vector(vm, n, VS_FALSE, out)) return false;
  for (; n-- > 0; r[0] = vs_cdr(r[0])) vs_gc_store(vm, vs_as_vector(*out), &vs_as_vector(*out)->at[n], vs_car(r[0]));
  return true;
}

bool vs_rules_make(vs_expansion *x, vs_value spec, vs_value env, vs_pos pos, vs_value *macro) {
  vs_scheme *vm = x->vm;
  VS_ROOTS(vm, r, R_COUNT);
  VS_ROOTS(vm, t, 6);
  t[0] = spec;
  if (vs_list_length(spec) < 2)
    return vs_expand_fail(x, pos, spec, "syntax-rules is written %s, not", vs_form_shape(VS_FORM_syntax_rules));
  vs_value l = vs_cdr(spec), ellipsis = VS_FALSE;
  if (vs_is_identifier(vs_car(l))) { ellipsis = vs_car(l); l = vs_cdr(l); }
  if (!vs_is_pair(l) || vs_list_length(vs_car(l)) < 0)
    return vs_expand_fail(x, pos, spec, "syntax-rules is written %s, not", vs_form_shape(VS_FORM_syntax_rules));
  for (vs_value k = vs_car(l); vs_is_pair(k); k = vs_cdr(k))
    if (!vs_is_identifier(vs_car(k)))
      return vs_expand_fail(x, pos, vs_car(k), "the literals of syntax-rules are names, not");
  t[1] = l; t[2] = ellipsis; t[3] = env;
  vs_macro *m = (vs_macro *)(void *)vs_gc_alloc(vm, VS_T_MACRO, VS_WORDS(vs_macro));
  if (!m) return false;
  m->kind = vs_fix(VS_MACRO_RULES); m->transformer = VS_FALSE; m->env = t[3]; m->data = VS_FALSE;
  r[R_MACRO] = vs_from_object(m);
  if (!vs_make_vector(vm, DATA_SIZE, VS_NIL, &t[4])) return false;
  vs_vector *d = vs_as_vector(t[4]);
  vs_gc_store(vm, d, &d->at[DATA_LITERALS], vs_car(t[1]));
  vs_gc_store(vm, d, &d->at[DATA_ELLIPSIS], t[2]);
  vs_gc_store(vm, vs_as_macro(r[R_MACRO]), &vs_as_macro(r[R_MACRO])->data, t[4]);
  rules s = {.x = x, .vm = vm, .r = r, .pos = pos};
  VS_ROOTS(vm, lists, 4);     /* roots of the garbage collector: variables, depths, rules so far, temporary value */
  lists[2] = VS_NIL;
  for (t[1] = vs_cdr(t[1]); vs_is_pair(t[1]); t[1] = vs_cdr(t[1])) {
    t[5] = vs_car(t[1]);
    s.pos = vs_element_pos(t[1], false, pos);
    if (vs_list_length(t[5]) != 2 || !vs_is_pair(vs_car(t[5])))
      return vs_expand_fail(x, s.pos, t[5], "a rule is (pattern template), the pattern in parentheses; not");
    lists[0] = lists[1] = VS_NIL;
    if (!collect(&s, vs_cdr(vs_car(t[5])), lists, 0, 0) ||
        !check_template(&s, lists, vs_car(vs_cdr(t[5])), true, 0, vs_element_pos(vs_cdr(t[5]), false, s.pos), 0) ||
        !vs_make_vector(vm, RULE_SIZE, VS_FALSE, &lists[3]))
      return false;
    vs_vector *rule = vs_as_vector(lists[3]);
    vs_gc_store(vm, rule, &rule->at[RULE_PATTERN], vs_cdr(vs_car(t[5])));
    vs_gc_store(vm, rule, &rule->at[RULE_TEMPLATE], vs_car(vs_cdr(t[5])));
    VS_ROOTS(vm, v, 1);
    for (int i = 0; i < 2; i++) {
      if (!to_vector(vm, lists[i], &v[0])) return false;
      vs_gc_store(vm, vs_as_vector(lists[3]), &vs_as_vector(lists[3])->at[i ? RULE_DEPTHS : RULE_VARS], v[0]);
    }
    if (!vs_cons(vm, lists[3], lists[2], &lists[2])) return false;
  }
  if (!to_vector(vm, lists[2], &lists[3])) return false;
  d = vs_as_vector(vs_as_macro(r[R_MACRO])->data);
  vs_gc_store(vm, d, &d->at[DATA_RULES], lists[3]);
  *macro = r[R_MACRO];
  return true;
}

/* ---- matching: functions return 1 if the form matches, 0 if not, -1 with the error set; *slot is the slot of the next
 * variable ---- */
static size_t count_vars(const rules *s, vs_value p, int depth) {
  size_t n = 0;
  if (depth > PATTERN_DEPTH) return 0;
  for (; vs_is_pair(p); p = vs_cdr(p)) if (!is_ellipsis(s, vs_car(p))) n += count_vars(s, vs_car(p), depth + 1);
  if (is_name(p)) return n + (!is_literal(s, p) && !is_underscore(s, p) && !is_ellipsis(s, p));
  if (vs_is_vector(p))
    for (size_t i = 0; i < vs_as_vector(p)->length; i++)
      if (!is_ellipsis(s, field(p, i))) n += count_vars(s, field(p, i), depth + 1);
  return n;
}

static bool vector_list(vs_scheme *vm, vs_value vector, vs_value *out) {
  VS_ROOTS(vm, r, 1);
  r[0] = vector;
  *out = VS_NIL;
  for (size_t i = vs_as_vector(r[0])->length; i-- > 0;) if (!vs_cons(vm, field(r[0], i), *out, out)) return false;
  return true;
}

static int match(rules *s, vs_value pattern, vs_value form, size_t *slot) {
  vs_scheme *vm = s->vm;
  VS_ROOTS(vm, r, 4);      /* roots of the garbage collector: pattern, form, values under an ellipsis, temporary
                            * value */
  r[0] = pattern; r[1] = form;
  for (;;) {
    if (is_name(r[0])) {
      if (is_literal(s, r[0]))
        return vs_is_identifier(r[1]) && vs_same_meaning(vs_as_macro(s->r[R_MACRO])->env, r[0], s->r[R_ENV], r[1]);
      if (is_underscore(s, r[0])) return 1;
      vs_vector *slots = vs_as_vector(s->r[R_SLOTS]);
      vs_gc_store(vm, slots, &slots->at[(*slot)++], r[1]);
      return 1;
    }
    if (vs_is_pair(r[0]) && vs_is_pair(vs_cdr(r[0])) && is_ellipsis(s, vs_car(vs_cdr(r[0])))) {
      vs_value after = vs_cdr(vs_cdr(r[0]));
      int64_t tail = 0, have = 0;
      for (vs_value l = after; vs_is_pair(l); l = vs_cdr(l)) tail++;
      for (vs_value l = r[1]; vs_is_pair(l); l = vs_cdr(l)) have++;
      if (have < tail) return 0;
      size_t first = *slot, n = count_vars(s, vs_car(r[0]), 0);
      if (!vs_make_vector(vm, n, VS_NIL, &r[2])) return -1;
      for (int64_t i = 0; i < have - tail; i++, r[1] = vs_cdr(r[1])) {
        *slot = first;
        int ok = match(s, vs_car(r[0]), vs_car(r[1]), slot);
        if (ok != 1) return ok;
        for (size_t k = 0; k < n; k++) {
          if (!vs_cons(vm, field(s->r[R_SLOTS], first + k), field(r[2], k), &r[3])) return -1;
          vs_gc_store(vm, vs_as_vector(r[2]), &vs_as_vector(r[2])->at[k], r[3]);
        }
      }
      for (size_t k = 0; k < n; k++) {                     /* reverses the list of each variable, which has its newest
                                                            * value first */
        vs_value l = field(r[2], k), done = VS_NIL;
        while (vs_is_pair(l)) {
          vs_value next = vs_cdr(l);
          vs_gc_store(vm, vs_as_pair(l), &vs_as_pair(l)->cdr, done);
          done = l;
          l = next;
        }
        vs_vector *slots = vs_as_vector(s->r[R_SLOTS]);
        vs_gc_store(vm, slots, &slots->at[first + k], done);
      }
      *slot = first + n;
      r[0] = vs_cdr(vs_cdr(r[0]));
      continue;
    }
    if (vs_is_pair(r[0])) {
      if (!vs_is_pair(r[1])) return 0;
      int ok = match(s, vs_car(r[0]), vs_car(r[1]), slot);
      if (ok != 1) return ok;
      r[0] = vs_cdr(r[0]);
      r[1] = vs_cdr(r[1]);
      continue;
    }
    if (vs_is_vector(r[0])) {
      if (!vs_is_vector(r[1])) return 0;
      if (!vector_list(vm, r[0], &r[0]) || !vector_list(vm, r[1], &r[1])) return -1;
      continue;
    }
    bool same;
    return vs_equal(vm, r[0], r[1], &same) ? same : -1;
  }
}

/* ---- expanding templates ---- */
static int64_t slot_of(const rules *s, vs_value id) {
  const vs_vector *vars = vs_as_vector(field(s->r[R_RULE], RULE_VARS));
  for (size_t i = 0; i < vars->length; i++) if (vars->at[i] == id) return (int64_t)i;
  return -1;
}

static bool rename_id(rules *s, vs_value id, vs_value *out) {
  vs_scheme *vm = s->vm;
  VS_ROOTS(vm, r, 2);
  for (vs_value l = s->r[R_RENAMES]; vs_is_pair(l); l = vs_cdr(l))
    if (vs_car(vs_car(l)) == id) { *out = vs_cdr(vs_car(l)); return true; }
  r[0] = id;
  return vs_make_alias(vm, id, vs_as_macro(s->r[R_MACRO])->env, &r[1]) &&
         (*out = r[1], vs_cons(vm, r[0], r[1], &r[0])) && vs_cons(vm, r[0], s->r[R_RENAMES], &s->r[R_RENAMES]) &&
         (*out = vs_cdr(vs_car(s->r[R_RENAMES])), true);
}

static bool instantiate(rules *s, vs_value template, bool dots, vs_value *out, int depth);

/* Sets used[i] for each variable i in the subtemplate t whose slot still contains a list, because the variable is under
 * an ellipsis. */
static void mark_slots(const rules *s, vs_value t, bool *used, bool dots, int depth) {
  if (depth > PATTERN_DEPTH) return;
  for (; vs_is_pair(t); t = vs_cdr(t)) mark_slots(s, vs_car(t), used, dots, depth + 1);
  if (vs_is_identifier(t)) {
    int64_t i = slot_of(s, t);
    if (i >= 0 && vs_fixnum(field(s->r[R_DEPTHS], (size_t)i)) > 0) used[i] = true;
  } else if (vs_is_vector(t))
    for (size_t i = 0; i < vs_as_vector(t)->length; i++) mark_slots(s, field(t, i), used, dots, depth + 1);
}

static bool copy_vector(vs_scheme *vm, vs_value v, vs_value *out) {
  VS_ROOTS(vm, r, 1);
  r[0] = v;
  size_t n = vs_as_vector(v)->length;
  if (!vs_make_vector(vm, n, VS_FALSE, out)) return false;
  for (size_t i = 0; i < n; i++) vs_gc_store(vm, vs_as_vector(*out), &vs_as_vector(*out)->at[i], field(r[0], i));
  return true;
}

/* Expands the subtemplate sub, which has `level` ellipses after it, once for each element of its variables' lists. Adds
 * the expansions to the start of *list, newest first. */
static bool repeat(rules *s, vs_value sub, int level, vs_value *list, int depth) {
  vs_scheme *vm = s->vm;
  VS_ROOTS(vm, r, 6);     /* roots of the garbage collector: sub, saved slots, saved depths, current slots, current
                           * depths, result */
  r[0] = sub;
  size_t n = vs_as_vector(field(s->r[R_RULE], RULE_VARS))->length;
  bool small[64], *used = n <= 64 ? small : vs_mem(vm, NULL, 0, n);
  if (!used) return false;
  memset(used, 0, n);
  mark_slots(s, sub, used, true, 0);
  bool any = false, ok = true;
  size_t turns = 0;
  for (size_t i = 0; i < n; i++) {
    if (!used[i]) continue;
    size_t length = (size_t)vs_list_length(field(s->r[R_SLOTS], i));
    if (any && length != turns) {
      ok = vs_expand_fail(s->x, s->pos, VS_ABSENT, "the lists under one ellipsis have different lengths, %zu and %zu",
                          turns, length);
      break;
    }
    any = true;
    turns = length;
  }
  if (ok && !any) ok = no_repetition(s, s->pos);
  r[1] = s->r[R_SLOTS]; r[2] = s->r[R_DEPTHS];
  ok = ok && copy_vector(vm, r[1], &r[3]) && copy_vector(vm, r[2], &r[4]);
  for (size_t i = 0; ok && i < n; i++) if (used[i]) vs_as_vector(r[4])->at[i] = vs_fix(vs_fixnum(field(r[4], i)) - 1);
  for (size_t turn = 0; ok && turn < turns; turn++) {
    ok = vs_poll(vm, 1) && copy_vector(vm, r[3], &r[5]);
    if (!ok) break;
    vs_vector *now = vs_as_vector(r[5]), *next = vs_as_vector(r[3]);
    for (size_t i = 0; i < n; i++) {
      if (!used[i]) continue;
      vs_value l = next->at[i];
      vs_gc_store(vm, now, &now->at[i], vs_car(l));
      vs_gc_store(vm, next, &next->at[i], vs_cdr(l));
    }
    s->r[R_SLOTS] = r[5];
    s->r[R_DEPTHS] = r[4];
    if (level > 1) ok = repeat(s, r[0], level - 1, list, depth + 1);
    else ok = instantiate(s, r[0], true, &r[5], depth + 1) && vs_cons(vm, r[5], *list, list);
  }
  s->r[R_SLOTS] = r[1];
  s->r[R_DEPTHS] = r[2];
  if (used != small) vs_mem(vm, used, n, 0);
  return ok;
}

static bool instantiate(rules *s, vs_value template, bool dots, vs_value *out, int depth) {
  vs_scheme *vm = s->vm;
  if (depth > PATTERN_DEPTH) return vs_expand_fail(s->x, s->pos, VS_ABSENT, "this template is nested too deeply");
  VS_ROOTS(vm, r, 4);      /* roots of the garbage collector: rest of the template, first, last, temporary value */
  r[0] = template;
  r[1] = r[2] = VS_NIL;
  if (dots && vs_is_pair(r[0]) && is_ellipsis(s, vs_car(r[0]))) {
    if (!vs_is_pair(vs_cdr(r[0])) || vs_cdr(vs_cdr(r[0])) != VS_NIL)
      return vs_expand_fail(s->x, s->pos, VS_ABSENT, "(... template) takes one template");
    return instantiate(s, vs_car(vs_cdr(r[0])), false, out, depth + 1);
  }
  if (vs_is_vector(r[0])) {
    if (!vector_list(vm, r[0], &r[0]) || !instantiate(s, r[0], dots, &r[1], depth + 1)) return false;
    r[3] = VS_NIL;
    for (; vs_is_pair(r[1]); r[1] = vs_cdr(r[1])) if (!vs_cons(vm, vs_car(r[1]), r[3], &r[3])) return false;
    r[2] = r[3];
    return to_vector(vm, r[2], out);
  }
  while (vs_is_pair(r[0])) {
    if (dots && is_ellipsis(s, vs_car(r[0])) && r[1] != VS_NIL) break;             /* the tail is an escaped ellipsis:
                                                                                    * (a . (... b)) */
    int level = 0;
    vs_value rest = vs_cdr(r[0]);
    while (dots && vs_is_pair(rest) && is_ellipsis(s, vs_car(rest))) { level++; rest = vs_cdr(rest); }
    vs_value square = vs_object_of(r[0])->flags & VS_F_SQUARE;
    VS_ROOTS(vm, t, 2);                                                           /* roots of the garbage collector: the
                                                                                   * new pairs, newest first */
    t[0] = VS_NIL;
    if (level) { if (!repeat(s, vs_car(r[0]), level, &t[0], depth)) return false; }
    else if (!instantiate(s, vs_car(r[0]), dots, &t[1], depth + 1) || !vs_cons(vm, t[1], t[0], &t[0])) return false;
    vs_value chain = VS_NIL;                                                      /* reverses the list of new pairs in
                                                                                   * place */
    for (vs_value l = t[0]; vs_is_pair(l);) {
      vs_value next = vs_cdr(l);
      vs_gc_store(vm, vs_as_pair(l), &vs_as_pair(l)->cdr, chain);
      chain = l;
      l = next;
    }
    if (chain != VS_NIL) {
      if (square) vs_object_of(chain)->flags |= VS_F_SQUARE;
      if (r[1] == VS_NIL) r[1] = chain;
      else vs_gc_store(vm, vs_as_pair(r[2]), &vs_as_pair(r[2])->cdr, chain);
      r[2] = t[0];
    }
    r[0] = vs_cdr(r[0]);
    while (level-- > 0) r[0] = vs_cdr(r[0]);
  }
  if (is_name(r[0])) {
    int64_t i = slot_of(s, r[0]);
    if (i >= 0) {
      if (vs_fixnum(field(s->r[R_DEPTHS], (size_t)i)) > 0)
        return vs_expand_fail(s->x, s->pos, VS_ABSENT,
                              "%s matches a sequence: an ellipsis must follow it in the template",
                              vs_as_symbol(vs_identifier_symbol(r[0]))->name);
      r[3] = field(s->r[R_SLOTS], (size_t)i);
    } else if (!rename_id(s, r[0], &r[3])) return false;
  } else if (vs_is_pair(r[0])) { if (!instantiate(s, r[0], dots, &r[3], depth + 1)) return false; }
  else if (vs_is_vector(r[0])) { if (!instantiate(s, r[0], dots, &r[3], depth + 1)) return false; }
  else r[3] = r[0];
  if (r[1] == VS_NIL) { *out = r[3]; return true; }
  vs_gc_store(vm, vs_as_pair(r[2]), &vs_as_pair(r[2])->cdr, r[3]);
  *out = r[1];
  return true;
}

bool vs_rules_expand(vs_expansion *x, vs_value macro, vs_value form, vs_value env, vs_pos pos, vs_value *out) {
  vs_scheme *vm = x->vm;
  VS_ROOTS(vm, r, R_COUNT);
  r[R_MACRO] = macro; r[R_FORM] = form; r[R_ENV] = env; r[R_RENAMES] = VS_NIL;
  rules s = {.x = x, .vm = vm, .r = r, .pos = pos};
  size_t n = vs_as_vector(data(&s, DATA_RULES))->length;
  for (size_t i = 0; i < n; i++) {
    r[R_RULE] = field(data(&s, DATA_RULES), i);
    if (!vs_make_vector(vm, vs_as_vector(field(r[R_RULE], RULE_VARS))->length, VS_FALSE, &r[R_SLOTS])) return false;
    size_t slot = 0;
    int ok = match(&s, field(r[R_RULE], RULE_PATTERN), vs_cdr(r[R_FORM]), &slot);
    if (ok < 0) return false;
    if (!ok) continue;
    r[R_DEPTHS] = field(r[R_RULE], RULE_DEPTHS);
    return instantiate(&s, field(r[R_RULE], RULE_TEMPLATE), true, out, 0);
  }
  const char *name =
      vs_is_identifier(vs_car(r[R_FORM])) ? vs_as_symbol(vs_identifier_symbol(vs_car(r[R_FORM])))->name : "syntax";
  if (n == 1) {
    VS_ROOTS(vm, t, 1);
    r[R_RULE] = field(data(&s, DATA_RULES), 0);
    return vs_cons(vm, vs_identifier_symbol(vs_car(r[R_FORM])), field(r[R_RULE], RULE_PATTERN), &t[0]) &&
           vs_strip(vm, t[0], &t[0]) && vs_cons(vm, r[R_FORM], VS_NIL, &r[R_FORM]) &&
           vs_strip(vm, r[R_FORM], &r[R_FORM]) && vs_cons(vm, t[0], r[R_FORM], &r[R_FORM]) &&
           vs_fail_at(vm, vm->sym.syntax, pos, r[R_FORM],
                      "%s: this does not have the right form; the pattern and the use:", name);
  }
  return vs_expand_fail(x, pos, r[R_FORM], "%s: no rule of this macro matches", name);
}
