/* Declares the printing of a changed default of a parameter as a patch of the source. */
#ifndef VS_CLI_CURE_SOURCE_EDIT_H
#define VS_CLI_CURE_SOURCE_EDIT_H

#include "visualscheme.h"

/* The place of a define-parameter. The struct owns the file's name; NULL: the place is unknown. */
typedef struct { char *file; uint32_t line; } cure_place;

bool cure_place_keep(cure_place *out, const vs_span *at); /* Returns false when memory is out. */
void cure_place_free(cure_place *p);

/* Prints a patch (unified diff) that makes `value` the default of the parameter. Prints nothing if its line does not
 * have the form (define-parameter name number ...). */
void cure_print_edit(const cure_place *p, const char *name, const char *value);

#endif
