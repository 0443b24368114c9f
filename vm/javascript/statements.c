/* Translates statements and functions of JavaScript to data of Scheme.
 *
 * A list of statements becomes one expression. Statements that no jump leaves run in sequence. A statement that a jump
 * leaves (such as an if that contains a return) is in tail position. Its translation receives a description of where
 * control continues after it (vs_then), and puts the code that follows in the text into the statement's branches. If
 * several branches continue at one place, the code there becomes a procedure without parameters, which the branches
 * call. A loop is such a procedure, too. All these calls are in tail position, so that the compiler makes them jumps
 * within one activation.
 *
 * The parts of a try are procedures that other code calls. A jump that leaves such a part returns a number; the normal
 * end of the part returns 0. After the try, control continues at the place with the returned number. */
#include "vm/javascript/statements.h"

#include <string.h>

#include "vm/javascript/expressions.h"

#define TRY(x)                                                                                                         \
  do {                                                                                                                 \
    if (!(x)) return false;                                                                                            \
  } while (0)

enum { MOST_DEPTH = 2500, IN_ONE_ROW = 30 };

static const vs_script_node *node(const vs_translation *t, uint32_t i) { return vs_script_at(t->s, i); }
static bool fact(const vs_translation *t, uint32_t i, uint8_t what) { return t->k->facts[i] & what; }

static const vs_then nothing = { .kind = VS_THEN_NOTHING };

static bool go(vs_translation *t, const vs_then *then);
static bool leaving(vs_translation *t, uint32_t i, const vs_then *then);
static bool range(vs_translation *t, uint32_t first, uint32_t stop, const vs_then *then);
static bool done(vs_translation *t, uint32_t i);

/* ---- where control continues ---- */

/* Returns true if the code for continuing at `then` is only a word or two, so that it may be written several times. */
static bool cheap(const vs_translation *t, const vs_then *then) {
  if (then->kind == VS_THEN_LOOP) {
    const vs_script_node *n = node(t, then->node);
    return n->kind == VS_SCRIPT_WHILE || n->kind == VS_SCRIPT_FOR_IN || (n->kind == VS_SCRIPT_FOR && !n->c);
  }
  return then->kind == VS_THEN_NOTHING || then->kind == VS_THEN_END || then->kind == VS_THEN_MADE;
}

/* Opens (js:letrec ((to:n (js:lambda () ...))) and sets *named to a call of to:n. If the code for `then` is short, sets
 * *named to `then` instead. Sets *opened to true if the caller must close the form. */
static bool name_it(vs_translation *t, const vs_then *then, vs_then *named, bool *opened) {
  *named = *then;
  *opened = !cheap(t, then);
  if (!*opened) return true;
  uint32_t number = t->numbers++;
  TRY(vs_translate_call(t, "js:letrec") && vs_translate_open(t) && vs_translate_open(t) &&
      vs_translate_made(t, "to:", number));
  TRY(vs_translate_call(t, "js:lambda") && vs_translate_open(t) && vs_translate_close(t) && go(t, then) &&
      vs_translate_close(t));
  TRY(vs_translate_close(t) && vs_translate_close(t));
  *named = (vs_then){ .kind = VS_THEN_MADE, .word = "to:", .number = number };
  return true;
}

static bool made_call(vs_translation *t, const char *word, uint32_t number) {
  return vs_translate_open(t) && vs_translate_made(t, word, number) && vs_translate_close(t);
}

/* Writes the code that begins the next iteration of a loop. */
static bool turn(vs_translation *t, const vs_then *then) {
  const vs_script_node *n = node(t, then->node);
  if (n->kind == VS_SCRIPT_DO)
    return vs_translate_call(t, "js:if") && vs_translate_test(t, n->a) && made_call(t, "loop:", then->number) &&
           go(t, then->on) && vs_translate_close(t);
  if (n->kind == VS_SCRIPT_FOR_IN)
    return vs_translate_open(t) && vs_translate_made(t, "loop:", then->number) && vs_translate_call(t, "js:cdr") &&
           vs_translate_made(t, "keys:", then->number) && vs_translate_close(t) && vs_translate_close(t);
  if (n->kind == VS_SCRIPT_FOR && n->c)
    return vs_translate_call(t, "js:begin") && vs_translate_effect(t, n->c) && made_call(t, "loop:", then->number) &&
           vs_translate_close(t);
  return made_call(t, "loop:", then->number);
}

static bool jump(vs_translation *t, uint32_t i);

/* Writes the code after a try. Control continues after the try statement, or at the target of the jump whose number the
 * try returned. */
