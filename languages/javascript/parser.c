/* Implements the parser of scripts by recursive descent, with precedence of operators.
 *
 * The parser calls itself once for each level of brackets or statements, and counts the levels. It refuses a text with
 * more than VS_SCRIPT_DEPTH levels. A long sequence of operators makes a tree as high as the sequence is long; the
 * parser limits the height of each node. */
#include "languages/javascript/parser.h"

#include <string.h>

#include "languages/javascript/scanner.h"

typedef struct {
  vs_script *s;
  vs_scanner c;
  vs_script_place last; /* place of the last token that was read */
  unsigned depth, chained; /* depth: number of open levels of brackets and statements. chained: number of these that are
                            * else-ifs */
  unsigned functions, loops, switches; /* numbers of functions, loops and switches around the current position; loops
                                        * and switches are counted within the innermost function */
} parser;

typedef struct {
  uint32_t first, last, count;
} list;

static bool statement(parser *p, uint32_t *out);
static bool assignment(parser *p, bool in, uint32_t *out);
static bool expression(parser *p, bool in, uint32_t *out);
static bool function(parser *p, bool declaration, uint32_t *out);

/* ---- tokens ---- */

static const vs_token *now(const parser *p) { return &p->c.token; }

static bool next(parser *p) {
  p->last = p->c.token.at;
  return vs_scanner_next(&p->c);
}

static bool at_mark(const parser *p, const char *mark) {
  return now(p)->kind == VS_TOKEN_MARK && !strcmp(now(p)->mark, mark);
}
static bool at_word(const parser *p, vs_script_word word) {
  return now(p)->kind == VS_TOKEN_WORD && now(p)->word == word;
}

static bool unexpected(parser *p, const char *wanted) {
  const vs_token *t = now(p);
  if (t->kind == VS_TOKEN_END) return vs_script_fail(p->s, t->at, "the text ends where %s is expected", wanted);
  if (t->kind == VS_TOKEN_WORD && *vs_script_word_out(t->word))
    return vs_script_fail(p->s, t->at, "%s", vs_script_word_out(t->word));
  if (at_mark(p, "=>"))
    return vs_script_fail(p->s, t->at,
                          "=> is not part of this language (ECMAScript 3): write function (...) { return ...; }");
  if (at_mark(p, "...")) return vs_script_fail(p->s, t->at, "... is not part of this language (ECMAScript 3)");
  size_t n = t->at.to - t->at.from;
  return vs_script_fail(p->s, t->at, "%s is expected here, not %.*s%s", wanted, (int)(n > 40 ? 40 : n),
                        p->s->source + t->at.from, n > 40 ? "..." : "");
}

static bool expect(parser *p, const char *mark) { return at_mark(p, mark) ? next(p) : unexpected(p, mark); }

/* Reads the end of a statement: a semicolon, or a place where the grammar allows it to be omitted. */
static bool semicolon(parser *p) {
  if (at_mark(p, ";")) return next(p);
  if (at_mark(p, "}") || now(p)->kind == VS_TOKEN_END || now(p)->newline) return true;
  const char *before = p->s->source + p->last.from;
  if (p->last.to - p->last.from == 3 && !memcmp(before, "let", 3) && now(p)->kind == VS_TOKEN_NAME)
    return vs_script_fail(p->s, p->last, "let is not part of this language (ECMAScript 3): write var");
  return unexpected(p, ";");
}

/* ---- nodes ---- */

static vs_script_node *node(const parser *p, uint32_t i) { return &p->s->nodes[i]; }

/* Sets the end of the node to the end of the last token. */
static bool close_node(parser *p, uint32_t i) {
  vs_script_node *n = node(p, i);
  n->at.to = p->last.to, n->at.end_line = p->last.end_line, n->at.end_column = p->last.end_column;
  return true;
}

/* Makes the height of node i at least 1 greater than the height of its child, the node `part`. */
static bool above(parser *p, uint32_t i, uint32_t part) {
  if (!part || node(p, part)->height < node(p, i)->height) return true;
  if (node(p, part)->height >= VS_SCRIPT_HEIGHT)
    return vs_script_fail(p->s, node(p, part)->at,
                          "this expression nests more than %d levels deep: give its parts names", VS_SCRIPT_HEIGHT);
  node(p, i)->height = (uint16_t)(node(p, part)->height + 1);
  return true;
}

