/* Checks calls in which all arguments, or all but one, are constants. The interpreter evaluates the calls; its errors
 * and warnings are findings. */
#include "languages/checks/constant_calls.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "languages/checks/argument_checks.h"
#include "model/store/array.h"

enum { MOST_TEXT = 2000, MOST_DEPTH = 60 };

void know_put(know_expression *t, const char *s, size_t n) {
  if (t->count + n + 2 > MOST_TEXT) t->failed = true;
  if (t->failed || !VS_GROW(t->at, t->room, t->count + n + 2)) {
    t->failed = true;
    return;
  }
  memcpy(t->at + t->count, s, n);
  t->count += n;
  t->at[t->count++] = ' ';
}

void know_put_constant(const knowledge *k, know_index node, know_expression *t) {
  const know_node *n = &k->nodes[node];
  size_t length;
  const char *s = know_spelling(k, node, &length);
  if (t->failed || ++t->depth > MOST_DEPTH) {
    t->failed = true;
    return;
  }
  know_index head = n->first, value;
  if (n->kind == KNOW_NUMBER || n->kind == KNOW_STRING || n->kind == KNOW_BOOLEAN || n->kind == KNOW_CHARACTER ||
      n->kind == KNOW_KEYWORD || n->kind == KNOW_VECTOR)
    know_put(t, s, length);
  else if (n->kind == KNOW_LIST && n->walked && n->form && know_is(k, head, "quote")) know_put(t, s, length);
  else if (n->kind == KNOW_LIST && n->walked && !n->form && !n->expansion && know_plain_row(k,
      head ? k->nodes[head].symbol : 0) >= 0) {
    know_put(t, "(", 1);
    for (know_index i = head; i; i = k->nodes[i].next)
      if (i == head)
        know_put(t, k->symbols[k->nodes[head].symbol].text, strlen(k->symbols[k->nodes[head].symbol].text));
      else know_put_constant(k, i, t);
    know_put(t, ")", 1);
  } else if (n->kind == KNOW_SYMBOL && n->role == KNOW_REFERENCE && k->symbols[n->symbol].kind == KNOW_BUILTIN &&
      (!*k->symbols[n->symbol].call || know_plain_row(k, n->symbol) >= 0) && *k->symbols[n->symbol].text != '%')
    know_put(t, k->symbols[n->symbol].text, strlen(k->symbols[n->symbol].text)); /* writes a name of the language, such
                                                                                  * as pi, origin, ux or sqrt */
  else if (t->depth == 2 && n->kind == KNOW_SYMBOL && n->role == KNOW_REFERENCE && n->symbol &&
           k->symbols[n->symbol].kind == KNOW_FUNCTION)
    know_put(t, "(lambda any #t)", 15); /* writes this lambda in place of a procedure of the program, whose value is not
                                         * known */
  else if ((value = know_constant_value(k, node)) != 0) know_put_constant(k, value, t);
  else t->failed = true;
  t->depth--;
}

const char *know_objection(knowledge *k, know_index node, const char *expression, size_t length) {
  know_expression t = {0};
  know_put(&t, "(let ((value\n", 13);
  for (uint32_t i = 1; i < k->nodes[node].at.column && i < 200; i++) know_put(&t, "", 0);
  know_put(&t, expression, length);
  know_put(&t, ")) #t)", 6);
  *k->heard = 0;
  k->heard_warning = false;
  k->muted = true;
  vs_outcome outcome =
      t.failed ? VS_OUTCOME_DONE
               : vs_eval_text(k->scheme, "constant", k->nodes[node].at.line + 100000 * k->trial, t.at, t.count, 0);
  k->muted = false;
  free(t.at);
  return outcome == VS_OUTCOME_MODEL || (outcome == VS_OUTCOME_DONE && k->heard_warning) ? k->heard : "";
}

bool know_guarded(const knowledge *k, know_index node) {
  for (; node; node = k->nodes[node].parent)
    if (know_is(k, k->nodes[node].first, "guard") || know_is(k, k->nodes[node].first,
        "with-exception-handler")) return true;
  return false;
}

/* Returns true for a call of `draw` with an object. Such calls are not evaluated: the interpreter would keep all
 * objects, and warn about equal objects. */
static bool draws_object(const knowledge *k, know_index node) {
  know_type type = know_type_of(k, know_nth(k, node, 1));
  return know_is(k, k->nodes[node].first, "draw") && (type == KNOW_TYPE_OBJECT || type == KNOW_TYPE_LIST || !type);
}

/* Returns true for a node that is an argument of a predicate, as in (empty-object? (do-offset c -2)). The program
 * itself tests for the case about which a warning would inform. */
static bool is_asked(const knowledge *k, know_index node) {
  know_index head = k->nodes[k->nodes[node].parent].first;
  const char *name = head && k->nodes[head].kind == KNOW_SYMBOL ? k->names[k->nodes[head].name].text : "";
  return *name && name[strlen(name) - 1] == '?';
}

/* Returns true for the interpreter's error about a wrong number of arguments, or about an unknown keyword. */
static bool is_of_count(const char *why) {
  return strstr(why, " needs ") || strstr(why, " takes no arguments") || strstr(why, ": takes (") ||
         strstr(why, " has no keyword ");
}

bool know_check_constants(know_findings *f, know_index node, uint8_t *wrong) {
  knowledge *k = f->k;
  for (know_index i = know_nth(k, node, 1); i; i = k->nodes[i].next)
    if (wrong[i]) return wrong[node] = 1, false; /* the error in an argument is reported at the argument, so the call is
                                                  * only marked */
  if (draws_object(k, node)) return true;
  know_expression t = {0};
  know_put_constant(k, node, &t);
  const char *why = t.failed ? "" : know_objection(k, node, t.at, t.count);
  free(t.at);
  if (*why && !know_guarded(k, node) && !(k->heard_warning && is_asked(k, node)))
    know_found(f, is_of_count(why) ? KNOW_CHECK_ARGUMENTS : KNOW_CHECK_CONTRACT, node, "%s", why);
  wrong[node] = *why != 0;
  return !*why;
}


