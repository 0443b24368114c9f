/* Implements the procedures that print: display, write and similar, format and printf. Each procedure first creates its
 * complete text and then passes it to the port. An error or interrupt therefore never leaves a partial text. */
#include <math.h>
#include <stdio.h>

#include "vm/library/format.h"
#include "vm/library/string.h"
#include "vm/machine/fail.h"
#include "vm/numbers/number.h"
#include "vm/library/port.h"
#include "vm/numbers/number_text.h"
#include "vm/values/heap.h"
#include "vm/values/string_chars.h"

/* Sets *port to argument i or, if it is absent, to the current output port. Checks that it is an output port of this
 * kind. */
static bool out_port(vs_scheme *vm, const vs_value *a, int n, int i, uint32_t kind, vs_value *port) {
  *port = n > i ? a[i] : vs_port_current_output(vm);
  if (!vs_is(*port, VS_T_PORT)) return n > i ? vs_fail_type(vm, i, "an output port", *port) : false;
  uint32_t flags = vs_as_port(*port)->flags;
  if (!(flags & VS_PORT_OUTPUT)) return vs_fail_type(vm, i, "an output port", *port);
  if ((flags & VS_PORT_BINARY) != kind) return vs_fail_type(vm, i, kind ? "a binary port" : "a textual port", *port);
  return !(flags & VS_PORT_CLOSED) || vs_fail_type(vm, i, "an open port", *port);
}

static bool flush_text(vs_scheme *vm, vs_value port, vs_text *t, bool ok) {
  ok = ok && vs_port_write(vm, port, t->at, t->count);
  vs_text_close(t);
  return ok;
}

static vs_status print(vs_scheme *vm, vs_value *a, int n, vs_print_mode mode, bool newline) {
  VS_ROOTS(vm, r, 1);
  if (!out_port(vm, a, n, 1, 0, &r[0])) return VS_ERROR;
  vs_text t;
  vs_text_open(vm, &t, 0);
  return flush_text(vm, r[0], &t, vs_print(vm, a[0], mode, &t) && (!newline || vs_text_put(&t, "\n", 1)));
}
static vs_status display(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)out, print(vm, a, n, VS_PRINT_DISPLAY, false);
}
static vs_status displayln(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)out, print(vm, a, n, VS_PRINT_DISPLAY, true);
}
static vs_status write_(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)out, print(vm, a, n, VS_PRINT_WRITE, false);
}
static vs_status writeln(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)out, print(vm, a, n, VS_PRINT_WRITE, true);
}
static vs_status write_simple(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)out, print(vm, a, n, VS_PRINT_SIMPLE, false);
}
static vs_status write_shared(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)out, print(vm, a, n, VS_PRINT_SHARED, false);
}

static vs_status newline(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)out;
  vs_value port;
  return out_port(vm, a, n, 0, 0, &port) && vs_port_write(vm, port, "\n", 1);
}

static vs_status fresh_line(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)out;
  vs_value port;
  return out_port(vm, a, n, 0, 0, &port) && (vs_as_port(port)->col == 1 || vs_port_write(vm, port, "\n", 1));
}

static vs_status write_char(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)out;
  vs_value port;
  char s[4];
  if (!vs_is_char(a[0])) return vs_fail_type(vm, 0, "a character", a[0]);
  return out_port(vm, a, n, 1, 0, &port) && vs_port_write(vm, port, s, vs_utf8_encode(vs_char(a[0]), s));
}

static vs_status write_string(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)out;
  VS_ROOTS(vm, r, 2);
  if (!vs_arg_type(vm, a, 0, VS_T_STRING) || !out_port(vm, a, n, 1, 0, &r[0])) return VS_ERROR;
  int64_t length = vs_as_string(a[0])->length, start = 0, end = length;
  if ((n > 3 && !vs_arg_index(vm, a, 3, 0, length, &end)) || (n > 2 && !vs_arg_index(vm, a, 2, 0, end, &start)))
    return VS_ERROR;
  r[1] = a[0];
  if (n > 2 && !vs_string_slice(vm, &a[0], (size_t)start, (size_t)end, &r[1])) return VS_ERROR;
  vs_text t;
  vs_text_open(vm, &t, 0);
  return flush_text(vm, r[0], &t, vs_text_string(&t, r[1]));
}

static vs_status write_u8(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)out;
  vs_value port;
  int64_t byte;
  if (!vs_arg_index(vm, a, 0, 0, 255, &byte) || !out_port(vm, a, n, 1, VS_PORT_BINARY, &port)) return VS_ERROR;
  char c = (char)byte;
  return vs_port_write(vm, port, &c, 1);
}