static bool make(parser *p, vs_script_kind kind, vs_script_place at, uint32_t *out) {
  return (*out = vs_script_node_new(p->s, kind, at)) != 0;
}

/* Makes a node with the parts a to d. Its end is the end of the last token. */
static bool make_of(parser *p, vs_script_kind kind, vs_script_place at, uint32_t a, uint32_t b, uint32_t c, uint32_t d,
                    uint32_t *out) {
  if (!make(p, kind, at, out)) return false;
  vs_script_node *n = node(p, *out);
  n->a = a, n->b = b, n->c = c, n->d = d;
  return above(p, *out, a) && above(p, *out, b) && above(p, *out, c) && above(p, *out, d) && close_node(p, *out);
}

static void append(parser *p, list *l, uint32_t i) {
  if (l->last)
    node(p, l->last)->next = i;
  else
    l->first = i;
  l->last = i;
  l->count++;
}

static bool above_list(parser *p, uint32_t i, const list *l) {
  for (uint32_t at = l->first; at; at = node(p, at)->next)
    if (!above(p, i, at)) return false;
  return true;
}

static bool deeper(parser *p) {
  return ++p->depth <= VS_SCRIPT_DEPTH ||
         vs_script_fail(p->s, now(p)->at, "this nests deeper than %d levels", VS_SCRIPT_DEPTH);
}

static bool name(parser *p, const char *wanted, uint32_t *out) {
  if (now(p)->kind != VS_TOKEN_NAME) return unexpected(p, wanted);
  if (!make(p, VS_SCRIPT_NAME, now(p)->at, out)) return false;
  node(p, *out)->name = now(p)->name;
  return next(p);
}

/* Reads a name that a script may bind or assign. */
static bool own_name(parser *p, const char *wanted, uint32_t *out) {
  return name(p, wanted, out) &&
         (!vs_script_is(p->s, node(p, *out)->name, "arguments") ||
          vs_script_fail(p->s, node(p, *out)->at, "arguments holds the arguments of a function: take another name"));
}

/* ---- expressions ---- */

static bool literal(parser *p, vs_script_kind kind, uint32_t *out) {
  const vs_token *t = now(p);
  if (!make(p, kind, t->at, out)) return false;
  vs_script_node *n = node(p, *out);
  n->number = t->number, n->text = t->text, n->length = t->length;
  return next(p);
}

static bool array(parser *p, uint32_t *out) {
  list l = { 0 };
  if (!make(p, VS_SCRIPT_ARRAY, now(p)->at, out) || !next(p)) return false;
  while (!at_mark(p, "]")) {
    uint32_t element;
    if (at_mark(p, ",")) {
      if (!make(p, VS_SCRIPT_HOLE, now(p)->at, &element)) return false;
    } else if (!assignment(p, true, &element))
      return false;
    append(p, &l, element);
    if (!at_mark(p, "]") && !expect(p, ",")) return false;
  }
  node(p, *out)->a = l.first, node(p, *out)->count = l.count;
  return next(p) && above_list(p, *out, &l) && close_node(p, *out);
}

static bool property(parser *p, uint32_t *out) {
  const vs_token *t = now(p);
  uint32_t key, value;
  vs_script_place at = t->at;
  if (t->kind == VS_TOKEN_STRING || t->kind == VS_TOKEN_NUMBER) {
    if (!literal(p, t->kind == VS_TOKEN_STRING ? VS_SCRIPT_STRING : VS_SCRIPT_NUMBER, &key)) return false;
  } else if (t->kind == VS_TOKEN_NAME || t->kind == VS_TOKEN_WORD) {
    if (!make(p, VS_SCRIPT_NAME, at, &key)) return false;
    node(p, key)->name = t->name;
    bool accessor = vs_script_is(p->s, t->name, "get") || vs_script_is(p->s, t->name, "set");
    if (!next(p)) return false;
    if (accessor && !at_mark(p, ":"))
      return vs_script_fail(p->s, at, "properties with get and set are not part of this language (ECMAScript 3)");
  } else
    return unexpected(p, "the name of a property");
  return expect(p, ":") && assignment(p, true, &value) && make_of(p, VS_SCRIPT_PROPERTY, at, key, value, 0, 0, out);
}

