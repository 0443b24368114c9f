/* Implements `vs check`: it finds probable faults of a program by reading it, without running it. Each finding must
 * deserve the author's attention even in a careful program. Each check therefore excludes all cases in which the text
 * can be correct. */
#include "languages/checks/checks.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "languages/checks/argument_checks.h"
#include "languages/checks/syntax_checks.h"
#include "languages/analysis/source_tree.h"
#include "languages/analysis/tree_report.h"
#include "model/store/array.h"

enum { PROGRAM = 2 };

static const char *const names[] = {
#define KNOW_CHECK(id, name, meaning) name,
#include "languages/checks/checks.def"
};

void know_found(know_findings *f, know_check check, know_index node, const char *format, ...) {
  knowledge *k = f->k;
  char text[800];
  va_list list;
  va_start(list, format);
  vsnprintf(text, sizeof text, format, list);
  va_end(list);
  if (!VS_GROW(f->at, f->room, f->count + 1)) know_fail(k, NULL, VS_OUTCOME_MACHINE, "out of memory");
  else f->at[f->count++] = (know_finding){(uint8_t)check, k->nodes[node].at, know_text(k, text, strlen(text))};
}

bool know_is_call(const knowledge *k, know_index node) {
  const know_node *n = &k->nodes[node];
  return n->kind == KNOW_LIST && n->walked && !n->made && !n->origin && !n->expansion && n->first;
}

/* ---- names ---- */

static bool within(const knowledge *k, know_index node, know_index form) {
  const know_place *a = &k->nodes[node].at, *b = &k->nodes[form].at;
  return a->file == b->file && a->from >= b->from && a->to <= b->to;
}

/* Returns true if the symbol is used outside its own definition. */
static bool used_outside(const knowledge *k, const know_symbol *s) {
  for (know_index u = s->first_use; u; u = k->uses[u].next)
    if ((k->uses[u].role == KNOW_REFERENCE || k->uses[u].role == KNOW_OPAQUE) &&
        (s->kind == KNOW_PARAMETER || s->kind == KNOW_LOOP_VARIABLE || s->kind == KNOW_MACRO ||
         k->nodes[s->form].made || !within(k, k->uses[u].node, s->form)))
      return true;
  return false;
}

/* Returns true for a name in (rec name value): the form returns the name's value, so the name counts as used. */
static bool is_own_value(const knowledge *k, const know_symbol *s) {
  return s->form && !k->script && know_is(k, k->nodes[s->form].first, "rec");
}

/* Returns true for a procedure that is passed as a value, so that other procedures call it and determine its number of
 * parameters. */
static bool handed_on(const knowledge *k, const know_symbol *s) {
  for (know_index u = s->first_use; u; u = k->uses[u].next)
    if (k->uses[u].role != KNOW_DEFINITION && !k->uses[u].called) return true;
  return false;
}

/* Returns false for a library, which draws nothing and contains only definitions. */
static bool runs_something(const knowledge *k) {
  for (size_t i = 1; i < k->symbol_count; i++)
    if (k->symbols[i].kind == KNOW_BUILTIN && (!strcmp(k->symbols[i].text, "draw") ||
        !strcmp(k->symbols[i].text, "geo_draw")) && k->symbols[i].calls) return true;
  for (know_index i = k->nodes[k->files[0].root].first; i; i = k->nodes[i].next) {
    know_index head = k->nodes[i].first, s = head ? k->nodes[head].symbol : 0;
    if (k->nodes[i].kind == KNOW_LIST && !k->nodes[i].form && s && k->symbols[s].kind == KNOW_FUNCTION) return true;
  }
  return false;
}

static bool leaves_script(const knowledge *k, know_index node) {
  know_index head = k->nodes[node].kind == KNOW_LIST ? k->nodes[node].first : 0;
  return know_is(k, head, "return") || know_is(k, head, "throw") || know_is(k, head, "break") ||
         know_is(k, head, "continue");
}

static bool leaves(const knowledge *k, know_index node);

/* Returns true if the procedure only raises an error. */
static bool only_fails(const knowledge *k, const know_symbol *s) {
  know_index head = k->script && s->body ? k->nodes[s->body].first : 0;
  if (k->script && !know_is(k, head, "throw")) return false;
  return s->body && !k->nodes[s->body].next && leaves(k, s->body);
}

