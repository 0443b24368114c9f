/* Translates expressions of JavaScript to data of Scheme.
 *
 * Every number of a script is a double. If both operands of + - * / or of a comparison are numbers, instructions of the
 * VM compute the result. The test for numbers is an instruction, too; it is omitted if the types of the operands are
 * clear from the text. Operands other than names and constants are first bound to the variables l: and r:, in the order
 * of the text. */
#include "vm/javascript/expressions.h"

#include <string.h>

#include "vm/javascript/statements.h"

#define TRY(x)                                                                                                         \
  do {                                                                                                                 \
    if (!(x)) return false;                                                                                            \
  } while (0)

static const vs_script_node *node(const vs_translation *t, uint32_t i) { return vs_script_at(t->s, i); }

/* ---- types of values that the text shows ---- */

static bool arithmetic(vs_script_operator op) {
  return op != VS_OPERATOR_PLUS &&
         (op == VS_OPERATOR_MINUS || op == VS_OPERATOR_TIMES || op == VS_OPERATOR_DIVIDED ||
          op == VS_OPERATOR_REMAINDER || op == VS_OPERATOR_BIT_OR || op == VS_OPERATOR_BIT_XOR ||
          op == VS_OPERATOR_BIT_AND || op == VS_OPERATOR_SHIFT_LEFT || op == VS_OPERATOR_SHIFT_RIGHT ||
          op == VS_OPERATOR_SHIFT_UNSIGNED);
}

static vs_static_type type_of(const vs_translation *t, uint32_t i, unsigned depth);

static vs_static_type sum_type(const vs_translation *t, uint32_t a, uint32_t b, unsigned depth) {
  vs_static_type l = type_of(t, a, depth), r = type_of(t, b, depth);
  if (l == VS_TYPE_STRING || r == VS_TYPE_STRING) return VS_TYPE_STRING;
  return (l == VS_TYPE_NUMBER || l == VS_TYPE_BOOLEAN) && (r == VS_TYPE_NUMBER || r == VS_TYPE_BOOLEAN) ? VS_TYPE_NUMBER
                                                                                                        : VS_TYPE_ANY;
}

/* Returns the type of the value of expression i, as far as the text shows it. Examines only a few levels of the tree;
 * deeper expressions have an unknown type. */
static vs_static_type type_of(const vs_translation *t, uint32_t i, unsigned depth) {
  const vs_script_node *n = node(t, i);
  if (depth > 6) return VS_TYPE_ANY;
  depth++;
  switch ((vs_script_kind)n->kind) {
  case VS_SCRIPT_NUMBER:
  case VS_SCRIPT_UPDATE: return VS_TYPE_NUMBER;
  case VS_SCRIPT_STRING: return VS_TYPE_STRING;
  case VS_SCRIPT_TRUE:
  case VS_SCRIPT_FALSE: return VS_TYPE_BOOLEAN;
  case VS_SCRIPT_UNARY:
    if (n->op == VS_OPERATOR_NOT || n->op == VS_OPERATOR_DELETE) return VS_TYPE_BOOLEAN;
    return n->op == VS_OPERATOR_TYPE_OF ? VS_TYPE_STRING : n->op == VS_OPERATOR_VOID ? VS_TYPE_ANY : VS_TYPE_NUMBER;
  case VS_SCRIPT_BINARY:
    if (n->op == VS_OPERATOR_PLUS) return sum_type(t, n->a, n->b, depth);
    return arithmetic(n->op) ? VS_TYPE_NUMBER : VS_TYPE_BOOLEAN;
  case VS_SCRIPT_ASSIGN:
    if (n->op == VS_OPERATOR_NONE) return type_of(t, n->b, depth);
    if (n->op == VS_OPERATOR_PLUS) return type_of(t, n->b, depth) == VS_TYPE_STRING ? VS_TYPE_STRING : VS_TYPE_ANY;
    return VS_TYPE_NUMBER;
  case VS_SCRIPT_SEQUENCE: return type_of(t, n->b, depth);
  case VS_SCRIPT_CONDITIONAL:
  case VS_SCRIPT_LOGICAL: {
    uint32_t x = n->kind == VS_SCRIPT_LOGICAL ? n->a : n->b, y = n->kind == VS_SCRIPT_LOGICAL ? n->b : n->c;
    vs_static_type l = type_of(t, x, depth);
    return l == type_of(t, y, depth) ? l : VS_TYPE_ANY;
  }
  default: return VS_TYPE_ANY;
  }
}

