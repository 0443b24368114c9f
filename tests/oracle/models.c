/* Makes and shrinks random programs: see models.h.
 *
 * The kinds of solids are those of model/prims.def. Most are made by a procedure named (make-NAME ...), (do-NAME ...)
 * or (NAME ...). The table of procedures in bind/ contains the forms and contracts of these procedures, so this file
 * need not change for a new kind with rows in these two tables. The lines of `by_hand` make other kinds. `no_model`
 * lists the kinds that are no solid, with the reason. The test fails for a kind that none of these covers. Curves and
 * regions are profiles of swept solids. */
#include "tests/oracle/models.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bind/call/call.h"
#include "bind/procedures.h"

typedef struct { const char *name, *class_; } kind_row;
static const kind_row kinds[] = {
#define VS_KIND(upper, lower, name, class, level, role, traits) { name, #class },
#define VS_FIELD(type, member, argument)
#define VS_KIND_END(upper, lower)
#include "model/prims.def"
};

/* How a program makes a kind, if no procedure of the table makes it, or if its arguments depend on each other. $s is a
 * solid, $c a profile, $n a number, $p a point, $i an integer from 3 to 8. */
static const struct { const char *kind, *text; } by_hand[] = {
  { "spline", "(make-spline (list (xy 1 0) (xyz $n 2 0) (xy 3 1)))" },
  { "spline", "(make-spline (list (xy 1 0) (xy 3 0) (xyz 2 $n 0) (xy 1 0)))" },
  { "text", "(make-text (xyz 0 0 0) $n \"aB8\")" },
  { "text", "(make-text $p 2 \"%Q\" #:align 'center #:valign 'top)" },
  { "half-space", "(intersect $s (make-half-space (make-plane $p (vxyz 1 $n 1))))" },
  { "half-space", "(subtract $s (make-half-space (make-plane $p 'z)))" },
  { "half-space", "(unite $s (intersect $s (make-half-space 'xy) (make-half-space (make-plane $p (vxyz 1 1e-6 0)))))" },
  { "height-field", "(make-height-field '((0 1 0) (1 $n 2) (0 2 1) (1 0 $n)) (xy -1 -1) (xy 2 $n))" },
  { "height-field", "(make-height-field '((0 0) (0 $n)) (xy 0 0) (xy 2 2) #:low -1)" },
  { "polyface-mesh", "(make-polyface-mesh (list (xyz 0 0 0) (xyz 2 0 0) (xyz 0 2 0) $p) '((1 3 2) (1 2 4) (2 3 4) (3 1 4)))" },
  { "polyface-mesh", "(make-polyface-mesh (list (xyz 0 0 0) (xyz 2 0 0) (xyz 2 2 0) (xyz 0 2 $n) (xyz 0 0 2) (xyz 2 0 2) (xyz 2 2 2) "
                     "(xyz 0 2 2)) '((1 4 3 2) (5 6 7 8) (1 2 6 5) (2 3 7 6) (3 4 8 7) (4 1 5 8)) #:repair #t)" },
  { "mesh", "(make-mesh (map-division (lambda (u) (map-division (lambda (v) (cyl (+ 2 (* $n 1/3 (cos v))) u (sin v))) 0 2pi $i)) 0 2pi $i))" },
  { "mesh", "(make-mesh (map (lambda (r z) (map-division (lambda (a) (cyl r a z)) 0 2pi $i)) '(0 1 $n 0) '(0 0 2 2)))" },
  { "surface", "(make-surface (lambda (u v) (sph $n u v)) 0 2pi 0 pi #:nu $i #:nv $i)" },
  { "surface", "(make-surface (lambda (u v) (cyl (+ 2 (cos v)) u (+ (* $n u) (sin v)))) 0 2pi 0 2pi #:nu 12 #:nv $i)" },
  { "guided-loft", "(do-guided-loft (list (make-circle origin 1) (make-circle (xyz 0 0 4) $n)) (make-spline (xyz 0 0 0) (xyz $n 0 2) (xyz 0 0 4)))" },
  { "guided-loft", "(let ((bow (make-spline (xyz 1 0 0) (xyz $n 0 2) (xyz 1 0 4)))) (do-guided-loft (list (make-circle origin 1) "
                   "(make-circle (xyz 0 0 4) 1)) (list bow (do-rotate bow 'z pi))))" },
  { "with-material", "(unite (with-material \"brick\" $s) (with-material \"glass\" $s))" },
  { "layer", "(unite (layer \"walls\" $s) $s)" },
  { "part", "(part \"leg\" $s)" },
  { "native", "(native 'povray \"sphere { 0, 1 }\" #:otherwise $s)" },
  { "highlight", "(highlight $s)" },
  { "custom", "(let () (define-primitive (slab w) (make-box origin 2 w 1)) (unite (slab $n) $s))" },
  { "deform", "(scope-place (make-ffd-scope (xyz -2 2 0) (xyz 2 2 0) (xyz -1 1 $n) (xyz 1 1 3) (xyz -2 -2 0) (xyz 2 -2 0) (xyz -1 -1 3) $p) $s)" },
  { "offset", "(do-offset $c $n)" },
  { "offset", "(do-offset $c -.1 #:corners 'round)" },
  { "section", "(do-section $s (make-plane $p 'z))" },
  { "section", "(do-section $s 'xy)" },
  { "project", "(do-project $s 'xy)" },
  { "join-curves", "(join-curves (make-line (xy 1 0) (xy 3 0)) (make-arc (xy 2 0) 1 0 pi))" },
  { "ruled-loft", "(do-ruled-loft (list $c (do-move $c (vxyz 0 0 2)) (xyz 0 0 3)))" },
  { "extrude", "(do-extrude $c 2 #:twist $n #:scale $n)" },
};

