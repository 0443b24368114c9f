/* Owns libraries that are loaded when they are first used: linked eagerly they would cost every start of the program
 * milliseconds.
 *
 * A user keeps a struct of function pointers and a table that names them; nothing is global, and loading again costs
 * some microseconds. */
#ifndef VS_GEOMETRY_DYNAMIC_H
#define VS_GEOMETRY_DYNAMIC_H

#include <stddef.h>

#include "model/node.h"

typedef struct {
  const char *const *files; /* names to try in order, NULL at the end: "libgeos_c.so.1" */
  const char *package;      /* that has it in Debian */
  const char *purpose;      /* what needs it, as the subject of a message: "offsets" */
} vs_dynamic_library;
typedef struct { const char *symbol; size_t offset; /* of the function pointer in `functions` */ } vs_dynamic_name;

/* Fills the function pointers of the struct `functions`. A library once loaded stays in the process. False: it or a
 * function is not there (VS_ERROR_WORKER, with the package's name). */
bool vs_dynamic_load(const vs_dynamic_library *library, const vs_dynamic_name *names, size_t count, void *functions,
                     vs_error *e);

#endif