static bool object(parser *p, uint32_t *out) {
  list l = { 0 };
  if (!make(p, VS_SCRIPT_OBJECT, now(p)->at, out) || !next(p)) return false;
  while (!at_mark(p, "}")) {
    uint32_t one;
    if (!property(p, &one)) return false;
    append(p, &l, one);
    if (!at_mark(p, "}") && !expect(p, ",")) return false;
  }
  node(p, *out)->a = l.first, node(p, *out)->count = l.count;
  return next(p) && above_list(p, *out, &l) && close_node(p, *out);
}

static bool arguments(parser *p, uint32_t call) {
  list l = { 0 };
  if (!expect(p, "(")) return false;
  while (!at_mark(p, ")")) {
    uint32_t one;
    if (!assignment(p, true, &one)) return false;
    append(p, &l, one);
    if (!at_mark(p, ")") && !expect(p, ",")) return false;
    if (l.count > 200) return vs_script_fail(p->s, now(p)->at, "more than 200 arguments: hand over an array");
  }
  if (!next(p)) return false;
  node(p, call)->b = l.first, node(p, call)->count = l.count;
  return above_list(p, call, &l) && close_node(p, call);
}

static bool primary(parser *p, uint32_t *out) {
  const vs_token *t = now(p);
  if (t->kind == VS_TOKEN_NAME) return name(p, "a name", out);
  if (t->kind == VS_TOKEN_NUMBER) return literal(p, VS_SCRIPT_NUMBER, out);
  if (t->kind == VS_TOKEN_STRING) return literal(p, VS_SCRIPT_STRING, out);
  if (t->kind == VS_TOKEN_WORD) switch (t->word) {
    case VS_WORD_THIS: return literal(p, VS_SCRIPT_THIS, out);
    case VS_WORD_TRUE: return literal(p, VS_SCRIPT_TRUE, out);
    case VS_WORD_FALSE: return literal(p, VS_SCRIPT_FALSE, out);
    case VS_WORD_NULL: return literal(p, VS_SCRIPT_NULL, out);
    case VS_WORD_FUNCTION: return function(p, false, out);
    default: return unexpected(p, "an expression");
    }
  if (at_mark(p, "[")) return array(p, out);
  if (at_mark(p, "{")) return object(p, out);
  if (at_mark(p, "/") || at_mark(p, "/="))
    return vs_script_fail(
        p->s, t->at,
        "regular expressions are not part of this language: look through the string with indexOf and charAt");
  if (at_mark(p, "(")) {
    vs_script_place at = t->at;
    if (!next(p) || !expression(p, true, out) || !expect(p, ")")) return false;
    node(p, *out)->at = at; /* the place of an expression in parentheses includes the parentheses */
    return close_node(p, *out);
  }
  return unexpected(p, "an expression");
}

/* Reads .name, [index] and, if calls are allowed, (arguments) after the expression *out, which it extends. */
static bool members(parser *p, bool calls, uint32_t *out) {
  for (;;) {
    uint32_t object = *out, part;
    vs_script_place at = node(p, object)->at;
    if (at_mark(p, ".")) {
      if (!next(p)) return false;
      if (now(p)->kind != VS_TOKEN_NAME && now(p)->kind != VS_TOKEN_WORD)
        return unexpected(p, "the name of a property");
      if (!make(p, VS_SCRIPT_NAME, now(p)->at, &part)) return false;
      node(p, part)->name = now(p)->name;
      if (!next(p) || !make_of(p, VS_SCRIPT_MEMBER, at, object, part, 0, 0, out)) return false;
    } else if (at_mark(p, "[")) {
      if (!next(p) || !expression(p, true, &part) || !expect(p, "]") ||
          !make_of(p, VS_SCRIPT_INDEX, at, object, part, 0, 0, out))
        return false;
    } else if (calls && at_mark(p, "(")) {
      if (!make_of(p, VS_SCRIPT_CALL, at, object, 0, 0, 0, out) || !arguments(p, *out)) return false;
    } else
      return true;
  }
}

static bool creation(parser *p, uint32_t *out) {
  vs_script_place at = now(p)->at;
  uint32_t what;
  if (!next(p) || !deeper(p)) return false;
  if (!(at_word(p, VS_WORD_NEW) ? creation(p, &what) : primary(p, &what)) || !members(p, false, &what)) return false;
  p->depth--;
  return make_of(p, VS_SCRIPT_NEW, at, what, 0, 0, 0, out) && (!at_mark(p, "(") || arguments(p, *out));
}

