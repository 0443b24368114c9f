/* Tests that every procedure of the geometry checks its arguments: `badcalls TABLE`. For each parameter of each form of
 * a procedure, and for each way to break the parameter's contract, it makes a call with a single bad argument. It
 * evaluates all calls in one interpreter. Each must fail at the call's line and column, with a message that begins with
 * the procedure's name and names the parameter and the value. Before, the same call with a good argument must succeed;
 * otherwise the bad call would prove nothing. Then it checks the lines of TABLE (tests/bad/calls.txt).
 *
 * The good and bad arguments of each contract are listed below; `special` lists those of single procedures. The output
 * has the words that tests/run.sh reads. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "bind/call/call.h"
#include "bind/procedures.h"
#include "visualscheme.h"

enum { BAD_MOST = 24, TEXT_MOST = 8000 };

/* ---- good and bad arguments ---- */

typedef struct {
  const char *good[4];      /* good[i]: a good argument for the i-th parameter of a call that has this contract; the
                             * last element serves for all later parameters */
  const char *bad[BAD_MOST];
} samples;

/* Arguments that are bad for nearly all contracts. */
#define NO_NUMBER "\"wide\"", "'wide", "'()", "(list 1 2)", "car", "(if #f #f)", "(xyz 1 2 3)"
#define NOT_FINITE "+nan.0", "+inf.0", "-inf.0"
#define NO_OBJECT "5", "\"box\"", "'box", "(xyz 1 2 3)", "(if #f #f)", "car"

