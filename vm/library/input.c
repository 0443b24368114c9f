/* Implements the procedures that read characters, lines, bytes and data from ports, and those that test ports and
 * files. */
#include "vm/machine/fail.h"
#include "vm/numbers/number.h"
#include "vm/library/port.h"
#include "vm/front/reader.h"
#include "vm/front/scan.h"
#include "vm/values/heap.h"

static bool in_port(vs_scheme *vm, const vs_value *a, int n, int i, uint32_t kind, vs_value *port) {
  *port = n > i ? a[i] : vs_port_current_input(vm);
  if (!vs_is(*port, VS_T_PORT)) return n > i ? vs_fail_type(vm, i, "an input port", *port) : false;
  uint32_t flags = vs_as_port(*port)->flags;
  if (!(flags & VS_PORT_INPUT)) return vs_fail_type(vm, i, "an input port", *port);
  if ((flags & VS_PORT_BINARY) != kind) return vs_fail_type(vm, i, kind ? "a binary port" : "a textual port", *port);
  return !(flags & VS_PORT_CLOSED) || vs_fail_type(vm, i, "an open port", *port);
}

/* ---- reading text ---- */

static vs_status read_char(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  vs_value port;
  int32_t c;
  if (!in_port(vm, a, n, 0, 0, &port) || !vs_port_read_char(vm, port, &c)) return VS_ERROR;
  *out = c < 0 ? VS_EOF : VS_CHAR(c);
  return VS_OK;
}

static vs_status peek_char(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  vs_value port;
  int32_t c;
  if (!in_port(vm, a, n, 0, 0, &port) || !vs_port_peek_char(vm, port, &c)) return VS_ERROR;
  *out = c < 0 ? VS_EOF : VS_CHAR(c);
  return VS_OK;
}

/* Reads up to `count` characters from the port. If `line` is true, ends after the next line end (\n, \r or both in this
 * order), which the result does not contain. */
static vs_status read_some(vs_scheme *vm, vs_value port, int64_t count, bool line, vs_value *out) {
  VS_ROOTS(vm, r, 1);
  r[0] = port;
  vs_text t;
  vs_text_open(vm, &t, 0);
  bool ok = true, any = false;
  for (int64_t i = 0; ok && i < count; i++) {
    int32_t c;
    if (!(ok = vs_port_read_char(vm, r[0], &c)) || c < 0) break;
    any = true;
    if (line && c == '\n') break;
    if (line && c == '\r') {
      if ((ok = vs_port_peek_char(vm, r[0], &c)) && c == '\n') ok = vs_port_read_char(vm, r[0], &c);
      break;
    }
    ok = vs_text_char(&t, (uint32_t)c) && ((i & 1023) || vs_poll(vm, 1024));
  }
  ok = ok && (any || count == 0 ? vs_text_to_string(&t, out) : (*out = VS_EOF, true));
  vs_text_close(&t);
  return ok;
}

static vs_status read_line(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  vs_value port;
  return in_port(vm, a, n, 0, 0, &port) && read_some(vm, port, INT64_MAX, true, out);
}

static vs_status read_string(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  vs_value port;
  int64_t k;
  /* The port may also be the first of the two arguments, as in PLT Scheme and older systems. */
  if (n == 2 && vs_is(a[0], VS_T_PORT)) {
    vs_value swap = a[0];
    a[0] = a[1], a[1] = swap;
  }
  return vs_arg_index(vm, a, 0, 0, VS_FIXNUM_MAX, &k) && in_port(vm, a, n, 1, 0, &port) &&
         read_some(vm, port, k, false, out);
}

/* Sets VS_PORT_FOLD in the port's flags by the directives at the start of the text (#!fold-case, #!no-fold-case), since
 * they also apply to later reads from the port. */
static void keep_directives(const vs_text *t, uint32_t *flags) {
  static const struct {
    const char *text;
    bool fold;
  } directives[] = { { "#!fold-case", true }, { "#!no-fold-case", false } };
  for (size_t i = 0; i < t->count;) {
    size_t n = t->at[i] <= ' ' && t->at[i] > 0;
    for (size_t k = 0; !n && k < 2; k++) {
      size_t length = strlen(directives[k].text);
      if (t->count - i < length || memcmp(t->at + i, directives[k].text, length)) continue;
      *flags = directives[k].fold ? *flags | VS_PORT_FOLD : *flags & ~(uint32_t)VS_PORT_FOLD;
      n = length;
    }
    if (!n) break;
    i += n;
  }
}