static bool left_side(parser *p, uint32_t *out) {
  return (at_word(p, VS_WORD_NEW) ? creation(p, out) : primary(p, out)) && members(p, true, out);
}

static bool may_be_assigned(parser *p, uint32_t target) {
  const vs_script_node *n = node(p, target);
  if (n->kind == VS_SCRIPT_NAME && vs_script_is(p->s, n->name, "arguments"))
    return vs_script_fail(p->s, n->at, "arguments holds the arguments of a function: take another name");
  return n->kind == VS_SCRIPT_NAME || n->kind == VS_SCRIPT_MEMBER || n->kind == VS_SCRIPT_INDEX ||
         vs_script_fail(p->s, n->at, "only a variable or a property can be set");
}

static bool postfix(parser *p, uint32_t *out) {
  if (!left_side(p, out)) return false;
  if (now(p)->newline || !(at_mark(p, "++") || at_mark(p, "--"))) return true;
  uint32_t target = *out;
  vs_script_operator op = now(p)->mark[0] == '+' ? VS_OPERATOR_PLUS : VS_OPERATOR_MINUS;
  if (!may_be_assigned(p, target) || !next(p) ||
      !make_of(p, VS_SCRIPT_UPDATE, node(p, target)->at, target, 0, 0, 0, out))
    return false;
  node(p, *out)->op = (uint8_t)op;
  return true;
}

static bool unary(parser *p, uint32_t *out) {
  static const struct {
    const char *text;
    vs_script_operator op;
    bool update;
  } marks[] = { { "!", VS_OPERATOR_NOT, false },  { "~", VS_OPERATOR_BIT_NOT, false },
                { "+", VS_OPERATOR_PLUS, false }, { "-", VS_OPERATOR_MINUS, false },
                { "++", VS_OPERATOR_PLUS, true }, { "--", VS_OPERATOR_MINUS, true } };
  static const struct {
    vs_script_word word;
    vs_script_operator op;
  } words[] = { { VS_WORD_TYPEOF, VS_OPERATOR_TYPE_OF },
                { VS_WORD_VOID, VS_OPERATOR_VOID },
                { VS_WORD_DELETE, VS_OPERATOR_DELETE } };
  vs_script_operator op = VS_OPERATOR_NONE;
  bool update = false;
  for (size_t i = 0; i < sizeof marks / sizeof *marks; i++)
    if (at_mark(p, marks[i].text)) op = marks[i].op, update = marks[i].update;
  for (size_t i = 0; i < sizeof words / sizeof *words; i++)
    if (at_word(p, words[i].word)) op = words[i].op;
  if (op == VS_OPERATOR_NONE) return postfix(p, out);
  vs_script_place at = now(p)->at;
  uint32_t operand;
  if (!next(p) || !deeper(p) || !unary(p, &operand)) return false;
  p->depth--;
  if (update && !may_be_assigned(p, operand)) return false;
  if (!make_of(p, update ? VS_SCRIPT_UPDATE : VS_SCRIPT_UNARY, at, operand, 0, 0, 0, out)) return false;
  node(p, *out)->op = (uint8_t)op;
  node(p, *out)->flag = update;
  return true;
}

static const struct {
  const char *text;
  uint8_t binds;
} operators[] = {
#define VS_SCRIPT_OPERATOR(name, text, binds) { text, binds },
#include "languages/javascript/script_operators.def"
#undef VS_SCRIPT_OPERATOR
};
enum { OPERATORS = sizeof operators / sizeof *operators };

/* Returns the binary operator at the current token, or NONE if there is none. */
static vs_script_operator infix(const parser *p, bool in) {
  if (at_word(p, VS_WORD_INSTANCEOF)) return VS_OPERATOR_INSTANCE_OF;
  if (at_word(p, VS_WORD_IN)) return in ? VS_OPERATOR_IN : VS_OPERATOR_NONE;
  if (now(p)->kind == VS_TOKEN_MARK)
    for (unsigned i = 1; i < OPERATORS; i++)
      if (operators[i].binds && !strcmp(operators[i].text, now(p)->mark)) return (vs_script_operator)i;
  return VS_OPERATOR_NONE;
}