/* Returns true for a definition of a library, which other programs may use. */
static bool of_library(const knowledge *k, const know_symbol *s) {
  if (k->scopes[s->scope].procedure) return false;
  for (know_index i = s->scope; i; i = k->scopes[i].parent) {
    know_index node = k->scopes[i].node;
    if (k->nodes[node].kind == KNOW_LIST && know_is(k, k->nodes[node].first, "define-library")) return true;
  }
  return false;
}

static bool by_name(const know_symbol *s) { return s->text[0] == '_' || s->text[0] == '%'; }

static const char *noun(const know_symbol *s) {
  switch (s->kind) {
  case KNOW_FUNCTION: return "procedure";
  case KNOW_MODEL_PARAMETER: return "parameter of the model";
  case KNOW_RULE: return "rule";
  case KNOW_MACRO: return "macro";
  default: return "variable";
  }
}

static know_index hiding(const knowledge *k, know_index hidden) {
  for (know_index i = hidden + 1; i < k->symbol_count; i++)
    if (k->symbols[i].hides == hidden && !k->symbols[i].made && k->symbols[i].definition &&
        k->symbols[i].reads) return i;
  return 0;
}

/* Returns true for a name in a value of a let that binds the same name, which the value cannot use. */
static bool bound_by_let(const knowledge *k, know_index node) {
  for (know_index i = node; i; i = k->nodes[i].parent) {
    know_index clauses = k->nodes[k->nodes[i].parent].parent, form = k->nodes[clauses].parent;
    if (!form || !know_is(k, k->nodes[form].first, "let") || know_nth(k, form, 1) != clauses) continue;
    for (know_index c = k->nodes[clauses].first; c; c = k->nodes[c].next)
      if (know_is(k, k->nodes[c].first, k->names[k->nodes[node].name].text)) return true;
  }
  return false;
}

const char *know_advised(const knowledge *k, vs_advice_kind kind, know_index node, const char *message) {
  know_index at = node, parent = k->nodes[node].parent; /* at: node at which the advice is requested; for the name in
                                                         * (set! name value), the whole form */
  if (kind == VS_ADVICE_NAME && parent && know_is(k, k->nodes[parent].first, "set!") && know_nth(k, parent, 1) == node)
    at = parent;
  const know_file *file = &k->files[k->nodes[at].at.file];
  return vs_place_advice(k->scheme, kind, file->text, file->size, k->nodes[at].at.from, message);
}

/* Returns true if the names differ only in case, hyphens, underscores, or one letter. */
static bool similar(const char *a, const char *b) {
  size_t n = strlen(a), m = strlen(b), front = 0, back = 0;
  while (a[front] && (a[front] == b[front] || (a[front] == '_' && b[front] == '-'))) front++;
  while (back < n - front && back < m - front && a[n - 1 - back] == b[m - 1 - back]) back++;
  if (n > 3 && m > 3 && n - front - back <= 1 && m - front - back <= 1) return true;
  while (*a && *b) {
    if (*a == '_' || *a == '-') a++;
    else if (*b == '_' || *b == '-') b++;
    else if ((*a | 32) != (*b | 32)) return false;
    else a++, b++;
  }
  return !*a && !*b;
}

/* Returns a name that the program defines and that is similar to `name`; NULL: there is none. */
static const char *similar_name(const knowledge *k, const char *name) {
  for (know_index i = 1; i < k->symbol_count; i++)
    if (k->symbols[i].definition && !k->symbols[i].made && k->symbols[i].scope == PROGRAM &&
        similar(name, k->symbols[i].text)) return k->symbols[i].text;
  return NULL;
}

