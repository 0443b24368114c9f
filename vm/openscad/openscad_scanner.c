/* Implements the scanner of OpenSCAD. An include is a part of the text: the tokens of the other file take its place. */
#include "vm/openscad/openscad_scanner.h"

#include <string.h>

#include "vm/front/environment.h"
#include "vm/front/reader.h"
#include "vm/front/source.h"
#include "vm/library/port.h"
#include "vm/values/heap.h"
#include "vm/values/text.h"

static vs_pos place(const vs_scad_scanner *s) { return vs_cursor_place(&s->file->from); }
static int peek(const vs_scad_scanner *s, size_t ahead) { return vs_cursor_peek(&s->file->from, ahead); }
static void advance(vs_scad_scanner *s, size_t bytes) { vs_cursor_advance(&s->file->from, bytes); }
static const char *here(const vs_scad_scanner *s) { return s->file->from.text + s->file->from.at; }
static bool at_end(const vs_scad_scanner *s) { return s->file->from.at >= s->file->from.size; }

static bool refuse(vs_scad_scanner *s, vs_pos pos, const char *message) {
  return vs_fail_at(s->vm, s->vm->sym.read, pos, VS_NIL, "%s", message);
}

/* ---- files ---- */

bool vs_scad_open_text(vs_scad_scanner *s, const char *text, size_t size, uint32_t file, uint32_t line) {
  if (!vs_check_utf8(s->vm, text, size, file, line)) return false;
  vs_scad_file *f = vs_mem(s->vm, NULL, 0, sizeof *f);
  if (!f) return false;
  *f = (vs_scad_file){ s->file, { .text = text, .size = size, .file = file, .line = line, .col = 1 } };
  if (size >= 3 && !memcmp(text, "\xEF\xBB\xBF", 3)) f->from.at = 3;
  s->file = f;
  return true;
}

bool vs_scad_open_file(vs_scad_scanner *s, const char *path, uint32_t file) {
  VS_ROOTS(s->vm, r, 1);
  if (!vs_io_read_file(s->vm, path, &r[0])) return false;
  size_t size = (size_t)vs_as_bytes(r[0])->length;
  vs_scad_text *t = vs_mem(s->vm, NULL, 0, sizeof *t + size + 1);
  if (!t) return false;
  t->next = s->texts;
  t->size = size;
  memcpy(t->at, vs_as_bytes(r[0])->at, size);
  t->at[size] = 0;
  s->texts = t;
  return vs_scad_open_text(s, t->at, size, file, 1);
}

static void leave_file(vs_scad_scanner *s) {
  vs_scad_file *f = s->file;
  s->file = f->around;
  vs_mem(s->vm, f, sizeof *f, 0);
}

void vs_scad_close(vs_scad_scanner *s) {
  while (s->file) leave_file(s);
  for (vs_scad_text *t = s->texts, *next; t; t = next) {
    next = t->next;
    vs_mem(s->vm, t, sizeof *t + t->size + 1, 0);
  }
  s->texts = NULL;
}

/* Looks for the file below one folder of libraries. */
static bool find_below(vs_scheme *vm, const char *folder, size_t length, vs_value name, vs_text *path, bool *found) {
  VS_ROOTS(vm, r, 1);
  vs_text t;
  vs_text_open(vm, &t, 0);
  bool ok = vs_text_put(&t, folder, length) && vs_text_puts(&t, "/") && vs_text_string(&t, name) &&
            vs_string_from_utf8(vm, t.at, t.count, &r[0]) && vs_source_find(vm, r[0], 0, 0, path, found);
  vs_text_close(&t);
  return ok;
}

bool vs_scad_find(vs_scheme *vm, vs_value name, uint32_t from, vs_text *path, bool *found) {
  const char *(*variable)(void *, const char *) = vm->config.io ? vm->config.io->getenv : NULL;
  const char *folders = variable ? variable(vm->config.user, "OPENSCADPATH") : NULL;
  bool ok = vs_source_find(vm, name, from, 0, path, found);
  for (const char *p = folders; ok && !*found && p && *p;) {
    size_t n = strcspn(p, ":");
    if (n && *p == '/') ok = find_below(vm, p, n, name, path, found);
    p += n + (p[n] == ':');
  }
  const char *home = variable ? variable(vm->config.user, "HOME") : NULL;
  vs_text own;
  vs_text_open(vm, &own, 0);
  if (ok && !*found && home && *home == '/')
    ok = vs_text_puts(&own, home) && vs_text_puts(&own, "/.local/share/OpenSCAD/libraries") &&
         find_below(vm, own.at, own.count, name, path, found);
  vs_text_close(&own);
  return ok;
}