static vs_static_type type(const vs_translation *t, uint32_t i) { return type_of(t, i, 0); }

static vs_variable *variable(const vs_translation *t, uint32_t i) {
  uint32_t v = vs_scopes_resolve(t->k, t->scope, node(t, i)->name);
  return v ? &t->k->variables[v] : NULL;
}

/* Returns true if the expression has no side effects, and may be evaluated any number of times. */
static bool simple(const vs_translation *t, uint32_t i) {
  const vs_script_node *n = node(t, i);
  if (n->kind == VS_SCRIPT_NAME) {
    const vs_variable *v = variable(t, i);
    return v && v->kind != VS_VARIABLE_UNDECLARED;
  }
  return n->kind == VS_SCRIPT_NUMBER || n->kind == VS_SCRIPT_STRING || n->kind == VS_SCRIPT_TRUE ||
         n->kind == VS_SCRIPT_FALSE || n->kind == VS_SCRIPT_NULL || n->kind == VS_SCRIPT_THIS;
}

/* ---- binary operators ---- */

typedef struct {
  const char *fast, *slow;
} operator_words;

static operator_words words_of(vs_script_operator op) {
  switch (op) {
  case VS_OPERATOR_PLUS: return (operator_words){ "js:+", "js:add" };
  case VS_OPERATOR_MINUS: return (operator_words){ "js:-", "js:subtract" };
  case VS_OPERATOR_TIMES: return (operator_words){ "js:*", "js:multiply" };
  case VS_OPERATOR_DIVIDED: return (operator_words){ "js:/", "js:divide" };
  case VS_OPERATOR_REMAINDER: return (operator_words){ NULL, "js:remainder" };
  case VS_OPERATOR_LESS: return (operator_words){ "js:<", "js:less" };
  case VS_OPERATOR_MORE: return (operator_words){ "js:>", "js:more" };
  case VS_OPERATOR_LESS_EQUAL: return (operator_words){ "js:<=", "js:less-equal" };
  case VS_OPERATOR_MORE_EQUAL: return (operator_words){ "js:>=", "js:more-equal" };
  case VS_OPERATOR_SAME:
  case VS_OPERATOR_NOT_SAME: return (operator_words){ "js:=", "js:same" };
  case VS_OPERATOR_EQUAL:
  case VS_OPERATOR_NOT_EQUAL: return (operator_words){ "js:=", "js:equal" };
  case VS_OPERATOR_BIT_OR: return (operator_words){ NULL, "js:bit-or" };
  case VS_OPERATOR_BIT_XOR: return (operator_words){ NULL, "js:bit-xor" };
  case VS_OPERATOR_BIT_AND: return (operator_words){ NULL, "js:bit-and" };
  case VS_OPERATOR_SHIFT_LEFT: return (operator_words){ NULL, "js:shift-left" };
  case VS_OPERATOR_SHIFT_RIGHT: return (operator_words){ NULL, "js:shift-right" };
  case VS_OPERATOR_SHIFT_UNSIGNED: return (operator_words){ NULL, "js:shift-unsigned" };
  case VS_OPERATOR_INSTANCE_OF: return (operator_words){ NULL, "js:instance-of" };
  case VS_OPERATOR_IN: return (operator_words){ NULL, "js:has" };
  default: return (operator_words){ NULL, NULL };
  }
}

/* An operand: a node of the script's tree or, if `node` is 0, a variable that the translation has introduced, such as
 * l:. */
typedef struct {
  uint32_t node;
  const char *word;
  vs_static_type type;
} operand;

static bool put(vs_translation *t, operand o) {
  return o.word ? vs_translate_word(t, o.word) : vs_translate_value(t, o.node);
}

static bool put_call(vs_translation *t, const char *word, operand l, operand r) {
  return vs_translate_call(t, word) && put(t, l) && put(t, r) && vs_translate_close(t);
}

