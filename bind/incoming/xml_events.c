/* Converts an XML file to Scheme data with the library expat, which is loaded when it is first used. */
#include "bind/incoming/xml_events.h"

#include <expat.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bind/incoming/file_texts.h"
#include "geometry/dynamic.h"
#include "vm/machine/run.h"
#include "vm/values/heap.h"

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

/* State of reading an XML file. The list `events` is the result, newest first. The path is a root of the garbage
 * collector. The text contains the characters since the last tag. If meshes is true, `numbers` collects vertices and
 * triangles. */
typedef struct {
  vs_scheme *vm;
  vs_value *events;
  const vs_value *path;
  bool meshes;
  vs_text numbers;
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
  VS_ROOTS(vm, r, 2); /* roots of the garbage collector: the list of events, a value */
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

/* ---- the numbers of a mesh ---- */

static bool is_number_element(const xml_reading *x, const char *name) {
  name = local_name(name);
  return x->meshes && (!strcmp(name, "vertex") || !strcmp(name, "triangle"));
}

/* Adds the number in the attribute `name`. If the attribute is missing, adds `absent`, or sets the error if absent is
 * NAN. */
static bool add_number(xml_reading *x, const char **attributes, const char *name, double absent) {
  double d = absent;
  size_t i = 0;
  while (attributes[i] && strcmp(attributes[i], name)) i += 2;
  if (attributes[i]) {
    const char *text = attributes[i + 1];
    char *end;
    d = *text && strspn(text, "+-.0123456789eE \t\n\r") == strlen(text) ? strtod(text, &end) : NAN;
    if (!isnan(d) && end[strspn(end, " \t\n\r")]) d = NAN;
  }
  if (!isfinite(d)) {
    char why[64];
    snprintf(why, sizeof why, "the attribute %s must be a number", name);
    return vs_incoming_broken(x->vm, *x->path, (size_t)x->call.line(x->parser), why);
  }
  return vs_text_put(&x->numbers, (const char *)&d, sizeof d);
}

static bool add_numbers(xml_reading *x, const char *name, const char **attributes) {
  if (!strcmp(local_name(name), "vertex"))
    return add_number(x, attributes, "x", NAN) && add_number(x, attributes, "y", NAN) &&
           add_number(x, attributes, "z", NAN);
  return add_number(x, attributes, "v1", NAN) && add_number(x, attributes, "v2", NAN) &&
         add_number(x, attributes, "v3", NAN) && add_number(x, attributes, "pid", -1) &&
         add_number(x, attributes, "p1", -1);
}

/* Adds an event with the numbers that were collected since the last such event. */
static bool add_collected(xml_reading *x) {
  VS_ROOTS(x->vm, r, 1);
  if (!vs_make_bytes(x->vm, x->numbers.count, &r[0])) return false;
  if (x->numbers.count) memcpy(vs_as_bytes(r[0])->at, x->numbers.at, x->numbers.count);
  x->numbers.count = 0;
  return add_event(x, r[0]);
}

/* ---- callbacks ---- */

static void quit(xml_reading *x) {
  x->failed = true;
  x->call.stop(x->parser, XML_FALSE);
}
static void xml_start(void *user, const XML_Char *name, const XML_Char **attributes) {
  xml_reading *x = user;
  bool numbers = is_number_element(x, name);
  if (x->failed) return;
  x->text.count = numbers ? 0 : x->text.count; /* between the elements of a mesh there are only blanks */
  if (!(vs_poll(x->vm, 64) && add_text(x) &&
        (numbers ? add_numbers(x, name, attributes) : add_start(x, name, attributes))))
    quit(x);
}
static void xml_end(void *user, const XML_Char *name) {
  xml_reading *x = user;
  if (x->failed || is_number_element(x, name)) return;
  name = local_name(name);
  bool last = x->meshes && (!strcmp(name, "vertices") || !strcmp(name, "triangles"));
  if (!(add_text(x) && (!last || add_collected(x)) && add_event(x, VS_FALSE))) quit(x);
}
static void xml_characters(void *user, const XML_Char *at, int count) {
  xml_reading *x = user;
  if (!x->failed && !vs_text_put(&x->text, at, (size_t)count)) quit(x);
}

static bool parse_xml(xml_reading *x, const vs_text *text) {
  enum { PIECE = 1 << 20 }; /* expat accepts fewer than 2^31 bytes in one call */
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
    else vs_incoming_broken(x->vm, *x->path, (size_t)x->call.line(x->parser), x->call.sentence(error));
  }
  x->call.discard(x->parser);
  return ok && !x->failed;
}

vs_status vs_xml_text_events(vs_scheme *vm, vs_value path, const vs_text *text, bool meshes, vs_value *out) {
  vs_error e = { 0 };
  VS_ROOTS(vm, r, 2); /* roots of the garbage collector: the events, the path */
  r[0] = VS_NIL, r[1] = path;
  xml_reading x = { .vm = vm, .events = &r[0], .path = &r[1], .meshes = meshes };
  if (!vs_dynamic_load(VS_LIBRARY_EXPAT, "XML", dynamic_names, sizeof dynamic_names / sizeof *dynamic_names, &x.call,
                       &e))
    return vs_fail(vm, vm->sym.file, "%s", e.message);
  vs_text_open(vm, &x.text, 0);
  vs_text_open(vm, &x.numbers, 0);
  bool ok = parse_xml(&x, text);
  vs_text_close(&x.text);
  vs_text_close(&x.numbers);
  *out = r[0];
  return ok;
}

vs_status vs_xml_events(vs_scheme *vm, vs_value path, vs_value *out) {
  vs_text text;
  VS_ROOTS(vm, r, 1);
  r[0] = path;
  vs_text_open(vm, &text, 0);
  bool ok = vs_incoming_read(vm, r[0], &text) && vs_xml_text_events(vm, r[0], &text, false, out);
  vs_text_close(&text);
  return ok;
}