static vs_status write_bytevector(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)out;
  vs_value port;
  if (!vs_arg_type(vm, a, 0, VS_T_BYTES) || !out_port(vm, a, n, 1, VS_PORT_BINARY, &port)) return VS_ERROR;
  int64_t length = (int64_t)vs_as_bytes(a[0])->length, start = 0, end = length;
  if ((n > 3 && !vs_arg_index(vm, a, 3, 0, length, &end)) || (n > 2 && !vs_arg_index(vm, a, 2, 0, end, &start)))
    return VS_ERROR;
  vs_text t;                                      /* copies the bytes, since writing to the port may allocate, which
                                                   * moves bytevectors */
  vs_text_open(vm, &t, 0);
  return flush_text(vm, port, &t, vs_text_put(&t, (const char *)vs_as_bytes(a[0])->at + start, (size_t)(end - start)));
}

/* ---- formatted output ---- */

/* The field of a directive between ~ and the letter, as in ~8a, ~8@a, ~2,'0d and ~8,2f; -1 means not given. */
typedef struct { int64_t width, decimals; uint32_t pad; bool before; } format_field;

enum { WIDEST = 10000, MOST_DECIMALS = 100 };

/* Reads a number or 'c (a padding character) at position *i of the control string. Returns false if there is
 * neither. */
static bool format_parameter(vs_value control, size_t *i, size_t length, int64_t *number, uint32_t *pad) {
  if (*i + 1 < length && vs_string_at(control, *i) == '\'') {
    *pad = vs_string_at(control, *i + 1);
    *i += 2;
    return true;
  }
  size_t first = *i;
  int64_t n = 0;
  for (; *i < length && vs_string_at(control, *i) >= '0' && vs_string_at(control, *i) <= '9'; ++*i)
    if (n < WIDEST * 10) n = 10 * n + (int64_t)vs_string_at(control, *i) - '0';
  if (*i == first) return false;
  *number = n;
  return true;
}

static format_field format_field_at(vs_value control, size_t *i, size_t length) {
  format_field f = {-1, -1, ' ', false};
  format_parameter(control, i, length, &f.width, &f.pad);
  if (*i < length && vs_string_at(control, *i) == ',') {
    ++*i;
    format_parameter(control, i, length, &f.decimals, &f.pad);
  }
  if (*i < length && vs_string_at(control, *i) == '@') { f.before = true; ++*i; }
  return f;
}

/* Writes a number rounded to `decimals` digits after the point, as in ~8,2f. If decimals is -1, writes it as `display`
 * does. */
static bool format_fixed(vs_scheme *vm, vs_value v, int64_t decimals, vs_text *t) {
  double d;
  if (!vs_number_double(vm, v, &d)) return false;
  if (decimals < 0 || !isfinite(d)) return vs_number_print(vm, v, 10, t);
  char text[512];
  int n = snprintf(text, sizeof text, "%.*f", (int)decimals, d);
  const char *shown = text;
  if (*shown == '-' && strspn(shown + 1, "0.") == strlen(shown + 1)) shown++;      /* -0.00 is written as 0.00 */
  return n > 0 && (size_t)n < sizeof text && vs_text_puts(t, shown);
}

static bool format_number(vs_scheme *vm, vs_value v, char directive, const format_field *f, vs_text *t) {
  VS_ROOTS(vm, r, 1);
  r[0] = v;
  if (directive == 'f' && vs_is_number(v)) return format_fixed(vm, v, f->decimals, t);
  if (!vs_is_number(v))
    return vs_cons(vm, v, VS_NIL, &r[0]) && vs_fail_with(vm, vm->sym.type, r[0], "~%c needs a number, got", directive);
  double d;
  if (directive == 'e') return vs_number_double(vm, v, &d) && vs_number_print(vm, vs_flonum(d), 10, t);
  return vs_number_print(vm, v, directive == 'b' ? 2 : directive == 'o' ? 8 : 16, t);
}