static bool outcome(vs_translation *t, const vs_then *then) {
  vs_jump_target *f = then->target;
  const vs_script_node *n = node(t, f->node);
  if (n->d)
    TRY(vs_translate_call(t, "js:if") && vs_translate_call(t, "js:thrown?") &&
        vs_translate_made(t, "came:", f->number) && vs_translate_close(t) && vs_translate_call(t, "js:throw-again") &&
        vs_translate_made(t, "came:", f->number) && vs_translate_close(t));
  for (size_t e = 0; e < f->exit_count; e++) {
    TRY(vs_translate_call(t, "js:if") && vs_translate_call(t, "js:eq?") && vs_translate_made(t, "came:", f->number) &&
        vs_translate_item(t, (vs_item){ .kind = VS_ITEM_COUNT, .a = (uint32_t)e + 1 }) && vs_translate_close(t));
    if (f->exits[e])
      TRY(jump(t, f->exits[e]));
    else { /* the jump was a return out of the try; its value was stored */
      vs_jump_target *outer = f->up;
      while (outer && !outer->guard) outer = outer->up;
      if (!outer)
        TRY(vs_translate_made(t, "value:", f->number));
      else {
        size_t at = 0;
        while (at < outer->exit_count && outer->exits[at]) at++;
        if (at == outer->exit_count) {
          TRY(vs_script_room(t->s, &outer->exits, &outer->exit_room, outer->exit_count + 1, sizeof *outer->exits));
          outer->exits[outer->exit_count++] = 0;
        }
        TRY(vs_translate_call(t, "js:begin") && vs_translate_call(t, "js:set!") &&
            vs_translate_made(t, "value:", outer->number) && vs_translate_made(t, "value:", f->number) &&
            vs_translate_close(t) && vs_translate_item(t, (vs_item){ .kind = VS_ITEM_COUNT, .a = (uint32_t)at + 1 }) &&
            vs_translate_close(t));
      }
    }
  }
  TRY(go(t, then->on));
  for (size_t e = 0; e < f->exit_count + (n->d ? 1 : 0); e++) TRY(vs_translate_close(t));
  return true;
}

static bool go(vs_translation *t, const vs_then *then) {
  switch (then->kind) {
  case VS_THEN_NOTHING: return vs_translate_item(t, (vs_item){ .kind = VS_ITEM_COUNT, .a = 0 });
  case VS_THEN_END: return vs_translate_word(t, "js:undefined");
  case VS_THEN_MADE: return made_call(t, then->word, then->number);
  case VS_THEN_STATEMENTS: return range(t, then->node, then->stop, then->on);
  case VS_THEN_LOOP: return turn(t, then);
  case VS_THEN_OUTCOME: return outcome(t, then);
  }
  return false;
}

/* Writes a break or continue. Control continues at the jump's target. If a try is between the jump and its target, the
 * part of the try returns the jump's number instead. */
static bool jump(vs_translation *t, uint32_t i) {
  uint32_t to = t->k->targets[i];
  for (vs_jump_target *f = t->targets; f; f = f->up) {
    if (f->guard) {
      size_t at = 0;
      bool again = node(t, i)->kind == VS_SCRIPT_CONTINUE;
      while (at < f->exit_count && !(f->exits[at] && t->k->targets[f->exits[at]] == to &&
                                     (node(t, f->exits[at])->kind == VS_SCRIPT_CONTINUE) == again))
        at++;
      if (at == f->exit_count) {
        TRY(vs_script_room(t->s, &f->exits, &f->exit_room, f->exit_count + 1, sizeof *f->exits));
        f->exits[f->exit_count++] = i;
      }
      return vs_translate_item(t, (vs_item){ .kind = VS_ITEM_COUNT, .a = (uint32_t)at + 1 });
    }
    if (f->node == to) return go(t, node(t, i)->kind == VS_SCRIPT_CONTINUE ? &f->continued : &f->broken);
  }
  return false;
}

/* Writes the value of a return. If the expression may fail, its value is first bound to a variable. The expression is
 * then no tail call, and an error shows the function's place. */
static bool kept_value(vs_translation *t, uint32_t i) {
  vs_script_kind kind = (vs_script_kind)node(t, i)->kind;
  if (kind == VS_SCRIPT_NAME || kind == VS_SCRIPT_NUMBER || kind == VS_SCRIPT_STRING || kind == VS_SCRIPT_FUNCTION)
    return vs_translate_value(t, i);
  return vs_translate_call(t, "js:let") && vs_translate_open(t) && vs_translate_call(t, "v:") &&
         vs_translate_value(t, i) && vs_translate_close(t) && vs_translate_close(t) && vs_translate_word(t, "v:") &&
         vs_translate_close(t);
}

static bool give_back(vs_translation *t, const vs_script_node *n) {
  vs_jump_target *f = t->targets;
  while (f && !f->guard) f = f->up;
  if (!f) return n->a ? kept_value(t, n->a) : vs_translate_word(t, "js:undefined");
  size_t at = 0;
  while (at < f->exit_count && f->exits[at]) at++;
  if (at == f->exit_count) {
    TRY(vs_script_room(t->s, &f->exits, &f->exit_room, f->exit_count + 1, sizeof *f->exits));
    f->exits[f->exit_count++] = 0;
  }
  TRY(vs_translate_call(t, "js:begin") && vs_translate_call(t, "js:set!") && vs_translate_made(t, "value:", f->number));
  TRY(n->a ? vs_translate_value(t, n->a) : vs_translate_word(t, "js:undefined"));
  return vs_translate_close(t) && vs_translate_item(t, (vs_item){ .kind = VS_ITEM_COUNT, .a = (uint32_t)at + 1 }) &&
         vs_translate_close(t);
}