/* Reads an expression of operands and operators of precedence `least` or higher. It calls itself only for higher
 * precedences. */
static bool binary(parser *p, unsigned least, bool in, uint32_t *out) {
  if (!unary(p, out)) return false;
  for (;;) {
    vs_script_operator op = infix(p, in);
    if (op == VS_OPERATOR_NONE || operators[op].binds < least) return true;
    uint32_t left = *out, right;
    vs_script_place at = node(p, left)->at;
    if (!next(p) || !binary(p, operators[op].binds + 1u, in, &right)) return false;
    bool logical = op == VS_OPERATOR_AND || op == VS_OPERATOR_OR;
    if (!make_of(p, logical ? VS_SCRIPT_LOGICAL : VS_SCRIPT_BINARY, at, left, right, 0, 0, out)) return false;
    node(p, *out)->op = (uint8_t)op;
  }
}

static bool assignment(parser *p, bool in, uint32_t *out) {
  if (!deeper(p) || !binary(p, 1, in, out)) return false;
  uint32_t left = *out, b, c;
  vs_script_place at = node(p, left)->at;
  if (at_mark(p, "?")) {
    if (!next(p) || !assignment(p, true, &b) || !expect(p, ":") || !assignment(p, in, &c) ||
        !make_of(p, VS_SCRIPT_CONDITIONAL, at, left, b, c, 0, out))
      return false;
  } else if (now(p)->kind == VS_TOKEN_MARK) {
    const char *mark = now(p)->mark;
    size_t n = strlen(mark);
    vs_script_operator op = VS_OPERATOR_NONE;
    bool assigns = n == 1 && *mark == '=';
    for (unsigned i = 1; n > 1 && mark[n - 1] == '=' && i < OPERATORS; i++)
      if (operators[i].binds >= 3 && operators[i].binds != 6 && operators[i].binds != 7 &&
          strlen(operators[i].text) == n - 1 && !memcmp(operators[i].text, mark, n - 1))
        op = (vs_script_operator)i, assigns = true;
    if (assigns) {
      if (!may_be_assigned(p, left) || !next(p) || !assignment(p, in, &b) ||
          !make_of(p, VS_SCRIPT_ASSIGN, at, left, b, 0, 0, out))
        return false;
      node(p, *out)->op = (uint8_t)op;
    }
  }
  p->depth--;
  return true;
}

static bool expression(parser *p, bool in, uint32_t *out) {
  if (!assignment(p, in, out)) return false;
  while (at_mark(p, ",")) {
    uint32_t left = *out, right;
    if (!next(p) || !assignment(p, in, &right) ||
        !make_of(p, VS_SCRIPT_SEQUENCE, node(p, left)->at, left, right, 0, 0, out))
      return false;
  }
  return true;
}

/* ---- statements ---- */

/* Reads statements up to } or the end of the text. cases: inside a switch, where a case or default also ends the
 * statements. */
static bool statements(parser *p, bool cases, list *l) {
  while (now(p)->kind != VS_TOKEN_END && !at_mark(p, "}") &&
         !(cases && (at_word(p, VS_WORD_CASE) || at_word(p, VS_WORD_DEFAULT)))) {
    uint32_t one;
    if (!statement(p, &one)) return false;
    append(p, l, one);
  }
  return true;
}

/* Reads the } that closes a block. If the text ends, the error has the place of the opening {. */
static bool closing(parser *p, vs_script_place open) {
  if (now(p)->kind == VS_TOKEN_END) return vs_script_fail(p->s, open, "this { is never closed");
  return expect(p, "}");
}

static bool block(parser *p, uint32_t *out) {
  list l = { 0 };
  vs_script_place at = now(p)->at;
  if (!at_mark(p, "{")) return unexpected(p, "{");
  if (!make(p, VS_SCRIPT_BLOCK, at, out) || !next(p) || !statements(p, false, &l) || !closing(p, at)) return false;
  node(p, *out)->a = l.first, node(p, *out)->count = l.count;
  return above_list(p, *out, &l) && close_node(p, *out);
}