/* Appends the control string a[control] to t. The arguments after it replace its directives. */
bool vs_format(vs_scheme *vm, const vs_value *a, int control, int n, size_t brief, vs_text *t) {
  size_t length = vs_as_string(a[control])->length;
  int next = control + 1;
  VS_ASSERT(control < n);
  for (size_t i = 0; i < length; i++) {
    uint32_t c = vs_string_at(a[control], i);
    if (c != '~') {
      if (!vs_text_char(t, c)) return false;
      continue;
    }
    if (++i == length) return vs_fail(vm, vm->sym.error, "the format ends in ~");
    format_field field = format_field_at(a[control], &i, length);
    if (i == length) return vs_fail(vm, vm->sym.error, "the format ends within a directive");
    if (field.width > WIDEST) return vs_fail(vm, vm->sym.error, "a field of the format may be up to %d wide", WIDEST);
    if (field.decimals > MOST_DECIMALS)
      return vs_fail(vm, vm->sym.error, "a number of the format may have up to %d decimals", MOST_DECIMALS);
    uint32_t directive = vs_string_at(a[control], i);
    char d = (char)(directive >= 'A' && directive <= 'Z' ? directive + 32 : directive < 0x80 ? directive : '?');
    if (d == '%' || d == 'n' || d == '~') {
      if (!vs_text_put(t, d == '~' ? "~" : "\n", 1)) return false;
      continue;
    }
    if (d == '\n' || d == ' ') {                  /* omits the line end and the blanks that begin the next line */
      while (i + 1 < length && (vs_string_at(a[control], i + 1) == ' ' || vs_string_at(a[control], i + 1) == '\n')) i++;
      continue;
    }
    if (!strchr("adswvcboxef", d))
      return vs_fail(vm, vm->sym.error,
                     "unknown directive ~%c in the format; there are ~a ~s ~d ~f ~v ~c ~b ~o ~x ~e ~n ~%% ~~", d);
    if (next >= n)
      return vs_fail(vm, vm->sym.error, "the format has more directives than there are values (%d)", n - control - 1);
    vs_value v = a[next++];
    const size_t limit = d == 's' ? brief : 0;
    vs_text own, *to = field.width > 0 || limit ? &own : t;
    vs_text_open(vm, &own, limit);
    bool number = strchr("boxef", d) != NULL;
    bool ok = number ? format_number(vm, v, d, &field, to)
                     : vs_print(vm, v, d == 'a' || d == 'd' || d == 'c' ? VS_PRINT_DISPLAY : VS_PRINT_WRITE, to);
    /* Aligns numbers to the right and other values to the left; with @ in the directive, the other way round. */
    if (ok && to == &own) {
      int64_t shown = 0;
      for (size_t k = 0; k < own.count; k++) shown += ((unsigned char)own.at[k] & 0xC0) != 0x80;
      bool before = field.before || number || d == 'd';
      for (int64_t k = shown; ok && before && k < field.width; k++) ok = vs_text_char(t, field.pad);
      ok = ok && (!own.count || vs_text_put(t, own.at, own.count)) && (!own.cut || vs_text_puts(t, " ..."));
      for (int64_t k = shown; ok && !before && k < field.width; k++) ok = vs_text_char(t, field.pad);
    }
    vs_text_close(&own);
    if (!ok) return false;
  }
  if (next < n)
    return vs_fail(vm, vm->sym.error, "the format uses %d of the %d values", next - control - 1, n - control - 1);
  return true;
}

/* (format "..." v ...) and (format #f "..." v ...) return a string; (format #t ...) and (format port ...) print. */
static vs_status format(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  VS_ROOTS(vm, r, 1);
  int control = vs_is_string(a[0]) ? 0 : 1;
  if (n <= control || !vs_is_string(a[control]))
    return vs_fail_type(vm, control, "a string", n > control ? a[control] : a[0]);
  if (control && a[0] != VS_FALSE && !out_port(vm, a, a[0] == VS_TRUE ? 0 : 1, 0, 0, &r[0])) return VS_ERROR;
  vs_text t;
  vs_text_open(vm, &t, 0);
  if (control && a[0] != VS_FALSE) return flush_text(vm, r[0], &t, vs_format(vm, a, control, n, 0, &t));
  bool ok = vs_format(vm, a, control, n, 0, &t) && vs_text_to_string(&t, out);
  vs_text_close(&t);
  return ok;
}

static vs_status printf_(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)out;
  VS_ROOTS(vm, r, 1);
  vs_text t;
  if (!vs_arg_type(vm, a, 0, VS_T_STRING) || !out_port(vm, a, 0, 0, 0, &r[0])) return VS_ERROR;
  vs_text_open(vm, &t, 0);
  return flush_text(vm, r[0], &t, vs_format(vm, a, 0, n, 0, &t));
}

static vs_status fprintf_(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)out;
  VS_ROOTS(vm, r, 1);
  vs_text t;
  if (!out_port(vm, a, n, 0, 0, &r[0]) || !vs_arg_type(vm, a, 1, VS_T_STRING)) return VS_ERROR;
  vs_text_open(vm, &t, 0);
  return flush_text(vm, r[0], &t, vs_format(vm, a, 1, n, 0, &t));
}

/* ---- opening output ports ---- */