/* ---- loops and switch statements ---- */

/* Opens the call (loop:n ...) that begins the first iteration of loop n. in: the loop is a for-in loop. */
static bool first_turn(vs_translation *t, bool in, uint32_t number) {
  if (!in) return made_call(t, "loop:", number);
  return vs_translate_open(t) && vs_translate_made(t, "loop:", number) && vs_translate_call(t, "js:keys") &&
         vs_translate_made(t, "of:", number) && vs_translate_close(t) && vs_translate_close(t);
}

/* For a for-in loop: binds the variable keys: to the remaining keys, tests whether there is one, and assigns the first
 * key to the loop's variable. */
static bool take_key(vs_translation *t, const vs_script_node *n, uint32_t number) {
  const vs_script_node *a = node(t, n->a);
  uint32_t target = a->kind == VS_SCRIPT_VAR ? node(t, a->a)->a : n->a;
  TRY(vs_translate_call(t, "js:let") && vs_translate_open(t) && vs_translate_open(t) &&
      vs_translate_made(t, "keys:", number));
  TRY(vs_translate_call(t, "js:keys-left") && vs_translate_made(t, "of:", number) &&
      vs_translate_made(t, "all:", number));
  TRY(vs_translate_close(t) && vs_translate_close(t) && vs_translate_close(t));
  TRY(vs_translate_call(t, "js:if") && vs_translate_call(t, "js:pair?") && vs_translate_made(t, "keys:", number));
  return vs_translate_close(t) && vs_translate_call(t, "js:begin") &&
         vs_translate_assign_made(t, target, "js:key-text", "keys:", number);
}

/* Writes a while, do, for or for-in loop. */
static bool turns(vs_translation *t, uint32_t i, uint32_t number, const vs_then *then) {
  const vs_script_node *n = node(t, i);
  bool opened = false, turned = false, in = n->kind == VS_SCRIPT_FOR_IN;
  uint32_t test = n->kind == VS_SCRIPT_WHILE ? n->a : n->kind == VS_SCRIPT_FOR ? n->b : 0;
  vs_then on = *then;
  vs_jump_target target = { .up = t->targets, .node = i, .number = number };
  vs_then again = { .kind = VS_THEN_LOOP, .node = i, .number = number, .on = &on };
  if (fact(t, i, VS_BROKEN) || n->kind == VS_SCRIPT_DO) TRY(name_it(t, then, &on, &opened));
  target.broken = on;
  target.continued = again;
  TRY(vs_translate_call(t, "js:letrec") && vs_translate_open(t) && vs_translate_open(t));
  TRY(vs_translate_made(t, "loop:", number) && vs_translate_call(t, "js:lambda") && vs_translate_open(t));
  TRY((!in || vs_translate_made(t, "all:", number)) && vs_translate_close(t));
  if (in) TRY(take_key(t, n, number));
  if (test) TRY(vs_translate_call(t, "js:if") && vs_translate_test(t, test));
  if (fact(t, i, VS_CONTINUED)) TRY(name_it(t, &again, &target.continued, &turned));
  t->targets = &target;
  vs_then next = target.continued;
  if (fact(t, n->d, VS_JUMPS_OUT))
    TRY(leaving(t, n->d, &next));
  else
    TRY(vs_translate_call(t, "js:begin") && done(t, n->d) && go(t, &next) && vs_translate_close(t));
  t->targets = target.up;
  if (turned) TRY(vs_translate_close(t));
  if (in) TRY(vs_translate_close(t));
  if (in || test) TRY(go(t, &on) && vs_translate_close(t));
  if (in) TRY(vs_translate_close(t));
  TRY(vs_translate_close(t) && vs_translate_close(t) && vs_translate_close(t));
  return first_turn(t, in, number) && vs_translate_close(t) && (!opened || vs_translate_close(t));
}

static bool loop(vs_translation *t, uint32_t i, const vs_then *then) {
  const vs_script_node *n = node(t, i);
  uint32_t number = t->numbers++;
  if (n->kind == VS_SCRIPT_FOR_IN) { /* the object of a for-in is evaluated only once */
    TRY(vs_translate_call(t, "js:begin") && (node(t, n->a)->kind != VS_SCRIPT_VAR || done(t, n->a)));
    TRY(vs_translate_call(t, "js:let") && vs_translate_open(t) && vs_translate_open(t));
    TRY(vs_translate_made(t, "of:", number) && vs_translate_value(t, n->b) && vs_translate_close(t) &&
        vs_translate_close(t));
    return turns(t, i, number, then) && vs_translate_close(t) && vs_translate_close(t);
  }
  if (n->kind != VS_SCRIPT_FOR || !n->a) return turns(t, i, number, then);
  TRY(vs_translate_call(t, "js:begin") && done(t, n->a));
  t->at = n->at;
  return turns(t, i, number, then) && vs_translate_close(t);
}

/* Translates a switch. Each case becomes a procedure that calls the next case at its end. Tests choose the first
 * procedure to call. */