/* Writes an operation that tests the types of its operands first. The code may contain each operand several times. */
static bool guarded(vs_translation *t, vs_script_operator op, operand l, operand r) {
  operator_words w = words_of(op);
  bool ln = l.type == VS_TYPE_NUMBER, rn = r.type == VS_TYPE_NUMBER;
  if (!w.fast || l.type == VS_TYPE_STRING || r.type == VS_TYPE_STRING) return put_call(t, w.slow, l, r);
  if (ln && rn) return put_call(t, w.fast, l, r);
  TRY(vs_translate_call(t, "js:if"));
  if (!ln && !rn) TRY(vs_translate_call(t, "js:if"));
  for (int i = 0; i < 2; i++) {
    if (i ? rn : ln) continue;
    TRY(vs_translate_call(t, "js:flonum?") && put(t, i ? r : l) && vs_translate_close(t));
  }
  if (!ln && !rn) TRY(vs_translate_word(t, "js:false") && vs_translate_close(t));
  return put_call(t, w.fast, l, r) && put_call(t, w.slow, l, r) && vs_translate_close(t);
}

static bool binary(vs_translation *t, vs_script_operator op, operand l, operand r) {
  bool both = words_of(op).fast && l.type != VS_TYPE_STRING && r.type != VS_TYPE_STRING &&
              !(l.type == VS_TYPE_NUMBER && r.type == VS_TYPE_NUMBER);
  bool ls = l.word || simple(t, l.node), rs = r.word || simple(t, r.node), bind_l = both && !(ls && rs),
       bind_r = both && !rs;
  /* if the left operand is a name, its value must be read before the right operand can change it */
  if (bind_l && ls && (l.word || node(t, l.node)->kind != VS_SCRIPT_NAME)) bind_l = false;
  vs_script_place at = t->at;
  if (bind_l || bind_r) {
    TRY(vs_translate_call(t, "js:let") && vs_translate_open(t));
    if (bind_l) TRY(vs_translate_call(t, "l:") && put(t, l) && vs_translate_close(t));
    t->at = at;
    if (bind_r) TRY(vs_translate_call(t, "r:") && put(t, r) && vs_translate_close(t));
    t->at = at;
    TRY(vs_translate_close(t));
  }
  if (bind_l) l = (operand){ 0, "l:", l.type };
  if (bind_r) r = (operand){ 0, "r:", r.type };
  return guarded(t, op, l, r) && (!(bind_l || bind_r) || vs_translate_close(t));
}

static operand of(const vs_translation *t, uint32_t i) { return (operand){ i, NULL, type(t, i) }; }

/* Translates == and === if the right operand is null, true or false and a simple test suffices. Then sets *done to
 * true. */
static bool equality(vs_translation *t, const vs_script_node *n, bool *done) {
  bool same = n->op == VS_OPERATOR_SAME || n->op == VS_OPERATOR_NOT_SAME;
  vs_script_kind kind = (vs_script_kind)node(t, n->b)->kind;
  *done = false;
  if (kind == VS_SCRIPT_NULL && !same) {
    *done = true;
    return vs_translate_call(t, "js:nothing?") && vs_translate_value(t, n->a) && vs_translate_close(t);
  }
  if (!same || (kind != VS_SCRIPT_NULL && kind != VS_SCRIPT_TRUE && kind != VS_SCRIPT_FALSE)) return true;
  *done = true;
  return vs_translate_call(t, "js:eq?") && vs_translate_value(t, n->a) && vs_translate_value(t, n->b) &&
         vs_translate_close(t);
}

static bool binary_node(vs_translation *t, const vs_script_node *n) {
  bool negated = n->op == VS_OPERATOR_NOT_EQUAL || n->op == VS_OPERATOR_NOT_SAME, done = false;
  if (negated) TRY(vs_translate_call(t, "js:not"));
  if (n->op == VS_OPERATOR_EQUAL || n->op == VS_OPERATOR_SAME || negated) TRY(equality(t, n, &done));
  if (!done) TRY(binary(t, (vs_script_operator)n->op, of(t, n->a), of(t, n->b)));
  return !negated || vs_translate_close(t);
}

/* ---- variables and properties ---- */

