/* Writes tapes as formulas (formula_text.h). Pieces of text that are still to be written are on an explicit stack, the
 * last piece at the bottom. */
#include "geometry/functions/formula_text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "model/store/array.h"

static const struct {
  int binds;
  const char *text[VS_FORMULA_LANGUAGES];
} forms[VS_TAPE_OPERATORS] = {
  [VS_TAPE_CONSTANT] = { 3, { "", "", "" } },
  [VS_TAPE_INPUT] = { 3, { "", "", "" } },
#define VS_OPERATOR(id, name, operands, binds, pov, scad, js) [VS_TAPE_##id] = { binds, { pov, scad, js } },
#include "geometry/functions/operators.def"
};

typedef struct {
  const char *text;
  uint32_t step;
} piece; /* A piece of the text that is still to be written: `step` characters of a text, or if the text is NULL, the
          * formula of the tape's step number `step`. */

typedef struct {
  const vs_tape *t;
  vs_formula_language language;
  const char *const *names;
  piece *todo;
  size_t todo_count, todo_room;
  char *out;
  size_t count, room;
  bool too_long;
} writer;

static bool put(writer *w, const char *s, size_t n) {
  if (w->count + n > VS_FORMULA_MOST) return w->too_long = true, false;
  if (!VS_GROW(w->out, w->room, w->count + n + 1)) return false;
  memcpy(w->out + w->count, s, n);
  w->count += n;
  w->out[w->count] = 0;
  return true;
}

static bool push(writer *w, const char *text, uint32_t step) {
  if (!VS_GROW(w->todo, w->todo_room, w->todo_count + 1)) return false;
  w->todo[w->todo_count++] = (piece){ text, step };
  return true;
}

static bool put_number(writer *w, double d) {
  char text[40];
  if (w->language == VS_FORMULA_POVRAY && isinf(d)) d = d > 0 ? 1e300 : -1e300;
  for (int digits = 1; digits <= 17; digits++) {
    snprintf(text, sizeof text, "%.*g", digits, d);
    if (strtod(text, NULL) == d) break;
  }
  bool negative = text[0] == '-';
  return (!negative || put(w, "(", 1)) && put(w, text, strlen(text)) && (!negative || put(w, ")", 1));
}

/* Divides the template of a step's operator into pieces of text and operands. Pushes these onto the stack, the last
 * first. Returns false when memory is out. */
static bool push_form(writer *w, const vs_tape_step *s) {
  const char *form = forms[s->op].text[w->language];
  int mine = forms[s->op].binds;
  bool infix = mine < 3;
  size_t n = strlen(form);
  bool ok = true;
  for (size_t end = n; ok && end > 0;) {
    size_t at = end;
    while (at > 0 && form[at - 1] != '$') at--;
    /* plain: the text after an operand's name. form[at] is the name of the operand, and form[at + 1] to form[end - 1]
     * is that text. If at == 0, no operand remains. */
    const char *plain = form + (at ? at + 1 : 0);
    size_t length = (size_t)(form + end - plain);
    if (length) ok = push(w, plain, (uint32_t)length);
    if (!at) break;
    uint32_t operand = s->of[form[at] - 'a'];
    int its = forms[w->t->step[operand].op].binds;
    bool wrap = infix && (its < mine || (its == mine && form[at] != 'a') || (s->op == VS_TAPE_NEG && its < 3));
    if (wrap) ok = ok && push(w, ")", 1);
    ok = ok && push(w, NULL, operand);
    if (wrap) ok = ok && push(w, "(", 1);
    end = at - 1;
  }
  return ok;
}

char *vs_formula_text(const vs_tape *t, uint32_t output, vs_formula_language language, const char *const *names,
                      bool *no_word) {
  writer w = { .t = t, .language = language, .names = names };
  bool ok = push(&w, NULL, t->output[output]);
  VS_ASSERT(output < t->outputs);
  *no_word = false;
  while (ok && w.todo_count) {
    piece p = w.todo[--w.todo_count];
    if (p.text) {
      ok = put(&w, p.text, p.step);
      continue;
    }
    const vs_tape_step *s = &t->step[p.step];
    if (s->op == VS_TAPE_CONSTANT)
      ok = put_number(&w, s->value);
    else if (s->op == VS_TAPE_INPUT)
      ok = put(&w, names[s->of[0]], strlen(names[s->of[0]]));
    else if (s->op == VS_TAPE_FIELD)
      ok = false, *no_word = true;
    else
      ok = push_form(&w, s);
  }
  free(w.todo);
  *no_word = *no_word || w.too_long;
  if (!ok) return free(w.out), NULL;
  return w.out;
}