static void check_names(know_findings *f) {
  knowledge *k = f->k;
  bool program = runs_something(k);
  for (know_index i = 1; i < k->symbol_count; i++) {
    const know_symbol *s = &k->symbols[i];
    if (!s->definition || s->made || by_name(s) || s->kind == KNOW_FIELD || s->kind == KNOW_LOOP) continue;
    bool used = used_outside(k, s), top = s->scope == PROGRAM;
    if (used || of_library(k, s)) continue;
    if (s->sets && !s->reads && s->kind != KNOW_FUNCTION && s->kind != KNOW_MACRO) {
      know_found(f, KNOW_CHECK_NEVER_READ, s->definition, "%s is set but never read", s->text);
      continue;
    }
    if (s->sets) continue;
    know_index other = top ? 0 : hiding(k, i);
    if (other && (s->kind == KNOW_PARAMETER || s->value)) {
      know_found(f, KNOW_CHECK_SHADOWED, k->symbols[other].definition,
          "this %s hides the one of line %u, and nothing uses the hidden definition",
                 s->text, k->nodes[s->definition].at.line);
    } else if (s->kind == KNOW_PARAMETER) {
      const know_symbol *owner = &k->symbols[s->owner];
      if (s->owner && owner->kind == KNOW_FUNCTION && !handed_on(k, owner) && !s->checked && !by_name(owner) &&
          !only_fails(k, owner))
        know_found(f, KNOW_CHECK_UNUSED_PARAMETER, s->definition, "%s does not use its parameter %s", owner->text,
            s->text);
    } else if (top) {
      if (program && !k->nodes[s->definition].at.file && s->kind != KNOW_RULE)
        know_found(f, KNOW_CHECK_UNREFERENCED, s->definition, "nothing uses the %s %s", noun(s), s->text);
    } else if (!is_own_value(k, s) &&
               (s->kind != KNOW_LOOP_VARIABLE ? s->value || s->kind == KNOW_FUNCTION : s->owner != 0))
      know_found(f, KNOW_CHECK_UNUSED, s->definition, "nothing uses the %s %s", noun(s), s->text);
  }
  if (k->open) return;
  for (know_index i = 1; i < k->node_count; i++) {
    const know_node *n = &k->nodes[i];
    if (n->kind == KNOW_SYMBOL && n->role == KNOW_UNBOUND && !n->made && !n->origin) {
      const char *text = k->names[n->name].text, *advice = k->script ? "" : vs_name_advice(k->scheme, text);
      const know_file *file = &k->files[n->at.file]; /* a name that begins with % is reported only before a parenthesis,
                                                      * as in %cube(3): other such names are internal to the library */
      if (*text == '%' && (n->at.to >= file->size || file->text[n->at.to] != '(')) continue;
      char said[800];
      char near[120] = "";
      const char *own = *advice || k->script ? NULL : similar_name(k, text);
      if (own) snprintf(near, sizeof near, "did you mean %.80s?", own), advice = near;
      if (bound_by_let(k, i)) advice = "let names it for its body alone; write let* where a value that follows uses it";
      snprintf(said, sizeof said, "%s is not defined%s%s", text, *advice ? "; " : "", advice);
      know_found(f, KNOW_CHECK_UNBOUND, i, "%s", k->script ? said : know_advised(k, VS_ADVICE_NAME, i, said));
    }
  }
}

/* ---- types and second definitions ---- */

static know_index defined_value(const knowledge *k, know_index node) {
  know_index parent = k->nodes[node].parent;
  bool plain = parent && k->nodes[k->nodes[parent].first].next == node && k->nodes[parent].count == 3;
  return plain ? k->nodes[node].next : 0;
}

