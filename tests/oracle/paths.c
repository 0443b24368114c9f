/* Makes random programs of the samples: see paths.h. tests/cross checks that the table of samples covers the tables of
 * kinds and of procedures, so a new kind or constructor must have a sample. This file adds samples that the table of
 * shapes lacks: rules, and scripts in other languages. */
#include "tests/oracle/paths.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A file that includes this file must first include models.c, which contains the generator of random numbers. */

enum { SAMPLES = 1000 };

typedef struct { char *name, *object; } path_row;
static path_row samples[SAMPLES];
static size_t sample_count;
static char *definitions;

/* Definitions that the samples need: solids made from curves, regions and surfaces; a drawing made by a script in
 * another language; a facade made by two rules. */
static const char helpers[] =
    "(define (thick o) (if (or (curve? o) (region? o) (surface? o)) (do-thicken o 1/8) o))\n"
    "(define (drawn file) (erase-all) (load file) (let ([all (drawing)]) (erase-all) (unite all)))\n"
    "(define-rule (bay [self scope?]) [(=> (scope-split 'y (absolute 1/2 (make-box (xyz 0 0 0) (xyz 1 1 1))) "
    "(absolute 1 #f) (rest (make-wedge (xyz 0 0 0) (xyz 1 1 1)))))])\n"
    "(define-rule (facade [self scope?]) [(=> (scope-repeat 'x 1 bay))])\n"
    "(define-rule (tree [self turtle-scope?] [n integer?]) [#:when (= n 0) (=> (scope-place (make-cylinder origin 1 "
    "1/2)))] [(=> (scope-place (make-box (xyz 0 0 0) (xyz 1 1 1))) (turtle-forward 1) (turtle-yaw 1/4) (tree (- n "
    "1)))])\n";
static const path_row others[] = {
  { "rules/facade", "(facade (make-box-scope (xyz -2 0 0) 4 3 1/4))" },
  { "rules/turtle", "(tree (make-turtle-scope origin ux uz 1/2 1/2) 3)" },
  { "rules/hexahedron",
    "(facade (make-ffd-scope (xyz -2 2 0) (xyz 2 2 0) (xyz -1 1 3) (xyz 1 1 3) (xyz -2 -2 0) (xyz 2 "
    "-2 0) (xyz -1 -1 3) (xyz 1 -1 3)))" },
  { "JavaScript", "(drawn \"../oracle/paths.js\")" },
  { "GML", "(drawn \"../oracle/paths.gml\")" },
};

/* ---- the table of shapes ---- */

/* Returns the first text in `at` that is neither a blank nor a comment. */
static const char *beyond_blanks(const char *at) {
  for (;;) {
    at += strspn(at, " \t\r\n");
    if (*at != ';') return at;
    at += strcspn(at, "\n");
  }
}

/* Returns the text after the expression that begins at `at`. Parentheses within strings, characters and comments do not
 * count. */
static const char *behind(const char *at) {
  int depth = 0;
  bool quoted;
  do {
    quoted = false;
    at = beyond_blanks(at);
    if (!*at) return at;
    if (*at == '"') {
      for (at++; *at && *at != '"'; at++)
        if (*at == '\\' && at[1]) at++;
      at += *at != 0;
    } else if (*at == '(' || *at == '[') {
      depth++, at++;
    } else if (*at == ')' || *at == ']') {
      depth--, at++;
    } else if (strchr("'`,@", *at)) {
      at++;
      quoted = depth == 0;
    } else {
      at += strcspn(at, " \t\r\n()[]\";");
    }
  } while (depth > 0 || quoted);
  return at;
}

static char *copy_of(const char *from, const char *to) {
  char *text = malloc((size_t)(to - from) + 1);
  if (!text) abort();
  memcpy(text, from, (size_t)(to - from));
  text[to - from] = 0;
  return text;
}