/* Kinds that are neither solids nor profiles of solids, with the reason. */
static const struct { const char *kind, *why; } no_model[] = {
  { "ghost", "no part of any drawing" },
  { "only", "what is drawn is then not what is measured" },
  { "xline", "endless" },
  { "ray", "endless" },
  { "edges", "many curves" },
};
static const char *const sets[] = { "unite", "subtract", "intersect" };

typedef struct {
  uint64_t state;
  char *text;
  size_t count;
  int depth;
  const char *first; /* kind of the first leaf; NULL after the leaf is written */
} maker;

static uint32_t any(maker *m, uint32_t n) { /* returns a random integer of 0 .. n-1 */
  m->state ^= m->state << 13;
  m->state ^= m->state >> 7;
  m->state ^= m->state << 17;
  return (uint32_t)((m->state >> 20) % n);
}

static void say(maker *m, const char *format, ...) {
  va_list rest;
  va_start(rest, format);
  int n = vsnprintf(m->text + m->count, MODEL_ROOM - m->count, format, rest);
  va_end(rest);
  m->count += n > 0 && (size_t)n < MODEL_ROOM - m->count ? (size_t)n : 0;
}

static const vs_procedure *procedure_of(const char *kind, char name[64]) {
  static const char *const prefixes[] = { "make-", "do-", "" };
  for (int p = 0; p < 3; p++)
    for (int i = 0; vs_bind_defs[i].name; i++) {
      size_t length = strcspn(vs_bind_defs[i].name, " ");
      snprintf(name, 64, "%s%s", prefixes[p], kind);
      if (strlen(name) == length && strncmp(vs_bind_defs[i].name, name, length) == 0) return &vs_bind_procedures[i];
    }
  return NULL;
}