static bool switch_statement(vs_translation *t, uint32_t i, const vs_then *then) {
  const vs_script_node *n = node(t, i);
  uint32_t number = t->numbers, fallback = 0;
  t->numbers += n->count + 1;
  bool opened;
  vs_then on;
  vs_jump_target target = { .up = t->targets, .node = i, .number = number };
  TRY(vs_translate_call(t, "js:let") && vs_translate_open(t) && vs_translate_open(t) &&
      vs_translate_made(t, "switch:", number) && vs_translate_value(t, n->a) && vs_translate_close(t) &&
      vs_translate_close(t));
  t->at = n->at;
  TRY(name_it(t, then, &on, &opened));
  target.broken = on;
  t->targets = &target;
  TRY(vs_translate_call(t, "js:letrec") && vs_translate_open(t));
  uint32_t k = 1;
  for (uint32_t c = n->b; c; c = node(t, c)->next, k++) {
    const vs_script_node *one = node(t, c);
    vs_then fall = one->next ? (vs_then){ .kind = VS_THEN_MADE, .word = "case:", .number = number + k + 1 } : on;
    if (!one->a) fallback = number + k;
    TRY(vs_translate_open(t) && vs_translate_made(t, "case:", number + k) && vs_translate_call(t, "js:lambda") &&
        vs_translate_open(t) && vs_translate_close(t));
    TRY(range(t, one->b, 0, &fall) && vs_translate_close(t) && vs_translate_close(t));
  }
  TRY(vs_translate_close(t));
  k = 1;
  unsigned tests = 0;
  for (uint32_t c = n->b; c; c = node(t, c)->next, k++) {
    const vs_script_node *one = node(t, c);
    if (!one->a) continue;
    bool number_test = node(t, one->a)->kind == VS_SCRIPT_NUMBER;
    t->at = one->at;
    TRY(vs_translate_call(t, "js:if"));
    if (number_test)
      TRY(vs_translate_call(t, "js:if") && vs_translate_call(t, "js:flonum?") &&
          vs_translate_made(t, "switch:", number) && vs_translate_close(t));
    TRY(vs_translate_call(t, number_test ? "js:=" : "js:same") && vs_translate_made(t, "switch:", number) &&
        vs_translate_value(t, one->a) && vs_translate_close(t));
    if (number_test) TRY(vs_translate_word(t, "js:false") && vs_translate_close(t));
    TRY(made_call(t, "case:", number + k));
    tests++;
  }
  TRY(fallback ? made_call(t, "case:", fallback) : go(t, &on));
  while (tests--) TRY(vs_translate_close(t));
  t->targets = target.up;
  return vs_translate_close(t) && (!opened || vs_translate_close(t)) && vs_translate_close(t);
}

/* ---- try statements ---- */

static bool thunk(vs_translation *t, uint32_t block) {
  return vs_translate_call(t, "js:lambda") && vs_translate_open(t) && vs_translate_close(t) &&
         range(t, node(t, block)->a, 0, &nothing) && vs_translate_close(t);
}

static bool try_statement(vs_translation *t, uint32_t i, const vs_then *then) {
  const vs_script_node *n = node(t, i);
  uint32_t outer = t->scope;
  vs_jump_target target = { .up = t->targets, .node = i, .guard = true, .number = t->numbers++ };
  TRY(vs_translate_call(t, "js:let") && vs_translate_open(t) && vs_translate_open(t) &&
      vs_translate_made(t, "value:", target.number) && vs_translate_word(t, "js:undefined") && vs_translate_close(t) &&
      vs_translate_close(t));
  TRY(vs_translate_call(t, "js:let") && vs_translate_open(t) && vs_translate_open(t) &&
      vs_translate_made(t, "came:", target.number));
  t->targets = &target;
  bool ok = true;
  if (n->d) ok = vs_translate_call(t, "js:protect");
  if (ok && n->d && n->c) ok = vs_translate_call(t, "js:lambda") && vs_translate_open(t) && vs_translate_close(t);
  if (ok && n->c) ok = vs_translate_call(t, "js:catch");
  ok = ok && thunk(t, n->a);
  if (ok && n->c) {
    t->scope = t->k->targets[i];
    ok = vs_translate_call(t, "js:lambda") && vs_translate_open(t) && vs_translate_name(t, node(t, n->b)->name) &&
         vs_translate_close(t) && range(t, node(t, n->c)->a, 0, &nothing) && vs_translate_close(t) &&
         vs_translate_close(t);
    t->scope = outer;
  }
  if (ok && n->d && n->c) ok = vs_translate_close(t);
  if (ok && n->d) ok = vs_translate_close(t);
  t->targets = target.up;
  ok = ok && vs_translate_close(t) && vs_translate_close(t);
  vs_then after = { .kind = VS_THEN_OUTCOME, .target = &target, .on = then };
  if (ok && n->d)
    ok = range(t, n->d, node(t, n->d)->next, &after);
  else if (ok)
    ok = go(t, &after);
  if (target.exits) t->s->resize(t->s->context, target.exits, target.exit_room * sizeof *target.exits, 0);
  return ok && vs_translate_close(t) && vs_translate_close(t);
}

/* ---- statements ---- */

