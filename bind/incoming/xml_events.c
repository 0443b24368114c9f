/* Takes an XML file apart into Scheme data with the library expat, which is loaded when it is first used. */
#include "bind/incoming/xml_events.h"

#include <expat.h>
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

/* events: the list that the native returns, newest first; text: the characters since the last tag. */
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
  VS_ROOTS(vm, r, 2); /* roots: the list, a value */
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

/* Parses the text of a file. path: its name, a root, since reading allocates. */
static bool parse_xml(xml_reading *x, const vs_value *path, const vs_text *text) {
  enum { PIECE = 1 << 20 }; /* expat takes at most an int of bytes at a time */
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
    else vs_incoming_broken(x->vm, *path, (size_t)x->call.line(x->parser), x->call.sentence(error));
  }
  x->call.discard(x->parser);
  return ok && !x->failed;
}

vs_status vs_xml_events(vs_scheme *vm, vs_value path, vs_value *out) {
  static const char *const files[] = { "libexpat.so.1", "libexpat.1.dylib", NULL };
  static const vs_dynamic_library library = { files, "libexpat1", "XML" };
  vs_error e = { 0 };
  vs_text text;
  VS_ROOTS(vm, r, 2); /* roots: the events, the path */
  r[0] = VS_NIL, r[1] = path;
  xml_reading x = { .vm = vm, .events = &r[0] };
  if (!vs_dynamic_load(&library, dynamic_names, sizeof dynamic_names / sizeof *dynamic_names, &x.call, &e))
    return vs_fail(vm, vm->sym.file, "%s", e.message);
  vs_text_open(vm, &text, 0);
  vs_text_open(vm, &x.text, 0);
  bool ok = vs_incoming_read(vm, path, &text) && parse_xml(&x, &r[1], &text);
  vs_text_close(&x.text);
  vs_text_close(&text);
  *out = r[0];
  return ok;
}