static void check_changes(know_findings *f) {
  const knowledge *k = f->k;
  for (know_index i = 1; i < k->symbol_count; i++) {
    const know_symbol *s = &k->symbols[i];
    if (!s->definition || s->made) continue;
    know_type type = KNOW_TYPE_UNKNOWN;
    know_index first = 0;
    for (know_index u = s->first_use; u; u = k->uses[u].next) {
      const know_use *use = &k->uses[u];
      if (use->role != KNOW_DEFINITION && use->role != KNOW_ASSIGNMENT) continue;
      if (k->nodes[use->node].made) continue;
      know_index value = use->node == s->definition && s->value ? s->value : defined_value(k, use->node);
      if (use->node == s->definition && s->kind == KNOW_FUNCTION) {
        type = KNOW_TYPE_PROCEDURE, first = use->node;
        continue;
      }
      know_type now = value ? know_type_of(k, value) : KNOW_TYPE_UNKNOWN;
      bool procedure = use->role == KNOW_DEFINITION && use->node != s->definition && s->kind == KNOW_FUNCTION && !value;
      if (procedure) know_found(f, KNOW_CHECK_REDEFINED, use->node, "%s is defined on line %u already", s->text,
                                k->nodes[first].at.line);
      bool empty = type == KNOW_TYPE_BOOLEAN || now == KNOW_TYPE_BOOLEAN; /* empty: whether a definition is a boolean,
                                                                           * since #f often means 'not yet set' */
      if (type && now && now != type && !empty)
        know_found(f, KNOW_CHECK_TYPE_CHANGE, use->node, "%s was %s on line %u and becomes %s", s->text,
            know_type_word(type),
                   k->nodes[first].at.line, know_type_word(now));
      if (now && now != KNOW_TYPE_BOOLEAN) type = now, first = use->node;
    }
  }
}

/* ---- unreachable code, and code without effect ---- */

static bool is_form(const knowledge *k, know_index node, const char *word) {
  return k->nodes[node].kind == KNOW_LIST && k->nodes[node].form && know_is(k, k->nodes[node].first, word);
}

/* Returns true for a statement that may follow a jump without a report: a function definition, which takes effect
 * before anything runs, or a break, which many authors write there. */
static bool harmless(const knowledge *k, know_index node) {
  know_index head = k->nodes[node].kind == KNOW_LIST ? k->nodes[node].first : 0;
  return k->script && (know_is(k, head, "define") || know_is(k, head, "declared") || know_is(k, head, "break") ||
         know_is(k, head, "empty"));
}

/* Returns true if control never continues after the node. */
static bool leaves(const knowledge *k, know_index node) {
  if (k->script) return leaves_script(k, node);
  if (k->nodes[node].kind != KNOW_LIST || k->nodes[node].form || !k->nodes[node].walked) return false;
  know_index head = k->nodes[node].first, s = head ? k->nodes[head].symbol : 0;
  if (!s || k->nodes[head].role != KNOW_REFERENCE) return false;
  const char *name = k->symbols[s].text;
  if (k->symbols[s].kind == KNOW_BUILTIN) return !strcmp(name, "error") || !strcmp(name, "exit") || !strcmp(name,
      "raise");
  /* handles a call of the escape procedure k of (let/ec k ...), after which control does not continue */
  know_index form = k->symbols[s].form, parent = form ? k->nodes[form].parent : 0;
  return k->symbols[s].kind == KNOW_LOCAL && parent && (is_form(k, parent, "let/ec") || is_form(k, parent, "let/cc")) &&
         know_nth(k, parent, 1) == form;
}

static bool truth(const knowledge *k, know_index node, bool *value) {
  const know_node *n = &k->nodes[node];
  size_t length;
  const char *s = know_spelling(k, node, &length);
  if (n->kind == KNOW_BOOLEAN) return *value = s[*s == '#'] == 't', true;
  if (k->script) return false; /* in a script, 0 and "" are false too */
  if (n->kind == KNOW_NUMBER || n->kind == KNOW_STRING) return *value = true, true;
  return false;
}

static void check_clauses(know_findings *f, know_index node, uint32_t from) {
  const knowledge *k = f->k;
  bool done = false, value;
  uint32_t line = 0;
  for (know_index i = know_nth(k, node, from); i; i = k->nodes[i].next) {
    know_index test = k->nodes[i].first;
    if (done) {
      know_found(f, KNOW_CHECK_UNREACHABLE, i, "the clause of line %u is always taken before this one", line);
      return;
    }
    if (test && from == 1 && truth(k, test, &value) && value) done = true, line = k->nodes[i].at.line;
  }
}

static bool same_text(const knowledge *k, know_index a, know_index b) {
  size_t n, m;
  const char *s = know_spelling(k, a, &n), *t = know_spelling(k, b, &m);
  return n == m && !memcmp(s, t, n);
}