/* Writes statement i in tail position, after which control continues at `then`. */
static bool one_to(vs_translation *t, uint32_t i, const vs_then *then) {
  if (fact(t, i, VS_JUMPS_OUT)) return leaving(t, i, then);
  if (then->kind == VS_THEN_NOTHING) return done(t, i);
  return vs_translate_call(t, "js:begin") && done(t, i) &&
         (fact(t, i, VS_STAYS) ? vs_translate_word(t, "js:undefined") : go(t, then)) && vs_translate_close(t);
}

static bool leaving_part(vs_translation *t, uint32_t i, const vs_then *then) {
  const vs_script_node *n = node(t, i);
  t->at = n->at;
  switch ((vs_script_kind)n->kind) {
  case VS_SCRIPT_BLOCK: return range(t, n->a, 0, then);
  case VS_SCRIPT_IF: {
    bool both = !fact(t, n->b, VS_STAYS) && !(n->c && fact(t, n->c, VS_STAYS)), opened = false;
    vs_then on = *then;
    if (both) TRY(name_it(t, then, &on, &opened));
    t->at = n->at;
    TRY(vs_translate_call(t, "js:if") && vs_translate_test(t, n->a) && one_to(t, n->b, &on));
    TRY(n->c ? one_to(t, n->c, &on) : go(t, &on));
    return vs_translate_close(t) && (!opened || vs_translate_close(t));
  }
  case VS_SCRIPT_RETURN: return give_back(t, n);
  case VS_SCRIPT_BREAK:
  case VS_SCRIPT_CONTINUE: return jump(t, i);
  case VS_SCRIPT_FOR_IN:
  case VS_SCRIPT_FOR:
  case VS_SCRIPT_WHILE:
  case VS_SCRIPT_DO: return loop(t, i, then);
  case VS_SCRIPT_SWITCH: return switch_statement(t, i, then);
  case VS_SCRIPT_TRY: return try_statement(t, i, then);
  case VS_SCRIPT_LABEL: {
    bool opened;
    vs_jump_target target = { .up = t->targets, .node = i };
    TRY(name_it(t, then, &target.broken, &opened));
    t->targets = &target;
    vs_then on = target.broken;
    TRY(one_to(t, n->b, &on));
    t->targets = target.up;
    return !opened || vs_translate_close(t);
  }
  default: return false;
  }
}

/* Writes statement i, which jumps leave. After its end, control continues at `then`. */
static bool leaving(vs_translation *t, uint32_t i, const vs_then *then) {
  if (++t->depth > MOST_DEPTH)
    return vs_script_fail(t->s, node(t, i)->at,
                          "too many statements with break or continue are nested here: move some into a function");
  bool ok = leaving_part(t, i, then);
  t->depth--;
  return ok;
}

static bool declarations(vs_translation *t, const vs_script_node *n) {
  TRY(vs_translate_call(t, "js:begin"));
  for (uint32_t d = n->a; d; d = node(t, d)->next) {
    const vs_script_node *one = node(t, d);
    if (!one->b) continue;
    t->at = one->at;
    TRY(vs_translate_call(t, "js:set!") && vs_translate_name(t, node(t, one->a)->name) &&
        vs_translate_value(t, one->b) && vs_translate_close(t));
  }
  return vs_translate_item(t, (vs_item){ .kind = VS_ITEM_COUNT, .a = 0 }) && vs_translate_close(t);
}

/* Writes statement i, which no jump leaves, as an expression whose value is not used. */
static bool done(vs_translation *t, uint32_t i) {
  const vs_script_node *n = node(t, i);
  t->at = n->at;
  switch ((vs_script_kind)n->kind) {
  case VS_SCRIPT_VAR: return declarations(t, n);
  case VS_SCRIPT_EXPRESSION: return vs_translate_effect(t, n->a);
  case VS_SCRIPT_EMPTY:
  case VS_SCRIPT_FUNCTION: return vs_translate_item(t, (vs_item){ .kind = VS_ITEM_COUNT, .a = 0 });
  case VS_SCRIPT_THROW: return vs_translate_call(t, "js:throw") && vs_translate_value(t, n->a) && vs_translate_close(t);
  case VS_SCRIPT_NATIVE:
    return vs_translate_call(t, "js:begin") && vs_translate_item(t, (vs_item){ .kind = VS_ITEM_COUNT, .a = 0 }) &&
           vs_translate_item(t, (vs_item){ .kind = VS_ITEM_NATIVE, .a = n->text, .b = n->length, .scope = t->scope }) &&
           vs_translate_close(t);
  default: return leaving(t, i, &nothing);
  }
}

/* Writes native text (Scheme) at the end of a function. Its value is the function's value. */
static bool native_value(vs_translation *t, uint32_t i) {
  const vs_script_node *n = node(t, i);
  t->at = n->at;
  return vs_translate_call(t, "js:from-native") && vs_translate_call(t, "js:begin") &&
         vs_translate_word(t, "js:undefined") &&
         vs_translate_item(t, (vs_item){ .kind = VS_ITEM_NATIVE, .a = n->text, .b = n->length, .scope = t->scope }) &&
         vs_translate_close(t) && vs_translate_close(t);
}