static bool name_value(vs_translation *t, uint32_t i) {
  const vs_variable *v = variable(t, i);
  if (!v && vs_script_is(t->s, node(t, i)->name, "arguments") && t->functions)
    return vs_translate_word(t, "arguments:");
  if (!v || v->kind != VS_VARIABLE_UNDECLARED) return vs_translate_name(t, node(t, i)->name);
  return vs_translate_call(t, "js:if") && vs_translate_call(t, "js:eq?") && vs_translate_name(t, node(t, i)->name) &&
         vs_translate_word(t, "js:unset") && vs_translate_close(t) && vs_translate_call(t, "js:not-defined") &&
         vs_translate_text(t, node(t, i)->name) && vs_translate_close(t) && vs_translate_name(t, node(t, i)->name) &&
         vs_translate_close(t);
}

/* Translates the value of a property, in this form: (js:get o key). */
static bool member_value(vs_translation *t, const vs_script_node *n, const char *object) {
  bool member = n->kind == VS_SCRIPT_MEMBER, length = member && vs_script_is(t->s, node(t, n->b)->name, "length");
  TRY(vs_translate_call(t, length ? "js:length" : member ? "js:get" : "js:at"));
  TRY(object ? vs_translate_word(t, object) : vs_translate_value(t, n->a));
  TRY(length || (member ? vs_translate_key(t, n->b) : vs_translate_value(t, n->b)));
  return vs_translate_close(t);
}

/* Assigns the value of a node or of a Scheme word to a variable. The resulting expression has no useful value. */
static bool assign_name(vs_translation *t, uint32_t name, operand value) {
  const vs_variable *v = variable(t, name);
  if (v && v->kind == VS_VARIABLE_SELF) return put(t, value); /* the name of a function expression cannot be assigned */
  return vs_translate_call(t, "js:set!") && vs_translate_name(t, node(t, name)->name) && put(t, value) &&
         vs_translate_close(t);
}

bool vs_translate_assign_made(vs_translation *t, uint32_t target, const char *procedure, const char *word,
                              uint32_t number) {
  const vs_script_node *n = node(t, target);
  if (n->kind == VS_SCRIPT_NAME)
    TRY(vs_translate_call(t, "js:set!") && vs_translate_name(t, n->name));
  else {
    bool member = n->kind == VS_SCRIPT_MEMBER;
    TRY(vs_translate_call(t, member ? "js:put!" : "js:at-put!") && vs_translate_value(t, n->a));
    TRY(member ? vs_translate_key(t, n->b) : vs_translate_value(t, n->b));
  }
  return vs_translate_call(t, procedure) && vs_translate_made(t, word, number) && vs_translate_close(t) &&
         vs_translate_close(t);
}

static bool let_one(vs_translation *t, const char *word) {
  return vs_translate_call(t, "js:let") && vs_translate_open(t) && vs_translate_call(t, word);
}
static bool let_body(vs_translation *t) { return vs_translate_close(t) && vs_translate_close(t); }

/* Binds the variable o: to the object of a property and, if the property is an index, k: to the index. */
static bool bind_property(vs_translation *t, const vs_script_node *n) {
  TRY(let_one(t, "o:") && vs_translate_value(t, n->a) && vs_translate_close(t));
  if (n->kind == VS_SCRIPT_INDEX)
    TRY(vs_translate_call(t, "k:") && vs_translate_value(t, n->b) && vs_translate_close(t));
  return vs_translate_close(t);
}

static bool bound_property(vs_translation *t, const vs_script_node *n) {
  return vs_translate_word(t, "o:") &&
         (n->kind == VS_SCRIPT_INDEX ? vs_translate_word(t, "k:") : vs_translate_key(t, n->b));
}

