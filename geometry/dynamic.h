/* Declares libraries that are loaded at their first use: linked in, they would cost every start of the program
 * milliseconds.
 *
 * A user keeps a struct of function pointers and a table that names them. Nothing is global; loading again costs some
 * microseconds. */
#ifndef VS_GEOMETRY_DYNAMIC_H
#define VS_GEOMETRY_DYNAMIC_H

#include <stddef.h>

#include "model/node.h"

typedef struct {
  const char *const *files; /* file names to try in order, ends with NULL: "libgeos_c.so.1" */
  const char *package;      /* the Debian package that contains it */
  const char *purpose;      /* its users, as a message's subject: "offsets" */
} vs_dynamic_library;
typedef struct { const char *symbol; size_t offset; /* offset: of its pointer in `functions` */ } vs_dynamic_name;

/* Fills the function pointers of the struct `functions`; the library stays loaded. Returns false if the library or a
 * function is missing (VS_ERROR_WORKER, with the package's name). */
bool vs_dynamic_load(const vs_dynamic_library *library, const vs_dynamic_name *names, size_t count, void *functions,
                     vs_error *e);

#endif