static const samples contracts[] = {
  [VS_C_ANY] = { { "1" }, { NULL } },
  [VS_C_REAL] = { { "1.5" }, { NO_NUMBER, "#f", NOT_FINITE } },
  [VS_C_RADIUS] = { { "2", "1" }, { NO_NUMBER, "#f", NOT_FINITE, "-1", "-1/1000" } },
  [VS_C_POSITIVE] = { { "2" }, { NO_NUMBER, "#f", NOT_FINITE, "-1", "0", "0." } },
  [VS_C_ANGLE] = { { "1/2", "1" }, { NO_NUMBER, "#f", NOT_FINITE } },
  [VS_C_DEGREES] = { { "30" }, { NO_NUMBER, "#f", NOT_FINITE } },
  [VS_C_UNIT] = { { "1/2" }, { NO_NUMBER, "#f", NOT_FINITE, "-1/10", "11/10" } },
  [VS_C_SOME] = { { "3" }, { NO_NUMBER, "#f", NOT_FINITE, "0", "-1", "3/2", "2.5" } },
  [VS_C_NATURAL] = { { "3" }, { NO_NUMBER, "#f", NOT_FINITE, "-1", "3/2", "2.5" } },
  [VS_C_SIDES] = { { "5" }, { NO_NUMBER, "#f", NOT_FINITE, "-3", "0", "2", "7/2", "100001", "(expt 10 30)" } },
  [VS_C_SEGMENTS] = { { "8" }, { NO_NUMBER, NOT_FINITE, "-3", "0", "2", "7/2", "100001", "(expt 10 30)" } },
  [VS_C_BOOLEAN] = { { "#t" }, { "\"yes\"", "'yes", "0", "'()" } },
  [VS_C_TEXT] = { { "\"a\"" }, { "5", "'()", "(list \"a\")", "(xyz 1 2 3)", "#f", "car" } },
  [VS_C_NAME] = { { "'a" }, { "5", "\"a\"", "'()", "#f", "car" } },
  [VS_C_POINT] = { { "(xyz 0 0 0)", "(xyz 3 2 4)", "(xyz 5 0 1)", "(xyz 1 7 2)" }, { "5", "\"here\"", "'here", "(list 1 2 3)", "(vxyz 1 2 3)", "'()", "#f", "(if #f #f)", "far-point" } },
  [VS_C_VECTOR] = { { "(vxyz 1 2 3)", "(vxyz 3 1 0)" }, { "5", "\"up\"", "'z", "(list 1 2 3)", "(xyz 1 2 3)", "'()", "#f", "(if #f #f)", "far-vector" } },
  [VS_C_DIRECTION] = { { "(vxyz 0 0 1)", "(vxyz 1 0 1)", "'y" }, { "5", "\"up\"", "'w", "(list 1 2 3)", "(xyz 1 2 3)", "#f", "(vxyz 0 0 0)", "far-vector" } },
  [VS_C_PLACE] = { { "(xyz 1 2 3)" }, { "5", "\"here\"", "'here", "(list 1 2 3)", "#f" } },
  [VS_C_AXIS] = { { "'z" }, { "5", "\"z\"", "'w", "(list 0 0 1)", "(xyz 0 0 1)", "#f", "(vxyz 0 0 0)", "far-vector" } },
  [VS_C_PLANE] = { { "'yz" }, { "5", "\"xy\"", "'x", "(list 0 0 1)", "(xyz 0 0 1)", "#f", "(vxyz 0 0 0)", "far-vector" } },
  [VS_C_MATRIX] = { { "(translation-matrix (vxyz 1 2 3))" }, { "5", "\"m\"", "'()", "(list 1 0 0 0)", "(vxyz 1 2 3)", "#f" } },
  [VS_C_FACTOR] = { { "2" }, { "\"big\"", "'big", "car", NOT_FINITE, "-1", "0", "'()", "(list 1 2)", "(list 1 2 3 4)", "(list 1 0 1)", "(list 1 -1 1)", "(list 1 +inf.0 1)", "(vxyz 1 0 1)", "far-vector" } },
  [VS_C_OBJECT] = { { "ball", "brick2" }, { NO_OBJECT, "(list ball 5)" } },
  [VS_C_OBJECTS] = { { "ball", "brick2" }, { NO_OBJECT, "(list ball 5)" } },
  [VS_C_CURVE] = { { "rail" }, { NO_OBJECT, "ball", "plate" } },
  [VS_C_CURVES] = { { "ring" }, { NO_OBJECT, "ball", "(list ring 5)" } },
  [VS_C_PROFILE] = { { "ring" }, { NO_OBJECT, "ball" } },
  [VS_C_FLAT] = { { "plate" }, { NO_OBJECT, "ball" } },
  [VS_C_SOLID] = { { "ball" }, { NO_OBJECT, "ring", "plate" } },
  [VS_C_POINTS] = { { "(list (xy 0 0) (xy 4 0) (xy 4 3) (xy 0 3))" }, { "5", "\"here\"", "(list (xy 0 0) 5 (xy 1 1))", "(list (xy 0 0) (vxyz 1 0 0) (xy 1 1))", "#f", "ball", "(list (xy 0 0) far-point (xy 1 1))" } },
  [VS_C_THINGS] = { { "ball" }, { "5", "\"box\"", "'box", "car", "(list ball 5)", "far-point" } },
  [VS_C_SCOPE] = { { "room" }, { NO_OBJECT, "#f", "ball" } },
  [VS_C_OWN_AXIS] = { { "'x" }, { "5", "\"x\"", "'w", "(vxyz 1 0 0)", "#f" } },
  [VS_C_RULE] = { { "ball" }, { "5", "'wall", "room" } },
  [VS_C_FACES] = { { "'((1 2 3) (1 3 4))" }, { "5", "'faces", "'(1 2 3)", "'((1 2))", "'((1 2 a))", "'((0 1 2))", "'((-1 1 2))", "'((1 2 1.5))", "'((1 2 3) . 4)" } },
  [VS_C_SECTIONS] = { { "(list ring (do-move ring (vxyz 0 0 3)))" }, { "5", "'rings", "(list ring 5)", "(list ring ball)", "car" } },
  [VS_C_PATH] = { { "3" }, { "\"up\"", "'z", "(xyz 1 2 3)", "ball", "plate", "car", NOT_FINITE, "far-vector" } },
  [VS_C_TANGENT] = { { "ux" }, { "\"up\"", "'z", "(xyz 1 2 3)", "ball", "+nan.0", "(vxyz 0 0 0)", "far-vector" } },
  [VS_C_MATERIAL] = { { "'steel" }, { "5", "'unobtainium", "\"unobtainium\"", "'()", "ball", "#f" } },
  [VS_C_COLOR] = { { "\"red\"" }, { "5", "\"no such colour\"", "\"#12345\"", "\"#12345g\"", "(list 1 0)", "(list 1 0 2)", "(list 1 0 -1)", "(list 1 0 +nan.0)", "(list 1 0 'a)", "#f", "'()" } },
  [VS_C_NUMERIC] = { { "1", "2" }, { "\"a\"", "'a", "'()", "#f", "ball" } },
};