/* Reads the tokens of an included file next. A file that is missing is noted: the program warns of it. */
static bool include(vs_scad_scanner *s, const vs_scad_token *name) {
  VS_ROOTS(s->vm, r, 1);
  vs_text path;
  vs_text_open(s->vm, &path, 0);
  uint32_t file = 0;
  bool found = false, circle = false;
  bool ok = vs_string_from_utf8(s->vm, name->text, name->size, &r[0]) &&
            vs_scad_find(s->vm, r[0], vs_pos_file(name->pos), &path, &found) && vs_text_end(&path) &&
            (!found || vs_file_number(s->vm, path.at, path.count, &file));
  for (const vs_scad_file *f = s->file; found && f; f = f->around) if (f->from.file == file) circle = true;
  if (ok && circle) ok = refuse(s, name->pos, "this file includes itself");
  else if (ok && found) ok = vs_scad_open_file(s, path.at, file);
  else if (ok) ok = vs_cons_at(s->vm, r[0], *s->missing, name->pos, s->missing);
  vs_text_close(&path);
  return ok;
}

/* ---- blanks and comments ---- */

/* Reads a comment of several lines. A comment that contains only [name] begins a group of the customizer. */
static bool skip_comment(vs_scad_scanner *s) {
  vs_pos pos = place(s);
  advance(s, 2);
  const char *start = here(s);
  while (!at_end(s) && !(peek(s, 0) == '*' && peek(s, 1) == '/')) advance(s, 1);
  if (at_end(s)) return refuse(s, pos, "this comment is never closed: */ is missing");
  const char *end = here(s);
  advance(s, 2);
  while (start < end && (*start == ' ' || *start == '*' || *start == '\n' || *start == '\r')) start++;
  while (end > start && (end[-1] == ' ' || end[-1] == '*' || end[-1] == '\n' || end[-1] == '\r')) end--;
  if (end - start >= 2 && *start == '[' && end[-1] == ']' && s->file->from.file == s->main_file) {
    s->group = (vs_scad_group){ start + 1, (size_t)(end - start) - 2 };
  }
  return true;
}

static bool skip(vs_scad_scanner *s) {
  for (;;) {
    int c = peek(s, 0);
    if (c == '/' && peek(s, 1) == '/') while (!at_end(s) && peek(s, 0) != '\n' && peek(s, 0) != '\r') advance(s, 1);
    else if (c == '/' && peek(s, 1) == '*') { if (!skip_comment(s)) return false; }
    else if (c >= 0 && c <= ' ') advance(s, 1);
    else if (c == 0xC2 && peek(s, 1) == 0xA0) advance(s, 2); /* a space that does not break lines */
    else if (c < 0 && s->file->around) leave_file(s);
    else return true;
  }
}

/* ---- tokens ---- */