static void check_case(know_findings *f, know_index node) {
  const knowledge *k = f->k;
  for (know_index i = know_nth(k, node, 2); i; i = k->nodes[i].next)
    for (know_index d = k->nodes[k->nodes[i].first].first; d; d = k->nodes[d].next)
      for (know_index j = know_nth(k, node, 2); j && j != i; j = k->nodes[j].next)
        for (know_index e = k->nodes[k->nodes[j].first].first; e; e = k->nodes[e].next)
          if (same_text(k, d, e)) {
            know_found(f, KNOW_CHECK_UNREACHABLE, d, "this datum is in the clause of line %u already",
                k->nodes[j].at.line);
            return;
          }
}

/* Reports a loop such as (for ([i 3]) (make-sphere ...)), whose objects are lost. */
static void check_loop(know_findings *f, know_index node) {
  const knowledge *k = f->k;
  know_index last = know_nth(k, node, 2);
  while (last && k->nodes[last].next) last = k->nodes[last].next;
  if (last && !k->script && know_is_call(k, last) && !k->nodes[last].form &&
      know_type_of(k, last) == KNOW_TYPE_OBJECT &&
      k->symbols[k->nodes[k->nodes[last].first].symbol].kind == KNOW_BUILTIN)
    know_found(f, KNOW_CHECK_NO_EFFECT, last,
               "the object made here is not used: a loop keeps none; (draw ...) each, or for/list gives their list");
}

static void check_form(know_findings *f, know_index node) {
  const knowledge *k = f->k;
  if (know_is(k, k->nodes[node].first, "for") || know_is(k, k->nodes[node].first, "for*")) check_loop(f, node);
  know_index head = k->nodes[node].first, second = know_nth(k, node, 1);
  bool value;
  if (know_is(k, head, "cond")) check_clauses(f, node, 1);
  else if (know_is(k, head, "case")) check_case(f, node), check_clauses(f, node, 2);
  else if (know_is(k, head, "if") && second && truth(k, second, &value)) {
    know_index dead = know_nth(k, node, value ? 3 : 2);
    bool nothing = k->nodes[node].count == 3 && k->nodes[k->nodes[second].next].kind == KNOW_BOOLEAN;
        /* Does not report (if #f #f), which is the usual spelling of no value. */
    if (dead && !nothing) know_found(f, KNOW_CHECK_UNREACHABLE, dead, "the test is always %s",
        value ? "true" : "false");
  } else if ((know_is(k, head, "when") || know_is(k, head, "unless")) && second && truth(k, second, &value) &&
             value == know_is(k, head, "unless") && know_nth(k, node, 2))
    know_found(f, KNOW_CHECK_UNREACHABLE, know_nth(k, node, 2), "the test is always %s", value ? "true" : "false");
}

/* Checks a body for forms without effect. The body's value is that of its last form; all earlier forms are useful only
 * by their effects. */
static void check_body(know_findings *f, know_index node) {
  const knowledge *k = f->k;
  know_index next = k->nodes[node].next;
  if (!next || !k->nodes[next].statement) return;
  const know_node *n = &k->nodes[node];
  if (n->parent && know_is(k, k->nodes[n->parent].first, "if")) return; /* only one of the two branches runs */
  if (leaves(k, node)) {
    if (!harmless(k, next))
      know_found(f, KNOW_CHECK_UNREACHABLE, next, "line %u always leaves this body: the expressions after it never run",
                 n->at.line);
    return;
  }
  bool top = n->scope == PROGRAM;
  if (top) return; /* the value of a form at top level is printed or drawn, so it has an effect */
  know_index parent = n->parent;
  bool doc = n->kind == KNOW_STRING && parent && k->nodes[parent].first && k->nodes[know_nth(k, parent,
      1)].next == node;
  if (doc) return;
  if (n->kind == KNOW_NUMBER || n->kind == KNOW_STRING || n->kind == KNOW_CHARACTER)
    know_found(f, KNOW_CHECK_NO_EFFECT, node, "this value is not used");
  else if (n->kind == KNOW_SYMBOL && n->role == KNOW_REFERENCE)
    know_found(f, KNOW_CHECK_NO_EFFECT, node, "the value of %s is not used", k->names[n->name].text);
  else if (know_is_call(k, node) && !n->form) {
    know_index callee = k->nodes[n->first].symbol; /* if the callee is a procedure of the program, it may draw its
                                                    * object */
    bool language = callee && k->symbols[callee].kind == KNOW_BUILTIN;
    know_type type = language ? know_type_of(k, node) : KNOW_TYPE_UNKNOWN;
    if (type == KNOW_TYPE_NOTHING) return;
    if (type == KNOW_TYPE_OBJECT) know_found(f, KNOW_CHECK_NO_EFFECT, node,
        "the object made here is not used; unite joins objects");
    else if (type) know_found(f, KNOW_CHECK_NO_EFFECT, node, "%s is computed here and not used",
        know_type_word(type));
  }
}