/* Arguments as large as the largest permitted length, or nearly. No procedure may round their small differences to
 * 0. */
static const char *const far_away[sizeof contracts / sizeof *contracts][3] = {
  [VS_C_REAL] = { "1e308", "-1e200" },
  [VS_C_RADIUS] = { "1e308", "1e200" },
  [VS_C_POSITIVE] = { "1e308", "1e200" },
  [VS_C_POINT] = { "(xyz -1e308 1e308 1)", "(xyz 1e200 2 1e200)" },
  [VS_C_VECTOR] = { "(vxyz -1e308 1e308 1)", "(vxyz 1e200 2 1e200)" },
  [VS_C_POINTS] = { "(list (xyz -1e308 0 0) (xyz 1e308 0 0) (xyz 0 1e308 0) (xyz 0 0 1e308))", "(list (xy 0 0) (xy 1e200 0) (xyz 0 1e200 1e200))" },
  [VS_C_THINGS] = { "(list (xyz -1e308 0 0) (xyz 1e308 0 0) (xyz 0 1e308 0) (xyz 0 0 1e308))", "(list (xy 0 0) (xy 1e200 0) (xyz 0 1e200 1e200))" },
};

/* Good arguments for a parameter of a single procedure. NULL: only tests/bad/calls.txt tests the parameter. */
static const struct { const char *procedure, *parameter, *good; } special[] = {
  { "make-material", "pattern", "'bricks" }, { "make-material", "image", NULL }, { "lamp", "p", "origin #:lumens 800" }, { "lamp", "ies", NULL }, { "lamp", "lumens", NULL },
  { "lamp", "to", NULL }, { "lamp", "turn", NULL }, { "lamp", "dim", NULL }, { "lamp", "color", NULL }, { "make-matrix", "m00", "1" }, { "make-matrix", "m11", "1" }, { "make-matrix", "m22", "1" }, { "make-matrix", "m33", "1" },
  { "make-matrix", "m30", "0" }, { "make-matrix", "m31", "0" }, { "make-matrix", "m32", "0" },
  { "make-torus", "r", "3" }, { "make-rectangle", "q", "(xyz 3 2 0)" },
  { "make-plane", "r", "(xyz 0 5 1)" }, { "v+v", "v", "ux" }, { "matrix*", "b", "(scaling-matrix 2)" },
  { "view", "name", "\"a\" 'plan" }, { "view", "kind", NULL }, { "view", "cut", "1" }, { "view", "sheet", "\"A3\"" }, { "view", "from", NULL }, { "view", "to", NULL },
  { "view", "lens", NULL }, { "view", "upright", NULL }, { "dimension", "q", "(xyz 9 9 9)" }, { "grid-axis", "q", "(xyz 9 9 9)" },
  { "camera", "target", "(xyz 9 9 9)" }, { "view-from", "side", "'top" }, { "units", "unit", "'mm" },
  { "sky", "kind", "'night" }, { "look", "name", "'arctic" },
  { "sky", "color", NULL }, { "sky", "image", NULL }, { "sun", "shines", "#f" },
  { "sky", "turbidity", NULL }, { "camera", "focus", NULL }, { "view", "focus", NULL }, { "view", "aperture", NULL },
  { "native", "target", "'povray" }, { "erase", "objects", "(draw ball)" }, { "native", "text", "\"sphere { 0, 1 }\"" },
  { "make-text", "font", "\"DejaVu Sans\"" }, { "text-width", "font", "\"DejaVu Sans\"" }, { "make-text", "align", "'left" }, { "make-text", "valign", "'top" },
  { "join-curves", "curves", "rail" }, { "make-superellipsoid", "e", "1" }, { "make-superellipsoid", "n", "1" },
  { "do-revolve", "s", "(make-circle (xyz 5 0 0) 1)" }, { "do-revolve", "axis", "'y" }, { "do-offset", "corners", "'round" },
  { "outline", "o", "plate" }, { "sun-direction", "latitude", NULL }, { "sun-direction", "longitude", NULL },
  { "sun-direction", "date", NULL }, { "sun-direction", "time", NULL },
  { "do-resize", "dx", NULL }, { "do-resize", "dy", NULL }, { "do-resize", "dz", NULL }, { "make-mesh", "rows", NULL },
  { "do-guided-loft", "guides", "bar" }, { "do-guided-loft", "path", NULL },  { "curve-length", "c", "rail" },
  { "curve-intersections", "b", "(make-circle origin 2)" },
  { "make-height-field", "source", "'((1 2) (2 3))" }, { "make-height-field", "q", "(xyz 3 2 0)" }, { "make-height-field", "high", "4" }, { "make-height-field", "low", "-1" },
  { "load-mesh", "file", NULL }, { "load-points", "file", NULL }, { "load-mesh", "repair", NULL }, { "make-mesh", "closed-u", NULL }, { "make-mesh", "closed-v", NULL },
  { "make-crust", "thickness", "0.1" }, { "make-crust", "side", "'out" },
  { "scope-corner", "i", "1" }, { "scope-corner", "j", "0" }, { "scope-corner", "k", "1" },
  { "make-surface-scope", "surface", "(do-revolve (make-line (xz 1 0) (xz 1 2)) 'z)" },
  { "turtle-forward", "s", "(make-turtle-scope origin ux uz 1 1)" }, { "turtle-yaw", "s", "(make-turtle-scope origin ux uz 1 1)" }, { "turtle-pitch", "s", "(make-turtle-scope origin ux uz 1 1)" },
  { "turtle-roll", "s", "(make-turtle-scope origin ux uz 1 1)" }, { "turtle-width", "s", "(make-turtle-scope origin ux uz 1 1)" }, { "turtle-height", "s", "(make-turtle-scope origin ux uz 1 1)" },
  { "turtle-toward", "s", "(make-turtle-scope origin ux uz 1 1)" }, { "turtle-back", "s", "(make-turtle-scope origin ux uz 1 1)" },
  { "scope-region", "s", "(make-triangle-scope origin (xy 1 0) (xy 0 1))" },
  { "sun", "azimuth", NULL }, { "sun", "altitude", NULL }, { "sun", "latitude", NULL }, { "sun", "longitude", NULL }, { "sun", "date", NULL }, { "sun", "time", NULL },
};