/* Implements read: reads characters until a datum is complete. If these characters are only a directive (#!fold-case),
 * continues to read. */
static vs_status read_(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  VS_ROOTS(vm, r, 1);
  if (!in_port(vm, a, n, 0, 0, &r[0])) return VS_ERROR;
  vs_text t;
  vs_text_open(vm, &t, 0);
  bool ok = !(vs_as_port(r[0])->flags & VS_PORT_FOLD) || vs_text_puts(&t, "#!fold-case "), end = false;
  for (*out = VS_EOF; ok && !end && *out == VS_EOF;) {
    vs_scan s;
    vs_scan_open(vm, &s);
    for (vs_scan_result result = VS_SCAN_MORE; ok && result == VS_SCAN_MORE;) {
      int32_t c;
      if (!(ok = vs_port_peek_char(vm, r[0], &c)) || (end = c < 0)) break;
      ok = vs_scan_feed(&s, (uint32_t)c, &result);
      if (ok && result != VS_SCAN_WHOLE)
        ok = vs_port_read_char(vm, r[0], &c) && vs_text_char(&t, (uint32_t)c) && vs_poll(vm, 64);
    }
    vs_scan_close(&s);
    ok = ok && vs_read_datum(vm, t.at ? t.at : "", t.count, out, NULL);
    keep_directives(&t, &vs_as_port(r[0])->flags);
  }
  vs_text_close(&t);
  return ok;
}

/* ---- reading bytes ---- */

static vs_status next_u8(vs_scheme *vm, vs_value *a, int n, bool take, vs_value *out) {
  VS_ROOTS(vm, r, 1);
  const uint8_t *at;
  size_t count;
  if (!in_port(vm, a, n, 0, VS_PORT_BINARY, &r[0]) || !vs_port_fill(vm, r[0], 1, &at, &count)) return VS_ERROR;
  *out = count ? vs_fix(*at) : VS_EOF;
  if (count && take) vs_as_port(r[0])->position++;
  return VS_OK;
}
static vs_status read_u8(vs_scheme *vm, vs_value *a, int n, vs_value *out) { return next_u8(vm, a, n, true, out); }
static vs_status peek_u8(vs_scheme *vm, vs_value *a, int n, vs_value *out) { return next_u8(vm, a, n, false, out); }

static vs_status read_bytevector(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  VS_ROOTS(vm, r, 1);
  int64_t k;
  const uint8_t *at;
  size_t count;
  if (!vs_arg_index(vm, a, 0, 0, VS_FIXNUM_MAX, &k) || !in_port(vm, a, n, 1, VS_PORT_BINARY, &r[0])) return VS_ERROR;
  if (!vs_port_fill(vm, r[0], (size_t)k, &at, &count)) return VS_ERROR;
  if (count > (size_t)k) count = (size_t)k;
  if (count == 0 && k > 0) return *out = VS_EOF, VS_OK;
  if (!vs_make_bytes(vm, count, out)) return VS_ERROR;
  vs_port *p = vs_as_port(r[0]);
  if (count) memcpy(vs_as_bytes(*out)->at, vs_as_bytes(p->buffer)->at + p->position, count);
  p->position += count;
  return VS_OK;
}

static vs_status read_bytevector_into(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  VS_ROOTS(vm, r, 1);
  const uint8_t *at;
  size_t count;
  if (!vs_arg_type(vm, a, 0, VS_T_BYTES) || !in_port(vm, a, n, 1, VS_PORT_BINARY, &r[0])) return VS_ERROR;
  int64_t length = (int64_t)vs_as_bytes(a[0])->length, start = 0, end = length;
  if ((n > 3 && !vs_arg_index(vm, a, 3, 0, length, &end)) || (n > 2 && !vs_arg_index(vm, a, 2, 0, end, &start)))
    return VS_ERROR;
  if (!vs_port_fill(vm, r[0], (size_t)(end - start), &at, &count)) return VS_ERROR;
  if (count > (size_t)(end - start)) count = (size_t)(end - start);
  if (count) memcpy(vs_as_bytes(a[0])->at + start, at, count);
  vs_as_port(r[0])->position += count;
  *out = count || end == start ? vs_fix((int64_t)count) : VS_EOF;
  return VS_OK;
}

