/* Owns the interface of warnings.c: warnings, each given once a place. */
#ifndef VS_BIND_WARNINGS_H
#define VS_BIND_WARNINGS_H

#include <stdbool.h>

#include "model/node.h"

typedef struct vs_bind vs_bind;

/* Was such a warning given for this place before? It counts as given from now on. */
bool vs_bind_warned(vs_bind *b, const vs_origin *o, const char *kind);
/* once a place and `kind` (any constant text); nothing when it could not be formatted */
void vs_bind_clear(vs_bind *b, const char *kind); /* no warning of this kind at the call's place from now on */
void vs_bind_warn(vs_bind *b, const char *kind, const char *format, ...) __attribute__((format(printf, 3, 4)));

#endif