/* Arguments that are bad for one form of the procedure but good for another form. */
static const struct { const char *procedure, *bad; } right[] = { { "make-cylinder", "5" }, { "make-cylinder", "(xyz 1 2 3)" } };

static bool is_right(const char *procedure, const char *bad) {
  for (size_t i = 0; i < sizeof right / sizeof *right; i++)
    if (strcmp(right[i].procedure, procedure) == 0 && strcmp(right[i].bad, bad) == 0) return true;
  return false;
}

static const char *first_definitions =
  "(define ball (make-sphere origin 1))"
  "(define brick2 (make-box (xyz 0 0 0) (xyz 1 2 3)))"
  "(define ring (make-circle origin 1))"
  "(define room (make-box-scope origin 4 3 2))"
  "(define plate (make-region (make-rectangle (xy 0 0) (xy 2 1))))"
  "(define rail (make-line (xyz 0 0 0) (xyz 0 0 5)))"
  "(define bar (list (make-line (xyz 1 0 0) (xyz 1 0 3))))"
  "(define far-vector (* 1e300 (* 1e300 (vxyz 1 0 0))))"
  "(define far-point (+ origin far-vector))";

/* ---- evaluating a text ---- */

typedef struct {
  char error[TEXT_MOST], warning[TEXT_MOST];
  vs_span at; /* place of the error in the text */
} said;

static void hear(void *context, const vs_diagnostic *d) {
  said *s = context;
  if (d->severity == VS_SEVERITY_NOTE) return;
  char *to = d->severity == VS_SEVERITY_ERROR ? s->error : s->warning;
  if (d->severity == VS_SEVERITY_ERROR) s->at = d->at;
  snprintf(to, TEXT_MOST, "%s", d->message);
}

enum { SECONDS = 20 }; /* greatest processor time of a call; its elapsed time, which depends on other processes, may be
                        * ten times as long */
static vs_scheme *scheme;
static said heard;
static unsigned line;
static int passed, failed;

static void fresh(void) {
  vs_free(scheme);
  vs_options o = vs_options_default();
  o.host.context = &heard;
  o.host.diagnose = hear;
  o.limit_time = 10 * SECONDS;
  o.limit_memory = (size_t)2000 << 20;
  scheme = vs_new(&o);
  if (!scheme || vs_eval_text(scheme, "first", 1, first_definitions, strlen(first_definitions), 0) != VS_OUTCOME_DONE) {
    printf("not ok bad/definitions\n    %s\n", heard.error);
    exit(1);
  }
}