static bool assignment(vs_translation *t, const vs_script_node *n, bool wanted) {
  const vs_script_node *target = node(t, n->a);
  if (target->kind == VS_SCRIPT_NAME) {
    if (wanted)
      TRY(let_one(t, "v:"));
    else
      TRY(vs_translate_call(t, "js:set!") && vs_translate_name(t, target->name));
    bool self = variable(t, n->a) && variable(t, n->a)->kind == VS_VARIABLE_SELF;
    if (n->op == VS_OPERATOR_NONE)
      TRY(vs_translate_value(t, n->b));
    else
      TRY(binary(t, (vs_script_operator)n->op, of(t, n->a), of(t, n->b)));
    if (!wanted) return vs_translate_close(t);
    TRY(let_body(t));
    if (!self) TRY(assign_name(t, n->a, (operand){ 0, "v:", VS_TYPE_ANY }));
    return vs_translate_word(t, "v:") && vs_translate_close(t);
  }
  const char *put_word = target->kind == VS_SCRIPT_MEMBER ? "js:put!" : "js:at-put!";
  if (n->op == VS_OPERATOR_NONE) {
    TRY(vs_translate_call(t, put_word) && vs_translate_value(t, target->a));
    TRY(target->kind == VS_SCRIPT_MEMBER ? vs_translate_key(t, target->b) : vs_translate_value(t, target->b));
    return vs_translate_value(t, n->b) && vs_translate_close(t);
  }
  TRY(bind_property(t, target) && vs_translate_call(t, put_word) && bound_property(t, target));
  TRY(let_one(t, "a:") && vs_translate_call(t, target->kind == VS_SCRIPT_MEMBER ? "js:get" : "js:at") &&
      bound_property(t, target) && vs_translate_close(t) && let_body(t));
  TRY(binary(t, (vs_script_operator)n->op, (operand){ 0, "a:", VS_TYPE_ANY }, of(t, n->b)));
  return vs_translate_close(t) && vs_translate_close(t) && vs_translate_close(t);
}

static bool one(vs_translation *t) { return vs_translate_item(t, (vs_item){ .kind = VS_ITEM_NUMBER, .number = 1 }); }

/* Writes (+ v: 1) for ++, or (- v: 1) for --; v: is the number before the operator is applied. */
static bool stepped(vs_translation *t, const vs_script_node *n, const char *word) {
  return vs_translate_call(t, n->op == VS_OPERATOR_PLUS ? "js:+" : "js:-") && vs_translate_word(t, word) && one(t) &&
         vs_translate_close(t);
}

static bool update(vs_translation *t, const vs_script_node *n, bool wanted) {
  const vs_script_node *target = node(t, n->a);
  bool is_name = target->kind == VS_SCRIPT_NAME, member = target->kind == VS_SCRIPT_MEMBER,
       plain = is_name && simple(t, n->a);
  if (!wanted && plain && variable(t, n->a)->kind != VS_VARIABLE_SELF) {
    TRY(vs_translate_call(t, "js:set!") && vs_translate_name(t, target->name) && vs_translate_call(t, "js:if") &&
        vs_translate_call(t, "js:flonum?") && vs_translate_name(t, target->name) && vs_translate_close(t));
    TRY(vs_translate_call(t, n->op == VS_OPERATOR_PLUS ? "js:+" : "js:-") && vs_translate_name(t, target->name) &&
        one(t) && vs_translate_close(t));
    TRY(vs_translate_call(t, n->op == VS_OPERATOR_PLUS ? "js:+" : "js:-") && vs_translate_call(t, "js:number") &&
        vs_translate_name(t, target->name) && vs_translate_close(t) && one(t) && vs_translate_close(t));
    return vs_translate_close(t) && vs_translate_close(t);
  }
  if (!is_name) TRY(bind_property(t, target));
  TRY(let_one(t, "v:") && vs_translate_call(t, "js:number"));
  if (is_name)
    TRY(name_value(t, n->a));
  else
    TRY(vs_translate_call(t, member ? "js:get" : "js:at") && bound_property(t, target) && vs_translate_close(t));
  TRY(vs_translate_close(t) && let_body(t));
  bool self = is_name && variable(t, n->a) && variable(t, n->a)->kind == VS_VARIABLE_SELF;
  if (!self) {
    if (is_name)
      TRY(vs_translate_call(t, "js:set!") && vs_translate_name(t, target->name));
    else
      TRY(vs_translate_call(t, member ? "js:put!" : "js:at-put!") && bound_property(t, target));
    TRY(stepped(t, n, "v:") && vs_translate_close(t));
  }
  TRY(n->flag ? stepped(t, n, "v:") : vs_translate_word(t, "v:"));
  return vs_translate_close(t) && (is_name || vs_translate_close(t));
}

/* ---- calls of functions ---- */

static bool arguments(vs_translation *t, uint32_t i) {
  for (; i; i = node(t, i)->next) TRY(vs_translate_value(t, i));
  return true;
}

