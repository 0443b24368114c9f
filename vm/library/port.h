/* Declares ports and vs_io: the functions of the host for files, the console and the clock (vm/ makes no system calls).
 *
 * Output is not buffered here: each procedure that prints passes its text to the host at once. Files are read
 * completely when they are opened; the console is read one line at a time. Text is UTF-8; invalid bytes are read as
 * U+FFFD. */
#ifndef VS_VM_LIBRARY_PORT_H
#define VS_VM_LIBRARY_PORT_H

#include "vm/machine/native.h"
#include "vm/values/text.h"

typedef enum { VS_IO_READ, VS_IO_WRITE, VS_IO_APPEND } vs_io_mode;
enum { VS_IO_STDIN = 0, VS_IO_STDOUT = 1, VS_IO_STDERR = 2 };       /* numbers of the streams that are always open */

/* Functions of the host. Any of them may be NULL; the Scheme procedures that need it then fail with "not available
 * here". */
/* Text to which a host function sets *why if it fails because memory is out, not because of the file. */
#define VS_IO_NO_MEMORY "out of memory"

typedef struct vs_io {
  /* Opens a file and returns the number of a stream, above 2. If it fails, returns -1 and sets *why to a text such as
   * "no such file", valid until the next call. */
  int64_t (*open)(void *user, const char *path, vs_io_mode mode, const char **why);
  /* Returns the number of bytes read, 0 at the end of the stream, -1 on failure. */
  ptrdiff_t (*read)(void *user, int64_t stream, void *to, size_t room);
  bool (*write)(void *user, int64_t stream, const char *bytes, size_t n);
  bool (*flush)(void *user, int64_t stream);
  /* Closes a stream. Returns false if its data could not be written completely. */
  bool (*close)(void *user, int64_t stream);
  bool (*exists)(void *user, const char *path);
  bool (*remove)(void *user, const char *path, const char **why);
  /* Calls `take` with each name in the folder, except . and .. . If the folder cannot be read, returns false and sets
   * *why. If `take` returns false, also returns false, with *why unchanged. */
  bool (*list)(void *user, const char *path, bool (*take)(void *context, const char *name, size_t length),
               void *context, const char **why);
  double (*now)(void *user);                                                 /* returns the time in seconds since
                                                                              * 1970 */
  const char *(*getenv)(void *user, const char *name);
  /* Returns environment variable i as NAME=value, or NULL if there is none. */
  const char *(*variable)(void *user, size_t i);
} vs_io;

enum {                       /* flags of a port */
  VS_PORT_INPUT = 1, VS_PORT_OUTPUT = 2, VS_PORT_BINARY = 4, VS_PORT_CLOSED = 8, VS_PORT_STRING = 16, VS_PORT_EOF = 32,
  VS_PORT_FOLD = 64            /* whether letters are converted to lower case, because #!fold-case was read */
};

bool vs_port_open_file(vs_scheme *vm, vs_value path, vs_io_mode mode, uint32_t flags, vs_value *out);
/* Sets *out to a new input port that reads the first `count` bytes of a bytevector. */
bool vs_port_open_bytes(vs_scheme *vm, vs_value bytes, size_t count, uint32_t flags, vs_value *out);
/* Sets *out to a new output port that collects a string. */
bool vs_port_open_text(vs_scheme *vm, vs_value *out);
bool vs_port_write(vs_scheme *vm, vs_value port, const char *bytes, size_t n);
/* Reads a character: sets *c to its code point, or to -1 at the end. */
bool vs_port_read_char(vs_scheme *vm, vs_value port, int32_t *c);
bool vs_port_peek_char(vs_scheme *vm, vs_value port, int32_t *c);
/* Sets *at and *count to the port's unread bytes: at least `wanted` bytes, or fewer at the end of the data. The bytes
 * remain unread until the caller advances the port's `position`. */
bool vs_port_fill(vs_scheme *vm, vs_value port, size_t wanted, const uint8_t **at, size_t *count);
bool vs_port_close(vs_scheme *vm, vs_value port);
/* Sets *out to the parameter object of the current input port (stream 0), output port (1) or error port (2). */
bool vs_port_parameter(vs_scheme *vm, int stream, vs_value *out);
/* Returns true if v is allowed as the value of `parameter`. The parameters of the current ports allow only a port of
 * the right direction; other parameters allow any value. */
bool vs_port_parameter_fits(const vs_scheme *vm, vs_value parameter, vs_value v);
/* Returns the current output port: the value of its parameter object or, before this object exists, the standard
 * port. */
vs_value vs_port_current_output(vs_scheme *vm);
/* Returns the current input port, as vs_port_current_output does for output. */
vs_value vs_port_current_input(vs_scheme *vm);

/* Creates the three standard ports and their parameter objects (vm->at.standard_..., vm->at.lib) if they do not exist.
 * Procedures that use ports call this function first. */
bool vs_port_setup(vs_scheme *vm);

/* Sets *out to a BYTES object with the content of a file. The object counts for the memory limit. An error message
 * names the file. */
bool vs_io_read_file(vs_scheme *vm, const char *path, vs_value *out);

#endif