static vs_status char_ready(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  vs_value port;
  return *out = VS_TRUE, in_port(vm, a, n, 0, 0, &port);
}
static vs_status u8_ready(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  vs_value port;
  return *out = VS_TRUE, in_port(vm, a, n, 0, VS_PORT_BINARY, &port);
}

/* ---- opening and testing ports ---- */

static vs_status open_input_file(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  return vs_arg_type(vm, a, 0, VS_T_STRING) && vs_port_open_file(vm, a[0], VS_IO_READ, VS_PORT_INPUT, out);
}
static vs_status open_binary_input_file(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  return vs_arg_type(vm, a, 0, VS_T_STRING) &&
         vs_port_open_file(vm, a[0], VS_IO_READ, VS_PORT_INPUT | VS_PORT_BINARY, out);
}

static vs_status open_input_string(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  VS_ROOTS(vm, r, 1);
  if (!vs_arg_type(vm, a, 0, VS_T_STRING)) return VS_ERROR;
  vs_text t;
  vs_text_open(vm, &t, 0);
  bool ok = vs_text_string(&t, a[0]) && vs_make_bytes(vm, t.count, &r[0]);
  if (ok && t.count) memcpy(vs_as_bytes(r[0])->at, t.at, t.count);
  ok = ok && vs_port_open_bytes(vm, r[0], t.count, VS_PORT_STRING, out);
  vs_text_close(&t);
  return ok;
}

static vs_status open_input_bytevector(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  VS_ROOTS(vm, r, 1);
  if (!vs_arg_type(vm, a, 0, VS_T_BYTES)) return VS_ERROR;
  size_t count = vs_as_bytes(a[0])->length;
  if (!vs_make_bytes(vm, count, &r[0])) return VS_ERROR;
  if (count) memcpy(vs_as_bytes(r[0])->at, vs_as_bytes(a[0])->at, count);
  return vs_port_open_bytes(vm, r[0], count, VS_PORT_STRING | VS_PORT_BINARY, out);
}

static vs_status close_port(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n, (void)out;
  return vs_arg_type(vm, a, 0, VS_T_PORT) && vs_port_close(vm, a[0]);
}
static vs_status close_input_port(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n, (void)out;
  bool fits = vs_is(a[0], VS_T_PORT) && vs_as_port(a[0])->flags & VS_PORT_INPUT;
  return (fits || vs_fail_type(vm, 0, "an input port", a[0])) && vs_port_close(vm, a[0]);
}
static vs_status close_output_port(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n, (void)out;
  bool fits = vs_is(a[0], VS_T_PORT) && vs_as_port(a[0])->flags & VS_PORT_OUTPUT;
  return (fits || vs_fail_type(vm, 0, "an output port", a[0])) && vs_port_close(vm, a[0]);
}

/* Sets *out to #t if the argument is a port that has all flags in `on` and none in `off`, otherwise to #f. */
static vs_status port_has(const vs_value *a, uint32_t on, uint32_t off, vs_value *out) {
  uint32_t flags = vs_is(a[0], VS_T_PORT) ? vs_as_port(a[0])->flags : 0;
  *out = vs_bool(vs_is(a[0], VS_T_PORT) && (flags & on) == on && !(flags & off));
  return VS_OK;
}
static vs_status is_port(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)vm, (void)n, port_has(a, 0, 0, out);
}
static vs_status is_input_port(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)vm, (void)n, port_has(a, VS_PORT_INPUT, 0, out);
}
static vs_status is_output_port(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)vm, (void)n, port_has(a, VS_PORT_OUTPUT, 0, out);
}
static vs_status is_textual_port(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)vm, (void)n, port_has(a, 0, VS_PORT_BINARY, out);
}
static vs_status is_binary_port(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)vm, (void)n, port_has(a, VS_PORT_BINARY, 0, out);
}
static vs_status is_input_open(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)n, vs_arg_type(vm, a, 0, VS_T_PORT) && port_has(a, VS_PORT_INPUT, VS_PORT_CLOSED, out);
}
static vs_status is_output_open(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)n, vs_arg_type(vm, a, 0, VS_T_PORT) && port_has(a, VS_PORT_OUTPUT, VS_PORT_CLOSED, out);
}