static bool is_set(const char *kind) {
  for (size_t i = 0; i < sizeof sets / sizeof *sets; i++)
    if (strcmp(sets[i], kind) == 0) return true;
  return false;
}
static const char *no_model_why(const char *kind) {
  for (size_t i = 0; i < sizeof no_model / sizeof *no_model; i++)
    if (strcmp(no_model[i].kind, kind) == 0) return no_model[i].why;
  return NULL;
}
static size_t hands(const char *kind) { /* returns the number of lines of by_hand that make the kind */
  size_t n = 0;
  for (size_t i = 0; i < sizeof by_hand / sizeof *by_hand; i++) n += strcmp(by_hand[i].kind, kind) == 0;
  return n;
}
static bool is_profile(const kind_row *k) {
  return strcmp(k->class_, "CURVE") == 0 || strcmp(k->class_, "REGION") == 0 || strcmp(k->name, "offset") == 0;
}

static bool taken(const kind_row *k, bool profile) { return !is_set(k->name) && !no_model_why(k->name) && is_profile(k) == profile; }
static size_t count_kinds(bool profile) {
  size_t n = 0;
  for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) n += taken(&kinds[i], profile);
  return n;
}
static const char *kind_at(size_t which, bool profile) {
  for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
    if (taken(&kinds[i], profile) && which-- == 0) return kinds[i].name;
  return NULL;
}
size_t model_kinds(void) { return count_kinds(false) + count_kinds(true); }
const char *model_kind(size_t which) {
  size_t solids = count_kinds(false);
  return which < solids ? kind_at(which, false) : kind_at(which - solids, true);
}
const char *model_kind_word(size_t which, char word[64]) {
  const char *kind = model_kind(which);
  if (!procedure_of(kind, word) || hands(kind))
    for (size_t i = 0; i < sizeof by_hand / sizeof *by_hand; i++)
      if (strcmp(by_hand[i].kind, kind) == 0) {
        const char *name = strstr(by_hand[i].text, kind), *from = name;
        if (!name) return strcpy(word, strcmp(kind, "custom") == 0 ? "(define-primitive " : "(scope-place ");
        while (*from != '(') from--;
        snprintf(word, 64, "%.*s ", (int)(name + strlen(kind) - from), from);
        return word;
      }
  return procedure_of(kind, word) ? word : NULL;
}

/* ---- arguments ---- */

static void number(maker *m, double low, double high) { /* writes a number, mostly a simple one */
  switch (any(m, 24)) {
  case 0: say(m, "0"); break;
  case 1: say(m, "%g", low + (high - low) * any(m, 1000000) / 1e6); break;
  case 2: say(m, "%.17g", low + (high - low) * any(m, 1 << 30) / (1 << 30)); break;
  case 3: say(m, any(m, 2) ? "1e-3" : "1e-6"); break;
  default: say(m, "%g", low + (high - low) * any(m, 9) / 8);
  }
}
static void triple(maker *m, const char *name, double low, double high) {
  say(m, "(%s ", name);
  for (int i = 0; i < 3; i++) {
    number(m, low, high);
    say(m, i < 2 ? " " : ")");
  }
}
static void tiny_angle(maker *m) { say(m, "%de-%d", 1 + (int)any(m, 9), 5 + (int)any(m, 6)); }
static void angle(maker *m) {
  switch (any(m, 4)) {
  case 0: tiny_angle(m); break;
  case 1: say(m, "(* %d 1/4 pi)", 1 + (int)any(m, 8)); break;
  default: number(m, -3, 3);
  }
}

static bool solid(maker *m);
static bool made(maker *m, const char *kind);

static void profile(maker *m, bool closed) {
  static const char *const stars[] = { "(make-polygon (xy 0 0) (xy 2 0) (xy 2 1) (xy 0 1))", "(make-polygon (xy 1 0) (xy 3 0) (xy 2 1.5))", "(make-polygon (xy 1 0) (xy 3 0) (xy 1.5 .5) (xy 2 2))" };
  if (m->depth > -3 && any(m, 3) == 0) { /* writes a solid by a procedure of the table. At great depth it writes a
                                          * simple solid, because the nesting of some kinds would never end */
    m->depth--;
    bool done = made(m, kind_at(any(m, (uint32_t)count_kinds(true)), true));
    m->depth++;
    if (done) return;
  }
  uint32_t which = any(m, closed ? 5 : 7);
  if (which == 0) say(m, "(make-circle (xy %d 0) %g)", (int)any(m, 4), 0.25 + any(m, 4) / 4.0);
  else if (which == 1) say(m, "(make-region (make-circle (xy 3 0) 1) (make-circle (xy 3 0) .5))");
  else if (which < 5) say(m, "%s", stars[which - 2]);
  else say(m, "(make-line (xyz 0 0 0) (xyz %g 0 2) (xyz 2 1 3))", (double)any(m, 3));
}