static bool function(parser *p, bool declaration, uint32_t *out) {
  vs_script_place at = now(p)->at;
  list parameters = { 0 }, body = { 0 };
  uint32_t own = 0;
  if (!next(p) || !deeper(p)) return false;
  if ((declaration || now(p)->kind == VS_TOKEN_NAME) && !own_name(p, "the function's name", &own)) return false;
  if (!expect(p, "(")) return false;
  while (!at_mark(p, ")")) {
    uint32_t one;
    if (!own_name(p, "a parameter", &one)) return false;
    append(p, &parameters, one);
    if (at_mark(p, "="))
      return vs_script_fail(p->s, now(p)->at, "a parameter with a default is not part of this language (ECMAScript 3)");
    if (!at_mark(p, ")") && !expect(p, ",")) return false;
    if (parameters.count > 100) return vs_script_fail(p->s, now(p)->at, "more than 100 parameters: take an array");
  }
  if (!next(p)) return false;
  vs_script_place open = now(p)->at;
  parser outer = *p;
  p->functions++, p->loops = p->switches = 0;
  if (!expect(p, "{") || !statements(p, false, &body) || !closing(p, open)) return false;
  p->functions = outer.functions, p->loops = outer.loops, p->switches = outer.switches;
  p->depth--;
  if (!make_of(p, VS_SCRIPT_FUNCTION, at, 0, 0, own, 0, out)) return false;
  vs_script_node *n = node(p, *out);
  n->a = parameters.first, n->b = body.first, n->count = parameters.count, n->flag = declaration;
  return above_list(p, *out, &body);
}

static bool declarations(parser *p, bool in, uint32_t *out) {
  list l = { 0 };
  if (!make(p, VS_SCRIPT_VAR, now(p)->at, out) || !next(p)) return false;
  for (;;) {
    uint32_t own, value = 0, one;
    vs_script_place at = now(p)->at;
    if (at_mark(p, "[") || at_mark(p, "{"))
      return vs_script_fail(p->s, at, "destructuring is not part of this language (ECMAScript 3)");
    if (!own_name(p, "a variable's name", &own)) return false;
    if (at_mark(p, "=") && (!next(p) || !assignment(p, in, &value))) return false;
    if (!make_of(p, VS_SCRIPT_DECLARATOR, at, own, value, 0, 0, &one)) return false;
    append(p, &l, one);
    if (!at_mark(p, ",")) break;
    if (!next(p)) return false;
  }
  node(p, *out)->a = l.first, node(p, *out)->count = l.count;
  return above_list(p, *out, &l) && close_node(p, *out);
}

static bool loop_body(parser *p, uint32_t *out) {
  p->loops++;
  bool ok = statement(p, out);
  p->loops--;
  return ok;
}

static bool for_statement(parser *p, vs_script_place at, uint32_t *out) {
  uint32_t first = 0, test = 0, step = 0, body, object;
  if (!next(p) || !expect(p, "(")) return false;
  if (at_word(p, VS_WORD_VAR)) {
    if (!declarations(p, false, &first)) return false;
  } else if (!at_mark(p, ";")) {
    uint32_t value;
    if (!expression(p, false, &value)) return false;
    first = value;
  }
  if (first && now(p)->kind == VS_TOKEN_NAME && vs_script_is(p->s, now(p)->name, "of"))
    return vs_script_fail(p->s, now(p)->at,
                          "for ... of is not part of this language (ECMAScript 3): count with an index");
  if (first && at_word(p, VS_WORD_IN)) {
    const vs_script_node *n = node(p, first);
    if (n->kind == VS_SCRIPT_VAR && n->count != 1) return vs_script_fail(p->s, n->at, "for ... in takes one variable");
    if (n->kind != VS_SCRIPT_VAR && !may_be_assigned(p, first)) return false;
    return next(p) && expression(p, true, &object) && expect(p, ")") && loop_body(p, &body) &&
           make_of(p, VS_SCRIPT_FOR_IN, at, first, object, 0, body, out);
  }
  if (first && node(p, first)->kind != VS_SCRIPT_VAR &&
      !make_of(p, VS_SCRIPT_EXPRESSION, node(p, first)->at, first, 0, 0, 0, &first))
    return false;
  if (!expect(p, ";") || (!at_mark(p, ";") && !expression(p, true, &test)) || !expect(p, ";") ||
      (!at_mark(p, ")") && !expression(p, true, &step)) || !expect(p, ")") || !loop_body(p, &body))
    return false;
  return make_of(p, VS_SCRIPT_FOR, at, first, test, step, body, out);
}

