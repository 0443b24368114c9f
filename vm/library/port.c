/* Implements ports (port.h): input and output of characters and bytes, for files, the console, strings and bytevectors.
 *
 * The unread data of an input port are in `buffer` (BYTES) from `position` to `limit`. Only the console adds data, one
 * line at a time. An output port into memory collects data in `buffer`, of which `position` bytes are used. All other
 * output ports pass their bytes to the host. */
#include "vm/library/port.h"

#include "vm/library/kept.h"
#include "vm/values/heap.h"

static bool port_new(vs_scheme *vm, uint32_t flags, int64_t host, const vs_value *name, vs_value *out) {
  vs_port *p = (vs_port *)(void *)vs_gc_alloc(vm, VS_T_PORT, VS_WORDS(vs_port));
  if (!p) return false;
  p->buffer = VS_FALSE;
  p->name = name ? *name : VS_FALSE;
  p->data = VS_FALSE;
  p->host = host;
  p->flags = flags;
  p->line = p->col = 1;
  *out = vs_from_object(p);
  return true;
}

static bool port_standard(vs_scheme *vm, const char *name, int stream, uint32_t flags, vs_value *port, int slot) {
  VS_ROOTS(vm, r, 1);
  if (!vs_string_from_utf8(vm, name, strlen(name), &r[0]) || !port_new(vm, flags, stream, &r[0], port)) return false;
  if (!vs_intern_c(vm, name, &r[0])) return false;
  vs_parameter *p = (vs_parameter *)(void *)vs_gc_alloc(vm, VS_T_PARAMETER, VS_WORDS(vs_parameter));
  if (!p) return false;
  p->value = *port;
  p->converter = VS_FALSE;
  p->name = r[0];
  vs_lib_set(vm, slot, vs_from_object(p));
  return true;
}

bool vs_port_setup(vs_scheme *vm) {
  if (vs_lib_get(vm, VS_LIB_ERROR) != VS_FALSE) return true;
  return vs_lib_open(vm) &&
         port_standard(vm, "current-input-port", VS_IO_STDIN, VS_PORT_INPUT, &vm->at.standard_in, VS_LIB_INPUT) &&
         port_standard(vm, "current-output-port", VS_IO_STDOUT, VS_PORT_OUTPUT, &vm->at.standard_out, VS_LIB_OUTPUT) &&
         port_standard(vm, "current-error-port", VS_IO_STDERR, VS_PORT_OUTPUT, &vm->at.standard_error, VS_LIB_ERROR);
}

bool vs_port_parameter(vs_scheme *vm, int stream, vs_value *out) {
  VS_ASSERT(stream >= VS_IO_STDIN && stream <= VS_IO_STDERR);
  if (!vs_port_setup(vm)) return false;
  *out = vs_lib_get(vm, VS_LIB_INPUT + stream);
  return true;
}

bool vs_port_parameter_fits(const vs_scheme *vm, vs_value parameter, vs_value v) {
  for (int slot = VS_LIB_INPUT; slot <= VS_LIB_ERROR; slot++)
    if (parameter == vs_lib_get(vm, slot))
      return vs_is(v, VS_T_PORT) && vs_as_port(v)->flags & (slot == VS_LIB_INPUT ? VS_PORT_INPUT : VS_PORT_OUTPUT);
  return true;
}

static vs_value port_current(vs_scheme *vm, int slot) {
  if (!vs_port_setup(vm)) return VS_FALSE;
  return vs_parameter_value(vm, vs_lib_get(vm, slot));
}
vs_value vs_port_current_output(vs_scheme *vm) { return port_current(vm, VS_LIB_OUTPUT); }
vs_value vs_port_current_input(vs_scheme *vm) { return port_current(vm, VS_LIB_INPUT); }

/* ---- opening and reading files ---- */

static bool fail_file(vs_scheme *vm, const char *what, const char *path, const char *why) {
  bool memory = why && !strcmp(why, VS_IO_NO_MEMORY);
  return vs_fail(vm, memory ? vm->sym.memory : vm->sym.file, "cannot %s %s: %s", what, path,
                 why ? why : "not available here");
}

/* Reads the stream to its end into a new BYTES object, which may be longer than the data. Sets *count to the number of
 * bytes read. */