/* Writes the statements from `first` up to `stop`, excluding `stop`. Jumps leave fewer than IN_ONE_ROW of them. */
static bool row(vs_translation *t, uint32_t first, uint32_t stop, const vs_then *then) {
  if (first == stop) return go(t, then);
  TRY(vs_translate_call(t, "js:begin"));
  for (uint32_t i = first; i != stop; i = node(t, i)->next) {
    uint32_t next = node(t, i)->next;
    if (fact(t, i, VS_JUMPS_OUT)) {
      vs_then on =
          next == stop ? *then : (vs_then){ .kind = VS_THEN_STATEMENTS, .node = next, .stop = stop, .on = then };
      return leaving(t, i, &on) && vs_translate_close(t);
    }
    if (next == stop && then->kind == VS_THEN_END && node(t, i)->kind == VS_SCRIPT_NATIVE)
      return native_value(t, i) && vs_translate_close(t);
    TRY(done(t, i));
    if (fact(t, i, VS_STAYS))
      return vs_translate_word(t, "js:undefined") && vs_translate_close(t); /* no statement after this place is ever
                                                                             * reached */
  }
  return go(t, then) && vs_translate_close(t);
}

/* Writes the statements from `first` up to `stop` like `row`. Divides a long list into several procedures, to limit the
 * nesting of their code. */
static bool range(vs_translation *t, uint32_t first, uint32_t stop, const vs_then *then) {
  uint32_t leaving_count = 0, rows = 0, cut = 0;
  for (uint32_t i = first; i != stop && !cut; i = node(t, i)->next)
    if (fact(t, i, VS_JUMPS_OUT) && ++leaving_count == IN_ONE_ROW) cut = node(t, i)->next;
  if (!cut || cut == stop) return row(t, first, stop, then);
  bool opened;
  vs_then on;
  TRY(name_it(t, then, &on, &opened) && vs_translate_call(t, "js:letrec") && vs_translate_open(t));
  uint32_t number = t->numbers, begin = cut, count = 0;
  for (uint32_t i = cut; i != stop; i = node(t, i)->next)
    if (fact(t, i, VS_JUMPS_OUT) && ++count % IN_ONE_ROW == 0) rows++;
  t->numbers += rows + 1;
  count = rows = 0;
  for (uint32_t i = cut; i != stop; i = node(t, i)->next) {
    uint32_t next = node(t, i)->next;
    bool full = fact(t, i, VS_JUMPS_OUT) && ++count % IN_ONE_ROW == 0;
    if (!full && next != stop) continue;
    vs_then follows =
        next == stop ? on : (vs_then){ .kind = VS_THEN_MADE, .word = "row:", .number = number + rows + 1 };
    TRY(vs_translate_open(t) && vs_translate_made(t, "row:", number + rows) && vs_translate_call(t, "js:lambda") &&
        vs_translate_open(t) && vs_translate_close(t));
    TRY(row(t, begin, next, &follows) && vs_translate_close(t) && vs_translate_close(t));
    begin = next;
    rows++;
  }
  vs_then follows = { .kind = VS_THEN_MADE, .word = "row:", .number = number };
  return vs_translate_close(t) && row(t, first, cut, &follows) && vs_translate_close(t) &&
         (!opened || vs_translate_close(t));
}

/* ---- functions ---- */

bool vs_translate_has_direct(const vs_translation *t, uint32_t i) {
  const vs_scope_of_script *o = &t->k->scopes[t->k->targets[i]];
  if (o->uses_this || o->uses_arguments) return false;
  for (uint32_t p = node(t, i)->a; p; p = node(t, p)->next) /* whether two parameters of the function have the same
                                                             * name */
    for (uint32_t q = node(t, p)->next; q; q = node(t, q)->next)
      if (node(t, p)->name == node(t, q)->name) return false;
  return true;
}

/* Returns true if v is a declared function whose name is never assigned, so that it can be defined by (js:letrec ((f:
 * ...) (f ...)). */
static bool settled(const vs_translation *t, const vs_variable *v) {
  return v->kind == VS_VARIABLE_FUNCTION && !v->assigned && v->declaration &&
         node(t, v->declaration)->kind == VS_SCRIPT_FUNCTION;
}