static bool switch_statement(parser *p, vs_script_place at, uint32_t *out) {
  uint32_t value;
  list cases = { 0 };
  bool fallback = false;
  if (!next(p) || !expect(p, "(") || !expression(p, true, &value) || !expect(p, ")")) return false;
  vs_script_place open = now(p)->at;
  if (!expect(p, "{")) return false;
  p->switches++;
  while (!at_mark(p, "}")) {
    uint32_t test = 0, one;
    vs_script_place place = now(p)->at;
    list body = { 0 };
    if (now(p)->kind == VS_TOKEN_END) return closing(p, open);
    if (at_word(p, VS_WORD_DEFAULT)) {
      if (fallback) return vs_script_fail(p->s, place, "a second default in one switch");
      fallback = true;
      if (!next(p)) return false;
    } else if (!at_word(p, VS_WORD_CASE)) {
      return unexpected(p, "case or default");
    } else if (!next(p) || !expression(p, true, &test))
      return false;
    if (!expect(p, ":") || !statements(p, true, &body) || !make_of(p, VS_SCRIPT_CASE, place, test, 0, 0, 0, &one))
      return false;
    node(p, one)->b = body.first;
    if (!above_list(p, one, &body)) return false;
    append(p, &cases, one);
  }
  p->switches--;
  if (!next(p) || !make_of(p, VS_SCRIPT_SWITCH, at, value, 0, 0, 0, out)) return false;
  node(p, *out)->b = cases.first, node(p, *out)->count = cases.count;
  return above_list(p, *out, &cases);
}

static bool try_statement(parser *p, vs_script_place at, uint32_t *out) {
  uint32_t body, own = 0, handler = 0, last = 0;
  if (!next(p) || !block(p, &body)) return false;
  if (at_word(p, VS_WORD_CATCH) && (!next(p) || !expect(p, "(") || !own_name(p, "the name of the thrown value", &own) ||
                                    !expect(p, ")") || !block(p, &handler)))
    return false;
  if (at_word(p, VS_WORD_FINALLY) && (!next(p) || !block(p, &last))) return false;
  if (!handler && !last) return unexpected(p, "catch or finally");
  return make_of(p, VS_SCRIPT_TRY, at, body, own, handler, last, out);
}

/* Reads break or continue, with a label if there is a label on the same line. */
static bool jump(parser *p, vs_script_kind kind, vs_script_place at, uint32_t *out) {
  uint32_t label = 0;
  if (!next(p)) return false;
  if (!now(p)->newline && now(p)->kind == VS_TOKEN_NAME) {
    if (!name(p, "a label", &label)) return false;
  } else if (kind == VS_SCRIPT_CONTINUE ? !p->loops : !p->loops && !p->switches) {
    return vs_script_fail(p->s, at,
                          kind == VS_SCRIPT_CONTINUE ? "continue is not inside a loop"
                                                     : "break is not inside a loop or a switch");
  }
  return make_of(p, kind, at, label, 0, 0, 0, out) && semicolon(p);
}

static bool word_statement(parser *p, vs_script_place at, uint32_t *out);

/* Reads the statement after `else`. Another `if` continues the chain of else-ifs and does not begin a new level. Only
 * the height of the tree limits the length of a chain. */
static bool otherwise(parser *p, uint32_t *out) {
  if (!at_word(p, VS_WORD_IF)) return statement(p, out);
  if (++p->chained > VS_SCRIPT_HEIGHT)
    return vs_script_fail(p->s, now(p)->at, "more than %d times else if in a row", VS_SCRIPT_HEIGHT);
  bool ok = word_statement(p, now(p)->at, out);
  p->chained--;
  return ok;
}

