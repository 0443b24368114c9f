/* Owns ports, and vs_io: what the VM asks of its host for files, the console and the clock (vm/ has no system calls).

   Output is not buffered here: each procedure that prints hands its whole text to the host at once. Files are read
   whole when opened; console input comes a line at a time. Text is UTF-8; bad bytes read as U+FFFD. */
#ifndef VS_VM_LIBRARY_PORT_H
#define VS_VM_LIBRARY_PORT_H

#include "vm/machine/native.h"
#include "vm/values/text.h"

typedef enum { VS_IO_READ, VS_IO_WRITE, VS_IO_APPEND } vs_io_mode;
enum { VS_IO_STDIN = 0, VS_IO_STDOUT = 1, VS_IO_STDERR = 2 };       /* streams that are always open */

/* Any member may be NULL: then that fails with "not available here". */
/* The text of `why` if memory, and not the file, is the fault. */
#define VS_IO_NO_MEMORY "out of memory"

typedef struct vs_io {
  /* a stream's number > 2, or -1 and *why ("no such file"), living until the next call */
  int64_t (*open)(void *user, const char *path, vs_io_mode mode, const char **why);
  ptrdiff_t (*read)(void *user, int64_t stream, void *to, size_t room);      /* bytes got, 0 at the end, -1 failed */
  bool (*write)(void *user, int64_t stream, const char *bytes, size_t n);
  bool (*flush)(void *user, int64_t stream);
  /* false: could not be written to the end */
  bool (*close)(void *user, int64_t stream);
  bool (*exists)(void *user, const char *path);
  bool (*remove)(void *user, const char *path, const char **why);
  /* Hands each name in a folder to `take`, but for . and .. ; false: *why, or take said false and *why is as it was. */
  bool (*list)(void *user, const char *path, bool (*take)(void *context, const char *name, size_t length),
               void *context, const char **why);
  double (*now)(void *user);                                                 /* seconds since 1970 */
  const char *(*getenv)(void *user, const char *name);
  /* the i-th variable of the environment, as NAME=value; NULL past the last */
  const char *(*variable)(void *user, size_t i);
} vs_io;

enum {                       /* vs_port.flags */
  VS_PORT_INPUT = 1, VS_PORT_OUTPUT = 2, VS_PORT_BINARY = 4, VS_PORT_CLOSED = 8, VS_PORT_STRING = 16, VS_PORT_EOF = 32,
  VS_PORT_FOLD = 64            /* #!fold-case was read */
};

bool vs_port_open_file(vs_scheme *vm, vs_value path, vs_io_mode mode, uint32_t flags, vs_value *out);
/* input from memory */
bool vs_port_open_bytes(vs_scheme *vm, vs_value bytes, size_t count, uint32_t flags, vs_value *out);
/* a string output port */
bool vs_port_open_text(vs_scheme *vm, vs_value *out);
bool vs_port_write(vs_scheme *vm, vs_value port, const char *bytes, size_t n);
/* *c = code point, or -1 at the end */
bool vs_port_read_char(vs_scheme *vm, vs_value port, int32_t *c);
bool vs_port_peek_char(vs_scheme *vm, vs_value port, int32_t *c);
/* At least `wanted` bytes if there are so many, from *at; they stay in the port: move its `position`. */
bool vs_port_fill(vs_scheme *vm, vs_value port, size_t wanted, const uint8_t **at, size_t *count);
bool vs_port_close(vs_scheme *vm, vs_value port);
/* The parameter object of the current input (0), output (1) or error port (2). */
bool vs_port_parameter(vs_scheme *vm, int stream, vs_value *out);
/* May the parameter have this value? A port of its direction for those three; anything for others. */
bool vs_port_parameter_fits(const vs_scheme *vm, vs_value parameter, vs_value v);
/* the current ports: parameters' values, else the standard ones */
vs_value vs_port_current_output(vs_scheme *vm);
vs_value vs_port_current_input(vs_scheme *vm);

/* Makes the three standard ports and their parameters (vm->at.standard_..., vm->at.lib) unless that was done. The
   procedures do it when they are first used. */
bool vs_port_setup(vs_scheme *vm);

/* A whole file as BYTES (accounted, limits hold); an error names the file. For load, include and ports. */
bool vs_io_read_file(vs_scheme *vm, const char *path, vs_value *out);

#endif
