/* Converts files of other programs to Scheme data: groups of a .dxf file, commands of an SVG path. load_dxf.scm and
 * load_svg.scm create objects from these data; xml_events.c reads XML.
 *
 * vs reads the groups of .dxf itself: a group is two lines of text. Debian's only library for .dxf, libdxflib, is in
 * C++ and has no MESH. */
#include "bind/incoming/file_texts.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "bind/call/context.h"
#include "bind/incoming/xml_events.h"
#include "model/characters.h"
#include "model/scene.h"
#include "vm/library/port.h"
#include "vm/machine/activation.h"
#include "vm/machine/run.h"
#include "vm/values/heap.h"

bool vs_incoming_read(vs_scheme *vm, vs_value path, vs_text *text) {
  vs_text name;
  vs_text_open(vm, &name, 0);
  VS_ROOTS(vm, r, 1);
  bool ok = vs_text_string(&name, path) && vs_text_end(&name) && vs_io_read_file(vm, name.at, &r[0]);
  if (ok) {
    const char *at = (const char *)vs_as_bytes(r[0])->at;
    size_t count = (size_t)vs_as_bytes(r[0])->length, mark = count >= 3 && !memcmp(at, "\xEF\xBB\xBF", 3) ? 3 : 0;
    ok = vs_text_put(text, at + mark, count - mark) && vs_text_end(text);
  }
  vs_text_close(&name);
  return ok;
}

vs_status vs_incoming_broken(vs_scheme *vm, vs_value path, size_t line, const char *why) {
  vs_text name;
  vs_text_open(vm, &name, 0);
  if (vs_text_string(&name, path) && vs_text_end(&name))
    vs_fail(vm, vm->sym.error, "%s:%zu: %s", name.at, line, why);
  vs_text_close(&name);
  return VS_ERROR;
}

/* ---- .dxf ---- */

/* The type of a group's value, which the group's code determines. */
typedef enum { GROUP_TEXT, GROUP_REAL, GROUP_INTEGER } group_type;

static group_type type_of(long code) {
  static const struct { short first, last; group_type type; } ranges[] = {
    { 10, 59, GROUP_REAL },     { 60, 99, GROUP_INTEGER },   { 110, 149, GROUP_REAL },    { 160, 179, GROUP_INTEGER },
    { 210, 239, GROUP_REAL },   { 270, 299, GROUP_INTEGER }, { 370, 389, GROUP_INTEGER }, { 400, 409, GROUP_INTEGER },
    { 420, 429, GROUP_INTEGER }, { 440, 459, GROUP_INTEGER }, { 460, 469, GROUP_REAL },   { 1010, 1059, GROUP_REAL },
    { 1060, 1071, GROUP_INTEGER },
  };
  for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++)
    if (code >= ranges[i].first && code <= ranges[i].last) return ranges[i].type;
  return GROUP_TEXT;
}

/* A line of a text, without its line end. */
typedef struct { const char *at; size_t count; } line_text;

/* Sets *line to the line at *at and moves *at to the next line. Returns false at the end of the text. */
static bool next_line(const char **at, const char *end, line_text *line) {
  if (*at >= end) return false;
  const char *stop = memchr(*at, '\n', (size_t)(end - *at));
  *line = (line_text){ *at, (size_t)((stop ? stop : end) - *at) };
  *at = stop ? stop + 1 : end;
  while (line->count && (line->at[line->count - 1] == '\r')) line->count--;
  return true;
}

static line_text trimmed(line_text l) {
  while (l.count && isspace((unsigned char)l.at[l.count - 1])) l.count--;
  while (l.count && isspace((unsigned char)*l.at)) l.at++, l.count--;
  return l;
}

/* Reads a finite number. Returns false if the line contains anything else. */
static bool line_number(line_text l, double *out) {
  char t[64], *end;
  l = trimmed(l);
  if (l.count == 0 || l.count >= sizeof t || !memchr("+-.0123456789", *l.at, 13)) return false;
  memcpy(t, l.at, l.count), t[l.count] = '\0';
  *out = strtod(t, &end);
  return !*end && isfinite(*out) && !strpbrk(t, "xX");
}