static bool read_stream(vs_scheme *vm, int64_t stream, const char *path, vs_value *out, size_t *count) {
  const vs_io *io = vm->config.io;
  vs_text t;
  vs_text_open(vm, &t, 0);
  bool ok = true;
  for (char chunk[8192]; ok;) {
    ptrdiff_t n = io->read ? io->read(vm->config.user, stream, chunk, sizeof chunk) : -1;
    if (n == 0) break;
    ok = n < 0 ? fail_file(vm, "read", path, "reading failed")
               : vs_text_put(&t, chunk, (size_t)n) && vs_poll(vm, (uint64_t)n / 64);
  }
  if (ok && (ok = vs_make_bytes(vm, t.count, out)) && t.count) memcpy(vs_as_bytes(*out)->at, t.at, t.count);
  if (count) *count = t.count;
  vs_text_close(&t);
  return ok;
}

bool vs_io_read_file(vs_scheme *vm, const char *path, vs_value *out) {
  const vs_io *io = vm->config.io;
  const char *why = NULL;
  int64_t stream = io && io->open ? io->open(vm->config.user, path, VS_IO_READ, &why) : -1;
  if (stream < 0) return fail_file(vm, "open", path, why);
  bool ok = read_stream(vm, stream, path, out, NULL);
  if (io->close) io->close(vm->config.user, stream);
  return ok;
}

bool vs_port_open_file(vs_scheme *vm, vs_value path, vs_io_mode mode, uint32_t flags, vs_value *out) {
  VS_ROOTS(vm, r, 3);
  r[0] = path;
  vs_text name;
  vs_text_open(vm, &name, 0);
  bool ok = vs_text_string(&name, path) && vs_text_end(&name);
  if (ok && strlen(name.at) != name.count)
    ok = vs_fail(vm, vm->sym.file, "a file name cannot contain a zero character");
  if (ok && mode == VS_IO_READ) {
    ok = vs_io_read_file(vm, name.at, &r[1]) && port_new(vm, flags, -1, &r[0], out);
    if (ok) {
      vs_port *p = vs_as_port(*out);
      vs_gc_store(vm, p, &p->buffer, r[1]);
      p->limit = vs_as_bytes(r[1])->length;
    }
  } else if (ok) {
    const vs_io *io = vm->config.io;
    const char *why = NULL;
    int64_t stream = io && io->open ? io->open(vm->config.user, name.at, mode, &why) : -1;
    ok = stream >= 0 ? port_new(vm, flags, stream, &r[0], out) : fail_file(vm, "open", name.at, why);
    if (!ok && stream >= 0 && io->close) io->close(vm->config.user, stream);
  }
  vs_text_close(&name);
  return ok;
}

bool vs_port_open_bytes(vs_scheme *vm, vs_value bytes, size_t count, uint32_t flags, vs_value *out) {
  VS_ROOTS(vm, r, 1);
  r[0] = bytes;
  if (!port_new(vm, flags | VS_PORT_INPUT, -1, NULL, out)) return false;
  vs_port *p = vs_as_port(*out);
  p->buffer = r[0];
  p->limit = count;
  return true;
}

bool vs_port_open_text(vs_scheme *vm, vs_value *out) {
  return port_new(vm, VS_PORT_OUTPUT | VS_PORT_STRING, -1, NULL, out);
}

bool vs_port_close(vs_scheme *vm, vs_value port) {
  vs_port *p = vs_as_port(port);
  if (p->flags & VS_PORT_CLOSED) return true;
  p->flags |= VS_PORT_CLOSED;
  if (p->host <= VS_IO_STDERR || !vm->config.io || !vm->config.io->close ||
      vm->config.io->close(vm->config.user, p->host))
    return true;
  return vs_fail(vm, vm->sym.file, "the file could not be written to its end");
}

/* ---- writing ---- */

static bool collect(vs_scheme *vm, vs_value port, const char *bytes, size_t n) {
  if (n == 0) return true; /* an empty port may have no buffer */
  VS_ROOTS(vm, r, 2);
  r[0] = port;
  vs_port *p = vs_as_port(port);
  size_t room = p->buffer == VS_FALSE ? 0 : (size_t)vs_as_bytes(p->buffer)->length;
  if (room - p->position < n) {
    size_t more = room * 2 > p->position + n ? room * 2 : p->position + n + 64;
    if (!vs_make_bytes(vm, more, &r[1])) return false;
    p = vs_as_port(r[0]);
    if (p->position) memcpy(vs_as_bytes(r[1])->at, vs_as_bytes(p->buffer)->at, p->position);
    vs_gc_store(vm, p, &p->buffer, r[1]);
  }
  memcpy(vs_as_bytes(p->buffer)->at + p->position, bytes, n);
  p->position += n;
  return true;
}