/* Evaluates the text. Earlier definitions remain; earlier drawn objects are erased. Each text gets its own line number,
 * because vs prints a warning only once for each place. */
static vs_outcome evaluate(const char *text) {
  heard = (said){ .at = { NULL, 0, 0, 0, 0 } };
  clock_t from = clock();
  vs_drawing_clear(scheme);
  vs_outcome outcome = vs_eval_text(scheme, "bad", ++line, text, strlen(text), 0);
  if (clock() - from > SECONDS * CLOCKS_PER_SEC)
    snprintf(heard.error, sizeof heard.error, "used more than %d seconds of the processor", SECONDS);
  return outcome;
}

static void result(bool good, const char *name, const char *why) {
  if (good) {
    passed++;
    return;
  }
  failed++;
  printf("not ok bad/%s\n    %s\n", name, why);
  if (heard.error[0]) printf("    error: %.600s\n", heard.error);
  if (heard.warning[0]) printf("    warning: %.600s\n", heard.warning);
}

static bool at_call(void) { return heard.at.file && strcmp(heard.at.file, "bad") == 0 && heard.at.line == line && heard.at.column >= 1; }

/* ---- calls from the table of procedures ---- */

static bool special_find(const char *procedure, const char *parameter, const char **good) {
  for (size_t i = 0; i < sizeof special / sizeof *special; i++)
    if (strcmp(special[i].procedure, procedure) == 0 && strcmp(special[i].parameter, parameter) == 0) return *good = special[i].good, true;
  return false;
}

static void append(char *text, const char *more) {
  size_t used = strlen(text);
  snprintf(text + used, TEXT_MOST - used, "%s", more);
}

/* Writes the call (name argument ... #:key argument). Positional parameter number `at`, or keyword number `key`, gets
 * the argument `bad`. */
static void make_call(char *text, const char *name, const vs_procedure *p, const vs_form *form, int at, int key, const char *bad) {
  int met[sizeof contracts / sizeof *contracts] = { 0 };
  *text = 0;
  append(text, "(");
  append(text, name);
  for (int i = 0; form->at[i].mode != VS_ARG_END; i++) {
    const vs_bind_param *q = &form->at[i];
    const char *good = NULL;
    if (!special_find(name, q->name, &good) || !good) {
      const char *const *all = contracts[q->contract].good;
      int n = met[q->contract];
      while (n > 0 && (n > 3 || !all[n])) n--;
      good = all[n];
    }
    met[q->contract]++;
    if (q->mode == VS_ARG_OPTIONAL && i > at) break; /* writes optional parameters only up to the tested parameter */
    append(text, " ");
    append(text, i == at && bad ? bad : good);
  }
  if (key >= 0) {
    const vs_bind_param *q = &p->key[key];
    const char *good = NULL;
    if (!special_find(name, q->name, &good) || !good) good = contracts[q->contract].good[0];
    append(text, " #:");
    append(text, q->name);
    append(text, " ");
    append(text, bad ? bad : good);
  }
  append(text, ")");
}

/* Returns true if the message contains the name of the parameter. The name of the parameter at the same position in
 * another form with as many arguments is also accepted, because vs cannot know the intended form. */
static bool names_parameter(const vs_procedure *p, const vs_bind_param *meant, int at) {
  if (strstr(heard.error, meant->name)) return true;
  for (int f = 0; at >= 0 && f < VS_MAX_FORMS && p->form[f].used; f++)
    for (int i = 0; p->form[f].at[i].mode != VS_ARG_END; i++)
      if (i == at && strstr(heard.error, p->form[f].at[i].name)) return true;
  return strstr(heard.error, ": takes (") != NULL && p->form[1].used;
}

/* Evaluates an expression and returns its written value, which it reads from an error message. */
static const char *written_as(const char *expression) {
  static char text[2 * TEXT_MOST];
  snprintf(text, sizeof text, "(error (call-with-output-string (lambda (p) (write %s p))))", expression);
  evaluate(text);
  snprintf(text, sizeof text, "%s", heard.error);
  return text;
}

