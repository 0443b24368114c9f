/* Parses files of other programs to Scheme data: groups of a .dxf file, elements of an XML file, commands of an SVG
 * path. load_dxf.scm and load_svg.scm make objects from these data.
 *
 * The library expat, which parses XML, is loaded when it is first used. vs reads the groups of .dxf itself: a group is
 * two lines of text. Debian's only library for it, libdxflib, is in C++ and has no MESH. */
#include "bind/incoming/file_texts.h"

#include <ctype.h>
#include <expat.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "bind/state.h"
#include "geometry/dynamic.h"
#include "model/characters.h"
#include "model/scene.h"
#include "vm/library/port.h"
#include "vm/machine/activation.h"
#include "vm/machine/run.h"
#include "vm/values/heap.h"

/* Copies the bytes of the file a[0] to *text, since the garbage collector may move them. */
static bool read_file(vs_scheme *vm, vs_value path, vs_text *text) {
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

/* Sets the error "file:line: why", where file is the path a[0]. */
static vs_status broken(vs_scheme *vm, vs_value path, size_t line, const char *why) {
  vs_text name;
  vs_text_open(vm, &name, 0);
  if (vs_text_string(&name, path) && vs_text_end(&name))
    vs_fail(vm, vm->sym.error, "%s:%zu: %s", name.at, line, why);
  vs_text_close(&name);
  return VS_ERROR;
}

/* ---- .dxf ---- */

/* The type of a group's value, by its code. */
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

/* A line of a text, without its end. */
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

/* Reads a finite number that is the whole text of the line. */
static bool line_number(line_text l, double *out) {
  char t[64], *end;
  l = trimmed(l);
  if (l.count == 0 || l.count >= sizeof t || !memchr("+-.0123456789", *l.at, 13)) return false;
  memcpy(t, l.at, l.count), t[l.count] = '\0';
  *out = strtod(t, &end);
  return !*end && isfinite(*out) && !strpbrk(t, "xX");
}

/* Makes a string of a line. Older files spell characters outside ASCII in one byte; these are read as Latin 1. */
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

/* Creates the value of a .dxf group from its line. Sets the error if the group's code requires a number and the line is
 * none. */
static bool group_value(vs_scheme *vm, vs_value path, size_t line, long code, line_text l, vs_value *out) {
  double d;
  group_type type = type_of(code);
  if (type == GROUP_TEXT) return line_string(vm, code == 1 || code == 3 ? l : trimmed(l), out);
  if (!line_number(l, &d)) return broken(vm, path, line, "a number is expected here");
  if (type == GROUP_REAL) *out = vs_flonum(d);
  else if (fabs(d) > 9e15) return broken(vm, path, line, "this number is too large");
  else *out = vs_fix((int64_t)d);
  return true;
}

/* Returns a vector of the group codes and values of a .dxf file, one after the other: the code at
 * place 2i is in line 2i + 1 of the file. Ends after the group (0 . "EOF"). */
static vs_status dxf_groups(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  static const char sign[] = "AutoCAD Binary DXF";
  (void)n;
  vs_text text;
  vs_text_open(vm, &text, 0);
  VS_ROOTS(vm, r, 2);
  bool ok = read_file(vm, a[0], &text), over = false;
  if (ok && text.count >= sizeof sign - 1 && !memcmp(text.at, sign, sizeof sign - 1))
    ok = broken(vm, a[0], 1, "this is a binary .dxf; save it as ASCII");
  size_t lines = 0, at = 0;
  for (size_t i = 0; ok && i < text.count; i++) lines += text.at[i] == '\n';
  ok = ok && vs_make_vector(vm, lines + 2, VS_FALSE, &r[0]);
  const char *next = text.at, *end = text.at + text.count;
  while (ok && !over) {
    line_text l, v;
    double code;
    if (!next_line(&next, end, &l)) { ok = broken(vm, a[0], at ? at : 1, "the file ends before its EOF"); break; }
    if (!line_number(l, &code) || code != floor(code) || fabs(code) > 1100) {
      ok = broken(vm, a[0], at + 1, "a group code is expected here");
      break;
    }
    if (!next_line(&next, end, &v)) { ok = broken(vm, a[0], at + 1, "the file ends within a group"); break; }
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

/* ---- XML ---- */

#define EXPAT_FUNCTIONS(F)                                                                                         \
  F(create, XML_ParserCreate, XML_Parser, (const XML_Char *))                                                      \
  F(discard, XML_ParserFree, void, (XML_Parser))                                                                   \
  F(user, XML_SetUserData, void, (XML_Parser, void *))                                                             \
  F(elements, XML_SetElementHandler, void, (XML_Parser, XML_StartElementHandler, XML_EndElementHandler))           \
  F(characters, XML_SetCharacterDataHandler, void, (XML_Parser, XML_CharacterDataHandler))                         \
  F(parse, XML_Parse, enum XML_Status, (XML_Parser, const char *, int, int))                                       \
  F(stop, XML_StopParser, enum XML_Status, (XML_Parser, XML_Bool))                                                 \
  F(line, XML_GetCurrentLineNumber, XML_Size, (XML_Parser))                                                        \
  F(error, XML_GetErrorCode, enum XML_Error, (XML_Parser))                                                         \
  F(sentence, XML_ErrorString, const XML_LChar *, (enum XML_Error))

VS_DYNAMIC_FUNCTIONS(EXPAT_FUNCTIONS);

/* events: the list that xml_events returns, newest first; text: the characters since the last tag. */
typedef struct {
  vs_scheme *vm;
  vs_value *events;
  dynamic_functions call;
  XML_Parser parser;
  vs_text text;
  bool failed;
} xml_reading;

static bool add_event(xml_reading *x, vs_value event) { return vs_cons(x->vm, event, *x->events, x->events); }

static bool add_text(xml_reading *x) {
  VS_ROOTS(x->vm, r, 1);
  bool ok = x->text.count == 0 || (vs_string_from_utf8(x->vm, x->text.at, x->text.count, &r[0]) && add_event(x, r[0]));
  x->text.count = 0;
  return ok;
}

static const char *local_name(const char *name) { /* returns the name without the prefix of its namespace */
  const char *colon = strrchr(name, ':');
  return colon ? colon + 1 : name;
}

static bool add_start(xml_reading *x, const char *name, const char **attributes) {
  vs_scheme *vm = x->vm;
  VS_ROOTS(vm, r, 2); /* roots of the garbage collector: the list, a value */
  r[0] = VS_NIL;
  size_t count = 0;
  while (attributes[count]) count += 2;
  for (size_t i = count; i > 0; i -= 2) {
    VS_ROOTS(vm, q, 1);
    if (!vs_string_from_utf8(vm, attributes[i - 1], strlen(attributes[i - 1]), &r[1]) ||
        !vs_intern(vm, attributes[i - 2], strlen(attributes[i - 2]), &q[0]) || !vs_cons(vm, q[0], r[1], &r[1]) ||
        !vs_cons(vm, r[1], r[0], &r[0]))
      return false;
  }
  name = local_name(name);
  return vs_intern(vm, name, strlen(name), &r[1]) && vs_cons(vm, r[1], r[0], &r[0]) &&
         vs_cons(vm, vs_fix((int64_t)x->call.line(x->parser)), r[0], &r[0]) && add_event(x, r[0]);
}

static void quit(xml_reading *x) {
  x->failed = true;
  x->call.stop(x->parser, XML_FALSE);
}
static void xml_start(void *user, const XML_Char *name, const XML_Char **attributes) {
  xml_reading *x = user;
  if (!x->failed && !(vs_poll(x->vm, 64) && add_text(x) && add_start(x, name, attributes))) quit(x);
}
static void xml_end(void *user, const XML_Char *name) {
  xml_reading *x = user;
  (void)name;
  if (!x->failed && !(add_text(x) && add_event(x, VS_FALSE))) quit(x);
}
static void xml_characters(void *user, const XML_Char *at, int count) {
  xml_reading *x = user;
  if (!x->failed && !vs_text_put(&x->text, at, (size_t)count)) quit(x);
}

/* Parses the text of a file. path: the file's name, a root of the garbage collector, since reading allocates. */
static bool parse_xml(xml_reading *x, const vs_value *path, const vs_text *text) {
  enum { PIECE = 1 << 20 }; /* most bytes passed to expat in one call, whose count is an int */
  x->parser = x->call.create(NULL);
  if (!x->parser) return vs_fail_memory(x->vm);
  x->call.user(x->parser, x);
  x->call.elements(x->parser, xml_start, xml_end);
  x->call.characters(x->parser, xml_characters);
  bool ok = true;
  size_t at = 0;
  do {
    size_t count = text->count - at < PIECE ? text->count - at : PIECE;
    ok = x->call.parse(x->parser, text->at + at, (int)count, at + count == text->count) == XML_STATUS_OK;
    at += count;
  } while (ok && at < text->count);
  if (!ok && !x->failed) {
    enum XML_Error error = x->call.error(x->parser);
    if (error == XML_ERROR_NO_MEMORY) vs_fail_memory(x->vm);
    else broken(x->vm, *path, (size_t)x->call.line(x->parser), x->call.sentence(error));
  }
  x->call.discard(x->parser);
  return ok && !x->failed;
}

/* Returns the list of an XML file's events in reverse order: (line name (attribute . text) ...) for
 * the start of an element, #f for its end, and a string for text. Names are symbols, without their namespaces. */
static vs_status xml_events(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  static const char *const files[] = { "libexpat.so.1", "libexpat.1.dylib", NULL };
  static const vs_dynamic_library library = { files, "libexpat1", "XML" };
  (void)n;
  vs_error e = { 0 };
  vs_text text;
  VS_ROOTS(vm, r, 1);
  r[0] = VS_NIL;
  xml_reading x = { .vm = vm, .events = &r[0] };
  if (!vs_dynamic_load(&library, dynamic_names, sizeof dynamic_names / sizeof *dynamic_names, &x.call, &e))
    return vs_fail(vm, vm->sym.file, "%s", e.message);
  vs_text_open(vm, &text, 0);
  vs_text_open(vm, &x.text, 0);
  bool ok = read_file(vm, a[0], &text) && parse_xml(&x, &a[0], &text);
  vs_text_close(&x.text);
  vs_text_close(&text);
  *out = r[0];
  return ok;
}

/* (%load-outline path): returns the groups of a .dxf file, or the events of another file, which is XML. */
static vs_status load_outline(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  vs_text path;
  vs_text_open(vm, &path, 0);
  bool ok = vs_text_string(&path, a[0]) && vs_text_end(&path);
  bool dxf = ok && path.count > 4 && strcasecmp(path.at + path.count - 4, ".dxf") == 0;
  vs_text_close(&path);
  return !ok ? VS_ERROR : dxf ? dxf_groups(vm, a, n, out) : xml_events(vm, a, n, out);
}

/* ---- lists of numbers in SVG ---- */

static bool is_separator(char c) { return c == ' ' || c == ',' || c == '\t' || c == '\n' || c == '\r' || c == '\f'; }

/* Reads a number of SVG at *at and moves *at behind it. Blanks before the number, hexadecimal numbers and infinity are
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
  while (isdigit((unsigned char)*s)) s++; /* skips digits beyond a double's precision */
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

/* (%path-tokens text): returns the list of a path's letters, as characters, and numbers, in reverse order. A fault ends
 * the list, and its first element is then #f: SVG requires that a path is drawn up to a fault. */
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

/* (%model-metres): returns the length of the model's unit in metres. */
static vs_status model_metres(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  const vs_bind *b = vm->host;
  (void)a, (void)n;
  *out = vs_flonum(vs_scene_metres(&b->scene));
  return VS_OK;
}

static const vs_native_def defs[] = {
  { "%load-outline", "path", load_outline, 0, NULL }, /* error messages show the name of this native without the % */
  { "%path-tokens", "text", path_tokens, 0, NULL },
  { "%model-metres", "", model_metres, 0, NULL },
  { 0 },
};
const vs_native_table vs_incoming_table = { "incoming", defs };