static bool is_digit(int c) { return c >= '0' && c <= '9'; }
static bool is_letter(int c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

/* Returns the number of bytes of the number at the current place, or 0 if there is none. */
static size_t number_size(const vs_scad_scanner *s) {
  size_t n = 0, digits = 0;
  while (is_digit(peek(s, n))) n++, digits++;
  if (peek(s, n) == '.') for (n++; is_digit(peek(s, n)); n++) digits++;
  if (!digits) return 0;
  int e = peek(s, n);
  if (e == 'e' || e == 'E') {
    size_t m = n + 1;
    if (peek(s, m) == '-' || peek(s, m) == '+') m++;
    if (is_digit(peek(s, m))) {
      while (is_digit(peek(s, m))) m++;
      n = m;
    }
  }
  return n;
}

static size_t name_size(const vs_scad_scanner *s) {
  size_t n = peek(s, 0) == '$';
  while (is_letter(peek(s, n)) || is_digit(peek(s, n))) n++;
  return n == 1 && peek(s, 0) == '$' ? 0 : n;
}

static size_t mark_size(const vs_scad_scanner *s) {
  static const char two[] = "&& || == != <= >= ", one[] = "+-*/%^!<>=?:;,.()[]{}#&|";
  int c = peek(s, 0), d = peek(s, 1);
  for (const char *m = two; *m; m += 3) if (c == m[0] && d == m[1]) return 2;
  return c > 0 && strchr(one, c) ? 1 : 0;
}

static bool scan_string(vs_scad_scanner *s, vs_scad_token *t) {
  advance(s, 1);
  t->kind = VS_SCAD_STRING;
  t->text = here(s);
  while (!at_end(s) && peek(s, 0) != '"') {
    if (peek(s, 0) == '\\' && peek(s, 1) >= 0) advance(s, 1);
    advance(s, 1);
  }
  if (at_end(s)) return refuse(s, t->pos, "this string is never closed: a \" is missing");
  t->size = (size_t)(here(s) - t->text);
  advance(s, 1);
  return true;
}

/* Reads the <name> after `include` or `use`. If there is none, *found is false, and the word is an ordinary name. */
static bool scan_file_name(vs_scad_scanner *s, size_t word, vs_scad_token *t, bool *found) {
  size_t n = word;
  while (peek(s, n) == ' ' || peek(s, n) == '\t' || peek(s, n) == '\n' || peek(s, n) == '\r') n++;
  *found = peek(s, n) == '<';
  if (!*found) return true;
  advance(s, n + 1);
  t->kind = VS_SCAD_USE;
  t->text = here(s);
  while (!at_end(s) && peek(s, 0) != '>' && peek(s, 0) != '\n') advance(s, 1);
  if (peek(s, 0) != '>') return refuse(s, t->pos, "> is missing after the name of this file");
  t->size = (size_t)(here(s) - t->text);
  advance(s, 1);
  return true;
}

static bool refuse_character(vs_scad_scanner *s) {
  size_t n = 1;
  while ((peek(s, n) & 0xC0) == 0x80 && peek(s, n) >= 0) n++;
  return vs_fail_at(s->vm, s->vm->sym.read, place(s), VS_NIL, "OpenSCAD has no character %.*s outside strings", (int)n,
                    here(s));
}

bool vs_scad_next(vs_scad_scanner *s, vs_scad_token *t) {
  for (;;) {
    if (!skip(s)) return false;
    const vs_text_cursor *from = &s->file->from;
    *t = (vs_scad_token){ .pos = place(s), .text = here(s), .start = from->text, .end = from->text + from->size };
    if (at_end(s)) return true;
    size_t number = number_size(s), name = name_size(s), mark = mark_size(s);
    bool found = false;
    bool includes = name == 7 && !memcmp(t->text, "include", 7), uses = name == 3 && !memcmp(t->text, "use", 3);
    if ((includes || uses) && !scan_file_name(s, name, t, &found)) return false;
    if (found && uses) return true;
    if (found) { if (!include(s, t)) return false; continue; }
    if (*t->text == '"') return scan_string(s, t);
    if (number >= name && number) t->kind = VS_SCAD_NUMBER, t->size = number;
    else if (name) t->kind = VS_SCAD_NAME, t->size = name;
    else if (mark) t->kind = VS_SCAD_MARK, t->size = mark;
    else return refuse_character(s);
    advance(s, t->size);
    return true;
  }
}

bool vs_scad_is(const vs_scad_token *t, const char *mark) {
  return t->kind == VS_SCAD_MARK && t->size == strlen(mark) && !memcmp(t->text, mark, t->size);
}

bool vs_scad_is_name(const vs_scad_token *t, const char *name) {
  return t->kind == VS_SCAD_NAME && t->size == strlen(name) && !memcmp(t->text, name, t->size);
}

/* ---- strings ---- */

/* Returns the value of the `digits` hexadecimal digits at `at`, or -1 if they are not there. */
static long hexadecimal(const char *at, const char *end, size_t digits) {
  long value = 0;
  if ((size_t)(end - at) < digits) return -1;
  for (size_t i = 0; i < digits; i++) {
    int c = at[i] | 32;
    if (is_digit(at[i])) value = value * 16 + (at[i] - '0');
    else if (c >= 'a' && c <= 'f') value = value * 16 + (c - 'a' + 10);
    else return -1;
  }
  return value;
}

/* Appends the character of the escape at `at`, after its backslash. Returns the number of bytes of the escape, or 0
 * when memory is out. */
static size_t put_escape(vs_text *t, const char *at, const char *end) {
  static const char marks[] = "nrt\\\"", meanings[] = "\n\r\t\\\"", sizes[] = "xuU";
  static const size_t digits[] = { 2, 4, 6 };
  const char *mark = strchr(marks, *at), *size = strchr(sizes, *at);
  if (*at && mark) return vs_text_put(t, &meanings[mark - marks], 1);
  if (*at && size) {
    size_t n = digits[size - sizes];
    long code = hexadecimal(at + 1, end, n);
    bool character = code > 0 && code <= 0x10FFFF && !(code >= 0xD800 && code < 0xE000) && !(n == 2 && code > 0x7F);
    if (character) return vs_text_char(t, (uint32_t)code) ? n + 1 : 0;
  }
  return vs_text_put(t, "\\", 1) && vs_text_put(t, at, 1);
}

bool vs_scad_string(vs_scheme *vm, const vs_scad_token *token, vs_value *out) {
  vs_text t;
  vs_text_open(vm, &t, 0);
  const char *end = token->text + token->size;
  bool ok = true;
  for (const char *at = token->text; ok && at < end;) {
    size_t n = (size_t)(end - at);
    const char *backslash = memchr(at, '\\', n);
    ok = vs_text_put(&t, at, backslash ? (size_t)(backslash - at) : n);
    at = backslash ? backslash + 1 : end;
    if (backslash && ok && at < end) {
      size_t used = put_escape(&t, at, end);
      ok = used > 0;
      at += used;
    }
  }
  ok = ok && vs_string_from_utf8(vm, t.at ? t.at : "", t.count, out);
  vs_text_close(&t);
  if (ok) vs_object_of(*out)->flags |= VS_F_IMMUTABLE;
  return ok;
}