static vs_status open_output(vs_scheme *vm, vs_value *a, uint32_t flags, vs_io_mode mode, vs_value *out) {
  return vs_arg_type(vm, a, 0, VS_T_STRING) && vs_port_open_file(vm, a[0], mode, VS_PORT_OUTPUT | flags, out);
}
static vs_status open_output_file(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)n, open_output(vm, a, 0, VS_IO_WRITE, out);
}
static vs_status open_append_file(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)n, open_output(vm, a, 0, VS_IO_APPEND, out);
}
static vs_status open_binary_output_file(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)n, open_output(vm, a, VS_PORT_BINARY, VS_IO_WRITE, out);
}

static vs_status open_output_string(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)a, (void)n, vs_port_open_text(vm, out);
}
static vs_status open_output_bytevector(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)a, (void)n;
  if (!vs_port_open_text(vm, out)) return VS_ERROR;
  vs_as_port(*out)->flags |= VS_PORT_BINARY;
  return VS_OK;
}

static bool want_collector(vs_scheme *vm, const vs_value *a, uint32_t kind, const char *what) {
  return (vs_is(a[0], VS_T_PORT) && (vs_as_port(a[0])->flags & VS_PORT_STRING) &&
          (vs_as_port(a[0])->flags & VS_PORT_OUTPUT) && (vs_as_port(a[0])->flags & VS_PORT_BINARY) == kind) ||
         vs_fail_type(vm, 0, what, a[0]);
}

static vs_status get_output_string(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!want_collector(vm, a, 0, "a port from open-output-string")) return VS_ERROR;
  vs_text t;                                      /* copies the text, since creating the string may move the buffer */
  vs_text_open(vm, &t, 0);
  const vs_port *p = vs_as_port(a[0]);
  bool ok = (p->position == 0 || vs_text_put(&t, (const char *)vs_as_bytes(p->buffer)->at, p->position)) &&
            vs_text_to_string(&t, out);
  vs_text_close(&t);
  return ok;
}

static vs_status get_output_bytevector(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!want_collector(vm, a, VS_PORT_BINARY, "a port from open-output-bytevector") ||
      !vs_make_bytes(vm, vs_as_port(a[0])->position, out))
    return VS_ERROR;
  const vs_port *p = vs_as_port(a[0]);
  if (p->position) memcpy(vs_as_bytes(*out)->at, vs_as_bytes(p->buffer)->at, p->position);
  return VS_OK;
}

static vs_status flush_output_port(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)out;
  vs_value port = n ? a[0] : vs_port_current_output(vm);
  if (!vs_is(port, VS_T_PORT)) return vs_fail_type(vm, 0, "an output port", port);
  const vs_io *io = vm->config.io;
  if (vs_as_port(port)->host < 0 || !io || !io->flush || io->flush(vm->config.user, vs_as_port(port)->host))
    return VS_OK;
  return vs_fail(vm, vm->sym.file, "writing failed");
}

static const vs_native_def defs[] = {
    {"display", "x [port]", display, 0, "print x for people"},
    {"displayln", "x [port]", displayln, 0, "display x and end the line"},
    {"write", "x [port]", write_, 0, "print x so that read reads it again, cycles with labels"},
    {"writeln", "x [port]", writeln, 0, "write x and end the line"},
    {"print", "x [port]", write_, 0, NULL},
    {"pretty-print", "x [port]", writeln, 0, NULL},
    {"write-simple", "x [port]", write_simple, 0, NULL},
    {"write-shared", "x [port]", write_shared, 0, NULL},
    {"newline", "[port]", newline, 0, NULL},
    {"fresh-line", "[port]", fresh_line, 0, "a newline unless the line is empty"},
    {"write-char", "char [port]", write_char, 0, NULL},
    {"write-string", "string [port start end]", write_string, 0, NULL},
    {"write-u8", "byte [port]", write_u8, 0, NULL},
    {"write-bytevector", "bytevector [port start end]", write_bytevector, 0, NULL},
    {"format", "control . values", format, 0, "a string: control with ~a ~s ... filled in"},
    {"printf", "control . values", printf_, 0, "print control with ~a ~s ... filled in"},
    {"fprintf", "port control . values", fprintf_, 0, NULL},
    {"open-output-file %write-json", "name", open_output_file, 0, NULL},
    {"open-append-file", "name", open_append_file, 0, NULL},
    {"open-binary-output-file", "name", open_binary_output_file, 0, NULL},
    {"open-output-string", "", open_output_string, 0, NULL},
    {"open-output-bytevector", "", open_output_bytevector, 0, NULL},
    {"get-output-string", "port", get_output_string, 0, NULL},
    {"get-output-bytevector", "port", get_output_bytevector, 0, NULL},
    {"flush-output-port flush-output", "[port]", flush_output_port, 0, NULL},
    {NULL, NULL, NULL, 0, NULL},
};
const vs_native_table vs_output_natives = {"output", defs};