/* Returns true if the message ends in "..., got VALUE". A long value may be cut short with dots. For a list, the
 * message may name the bad element. For a missing value, it says that the value is missing. */
static bool names_value(const char *value, const char *error) {
  const char *got = strstr(error, "got ");
  if (!got) return strcmp(value, "#<void>") == 0 && strstr(error, "gave no value");
  size_t same = 0;
  got += 4;
  /* removes "; call it: (NAME parameters)" from the end of the message */
  if (strncmp(value, "#<procedure ", 12) == 0 && strncmp(got, "the procedure ", 14) == 0) {
    size_t name = strlen(value) - 13;
    return strncmp(got + 14, value + 12, name) == 0 && strncmp(got + 14 + name, "; call it: (", 12) == 0;
  }
  while (got[same] && got[same] == value[same]) same++;
  if (!value[same] || (same >= 12 && strncmp(got + same, "...", 3) == 0)) return true;
  char one[300]; /* copy of the list's element that the message names, without the advice after it */
  snprintf(one, sizeof one, "%.*s", (int)strcspn(got, ";"), got);
  const char *element = value[0] == '(' ? strstr(value, one) : NULL;
  return element && (element[-1] == ' ' || element[-1] == '(') && strchr(" )", element[strlen(one)]);
}

static void try_parameter(const char *name, const vs_procedure *p, const vs_form *form, int at, int key) {
  const vs_bind_param *q = key >= 0 ? &p->key[key] : &form->at[at];
  const char *unused = "", *const *bad = contracts[q->contract].bad;
  char call[TEXT_MOST], label[TEXT_MOST], prefix[100];
  if (!bad[0] || (special_find(name, q->name, &unused) && !unused)) return;
  make_call(call, name, p, form, at, key, NULL);
  if (evaluate(call) != VS_OUTCOME_DONE) {
    result(false, call, "a good call fails: give its arguments in tests/tools/badcalls.c");
    return;
  }
  snprintf(prefix, sizeof prefix, "%s: ", name);
  for (int i = 0; i < BAD_MOST && bad[i]; i++) {
    make_call(call, name, p, form, at, key, bad[i]);
    snprintf(label, sizeof label, "%.300s", call);
    vs_outcome outcome = evaluate(call);
    if (outcome == VS_OUTCOME_DONE) result(is_right(name, bad[i]), label, "it is taken");
    else if (outcome != VS_OUTCOME_MODEL) result(false, label, "does not end as a fault of the model");
    else if (strncmp(heard.error, prefix, strlen(prefix)) != 0) result(false, label, "the error does not begin with the procedure's name");
    else if (!names_parameter(p, q, at)) result(false, label, "the error does not name the parameter");
    else if (!at_call()) result(false, label, "the error is not at the call");
    else {
      said mine = heard;
      static char value[2 * TEXT_MOST];
      snprintf(value, sizeof value, "%s", written_as(bad[i]));
      heard = mine;
      result(names_value(value, mine.error), label, value);
    }
  }
}

/* Tries a call with a huge argument. The call must fail or make an object; it must not return the empty object. */
static void try_far(const char *name, const vs_procedure *p, const vs_form *form, int at, int key) {
  const vs_bind_param *q = key >= 0 ? &p->key[key] : &form->at[at];
  const char *const *far = far_away[q->contract];
  char call[TEXT_MOST], label[TEXT_MOST];
  for (int i = 0; far[i]; i++) {
    make_call(call, name, p, form, at, key, far[i]);
    snprintf(label, sizeof label, "%.300s", call);
    vs_outcome outcome = evaluate(call);
    if (outcome != VS_OUTCOME_DONE && outcome != VS_OUTCOME_MODEL) result(false, label, "does not end as a fault of the model");
    else result(!strstr(heard.warning, "nothing is made"), label, "huge arguments are taken for equal or for 0");
  }
}

/* ---- lines of the table ---- */

/* Evaluates a line of the table and checks its expectation:
 *
 *   EXPRESSION ; error: TEXT    an error at the expression's place, whose message contains TEXT
 *   EXPRESSION ; empty: TEXT    the empty object, and a warning at the expression's place that contains TEXT
 *   EXPRESSION ; warning: TEXT  a value, and a warning that contains TEXT
 *   EXPRESSION ; value: V       a value that is written as V, without a warning
 *   EXPRESSION ; fine           a value without a warning, although the call looks bad
 *   EXPRESSION ; define         a definition for the lines below
 *
 * For a line without an expectation the function prints the result. */