static bool body(vs_translation *t, uint32_t i) {
  const vs_script_node *n = node(t, i);
  uint32_t scope = t->scope;
  bool locals = false, functions = false;
  for (uint32_t v = t->k->scopes[scope].first; v; v = t->k->variables[v].next) {
    const vs_variable *one = &t->k->variables[v];
    if (settled(t, one))
      functions = true;
    else if (one->kind != VS_VARIABLE_PARAMETER || one->assigned)
      locals = true;
  }
  if (locals) {
    TRY(vs_translate_call(t, "js:let-registers") && vs_translate_open(t));
    for (uint32_t v = t->k->scopes[scope].first; v; v = t->k->variables[v].next) {
      const vs_variable *one = &t->k->variables[v];
      if (settled(t, one) || (one->kind == VS_VARIABLE_PARAMETER && !one->assigned)) continue;
      TRY(vs_translate_open(t) && vs_translate_name(t, one->name));
      TRY(one->kind == VS_VARIABLE_PARAMETER ? vs_translate_name(t, one->name) : vs_translate_word(t, "js:undefined"));
      TRY(vs_translate_close(t));
    }
    TRY(vs_translate_close(t));
  }
  if (functions) {
    TRY(vs_translate_call(t, "js:letrec") && vs_translate_open(t));
    for (uint32_t v = t->k->scopes[scope].first; v; v = t->k->variables[v].next) {
      const vs_variable *one = &t->k->variables[v];
      if (!settled(t, one)) continue;
      bool direct = vs_translate_has_direct(t, one->declaration);
      if (direct)
        TRY(vs_translate_open(t) && vs_translate_direct(t, one->name) &&
            vs_translate_function(t, one->declaration, true) && vs_translate_close(t));
      TRY(vs_translate_open(t) && vs_translate_name(t, one->name) &&
          vs_translate_function(t, one->declaration, false) && vs_translate_close(t));
    }
    TRY(vs_translate_close(t));
  }
  t->at = n->at;
  TRY(vs_translate_call(t, "js:begin"));
  for (uint32_t v = t->k->scopes[scope].first; v; v = t->k->variables[v].next) {
    const vs_variable *one = &t->k->variables[v];
    if (!one->declaration || settled(t, one) || one->kind == VS_VARIABLE_SELF) continue;
    TRY(vs_translate_call(t, "js:set!") && vs_translate_name(t, one->name) &&
        vs_translate_function(t, one->declaration, false) && vs_translate_close(t));
  }
  vs_then end = { .kind = VS_THEN_END };
  TRY(range(t, n->b, 0, &end) && vs_translate_close(t));
  return (!functions || vs_translate_close(t)) && (!locals || vs_translate_close(t));
}

/* Writes the keyword parameter for `this` if `asks` is true. In a call that does not pass it, `this` is undefined. */
static bool self_parameter(vs_translation *t, bool asks) {
  if (!asks) return true;
  return vs_translate_word(t, "#:this") && vs_translate_open(t) && vs_translate_word(t, "this:") &&
         vs_translate_word(t, "js:any?") && vs_translate_word(t, "js:undefined") && vs_translate_close(t);
}

/* Writes the parameters of a function that any code may call. All are optional; after them come `this`, if `asks` is
 * true, and the rest parameter. */
static bool open_parameters(vs_translation *t, const vs_script_node *n, bool asks) {
  for (uint32_t p = n->a; p; p = node(t, p)->next) {
    bool again = false;
    for (uint32_t q = node(t, p)->next; q; q = node(t, q)->next) again |= node(t, p)->name == node(t, q)->name;
    TRY(vs_translate_open(t));
    TRY(again ? vs_translate_made(t, "unused:", t->numbers++) : vs_translate_name(t, node(t, p)->name));
    TRY(vs_translate_word(t, "js:any?") && vs_translate_word(t, "js:undefined") && vs_translate_close(t));
  }
  return self_parameter(t, asks) && vs_translate_word(t, ".") && vs_translate_word(t, "more:");
}

bool vs_translate_function(vs_translation *t, uint32_t i, bool direct) {
  const vs_script_node *n = node(t, i);
  vs_script_place at = t->at;
  uint32_t outer = t->scope, scope = t->k->targets[i];
  bool own = n->c && !n->flag, all = t->k->scopes[scope].uses_arguments;
  if (t->functions > 300)
    return vs_script_fail(t->s, n->at, "functions are nested more than 300 levels deep");
  vs_jump_target *targets = t->targets;
  unsigned depth = t->depth;
  t->at = n->at;
  if (own)
    TRY(vs_translate_call(t, "js:letrec") && vs_translate_open(t) && vs_translate_open(t) &&
        vs_translate_name(t, node(t, n->c)->name));
  bool wrapper = n->flag && !direct && vs_translate_has_direct(t, i) &&
                 t->k->variables[vs_scopes_resolve(t->k, outer, node(t, n->c)->name)].declaration == i &&
                 settled(t, &t->k->variables[vs_scopes_resolve(t->k, outer, node(t, n->c)->name)]);
  TRY(vs_translate_call(t, "js:lambda"));
  if (all)
    TRY(vs_translate_open(t) && self_parameter(t, t->k->scopes[scope].uses_this) && vs_translate_word(t, ".") &&
        vs_translate_word(t, "more:") && vs_translate_close(t));
  else {
    TRY(vs_translate_open(t));
    if (direct)
      for (uint32_t p = n->a; p; p = node(t, p)->next) TRY(vs_translate_name(t, node(t, p)->name));
    else
      TRY(open_parameters(t, n, t->k->scopes[scope].uses_this));
    TRY(vs_translate_close(t));
  }
  if (wrapper) {
    TRY(vs_translate_open(t) && vs_translate_direct(t, node(t, n->c)->name));
    for (uint32_t p = n->a; p; p = node(t, p)->next) TRY(vs_translate_name(t, node(t, p)->name));
    TRY(vs_translate_close(t));
  } else {
    t->scope = scope;
    t->functions++;
    t->targets = NULL;
    t->depth = 0;
    if (all) {
      TRY(vs_translate_call(t, "js:let") && vs_translate_open(t) && vs_translate_open(t) &&
          vs_translate_word(t, "arguments:") && vs_translate_call(t, "js:arguments") && vs_translate_word(t, "more:") &&
          vs_translate_close(t) && vs_translate_close(t));
      uint32_t at_number = 0;
      for (uint32_t p = n->a; p; p = node(t, p)->next, at_number++) {
        bool again = false;
        for (uint32_t q = node(t, p)->next; q; q = node(t, q)->next) again |= node(t, p)->name == node(t, q)->name;
        if (again) continue;
        TRY(vs_translate_open(t) && vs_translate_name(t, node(t, p)->name) && vs_translate_call(t, "js:nth") &&
            vs_translate_word(t, "more:") && vs_translate_item(t, (vs_item){ .kind = VS_ITEM_COUNT, .a = at_number }) &&
            vs_translate_close(t) && vs_translate_close(t));
      }
      TRY(vs_translate_close(t));
    }
    TRY(body(t, i));
    if (all) TRY(vs_translate_close(t));
    t->scope = outer;
    t->functions--;
    t->targets = targets;
    t->depth = depth;
  }
  TRY(vs_translate_close(t));
  if (own)
    TRY(vs_translate_close(t) && vs_translate_close(t) && vs_translate_name(t, node(t, n->c)->name) &&
        vs_translate_close(t));
  t->at = at;
  return true;
}