static vs_status port_parameter(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  int64_t stream;
  return vs_arg_index(vm, a, 0, 0, 2, &stream) && vs_port_parameter(vm, (int)stream, out);
}

static vs_status eof_object(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)vm, (void)a, (void)n, *out = VS_EOF, VS_OK;
}
static vs_status is_eof(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)vm, (void)n, *out = vs_bool(a[0] == VS_EOF), VS_OK;
}

/* ---- testing and removing files ---- */

/* Sets *yes to whether the file with the name a[0] exists; if `remove` is true, to whether the host has removed it.
 * Returns false with the error set if memory is out or a[0] is no name. */
static bool ask_file(vs_scheme *vm, vs_value *a, bool remove, bool *yes, const char **why) {
  if (!vs_arg_type(vm, a, 0, VS_T_STRING)) return false;
  const vs_io *io = vm->config.io;
  vs_text t;
  vs_text_open(vm, &t, 0);
  bool ok = vs_text_string(&t, a[0]) && vs_text_end(&t);
  *yes = false;
  if (ok && remove && io && io->remove) *yes = io->remove(vm->config.user, t.at, why);
  if (ok && !remove && io && io->exists) *yes = io->exists(vm->config.user, t.at);
  vs_text_close(&t);
  return ok;
}
static vs_status file_exists(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  bool yes;
  const char *why = NULL;
  return ask_file(vm, a, false, &yes, &why) ? (*out = vs_bool(yes), VS_OK) : VS_ERROR;
}
static vs_status delete_file(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n, (void)out;
  VS_ROOTS(vm, r, 1);
  bool yes;
  const char *why = NULL;
  if (!ask_file(vm, a, true, &yes, &why)) return VS_ERROR;
  return yes || (vs_cons(vm, a[0], VS_NIL, &r[0]) &&
                 vs_fail_with(vm, vm->sym.file, r[0], "cannot delete (%s)", why ? why : "not available here"));
}

static const vs_native_def defs[] = {
    {"read", "[port]", read_, 0, "the next datum"},
    {"read-char", "[port]", read_char, 0, NULL},
    {"peek-char", "[port]", peek_char, 0, NULL},
    {"read-line", "[port]", read_line, 0, "the next line without its end"},
    {"read-string", "k [port]", read_string, 0, "up to k characters"},
    {"char-ready?", "[port]", char_ready, 0, NULL},
    {"read-u8", "[port]", read_u8, 0, NULL},
    {"peek-u8", "[port]", peek_u8, 0, NULL},
    {"u8-ready?", "[port]", u8_ready, 0, NULL},
    {"read-bytevector", "k [port]", read_bytevector, 0, NULL},
    {"read-bytevector!", "bytevector [port start end]", read_bytevector_into, 0, NULL},
    {"open-input-file", "name", open_input_file, 0, NULL},
    {"open-binary-input-file", "name", open_binary_input_file, 0, NULL},
    {"open-input-string", "string", open_input_string, 0, NULL},
    {"open-input-bytevector", "bytevector", open_input_bytevector, 0, NULL},
    {"close-port", "port", close_port, 0, NULL},
    {"close-input-port", "port", close_input_port, 0, NULL},
    {"close-output-port", "port", close_output_port, 0, NULL},
    {"port?", "x", is_port, 0, NULL},
    {"input-port?", "x", is_input_port, 0, NULL},
    {"output-port?", "x", is_output_port, 0, NULL},
    {"textual-port?", "x", is_textual_port, 0, NULL},
    {"binary-port?", "x", is_binary_port, 0, NULL},
    {"input-port-open?", "port", is_input_open, 0, NULL},
    {"output-port-open?", "port", is_output_open, 0, NULL},
    {"%port-parameter", "stream", port_parameter, 0, NULL},
    {"eof-object", "", eof_object, 0, NULL},
    {"eof-object?", "x", is_eof, 0, NULL},
    {"file-exists?", "name", file_exists, 0, NULL},
    {"delete-file", "name", delete_file, 0, NULL},
    {NULL, NULL, NULL, 0, NULL},
};
const vs_native_table vs_input_natives = {"input", defs};