/* Sets *out to a string of the line. Old files have one byte for characters outside ASCII; these bytes are read as
 * Latin-1. */
static bool line_string(vs_scheme *vm, line_text l, vs_value *out) {
  uint32_t c;
  bool utf8 = true;
  for (size_t i = 0; i < l.count && utf8;) {
    size_t n = vs_character_read(l.at + i, l.count - i, &c);
    utf8 = n > 0, i += n;
  }
  if (utf8) return vs_string_from_utf8(vm, l.at, l.count, out);
  vs_text t;
  vs_text_open(vm, &t, 0);
  bool ok = true;
  for (size_t i = 0; ok && i < l.count; i++) ok = vs_text_char(&t, (unsigned char)l.at[i]);
  ok = ok && vs_text_to_string(&t, out);
  vs_text_close(&t);
  return ok;
}

/* Sets *out to the value of a .dxf group, read from its line. If the group's code requires a number and the line is
 * none, sets the error. */
static bool group_value(vs_scheme *vm, vs_value path, size_t line, long code, line_text l, vs_value *out) {
  double d;
  group_type type = type_of(code);
  if (type == GROUP_TEXT) return line_string(vm, code == 1 || code == 3 ? l : trimmed(l), out);
  if (!line_number(l, &d)) return vs_incoming_broken(vm, path, line, "a number is expected here");
  if (type == GROUP_REAL) *out = vs_flonum(d);
  else if (fabs(d) > 9e15) return vs_incoming_broken(vm, path, line, "this number is too large");
  else *out = vs_fix((int64_t)d);
  return true;
}

/* Sets *out to a vector of the groups of a .dxf file: code and value alternate. Element 2i, a code, is in line 2i + 1
 * of the file. Ends after the group (0 . "EOF"). */
static vs_status dxf_groups(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  static const char sign[] = "AutoCAD Binary DXF";
  (void)n;
  vs_text text;
  vs_text_open(vm, &text, 0);
  VS_ROOTS(vm, r, 2);
  bool ok = vs_incoming_read(vm, a[0], &text), over = false;
  if (ok && text.count >= sizeof sign - 1 && !memcmp(text.at, sign, sizeof sign - 1))
    ok = vs_incoming_broken(vm, a[0], 1, "this is a binary .dxf; save it as ASCII");
  size_t lines = 0, at = 0;
  for (size_t i = 0; ok && i < text.count; i++) lines += text.at[i] == '\n';
  ok = ok && vs_make_vector(vm, lines + 2, VS_FALSE, &r[0]);
  const char *next = text.at, *end = text.at + text.count;
  while (ok && !over) {
    line_text l, v;
    double code;
    if (!next_line(&next, end, &l)) {
      ok = vs_incoming_broken(vm, a[0], at ? at : 1, "the file ends before its EOF");
      break;
    }
    if (!line_number(l, &code) || code != floor(code) || fabs(code) > 1100) {
      ok = vs_incoming_broken(vm, a[0], at + 1, "a group code is expected here");
      break;
    }
    if (!next_line(&next, end, &v)) {
      ok = vs_incoming_broken(vm, a[0], at + 1, "the file ends within a group");
      break;
    }
    ok = vs_poll(vm, 16) && group_value(vm, a[0], at + 2, (long)code, v, &r[1]);
    if (!ok) break;
    vs_gc_store(vm, vs_as_vector(r[0]), &vs_as_vector(r[0])->at[at], vs_fix((int64_t)code));
    vs_gc_store(vm, vs_as_vector(r[0]), &vs_as_vector(r[0])->at[at + 1], r[1]);
    at += 2;
    v = trimmed(v);
    over = code == 0 && v.count == 3 && !memcmp(v.at, "EOF", 3);
  }
  vs_text_close(&text);
  *out = r[0];
  return ok;
}