bool vs_port_write(vs_scheme *vm, vs_value port, const char *bytes, size_t n) {
  vs_port *p = vs_as_port(port);
  if (n == 0) return true;
  if (!(p->flags & VS_PORT_BINARY) || p->host >= 0) {
    const char *end = NULL;                       /* end: last line end in the text, by which the port's column is
                                                   * updated for fresh-line */
    for (size_t i = n; i-- > 0 && !end;)
      if (bytes[i] == '\n') end = bytes + i;
    p->col = (uint32_t)(end ? 1 + (size_t)(bytes + n - end - 1) : p->col + n);
  }
  if (p->flags & VS_PORT_STRING) return collect(vm, port, bytes, n);
  vm->written += n;
  if (vm->config.output_limit && vm->written > vm->config.output_limit)
    return vs_fail(vm, vm->sym.limit, "the program printed more than the limit of %llu bytes",
                   (unsigned long long)vm->config.output_limit);
  const vs_io *io = vm->config.io;
  if ((!io || !io->write) && p->host <= VS_IO_STDERR) return true;       /* if the host has no console, the text is
                                                                          * ignored */
  if (io && io->write && io->write(vm->config.user, p->host, bytes, n)) return true;
  return vs_fail(vm, vm->sym.file, "writing failed");
}

/* ---- reading ---- */

/* Reads more data from the console. Sets *any to true if there were data. */
static bool refill(vs_scheme *vm, vs_value port, bool *any) {
  *any = false;
  vs_port *p = vs_as_port(port);
  const vs_io *io = vm->config.io;
  if (p->host != VS_IO_STDIN || !io || !io->read || (p->flags & VS_PORT_EOF)) return true;
  char chunk[4096];
  ptrdiff_t n = io->read(vm->config.user, p->host, chunk, sizeof chunk);
  if (n < 0) return vs_fail(vm, vm->sym.file, "reading failed");
  if (n == 0) return true;
  VS_ROOTS(vm, r, 2);
  r[0] = port;
  /* left: number of bytes not yet read. They are an incomplete character, or data that a program has examined without
   * reading them. */
  size_t left = (size_t)(p->limit - p->position);
  if (!vs_make_bytes(vm, left + (size_t)n, &r[1])) return false;
  p = vs_as_port(r[0]);
  if (left) memcpy(vs_as_bytes(r[1])->at, vs_as_bytes(p->buffer)->at + p->position, left);
  memcpy(vs_as_bytes(r[1])->at + left, chunk, (size_t)n);
  vs_gc_store(vm, p, &p->buffer, r[1]);
  p->position = 0;
  p->limit = left + (size_t)n;
  return *any = true;
}

/* Sets *at and *count to the port's unread bytes. If there are fewer than `wanted`, first reads more. */
bool vs_port_fill(vs_scheme *vm, vs_value port, size_t wanted, const uint8_t **at, size_t *count) {
  VS_ROOTS(vm, r, 1);
  r[0] = port;
  for (bool any = true; any && vs_as_port(r[0])->limit - vs_as_port(r[0])->position < wanted;)
    if (!refill(vm, r[0], &any)) return false;
  const vs_port *p = vs_as_port(r[0]);
  *count = (size_t)(p->limit - p->position);
  *at = *count ? vs_as_bytes(p->buffer)->at + p->position : NULL;
  return true;
}

/* Sets *c to the next character of the port without reading past it, or to -1 at the end. Sets *used to the character's
 * length in bytes. */
static bool look(vs_scheme *vm, vs_value *port, int32_t *c, size_t *used) {
  const uint8_t *at;
  size_t count;
  uint32_t code;
  if (!vs_port_fill(vm, *port, 1, &at, &count)) return false;
  if (count == 0) return *c = -1, *used = 0, true;
  if (*at < 0x80) return *c = *at, *used = 1, true;
  if (!vs_port_fill(vm, *port, *at >= 0xF0 ? 4 : *at >= 0xE0 ? 3 : 2, &at, &count)) return false;
  *used = vs_utf8_decode((const char *)at, count, &code);
  *c = (int32_t)code;
  if (*used == 0) {
    *used = 1;
    *c = 0xFFFD;
  }
  return true;
}

bool vs_port_peek_char(vs_scheme *vm, vs_value port, int32_t *c) {
  VS_ROOTS(vm, r, 1);
  size_t used;
  r[0] = port;
  return look(vm, &r[0], c, &used);
}

bool vs_port_read_char(vs_scheme *vm, vs_value port, int32_t *c) {
  VS_ROOTS(vm, r, 1);
  size_t used;
  r[0] = port;
  if (!look(vm, &r[0], c, &used)) return false;
  vs_port *p = vs_as_port(r[0]);
  p->position += used;
  if (*c == '\n') p->line++, p->col = 1;
  else p->col++;
  return true;
}