/* Writes ((js:if (js:procedure? f:) f: (js:not-callable "name")) arguments #:this o:), which calls the value in f:.
 * Only a call of a method has the part #:this o:. */
static bool call_bound(vs_translation *t, const vs_script_node *n, const char *self, uint32_t name) {
  TRY(vs_translate_open(t) && vs_translate_call(t, "js:if") && vs_translate_call(t, "js:procedure?") &&
      vs_translate_word(t, "f:") && vs_translate_close(t) && vs_translate_word(t, "f:") &&
      vs_translate_call(t, "js:not-callable") && vs_translate_word(t, "f:"));
  TRY(name ? vs_translate_text(t, name) : vs_translate_word(t, "js:false"));
  return vs_translate_close(t) && vs_translate_close(t) && arguments(t, n->b) &&
         (!self || (vs_translate_word(t, "#:this") && vs_translate_word(t, self))) && vs_translate_close(t);
}

/* Writes a call of a function whose definition the text shows: calls the procedure that has exactly the function's
 * parameters. */
static bool direct_call(vs_translation *t, const vs_script_node *n, const vs_variable *v) {
  uint32_t wanted = node(t, v->declaration)->count;
  bool more = n->count > wanted;
  if (more) { /* extra arguments have no parameter; they are evaluated for their effects */
    TRY(vs_translate_call(t, "js:let") && vs_translate_open(t));
    uint32_t at = n->b;
    for (uint32_t i = 0; at; at = node(t, at)->next, i++)
      TRY(vs_translate_open(t) && vs_translate_made(t, "a:", i) && vs_translate_value(t, at) && vs_translate_close(t));
    TRY(vs_translate_close(t));
  }
  TRY(vs_translate_open(t) && vs_translate_direct(t, node(t, n->a)->name));
  if (more)
    for (uint32_t i = 0; i < wanted; i++) TRY(vs_translate_made(t, "a:", i));
  else {
    TRY(arguments(t, n->b));
    for (uint32_t i = n->count; i < wanted; i++) TRY(vs_translate_word(t, "js:undefined"));
  }
  return vs_translate_close(t) && (!more || vs_translate_close(t));
}

static bool call(vs_translation *t, const vs_script_node *n) {
  const vs_script_node *f = node(t, n->a);
  vs_script_place at = t->at;
  if (f->kind == VS_SCRIPT_NAME) {
    const vs_variable *v = variable(t, n->a);
    if (v && v->kind == VS_VARIABLE_FUNCTION && !v->assigned && vs_translate_has_direct(t, v->declaration))
      return direct_call(t, n, v);
    if (!v && vs_translate_parameter_word(t, f->name))
      return vs_script_fail(t->s, f->at,
                            "a parameter of the model is a variable of its own at top level: var x = %.*s(...)",
                            (int)t->s->names[f->name].length, t->s->texts + t->s->names[f->name].text);
    if (!v && (vs_script_is(t->s, f->name, "eval") || vs_script_is(t->s, f->name, "Function")))
      return vs_script_fail(t->s, f->at, "%s is not part of this language: a program cannot make code while it runs",
                            vs_script_is(t->s, f->name, "eval") ? "eval" : "Function");
  }
  if (f->kind == VS_SCRIPT_MEMBER || f->kind == VS_SCRIPT_INDEX) {
    TRY(let_one(t, "o:") && vs_translate_value(t, f->a) && let_body(t));
    t->at = at;
    TRY(let_one(t, "f:") && member_value(t, f, "o:") && let_body(t) &&
        call_bound(t, n, "o:", f->kind == VS_SCRIPT_MEMBER ? node(t, f->b)->name : 0));
    return vs_translate_close(t) && vs_translate_close(t);
  }
  TRY(let_one(t, "f:") && vs_translate_value(t, n->a) && let_body(t));
  t->at = at;
  return call_bound(t, n, NULL, f->kind == VS_SCRIPT_NAME ? f->name : 0) && vs_translate_close(t);
}

/* ---- arrays, objects and other literals ---- */

enum { AT_ONCE = 50 };