static bool is_mesh(const char *path) {
  static const char *const endings[] = {".stl", ".obj", ".off", ".ply"};
  const char *dot = strrchr(path, '.');
  for (size_t i = 0; dot && i < sizeof endings / sizeof *endings; i++)
    if (!strcasecmp(dot, endings[i])) return true;
  return false;
}

/* Reports a file that `load` or `load-mesh` cannot read, with the message that a run would give. */
static void missing_file(know_findings *f, know_index node, const char *path) {
  knowledge *k = f->k;
  size_t n;
  know_index call = k->nodes[node].parent;
  const char *name = know_spelling(k, node, &n);
  char program[600];
  const char *word = k->names[k->nodes[k->nodes[call].first].name].text;
  int length = snprintf(program, sizeof program, "(%s %.*s)", strcmp(word, "load-mesh") ? "load" : word, (int)n, name);
  *k->heard = 0;
  k->muted = true;
  bool whole = !k->script && length < (int)sizeof program;
  vs_outcome outcome =
      whole ? vs_eval_text(k->scheme, k->files[k->nodes[node].at.file].path, 1, program, (size_t)length, 0)
            : VS_OUTCOME_DONE;
  k->muted = false;
  const char *said = outcome == VS_OUTCOME_MODEL || outcome == VS_OUTCOME_USAGE ? k->heard : "";
  const char *file = strstr(said, "cannot open "), *reason = file ? strstr(file, ": no such file") : NULL;
  if (reason) know_found(f, KNOW_CHECK_MISSING_FILE, node, "%s%s", path, reason);
  else if (*said) know_found(f, KNOW_CHECK_MISSING_FILE, node, "%s", said);
  else know_found(f, KNOW_CHECK_MISSING_FILE, node, "%s: no such file", path);
}

static void check_nodes(know_findings *f) {
  const knowledge *k = f->k;
  for (know_index i = 1; i < k->node_count && !*k->trouble; i++) {
    const know_node *n = &k->nodes[i];
    if (n->made || n->origin) continue;
    if (n->statement) check_body(f, i);
    if (know_is_call(k, i) && n->form) check_form(f, i);
    if (n->kind == KNOW_STRING && n->parent && k->nodes[n->parent].kind == KNOW_LIST) {
      know_index head = k->nodes[n->parent].first;
      bool loads = (know_is(k, head, "load") || know_is(k, head, "require") || know_is(k, head, "include")) &&
          know_nth(k, n->parent, 1) == i &&
                   k->nodes[n->parent].walked;
      char path[KNOW_PATH];
      if (loads && !know_find_file(k, i, path) && *path) missing_file(f, i, path);
      loads = know_is(k, head, "load-mesh") && know_nth(k, n->parent, 1) == i && !k->script;
      if (loads && k->nodes[n->parent].walked && (!know_find_file(k, i, path) || !is_mesh(path)))
        missing_file(f, i, path);
    }
  }
}

/* ---- comments by which the author allows findings ---- */

/* Returns true if the comment allows findings of the check `name`: "check: allow NAME, NAME" or "check: allow all".
 * *whole_file: whether "in this file" follows. */
