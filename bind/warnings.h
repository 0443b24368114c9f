/* Owns the interface of warnings.c: warnings, each given once for each place. */
#ifndef VS_BIND_WARNINGS_H
#define VS_BIND_WARNINGS_H

#include <stdbool.h>

#include "model/node.h"

typedef struct vs_bind vs_bind;

/* Returns true if such a warning was given for this place before; counts it as given. */
bool vs_bind_warned(vs_bind *b, const vs_origin *o, const char *kind);
/* Warns once for each place and `kind` (any constant text); gives no warning when memory for the text is out. */
void vs_bind_clear(vs_bind *b, const char *kind); /* suppresses warnings of this kind at the call's place from now on */
void vs_bind_warn(vs_bind *b, const char *kind, const char *format, ...) __attribute__((format(printf, 3, 4)));

#endif