/* Writes a random argument that satisfies the contract. Returns false if this function has no example for the
 * contract. */
static bool argument(maker *m, int contract, const char *name) {
  switch (contract) {
  case VS_C_REAL: number(m, -1, 3); return true;
  case VS_C_RADIUS: case VS_C_POSITIVE: number(m, 0, 3); return true;
  case VS_C_UNIT: number(m, 0, 1); return true;
  case VS_C_ANGLE: angle(m); return true;
  case VS_C_DEGREES: number(m, 0, 80); return true;
  case VS_C_SOME: case VS_C_NATURAL: say(m, "%d", 1 + (int)any(m, 5)); return true;
  case VS_C_SIDES: say(m, "%d", 3 + (int)any(m, 20)); return true;
  case VS_C_SEGMENTS: say(m, "%d", 24 + (int)any(m, 40)); return true; /* chooses at least 24 facets; with fewer, the
                                                                        * volume differs too much from the formula */
  case VS_C_BOOLEAN: say(m, any(m, 2) ? "#t" : "#f"); return true;
  case VS_C_POINT: case VS_C_PLACE: triple(m, "xyz", -3, 3); return true;
  case VS_C_VECTOR: triple(m, "vxyz", -2, 2); return true;
  case VS_C_DIRECTION: say(m, "(vxyz %d %d 1)", (int)any(m, 3), (int)any(m, 2)); return true;
  case VS_C_AXIS:
    if (any(m, 3)) say(m, "'%c", "xyz"[any(m, 3)]);
    else say(m, "(make-axis (xyz 0 0 0) (vxyz 1 2 %d))", (int)any(m, 4));
    return true;
  case VS_C_PLANE: say(m, any(m, 2) ? "'yz" : "(make-plane (xyz 1 0 0) (vxyz 1 2 3))"); return true;
  case VS_C_FACTOR: if (any(m, 2)) number(m, 0.25, 2); else say(m, "(list 1 %g 2)", 0.5 + any(m, 4)); return true;
  case VS_C_STAND: say(m, "'x%c", "yz"[any(m, 2)]); return true;
  case VS_C_MATRIX: say(m, "(rotation-matrix %g 'x)", any(m, 9) / 3.0); return true;
  case VS_C_CURVE: case VS_C_CURVES: case VS_C_PROFILE: case VS_C_FLAT: profile(m, strcmp(name, "path") != 0 && any(m, 4)); return true;
  case VS_C_SECTIONS: say(m, "(list (make-circle origin 1) (do-move "); profile(m, true); say(m, " (vxyz 0 0 2)))"); return true;
  case VS_C_PATH: if (any(m, 2)) number(m, -1, 3); else say(m, "(make-line (xyz 0 0 0) (xyz 0 0 2) (xyz 1 0 4))"); return true;
  case VS_C_POINTS: say(m, "(list (xyz 0 0 0) (xyz 2 0 0) (xyz 0 2 0) "); triple(m, "xyz", -1, 2); say(m, ")"); return true;
  case VS_C_SOLID: case VS_C_OBJECT: case VS_C_OBJECTS: case VS_C_THINGS: return solid(m);
  default: return false;
  }
}