static bool allows(const char *text, size_t n, const char *name, bool *whole_file) {
  static const char word[] = "check: allow ", everywhere[] = "in this file";
  if (n < sizeof word - 1 || memcmp(text, word, sizeof word - 1) != 0) return false;
  size_t length = strlen(name);
  *whole_file = false;
  bool found = false;
  for (size_t i = sizeof word - 1; i < n; i++) {
    bool start = text[i - 1] == ' ' || text[i - 1] == ',';
    if (start && n - i >= length && !memcmp(text + i, name, length) && (n - i == length || text[i + length] == ',' ||
        text[i + length] == ' '))
      found = true;
    if (start && n - i >= 3 && !memcmp(text + i, "all", 3) && (n - i == 3 || text[i + 3] == ' ')) found = true;
    if (start && n - i >= sizeof everywhere - 1 && !memcmp(text + i, everywhere,
        sizeof everywhere - 1)) *whole_file = true;
  }
  return found;
}

/* Returns true if the script contains the annotation of Euclides (a translator of JavaScript) that allows the finding:
 * "euclides.suppress_warning_unreferenced_object.NAME;". */
static bool annotated(const knowledge *k, const know_finding *f, const char *text, size_t n) {
  static const char word[] = "euclides.suppress_warning_unreferenced_object.";
  if (!k->script || (f->check != KNOW_CHECK_UNREFERENCED && f->check != KNOW_CHECK_UNUSED)) return false;
  const char *name = k->files[f->at.file].text + f->at.from;
  size_t length = f->at.to - f->at.from, before = sizeof word - 1;
  for (size_t i = 0; i + before + length <= n; i++)
    if (!memcmp(text + i, word, before) && !memcmp(text + i + before, name, length) &&
        (i + before + length == n || strchr("; \n\r\t,", text[i + before + length]))) return true;
  return false;
}

static bool allowed(const knowledge *k, const know_finding *f) {
  const know_file *file = &k->files[f->at.file];
  for (know_index c = file->first_comment; c < file->comment_end; c++) {
    size_t n;
    bool whole;
    const char *text = know_comment_text(k, c, &n);
    if (annotated(k, f, text, n)) return true;
    if (!allows(text, n, names[f->check], &whole)) continue;
    const know_comment *at = &k->comments[c];
    if (whole || at->line == f->at.line || (at->alone && at->end_line + 1 == f->at.line)) return true;
  }
  return false;
}

static int by_place(const void *a, const void *b) {
  const know_finding *x = a, *y = b;
  if (x->at.file != y->at.file) return x->at.file < y->at.file ? -1 : 1;
  if (x->at.from != y->at.from) return x->at.from < y->at.from ? -1 : 1;
  return x->check != y->check ? x->check < y->check ? -1 : 1 : strcmp(x->details, y->details);
}

/* ---- all checks ---- */

bool know_check_program(knowledge *k, know_findings *out) {
  *out = (know_findings){.k = k};
  check_names(out);
  check_changes(out);
  check_nodes(out);
  know_check_calls(out);
  know_check_syntax(out);
  if (*k->trouble) return false;
  if (out->count) qsort(out->at, out->count, sizeof *out->at, by_place);
  size_t kept = 0;
  for (size_t i = 0; i < out->count; i++) {
    if (kept && !by_place(&out->at[kept - 1], &out->at[i])) continue; /* omits the second of two equal findings, which a
                                                                       * file that is loaded twice has */
    if (!allowed(k, &out->at[i])) out->at[kept++] = out->at[i];
  }
  out->count = kept;
  return true;
}

void know_findings_free(know_findings *f) { free(f->at); }

void know_report_findings(const know_findings *f, FILE *to) {
  for (size_t i = 0; i < f->count; i++)
    fprintf(to, "%s:%u:%u: %s: %s\n", f->k->files[f->at[i].at.file].path, f->at[i].at.line, f->at[i].at.column,
        names[f->at[i].check],
            f->at[i].details);
}

void know_report_findings_json(const know_findings *f, FILE *to) {
  know_writer w;
  know_write_start(&w, to, KNOW_JSON, "findings");
  know_write_number(&w, "schema", KNOW_SCHEMA);
  know_write_list(&w, "findings");
  for (size_t i = 0; i < f->count; i++) {
    const know_finding *at = &f->at[i];
    know_write_item(&w, "finding");
    know_write_word(&w, "type", names[at->check]);
    know_write_place(&w, f->k, &at->at);
    know_write_word(&w, "details", at->details);
    know_write_item_end(&w, "finding");
  }
  know_write_list_end(&w, "findings");
  know_write_end(&w, "findings");
}