/* Joins the text into a single line without comments, since the shrinking of a program cannot read comments. */
static void unwrapped(char *text) {
  char *to = text;
  bool string = false;
  for (const char *from = text; *from;) {
    if (string && *from == '\\') *to++ = *from++;
    else if (*from == '"') string = !string;
    if (!string && strchr(" \t\r\n;", *from)) {
      from = beyond_blanks(from);
      *to++ = ' ';
    } else {
      *to++ = *from++;
    }
  }
  *to = 0;
}

static void add_sample(const char *name, const char *object, const char *end) {
  if (sample_count == SAMPLES) abort();
  if (strncmp(object, "(only ", 6) == 0) return; /* skips this sample: `only` restricts the written drawing, so the
                                                  * drawing differs from the measured object */
  const char *name_end = behind(name);
  samples[sample_count].name = copy_of(name + 1, name_end - 1);
  samples[sample_count].object = copy_of(object, end);
  unwrapped(samples[sample_count++].object);
}

bool path_samples_read(const char *file) {
  FILE *f = fopen(file, "rb");
  if (!f || fseek(f, 0, SEEK_END) != 0) return false;
  long size = ftell(f);
  char *text = malloc((size_t)size + 1);
  definitions = malloc((size_t)size + sizeof helpers + 1);
  if (!text || !definitions) abort();
  rewind(f);
  text[fread(text, 1, (size_t)size, f)] = 0;
  fclose(f);
  size_t used = (size_t)sprintf(definitions, "%s", helpers);
  for (const char *at = beyond_blanks(text), *end; *at; at = beyond_blanks(end)) {
    end = behind(at);
    if (strncmp(at, "(shape ", 7) != 0) {
      used += (size_t)sprintf(definitions + used, "%.*s\n", (int)(end - at), at);
      continue;
    }
    const char *name = beyond_blanks(at + 7), *object = beyond_blanks(behind(name));
    add_sample(name, object, behind(object));
  }
  free(text);
  for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
    samples[sample_count].name = others[i].name;
    samples[sample_count++].object = others[i].object;
  }
  return true;
}

size_t path_samples(void) { return sample_count; }
const char *path_sample(size_t i) { return i < sample_count ? samples[i].name : NULL; }
bool path_is_nothing(const char *name) {
  char kind[64];
  snprintf(kind, sizeof kind, "%.*s", (int)strcspn(name, "/"), name);
  bool endless = strcmp(kind, "xline") == 0 || strcmp(kind, "ray") == 0; /* whether the sample is infinite, with neither
                                                                          * bounds nor a mesh */
  return endless || strcmp(kind, "empty-object") == 0 || (no_model_why(kind) && strchr(name, '/') == NULL);
}
const char *path_definitions(void) { return definitions; }

/* ---- programs ---- */

/* Ways to place the object $o. $n is a number near 1, $a an angle, $v a gvector, $p a point. */
static const char *const ways[] = {
  "$o",
  "(do-move $o $v)",
  "(do-rotate $o 'z $a)",
  "(do-rotate $o (make-axis $p (vxyz 1 2 3)) $a)",
  "(do-scale $o $n)",
  "(do-scale $o (list $n $n $n))",
  "(do-mirror $o 'yz)",
  "(do-mirror $o (make-plane $p (vxyz 1 2 3)))",
  "(do-transform $o (make-matrix 1 $n 0 0  0 1 0 0  0.25 0 1 0  0 0 0 1))",
  "(do-resize $o 4 #f #f)",
  "(scope-place (make-ffd-scope (xyz -2 2 0) (xyz 2 2 0) (xyz -1 1 3) (xyz 1 1 3) (xyz -2 -2 0) (xyz 2 -2 0) (xyz -1 "
  "-1 "
  "3) (xyz 1 -1 3)) $o)",
  "(scope-place (make-box-scope $p 4 3 2) $o)",
  "(do-deform $o (lambda (p) (xyz (cx p) (cy p) (+ (cz p) (* 1/16 (cx p) (cx p))))))",
  "(do-move (do-rotate $o 'x $a) $v)",
  "(do-rotate (do-scale (do-move $o $v) (list $n 1 1)) (vxyz 1 1 0) $a)",
  "(do-mirror (do-rotate (unite $o) 'y $a) 'xy)",
  "(let ([s $o]) (unite s (do-move s $v)))",
  "(let ([s $o]) (do-move (unite (do-rotate s 'z $a) (do-move (do-mirror s 'xz) (vxyz 0 -9 0))) $v))",
  "(let* ([s $o] [t (do-move s $v)]) (unite t t (do-move t (vxyz 9 0 0))))",
  "(layer \"walls\" (do-move (color \"red\" $o) $v))",
  "(do-slice (do-move $o $v) (make-plane (xyz 1 0 0) (vxyz 1 2 3)))",
};
/* Sets that contain the object $o. $b is another solid. */
static const char *const set_forms[] = {
  "$o",
  "(unite $o $b)",
  "(unite $b $o)",
  "(subtract $o $b)",
  "(subtract $b $o)",
  "(intersect $o $b)",
  "(intersect $b $o)",
  "(subtract (unite $b (do-move $b (vxyz 1 1 1))) $o)",
};

