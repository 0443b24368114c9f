/* Owns ports, and vs_io: the VM's requests to its host for files, the console and the clock (vm/ makes no system
 * calls).
 *
 * Output is not buffered here: each procedure that prints passes its whole text to the host at once. Files are read
 * whole when they are opened; console input comes one line at a time. Text is UTF-8; bad bytes read as U+FFFD. */
#ifndef VS_VM_LIBRARY_PORT_H
#define VS_VM_LIBRARY_PORT_H

#include "vm/machine/native.h"
#include "vm/values/text.h"

typedef enum { VS_IO_READ, VS_IO_WRITE, VS_IO_APPEND } vs_io_mode;
enum { VS_IO_STDIN = 0, VS_IO_STDOUT = 1, VS_IO_STDERR = 2 };       /* streams that are always open */

/* Any member may be NULL: the procedure then fails with "not available here". */
/* The text of `why` if memory, and not the file, is the cause. */
#define VS_IO_NO_MEMORY "out of memory"

typedef struct vs_io {
  /* returns a stream's number > 2, or -1 with *why ("no such file"), which lives until the next call */
  int64_t (*open)(void *user, const char *path, vs_io_mode mode, const char **why);
  ptrdiff_t (*read)(void *user, int64_t stream, void *to, size_t room);      /* returns the number of bytes, 0 at the
                                                                              * end, -1 on failure */
  bool (*write)(void *user, int64_t stream, const char *bytes, size_t n);
  bool (*flush)(void *user, int64_t stream);
  /* returns false if the data could not be written to the end */
  bool (*close)(void *user, int64_t stream);
  bool (*exists)(void *user, const char *path);
  bool (*remove)(void *user, const char *path, const char **why);
  /* Passes each name in a folder, except . and .. , to `take`. Returns false with *why, or, if `take` returned false,
   * with *why unchanged. */
  bool (*list)(void *user, const char *path, bool (*take)(void *context, const char *name, size_t length),
               void *context, const char **why);
  double (*now)(void *user);                                                 /* seconds since 1970 */
  const char *(*getenv)(void *user, const char *name);
  /* returns the i-th variable of the environment, as NAME=value; NULL beyond the last */
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
/* *c is the code point, or -1 at the end */
bool vs_port_read_char(vs_scheme *vm, vs_value port, int32_t *c);
bool vs_port_peek_char(vs_scheme *vm, vs_value port, int32_t *c);
/* Gives at least `wanted` bytes, if there are so many, at *at. They stay in the port: the caller moves its
 * `position`. */
bool vs_port_fill(vs_scheme *vm, vs_value port, size_t wanted, const uint8_t **at, size_t *count);
bool vs_port_close(vs_scheme *vm, vs_value port);
/* Gives the parameter object of the current input (0), output (1) or error port (2). */
bool vs_port_parameter(vs_scheme *vm, int stream, vs_value *out);
/* Returns true if the parameter may have this value: for those three a port of its direction, for others any value. */
bool vs_port_parameter_fits(const vs_scheme *vm, vs_value parameter, vs_value v);
/* the current ports: parameters' values, else the standard ones */
vs_value vs_port_current_output(vs_scheme *vm);
vs_value vs_port_current_input(vs_scheme *vm);

/* Makes the three standard ports and their parameters (vm->at.standard_..., vm->at.lib) if there are none. The
 * procedures call it at their first use. */
bool vs_port_setup(vs_scheme *vm);

/* Reads a whole file as BYTES (accounted, with limits); an error names the file. For load, include and ports. */
bool vs_io_read_file(vs_scheme *vm, const char *path, vs_value *out);

#endif