static bool array(vs_translation *t, const vs_script_node *n) {
  bool many = n->count > AT_ONCE;
  if (many) TRY(let_one(t, "a:") && vs_translate_call(t, "js:array") && vs_translate_close(t) && let_body(t));
  uint32_t at = n->a;
  do {
    TRY(vs_translate_call(t, many ? "js:push!" : "js:array"));
    if (many) TRY(vs_translate_word(t, "a:"));
    for (unsigned i = 0; at && i < AT_ONCE; i++, at = node(t, at)->next)
      TRY(node(t, at)->kind == VS_SCRIPT_HOLE ? vs_translate_word(t, "js:hole") : vs_translate_value(t, at));
    TRY(vs_translate_close(t));
  } while (at);
  return !many || (vs_translate_word(t, "a:") && vs_translate_close(t));
}

static bool object(vs_translation *t, const vs_script_node *n) {
  bool many = n->count > AT_ONCE;
  if (many) TRY(let_one(t, "a:"));
  TRY(vs_translate_call(t, "js:object"));
  if (many) TRY(vs_translate_close(t) && let_body(t));
  for (uint32_t at = n->a; at; at = node(t, at)->next) {
    if (many) TRY(vs_translate_call(t, "js:put!") && vs_translate_word(t, "a:"));
    TRY(vs_translate_key(t, node(t, at)->a) && vs_translate_value(t, node(t, at)->b));
    if (many) TRY(vs_translate_close(t));
  }
  if (many) TRY(vs_translate_word(t, "a:"));
  return vs_translate_close(t);
}

/* ---- other expressions ---- */

static bool unary(vs_translation *t, const vs_script_node *n) {
  const vs_script_node *a = node(t, n->a);
  switch ((vs_script_operator)n->op) {
  case VS_OPERATOR_NOT: return vs_translate_call(t, "js:not") && vs_translate_test(t, n->a) && vs_translate_close(t);
  case VS_OPERATOR_MINUS:
    if (a->kind == VS_SCRIPT_NUMBER)
      return vs_translate_item(t, (vs_item){ .kind = VS_ITEM_NUMBER, .number = -a->number });
    return vs_translate_call(t, "js:negate") && vs_translate_value(t, n->a) && vs_translate_close(t);
  case VS_OPERATOR_PLUS:
    return vs_translate_call(t, "js:number") && vs_translate_value(t, n->a) && vs_translate_close(t);
  case VS_OPERATOR_BIT_NOT:
    return vs_translate_call(t, "js:bit-not") && vs_translate_value(t, n->a) && vs_translate_close(t);
  case VS_OPERATOR_VOID:
    return vs_translate_call(t, "js:begin") && vs_translate_effect(t, n->a) && vs_translate_word(t, "js:undefined") &&
           vs_translate_close(t);
  case VS_OPERATOR_TYPE_OF:
    if (a->kind == VS_SCRIPT_NAME && (!variable(t, n->a) || variable(t, n->a)->kind == VS_VARIABLE_UNDECLARED))
      return vs_translate_call(t, "js:type-of-unknown") && vs_translate_call(t, "js:lambda") && vs_translate_open(t) &&
             vs_translate_close(t) && name_value(t, n->a) && vs_translate_close(t) && vs_translate_close(t);
    return vs_translate_call(t, "js:type-of") && vs_translate_value(t, n->a) && vs_translate_close(t);
  case VS_OPERATOR_DELETE:
    if (a->kind == VS_SCRIPT_MEMBER || a->kind == VS_SCRIPT_INDEX)
      return vs_translate_call(t, "js:delete!") && vs_translate_value(t, a->a) &&
             (a->kind == VS_SCRIPT_MEMBER ? vs_translate_key(t, a->b) : vs_translate_value(t, a->b)) &&
             vs_translate_close(t);
    if (a->kind == VS_SCRIPT_NAME) return vs_translate_word(t, "js:false");
    return vs_translate_call(t, "js:begin") && vs_translate_effect(t, n->a) && vs_translate_word(t, "js:true") &&
           vs_translate_close(t);
  default: return false;
  }
}