size_t path_ways(void) { return sizeof ways / sizeof *ways; }
size_t path_sets(void) { return sizeof set_forms / sizeof *set_forms; }

static double between(maker *m, double low, double high) { return low + (high - low) * (1 + any(m, 14)) / 16; }

static void around(maker *m, const char *form, const char *object, const char *other) {
  for (; *form; form++) {
    if (*form != '$') {
      say(m, "%c", *form);
      continue;
    }
    switch (*++form) {
      case 'o': say(m, "%s", object); break;
      case 'b': say(m, "%s", other); break;
      case 'n': say(m, "%g", between(m, 0.5, 2)); break;
      case 'a': say(m, "%g", between(m, -3, 3)); break;
      case 'v': say(m, "(vxyz %g %g %g)", between(m, -3, 3), between(m, -3, 3), between(m, -2, 2)); break;
      case 'p': say(m, "(xyz %g %g %g)", between(m, -2, 2), between(m, -2, 2), between(m, -2, 2)); break;
      default: abort();
    }
  }
}

static void wrap(maker *m, const char *form, const char *other) {
  static char was[MODEL_ROOM];
  snprintf(was, sizeof was, "%s", m->text);
  m->count = 0;
  m->text[0] = 0;
  around(m, form, was, other);
}

/* Writes another solid: mostly a box, sometimes another sample. */
static void other_solid(maker *m) {
  if (any(m, 3)) {
    double x = between(m, -3, 2), y = between(m, -3, 2), z = between(m, -3, 2);
    say(m, "(make-box (xyz %g %g %g) (xyz %g %g %g))", x, y, z, x + between(m, 1, 5), y + between(m, 1, 5),
        z + between(m, 1, 5));
    return;
  }
  static char object[MODEL_ROOM];
  snprintf(object, sizeof object, "(thick %s)", samples[any(m, (uint32_t)sample_count)].object);
  around(m, ways[any(m, 9)], object, "");
}

void path_make(uint64_t seed, char text[MODEL_ROOM], size_t *which, size_t *way, size_t *set) {
  static char other[MODEL_ROOM];
  maker m = { .state = seed * 0x9e3779b97f4a7c15u + 0x2545f4914f6cdd1du, .text = other };
  for (int i = 0; i < 8; i++) any(&m, 2);
  other[0] = 0;
  other_solid(&m);
  m.text = text, m.count = 0;
  /* consecutive seeds use consecutive samples with different placements; the set operation is random */
  *which = seed % sample_count;
  *way = (seed + seed / sample_count) % path_ways();
  *set = any(&m, (uint32_t)path_sets());
  say(&m, "(thick %s)", samples[*which].object);
  wrap(&m, ways[*way], other);
  wrap(&m, set_forms[*set], other);
  if (any(&m, 3) == 0) wrap(&m, ways[1 + any(&m, 9)], other);
}

void path_thin(size_t which, const char *thickness, char text[MODEL_ROOM]) {
  maker m = { .text = text };
  text[0] = 0;
  say(&m, "(let ([o %s]) (if (or (curve? o) (region? o) (surface? o)) (do-thicken o %s) o))", samples[which].object,
      thickness);
}