static bool word_statement(parser *p, vs_script_place at, uint32_t *out) {
  uint32_t a, b, c = 0;
  switch (now(p)->word) {
  case VS_WORD_VAR: return declarations(p, true, out) && semicolon(p);
  case VS_WORD_FUNCTION: return function(p, true, out);
  case VS_WORD_IF:
    if (!next(p) || !expect(p, "(") || !expression(p, true, &a) || !expect(p, ")") || !statement(p, &b)) return false;
    if (at_word(p, VS_WORD_ELSE) && (!next(p) || !otherwise(p, &c))) return false;
    return make_of(p, VS_SCRIPT_IF, at, a, b, c, 0, out);
  case VS_WORD_FOR: return for_statement(p, at, out);
  case VS_WORD_WHILE:
    return next(p) && expect(p, "(") && expression(p, true, &a) && expect(p, ")") && loop_body(p, &b) &&
           make_of(p, VS_SCRIPT_WHILE, at, a, 0, 0, b, out);
  case VS_WORD_DO:
    if (!next(p) || !loop_body(p, &b)) return false;
    if (!at_word(p, VS_WORD_WHILE)) return unexpected(p, "while");
    if (!next(p) || !expect(p, "(") || !expression(p, true, &a) || !expect(p, ")")) return false;
    return make_of(p, VS_SCRIPT_DO, at, a, 0, 0, b, out) && (!at_mark(p, ";") || next(p));
  case VS_WORD_CONTINUE: return jump(p, VS_SCRIPT_CONTINUE, at, out);
  case VS_WORD_BREAK: return jump(p, VS_SCRIPT_BREAK, at, out);
  case VS_WORD_RETURN:
    if (!p->functions) return vs_script_fail(p->s, at, "return is not inside a function");
    a = 0;
    if (!next(p)) return false;
    if (!now(p)->newline && !at_mark(p, ";") && !at_mark(p, "}") && now(p)->kind != VS_TOKEN_END &&
        !expression(p, true, &a))
      return false;
    return make_of(p, VS_SCRIPT_RETURN, at, a, 0, 0, 0, out) && semicolon(p);
  case VS_WORD_THROW:
    if (!next(p)) return false;
    if (now(p)->newline) return vs_script_fail(p->s, at, "the thrown value must be on the line of throw");
    return expression(p, true, &a) && make_of(p, VS_SCRIPT_THROW, at, a, 0, 0, 0, out) && semicolon(p);
  case VS_WORD_SWITCH: return switch_statement(p, at, out);
  case VS_WORD_TRY: return try_statement(p, at, out);
  default: break;
  }
  return expression(p, true, &a) && make_of(p, VS_SCRIPT_EXPRESSION, at, a, 0, 0, 0, out) && semicolon(p);
}

static bool one_statement(parser *p, uint32_t *out) {
  vs_script_place at = now(p)->at;
  uint32_t a, b;
  if (at_mark(p, "{")) return block(p, out);
  if (at_mark(p, ";")) return next(p) && make_of(p, VS_SCRIPT_EMPTY, at, 0, 0, 0, 0, out);
  if (now(p)->kind == VS_TOKEN_NATIVE) return literal(p, VS_SCRIPT_NATIVE, out);
  if (now(p)->kind == VS_TOKEN_WORD) return word_statement(p, at, out);
  if (!expression(p, true, &a)) return false;
  if (node(p, a)->kind == VS_SCRIPT_NAME && at_mark(p, ":") && p->s->source[node(p, a)->at.from] != '(')
    return next(p) && statement(p, &b) && make_of(p, VS_SCRIPT_LABEL, at, a, b, 0, 0, out);
  return make_of(p, VS_SCRIPT_EXPRESSION, at, a, 0, 0, 0, out) && semicolon(p);
}

static bool statement(parser *p, uint32_t *out) {
  if (!deeper(p) || !one_statement(p, out)) return false;
  p->depth--;
  return true;
}

bool vs_script_parse(vs_script *s, const char *text, size_t size, vs_script_resize *resize, void *context) {
  *s = (vs_script){ .source = text, .size = size, .resize = resize, .context = context };
  parser p = { .s = s };
  list l = { 0 };
  vs_script_node_new(s, VS_SCRIPT_EMPTY, (vs_script_place){ 0 }); /* index 0 means that there is no node */
  if (s->no_memory || !vs_scanner_open(&p.c, s) || !next(&p)) return false;
  vs_script_place start = now(&p)->at;
  if (!statements(&p, false, &l)) return false;
  if (now(&p)->kind != VS_TOKEN_END) return vs_script_fail(s, now(&p)->at, "a } too many");
  if (!make_of(&p, VS_SCRIPT_PROGRAM, start, 0, 0, 0, 0, &s->root)) return false;
  node(&p, s->root)->a = l.first;
  return above_list(&p, s->root, &l);
}