static bool value(vs_translation *t, uint32_t i, bool wanted) {
  const vs_script_node *n = node(t, i);
  t->at = n->at;
  switch ((vs_script_kind)n->kind) {
  case VS_SCRIPT_NUMBER: return vs_translate_item(t, (vs_item){ .kind = VS_ITEM_NUMBER, .number = n->number });
  case VS_SCRIPT_STRING: return vs_translate_item(t, (vs_item){ .kind = VS_ITEM_STRING, .a = n->text, .b = n->length });
  case VS_SCRIPT_NAME: return name_value(t, i);
  case VS_SCRIPT_THIS: return vs_translate_word(t, t->functions ? "this:" : "js:undefined");
  case VS_SCRIPT_TRUE: return vs_translate_word(t, "js:true");
  case VS_SCRIPT_FALSE: return vs_translate_word(t, "js:false");
  case VS_SCRIPT_NULL: return vs_translate_word(t, "js:null");
  case VS_SCRIPT_ARRAY: return array(t, n);
  case VS_SCRIPT_OBJECT: return object(t, n);
  case VS_SCRIPT_FUNCTION: return vs_translate_function(t, i, false);
  case VS_SCRIPT_CALL: return call(t, n);
  case VS_SCRIPT_NEW:
    return vs_translate_call(t, "js:new") && vs_translate_value(t, n->a) && arguments(t, n->b) && vs_translate_close(t);
  case VS_SCRIPT_MEMBER:
  case VS_SCRIPT_INDEX: return member_value(t, n, NULL);
  case VS_SCRIPT_UNARY: return unary(t, n);
  case VS_SCRIPT_UPDATE: return update(t, n, wanted);
  case VS_SCRIPT_BINARY: return binary_node(t, n);
  case VS_SCRIPT_ASSIGN:
    return assignment(t, n,
                      wanted || (node(t, n->a)->kind == VS_SCRIPT_NAME && variable(t, n->a) &&
                                 variable(t, n->a)->kind == VS_VARIABLE_SELF));
  case VS_SCRIPT_CONDITIONAL:
    return vs_translate_call(t, "js:if") && vs_translate_test(t, n->a) && value(t, n->b, wanted) &&
           value(t, n->c, wanted) && vs_translate_close(t);
  case VS_SCRIPT_LOGICAL: {
    bool and = n->op == VS_OPERATOR_AND;
    if (!wanted || type(t, n->a) == VS_TYPE_BOOLEAN) {
      TRY(vs_translate_call(t, "js:if") && vs_translate_test(t, n->a));
      if (!and) TRY(vs_translate_word(t, "js:true"));
      TRY(value(t, n->b, wanted));
      return (!and || vs_translate_word(t, "js:false")) && vs_translate_close(t);
    }
    TRY(let_one(t, "l:") && vs_translate_value(t, n->a) && let_body(t) && vs_translate_call(t, "js:if") &&
        vs_translate_call(t, "js:true?") && vs_translate_word(t, "l:") && vs_translate_close(t));
    if (!and) TRY(vs_translate_word(t, "l:"));
    TRY(vs_translate_value(t, n->b));
    return (!and || vs_translate_word(t, "l:")) && vs_translate_close(t) && vs_translate_close(t);
  }
  case VS_SCRIPT_SEQUENCE:
    return vs_translate_call(t, "js:begin") && vs_translate_effect(t, n->a) && value(t, n->b, wanted) &&
           vs_translate_close(t);
  default: return vs_script_fail(t->s, n->at, "%s is no expression", vs_script_kind_word((vs_script_kind)n->kind));
  }
}

bool vs_translate_value(vs_translation *t, uint32_t i) { return value(t, i, true); }
bool vs_translate_effect(vs_translation *t, uint32_t i) { return value(t, i, false); }

bool vs_translate_test(vs_translation *t, uint32_t i) {
  const vs_script_node *n = node(t, i);
  t->at = n->at;
  if (n->kind == VS_SCRIPT_LOGICAL) {
    bool and = n->op == VS_OPERATOR_AND;
    TRY(vs_translate_call(t, "js:if") && vs_translate_test(t, n->a));
    if (!and) TRY(vs_translate_word(t, "js:true"));
    TRY(vs_translate_test(t, n->b));
    return (!and || vs_translate_word(t, "js:false")) && vs_translate_close(t);
  }
  if (type(t, i) == VS_TYPE_BOOLEAN) return vs_translate_value(t, i);
  return vs_translate_call(t, "js:true?") && vs_translate_value(t, i) && vs_translate_close(t);
}