static void try_line(char *text) {
  char *says = NULL, *next = text;
  static char wrapped[2 * TEXT_MOST + 200];
  while ((next = strstr(next, " ; ")) != NULL) says = next, next += 3;
  if (!says) { /* prints the result, so that the author of the table can write the expectation */
    text[strcspn(text, "\n")] = 0;
    vs_outcome outcome = evaluate(text);
    if (outcome != VS_OUTCOME_DONE) printf("%s ; error: %s\n", text, heard.error);
    else if (heard.warning[0]) printf("%s ; warning: %s\n", text, heard.warning);
    else printf("%s ; value: ?\n", text);
    result(false, text, "says nothing of what must come");
    return;
  }
  *says = 0;
  says += 3;
  says[strcspn(says, "\n")] = 0;
  char *wanted = strchr(says, ':');
  if (wanted) *wanted++ = 0, wanted += *wanted == ' ';
  if (strcmp(says, "define") == 0 || strcmp(says, "fine") == 0) {
    evaluate(text);
    result(!heard.error[0] && !heard.warning[0], text, "is not taken as it is");
  } else if (strcmp(says, "error") == 0) {
    vs_outcome outcome = evaluate(text);
    if (outcome != VS_OUTCOME_MODEL) result(false, text, outcome == VS_OUTCOME_DONE ? "it is taken" : "does not end as a fault of the model");
    else if (!wanted || !strstr(heard.error, wanted)) result(false, text, wanted);
    else result(at_call(), text, "the error is not at the call");
  } else if (strcmp(says, "empty") == 0) {
    snprintf(wrapped, sizeof wrapped, "(if (not (empty-object? %s)) (error \"not empty\"))", text);
    evaluate(wrapped);
    if (heard.error[0]) result(false, text, "is not the empty object");
    else result(wanted && heard.warning[0] && strstr(heard.warning, wanted), text, wanted);
  } else if (strcmp(says, "warning") == 0) {
    evaluate(text);
    result(!heard.error[0] && wanted && strstr(heard.warning, wanted), text, wanted);
  } else if (strcmp(says, "value") == 0) {
    snprintf(wrapped, sizeof wrapped, "(let ((v %s)) (if (not (equal? (call-with-output-string (lambda (p) (write v p))) \"%s\")) (error \"got\" v)))", text, wanted ? wanted : "");
    evaluate(wrapped);
    result(!heard.error[0] && !heard.warning[0], text, wanted);
  } else {
    result(false, text, "must say error, empty, warning, value, fine or define");
  }
}

int main(int argc, char **argv) {
  fresh();
  for (int i = 0; vs_bind_defs[i].name; i++) {
    char name[64];
    size_t length = strcspn(vs_bind_defs[i].name, " ");
    if (vs_bind_defs[i].name[0] == '%' || length >= sizeof name) continue;
    memcpy(name, vs_bind_defs[i].name, length);
    name[length] = 0;
    const vs_procedure *p = &vs_bind_procedures[i];
    for (int f = 0; f < VS_MAX_FORMS && p->form[f].used; f++)
      for (int at = 0; p->form[f].at[at].mode != VS_ARG_END; at++) {
        try_parameter(name, p, &p->form[f], at, -1);
        try_far(name, p, &p->form[f], at, -1);
      }
    for (int key = 0; p->key[key].mode != VS_ARG_END; key++) {
      try_parameter(name, p, &p->form[0], -1, key);
      try_far(name, p, &p->form[0], -1, key);
    }
  }
  printf("%s bad/contracts: %d calls with a bad argument each\n", failed ? "not ok" : "ok", passed + failed);
  int contract_failures = failed;
  passed = failed = 0;
  FILE *f = argc == 2 ? fopen(argv[1], "r") : NULL;
  static char text[TEXT_MOST];
  if (!f) {
    printf("not ok bad/calls: no table\n");
    return 1;
  }
  while (fgets(text, sizeof text, f))
    if (text[0] != ';' && text[0] != '\n') try_line(text);
  fclose(f);
  printf("%s bad/calls: %d lines\n", failed ? "not ok" : "ok", passed + failed);
  vs_free(scheme);
  return contract_failures || failed;
}
