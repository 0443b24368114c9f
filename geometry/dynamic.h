/* Declares the loading of shared libraries at their first use. If they were linked in, they would delay every start of
 * the program by milliseconds.
 *
 * The caller keeps a struct of function pointers and a table of their names. There is no global state; loading a
 * library again takes some microseconds. */
#ifndef VS_GEOMETRY_DYNAMIC_H
#define VS_GEOMETRY_DYNAMIC_H

#include <stddef.h>

#include "model/node.h"

typedef struct {
  const char *const *files; /* file names to try in order, such as "libgeos_c.so.1"; the list ends with NULL */
  const char *package;      /* name of the Debian package that contains the library */
  const char *purpose;      /* the feature that needs the library, such as "offsets"; it is the subject of error
                             * messages */
} vs_dynamic_library;
typedef struct {
  const char *symbol; /* name of a library function */
  size_t offset;      /* position, in the caller's struct, of the pointer to this function, in bytes */
} vs_dynamic_name;

/* Defines the struct `dynamic_functions` and the table `dynamic_names` of its members. LIST(F) is a macro that consists
 * of rows F(member, symbol, result, parameters), one for each library function. */
#define VS_DYNAMIC_FUNCTIONS(LIST)                                                                                     \
  typedef struct { LIST(VS_DYNAMIC_MEMBER) } dynamic_functions;                                                        \
  static const vs_dynamic_name dynamic_names[] = { LIST(VS_DYNAMIC_ROW) }
#define VS_DYNAMIC_MEMBER(member, symbol, result, parameters) result (*member) parameters;
#define VS_DYNAMIC_ROW(member, symbol, result, parameters) { #symbol, offsetof(dynamic_functions, member) },

extern const vs_dynamic_library vs_json_library; /* the library jansson, which reads JSON in bind/ and cli/ */

/* Loads the library. Sets the `count` pointers in the caller's struct that the table `names` describes. The library
 * stays loaded. Returns false if the library or a function is missing; e is then VS_ERROR_WORKER with the package's
 * name. */
bool vs_dynamic_load(const vs_dynamic_library *library, const vs_dynamic_name *names, size_t count, void *functions,
                     vs_error *e);

#endif