static void by_line(maker *m, const char *text) {
  for (; *text; text++) {
    if (*text != '$') {
      say(m, "%c", *text);
      continue;
    }
    switch (*++text) {
    case 's': solid(m); break;
    case 'c': profile(m, true); break;
    case 'n': number(m, 0, 3); break;
    case 'p': triple(m, "xyz", -1, 3); break;
    case 'i': say(m, "%d", 3 + (int)any(m, 6)); break;
    }
  }
}

static bool made(maker *m, const char *kind) {
  char name[64];
  const vs_procedure *p = procedure_of(kind, name);
  size_t before = m->count, lines = hands(kind);
  int forms = 0;
  if (lines && (!p || any(m, 2))) {
    size_t which = any(m, (uint32_t)lines);
    for (size_t i = 0; i < sizeof by_hand / sizeof *by_hand; i++)
      if (strcmp(by_hand[i].kind, kind) == 0 && which-- == 0) by_line(m, by_hand[i].text);
    return true;
  }
  if (!p) return false;
  while (forms < VS_MAX_FORMS && p->form[forms].used) forms++;
  const vs_form *form = &p->form[forms ? any(m, (uint32_t)forms) : 0];
  bool known = true;
  say(m, "(%s", name);
  for (int i = 0; known && form->at[i].mode != VS_ARG_END; i++) {
    const vs_bind_param *q = &form->at[i];
    if (q->mode == VS_ARG_OPTIONAL && any(m, 3)) break;
    say(m, " ");
    known = argument(m, q->contract, q->name);
  }
  for (int i = 0; known && i < VS_MAX_KEYS && p->key[i].mode != VS_ARG_END; i++) {
    size_t at = m->count;
    if (any(m, 4)) continue;
    say(m, " #:%s ", p->key[i].name);
    if (argument(m, p->key[i].contract, p->key[i].name)) continue;
    m->count = at;
    m->text[at] = 0;
  }
  say(m, ")");
  if (known) return true;
  m->count = before;
  m->text[before] = 0;
  return false;
}

/* Writes the first leaf. The seed selects its kind, or its profile's kind, so that consecutive seeds use every kind. */
static bool first_leaf(maker *m) {
  const char *kind = m->first;
  m->first = NULL;
  for (size_t i = 0; i < count_kinds(false); i++)
    if (strcmp(kind, kind_at(i, false)) == 0) return made(m, kind);
  bool thick = any(m, 3) == 0;
  say(m, thick ? "(do-thicken " : "(do-extrude ");
  if (!made(m, kind)) profile(m, true);
  say(m, thick ? " .25)" : " 1)");
  return true;
}

static void leaf(maker *m) {
  if (m->first && first_leaf(m)) return;
  for (int tries = 0; tries < 40; tries++) {
    if (any(m, 3) == 0 || m->depth < -3) {
      say(m, "(make-box ");
      triple(m, "xyz", -2, 1);
      say(m, " %g %g %g)", 0.5 + any(m, 4), 0.5 + any(m, 4), 0.05 + any(m, 3));
      return;
    }
    m->depth--; /* solids in arguments may have one level less below them */
    bool done = made(m, kind_at(any(m, (uint32_t)count_kinds(false)), false));
    m->depth++;
    if (done) return;
  }
  say(m, "(make-box origin 1 1 1)");
}

static void placed(maker *m, size_t from) { /* puts a placement around the text from position `from` to the end */
  static char was[MODEL_ROOM];
  snprintf(was, sizeof was, "%s", m->text + from);
  m->count = from;
  switch (any(m, 8)) {
  case 6: say(m, "(do-transform %s (make-matrix 1 %g 0 0  0 1 0 0  %s 0 1 0  0 0 0 1))", was, any(m, 3) / 2.0, any(m, 2) ? ".25" : "1e-7"); break;
  case 7: say(m, "(do-slice %s ", was), argument(m, VS_C_PLANE, ""), say(m, ")"); break;
  case 0: say(m, "(do-rotate %s '%c ", was, "xyz"[any(m, 3)]), tiny_angle(m), say(m, ")"); break;
  case 1: say(m, "(do-rotate %s (vxyz 1 2 3) ", was), angle(m), say(m, ")"); break;
  case 2: say(m, "(do-scale %s %s)", was, any(m, 2) ? "1e-3" : "1.0000001"); break;
  case 3: say(m, "(do-scale %s (list 1 1 %s))", was, any(m, 2) ? "100" : ".01"); break;
  case 4: say(m, "(do-mirror %s 'yz)", was); break;
  default: say(m, "(do-move %s ", was), triple(m, "vxyz", -1, 1), say(m, ")");
  }
}