/* ---- calls with one argument whose value is unknown ---- */

/* Values of all kinds that are tried in place of an unknown argument. Each contains 41; an error message that contains
 * 41 is about this value. The common kinds have two values, since one may equal a constant of the call. */
static const char *const values[] = {
  "41",
  "41.5",
  "0.41",
  "(xyz 41 2 3)",
  "(xyz -7 5 41)",
  "(xyz 41 7 0)",
  "(xyz 41 0 7)",
  "(xyz 0 41 7)",
  "(vxyz 41 2 3)",
  "(vxyz 0 0 41)",
  "(make-box (xyz 0 0 0) (xyz 41 1 1))",
  "(make-sphere (xyz 5 5 41) 2)",
  "(make-circle (xyz 41 0 0) 1)",
  "(make-circle (xz 41 0) 1 #:plane 'xz)",
  "(make-line (xyz 41 0 0) (xyz 41 1 0) (xyz 41 1 1))",
  "(make-region (make-circle (xyz 41 0 0) 1))",
  "(do-extrude (make-line (xyz 41 0 0) (xyz 41 1 0)) 1)",
  "(list (xyz 41 0 0) (xyz 41 1 0) (xyz 41 0 1))",
  "(list 41 41 41)",
  "(list (make-circle (xyz 41 0 0) 1) (make-circle (xyz 41 0 2) 1))",
  "(list (list (xyz 41 0 0) (xyz 41 1 0)))",
  "\"a41\"",
  "\"red\"",
  "'z",
  "'xy",
  "#t",
  "#f",
  "(lambda any (xyz 0 0 0))",
  "(make-plane (xyz 41 0 0) (vxyz 0 0 1))",
  "(make-axis (xyz 41 0 0) (vxyz 0 0 1))",
  "(translation-matrix (vxyz 41 0 0))",
  "(vector 41 2 3)",
  "(make-material #:roughness 0.41)",
  "'((41 2 3))",
};
enum { VALUES = sizeof values / sizeof *values };

/* Writes the call as text for the interpreter, with `value` in place of the unknown argument. */
static void put_call(const knowledge *k, know_index node, know_index unknown, const char *value, know_expression *t) {
  know_index head = k->nodes[node].first;
  know_put(t, "(", 1);
  know_put(t, k->symbols[k->nodes[head].symbol].text, strlen(k->symbols[k->nodes[head].symbol].text));
  for (know_index i = k->nodes[head].next; i; i = k->nodes[i].next)
    if (i == unknown) know_put(t, value, strlen(value));
    else know_put_constant(k, i, t);
  know_put(t, ")", 1);
}

/* Returns the node of the only positional argument that is not constant, if the call has other arguments. Returns 0 if
 * there is no such argument, or several. */
static know_index unknown_argument(const knowledge *k, know_index node) {
  know_index unknown = 0;
  uint32_t known = 0;
  for (know_index i = know_nth(k, node, 1); i; i = k->nodes[i].next) {
    if (k->nodes[i].kind == KNOW_KEYWORD) {
      i = k->nodes[i].next; /* skips the value of the keyword */
      know_expression value = {0};
      if (i) know_put_constant(k, i, &value);
      free(value.at);
      if (!i || value.failed) return 0;
      continue;
    }
    know_expression t = {0};
    know_put_constant(k, i, &t);
    free(t.at);
    if (t.failed && unknown) return 0;
    if (t.failed) unknown = i;
    else known++;
  }
  return known ? unknown : 0;
}

/* Returns true if the error message is about the kind of a constant, and not about the value that was tried. */
static bool is_of_constant(const char *why) {
  static const char *const plain[] = {"z", "xy", "#t", "#f", "#<", "\"red\""};
  const char *got = strstr(why, ", got ");
  if (!got || (!strstr(why, " must be a ") && !strstr(why, " must be an ")) || strstr(got, "41")) return false;
  for (size_t i = 0; i < sizeof plain / sizeof *plain; i++) {
    size_t n = strlen(plain[i]);
    if (!strncmp(got + 6, plain[i], n) && (plain[i][1] == '<' || !got[6 + n] || got[6 + n] == ';')) return false;
  }
  return true;
}

void know_check_with_unknown(know_findings *f, know_index node, uint8_t *wrong) {
  knowledge *k = f->k;
  know_index unknown = unknown_argument(k, node);
  const char *error = NULL, *warning = NULL;
  if (!unknown || wrong[unknown]) return;
  for (int i = 0; i < VALUES; i++) {
    know_expression t = {0};
    put_call(k, node, unknown, values[i], &t);
    k->trial = (uint32_t)i;
    const char *why = t.failed ? "" : know_objection(k, node, t.at, t.count);
    k->trial = 0;
    free(t.at);
    if (!*why || t.failed) return;
    if (k->heard_warning) { /* The procedure accepts the value that was tried and warns. This is a finding only if all
                             * accepted values lead to one warning */
      if (warning && strcmp(warning, why) != 0) return;
      warning = know_text(k, why, strlen(why));
    } else if (!error && is_of_constant(why)) error = know_text(k, why, strlen(why));
  }
  const char *said = warning ? warning : error;
  if (!said || !*said || know_guarded(k, node) || (warning && is_asked(k, node))) return;
  wrong[node] = 1;
  know_found(f, KNOW_CHECK_CONTRACT, node, "%s", said);
}