/* (%load-outline path): returns the groups of a .dxf file or, for any other file, the events of its XML. */
static vs_status load_outline(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  vs_text path;
  vs_text_open(vm, &path, 0);
  bool ok = vs_text_string(&path, a[0]) && vs_text_end(&path);
  bool dxf = ok && path.count > 4 && strcasecmp(path.at + path.count - 4, ".dxf") == 0;
  vs_text_close(&path);
  return !ok ? VS_ERROR : dxf ? dxf_groups(vm, a, n, out) : vs_xml_events(vm, a[0], out);
}

/* ---- lists of numbers in SVG ---- */

static bool is_separator(char c) { return c == ' ' || c == ',' || c == '\t' || c == '\n' || c == '\r' || c == '\f'; }

/* Reads a number of SVG at *at, and moves *at past it. Blanks before the number, hexadecimal numbers and infinity are
 * not allowed. */
static bool svg_number(const char **at, double *out) {
  char t[64];
  size_t n = 0;
  const char *s = *at;
  bool digits = false, dot = false;
  if (*s == '+' || *s == '-') t[n++] = *s++;
  while (n < sizeof t - 8 && (isdigit((unsigned char)*s) || (*s == '.' && !dot))) {
    if (*s == '.') dot = true;
    else digits = true;
    t[n++] = *s++;
  }
  while (isdigit((unsigned char)*s)) s++; /* skips digits that exceed a double's precision */
  if (!digits) return false;
  if (*s == 'e' || *s == 'E') {
    const char *power = s + 1 + (s[1] == '+' || s[1] == '-');
    if (isdigit((unsigned char)*power)) {
      t[n++] = *s++;
      if (*s == '+' || *s == '-') t[n++] = *s++;
      while (isdigit((unsigned char)*s) && n < sizeof t - 1) t[n++] = *s++;
      if (isdigit((unsigned char)*s)) return false;
    }
  }
  t[n] = '\0';
  *out = strtod(t, NULL);
  *at = s;
  return isfinite(*out);
}

/* (%path-tokens text): returns the list of the letters (as characters) and numbers in a path, in reverse order. After a
 * fault, reading stops, and #f is the list's first element: SVG requires that the part before a fault is drawn. */
static vs_status path_tokens(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  vs_text text;
  vs_text_open(vm, &text, 0);
  VS_ROOTS(vm, r, 1);
  r[0] = VS_NIL;
  bool ok = vs_text_string(&text, a[0]) && vs_text_end(&text);
  const char *at = text.at;
  char command = 0;
  for (size_t place = 0; ok;) {
    double d;
    while (ok && is_separator(*at)) at++;
    if (!*at) break;
    if (!vs_poll(vm, 4)) { ok = false; break; }
    if (isalpha((unsigned char)*at)) {
      command = *at++, place = 0;
      ok = vs_cons(vm, VS_CHAR((unsigned char)command), r[0], &r[0]);
      continue;
    }
    bool flag = (command == 'A' || command == 'a') && (place % 7 == 3 || place % 7 == 4);
    if (flag && (*at == '0' || *at == '1')) d = *at++ - '0';
    else if (flag || !svg_number(&at, &d)) {
      ok = vs_cons(vm, VS_FALSE, r[0], &r[0]);
      break;
    }
    place++;
    ok = vs_cons(vm, vs_flonum(d), r[0], &r[0]);
  }
  vs_text_close(&text);
  *out = r[0];
  return ok;
}

/* (%model-metres): returns the length of the model unit in metres. */
static vs_status model_metres(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)a, (void)n;
  *out = vs_flonum(vs_scene_metres(vs_bind_scene(vm)));
  return VS_OK;
}

static const vs_native_def defs[] = {
  { "%load-outline", "path", load_outline, 0, NULL }, /* error messages show the name of this native without the % */
  { "%path-tokens", "text", path_tokens, 0, NULL },
  { "%model-metres", "", model_metres, 0, NULL },
  { 0 },
};
const vs_native_table vs_incoming_table = { "incoming", defs };