static bool solid(maker *m) {
  static char was[MODEL_ROOM];
  size_t from = m->count;
  if (m->depth <= 0 || any(m, 3) == 0) {
    m->depth--;
    leaf(m);
  } else {
    m->depth--;
    uint32_t n = 2 + (any(m, 3) == 0);
    say(m, "(%s", sets[any(m, 3)]);
    for (uint32_t i = 0; i < n; i++) {
      say(m, " ");
      size_t at = m->count;
      solid(m);
      if (i == 0 && any(m, 4) == 0 && m->count - at < MODEL_ROOM / 8) { /* adds a copy of the last part, with slightly
                                                                         * different numbers */
        snprintf(was, sizeof was, "%s", m->text + at);
        say(m, " %s", was);
        size_t copy = m->count - strlen(was);
        placed(m, copy);
      }
    }
    say(m, ")");
    m->depth++;
  }
  if (any(m, 3) == 0 && m->count - from < MODEL_ROOM / 4) placed(m, from);
  return true;
}

void model_make(uint64_t seed, char text[MODEL_ROOM]) {
  maker m = { .state = seed * 0x9e3779b97f4a7c15u + 0x2545f4914f6cdd1du, .text = text, .depth = 2, .first = model_kind(seed % model_kinds()) };
  text[0] = 0;
  for (int i = 0; i < 8; i++) any(&m, 2);
  solid(&m);
}

/* ---- solids turned by very little ---- */

static int whole(maker *m, int low, int high) { return low + (int)any(m, (uint32_t)(high - low + 1)); }

static void whole_leaf(maker *m) {
  static const char *const round[] = { "prism", "pyramid", "cylinder", "cone" };
  int x = whole(m, -2, 2), y = whole(m, -2, 2), z = whole(m, -4, 0), high = whole(m, 1, 4), r = whole(m, 1, 2),
      sides = whole(m, 3, 16);
  uint32_t kind = any(m, 8);
  if (kind < 4)
    say(m, "(make-box (xyz %d %d %d) (xyz %d %d %d))", x, y, z, x + whole(m, 1, 3), y + whole(m, 1, 4), z + high);
  else if (kind == 4)
    say(m, "(make-sphere (xyz %d %d %d) %d)", x, y, z, r);
  else {
    kind = any(m, 4);
    say(m, "(make-%s (xyz %d %d %d) %d", round[kind], x, y, z, r);
    if (kind < 2) say(m, " %d", sides);
    say(m, " (xyz %d %d %d)", x, y, z + high);
    if (kind % 2) say(m, " %g", any(m, 2) ? r : r / 2.0);
    say(m, ")");
  }
}

static void slightly_turned(maker *m, size_t from) { /* puts a rotation by a tiny angle around the text from position
                                                      * `from` to the end */
  static char was[MODEL_ROOM];
  snprintf(was, sizeof was, "%s", m->text + from);
  m->count = from;
  say(m, "(do-rotate %s ", was);
  if (any(m, 4))
    say(m, "'%c ", "xyz"[any(m, 3)]);
  else
    say(m, "(vxyz %d %d 1) ", whole(m, 0, 2), whole(m, -1, 2));
  say(m, "(degrees->radians %s%de-%d))", any(m, 2) ? "" : "-", whole(m, 1, 9), whole(m, 5, 7));
}