/* ---- the program ---- */

static bool define(vs_translation *t, uint32_t name, const char *value) {
  return vs_translate_call(t, "js:define") && vs_translate_name(t, name) && vs_translate_word(t, value) &&
         vs_translate_close(t);
}

/* Returns the form for a declaration such as var depth = gui_number(3, 1, 9), which defines a parameter of the model.
 * Returns NULL for other variables. */
static const char *parameter_word(const vs_translation *t, uint32_t declarator) {
  const vs_script_node *n = node(t, declarator);
  if (!n->b || node(t, n->b)->kind != VS_SCRIPT_CALL) return NULL;
  const vs_script_node *f = node(t, node(t, n->b)->a);
  if (f->kind != VS_SCRIPT_NAME || vs_scopes_resolve(t->k, 1, f->name)) return NULL;
  return vs_translate_parameter_word(t, f->name);
}

static bool parameter(vs_translation *t, uint32_t declarator, const char *word) {
  const vs_script_node *n = node(t, declarator), *call = node(t, n->b);
  t->at = n->at;
  TRY(vs_translate_call(t, word) && vs_translate_name(t, node(t, n->a)->name));
  for (uint32_t a = call->b; a; a = node(t, a)->next) TRY(vs_translate_value(t, a));
  return vs_translate_close(t);
}

static bool top_statement(vs_translation *t, uint32_t i) {
  const vs_script_node *n = node(t, i);
  if (n->kind != VS_SCRIPT_VAR) return n->kind == VS_SCRIPT_FUNCTION || n->kind == VS_SCRIPT_EMPTY || done(t, i);
  for (uint32_t d = n->a; d; d = node(t, d)->next) {
    const vs_script_node *one = node(t, d);
    const char *word = parameter_word(t, d);
    t->at = one->at;
    if (word)
      TRY(parameter(t, d, word));
    else if (one->b)
      TRY(vs_translate_call(t, "js:set!") && vs_translate_name(t, node(t, one->a)->name) &&
          vs_translate_value(t, one->b) && vs_translate_close(t));
  }
  return true;
}

bool vs_translate_script(vs_translation *t) {
  vs_scopes *k = t->k;
  t->scope = 1;
  t->at = node(t, t->s->root)->at;
  TRY(vs_translate_call(t, "import") && vs_translate_call(t, "javascript") && vs_translate_word(t, "runtime") &&
      vs_translate_close(t) && vs_translate_close(t));
  for (uint32_t v = k->scopes[1].first; v; v = k->variables[v].next) {
    const vs_variable *one = &k->variables[v];
    if (!one->declaration && !one->elsewhere)
      TRY(define(t, one->name, one->kind == VS_VARIABLE_UNDECLARED ? "js:unset" : "js:undefined"));
  }
  for (uint32_t v = k->scopes[1].first; v; v = k->variables[v].next) {
    const vs_variable *one = &k->variables[v];
    if (!one->declaration) continue;
    t->at = node(t, one->declaration)->at;
    if (settled(t, one) && vs_translate_has_direct(t, one->declaration))
      TRY(vs_translate_call(t, "js:define") && vs_translate_direct(t, one->name) &&
          vs_translate_function(t, one->declaration, true) && vs_translate_close(t));
    TRY(vs_translate_call(t, "js:define") && vs_translate_name(t, one->name) &&
        vs_translate_function(t, one->declaration, false) && vs_translate_close(t));
  }
  for (uint32_t i = node(t, t->s->root)->a; i; i = node(t, i)->next) TRY(top_statement(t, i));
  return true;
}
