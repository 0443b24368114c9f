/* Declares the loading of shared libraries at their first use. If they were linked in, they would delay every start of
 * the program by milliseconds.
 *
 * The caller keeps a struct of function pointers and a table of their names. There is no global state; loading a
 * library again takes some microseconds. */
#ifndef VS_GEOMETRY_DYNAMIC_H
#define VS_GEOMETRY_DYNAMIC_H

#include <stddef.h>

#include "model/node.h"

/* The libraries that are loaded at their first use; used_libraries.def lists them. */
typedef enum {
#define LOADED(id, ...) VS_LIBRARY_##id,
#include "geometry/used_libraries.def"
  VS_LIBRARIES
} vs_library;
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

/* Loads the library, and sets the `count` function pointers that `names` describes. purpose: the feature that needs the
 * library, such as "offsets", for error messages. Returns false if the library or a function is missing. */
bool vs_dynamic_load(vs_library library, const char *purpose, const vs_dynamic_name *names, size_t count,
                     void *functions, vs_error *e);

#endif