static void whole_set(maker *m, int depth) {
  if (depth == 0) {
    whole_leaf(m);
    return;
  }
  int n = 2 + (any(m, 3) == 0);
  say(m, "(%s", sets[any(m, 8) * 3 / 8]);
  for (int i = 0; i < n; i++) {
    say(m, " ");
    size_t from = m->count;
    whole_set(m, depth > 1 && any(m, 2) ? depth - 1 : 0);
    if (i == 0 && any(m, 5) == 0 && m->count - from < MODEL_ROOM / 8) { /* adds a copy of the last part, with slightly
                                                                         * different numbers */
      char was[MODEL_ROOM / 8];
      snprintf(was, sizeof was, "%s", m->text + from);
      say(m, " ");
      from = m->count;
      say(m, "%s", was);
      slightly_turned(m, from);
    } else if (i && any(m, 3))
      slightly_turned(m, from);
  }
  say(m, ")");
}

void model_make_turned(uint64_t seed, char text[MODEL_ROOM]) {
  static const char *const around[] = { "(do-scale ", "(do-scale ", "(do-move ", "(do-rotate " }, *const behind[] = {
    " 1000)", " .001)", " (vxyz 100 20 3))", " 'z .5)"
  };
  maker m = { .state = seed * 0x9e3779b97f4a7c15u + 0x2545f4914f6cdd1du, .text = text };
  text[0] = 0;
  for (int i = 0; i < 8; i++) any(&m, 2);
  uint32_t how = any(&m, 16);
  if (how < 4) say(&m, "%s", around[how]);
  whole_set(&m, 2);
  if (how < 4) say(&m, "%s", behind[how]);
}

/* ---- shrinking ---- */

static const char *end_of(const char *at) { /* returns the end of the datum that begins at `at` */
  int depth = 0;
  if (*at == '\'') at++;
  do {
    if (*at == '(') depth++;
    if (*at == ')') depth--;
    at++;
  } while (*at && (depth > 0 || (*at != ' ' && *at != ')' && *at != '(')));
  return at;
}

/* Tries the text with the characters [from, to) replaced. Keeps the change if the new text still fails. */
static bool try_text(char text[MODEL_ROOM], const char *from, const char *to, const char *with, size_t length, model_fails *fails, void *context) {
  char tried[MODEL_ROOM];
  size_t before = (size_t)(from - text);
  if (before + length + strlen(to) >= MODEL_ROOM) return false;
  memcpy(tried, text, before);
  memcpy(tried + before, with, length);
  strcpy(tried + before + length, to);
  if (strlen(tried) >= strlen(text) || !fails(context, tried)) return false;
  strcpy(text, tried);
  return true;
}

static bool shrink_once(char text[MODEL_ROOM], model_fails *fails, void *context) {
  for (char *at = text; *at; at++) {
    if (at > text && at[-1] != ' ' && at[-1] != '(') continue;
    const char *end = end_of(at);
    if (*at == '(') {
      for (const char *kid = at + 1 + strcspn(at + 1, " ()"); *kid == ' '; kid = end_of(kid + 1))
        if (kid[1] == '(' && try_text(text, at, end, kid + 1, (size_t)(end_of(kid + 1) - kid - 1), fails, context)) return true;
      if (at > text && try_text(text, at - 1, end, "", 0, fails, context)) return true; /* removes an argument */
    } else if (strchr("-.0123456789", *at)) {
      char round[40];
      double x = strtod(at, NULL);
      for (int digits = 1; digits < 8; digits++) {
        snprintf(round, sizeof round, "%.*g", digits, x);
        if (strlen(round) < (size_t)(end - at) && try_text(text, at, end, round, strlen(round), fails, context)) return true;
      }
    }
  }
  return false;
}

void model_shrink(char text[MODEL_ROOM], model_fails *fails, void *context) {
  for (int rounds = 0; rounds < 300 && shrink_once(text, fails, context); rounds++) continue;
}
