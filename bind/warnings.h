/* Declares warnings that are given only once for each place in the program. Implemented in warnings.c. */
#ifndef VS_BIND_WARNINGS_H
#define VS_BIND_WARNINGS_H

#include <stdbool.h>

#include "model/node.h"

typedef struct vs_bind vs_bind;

/* Returns true if a warning of this kind was already given for the place o. Otherwise returns false, and records that
 * the warning is given now. */
bool vs_bind_warned(vs_bind *b, const vs_origin *o, const char *kind);
/* From now on, suppresses warnings of this kind at the place of the current call. */
void vs_bind_clear(vs_bind *b, const char *kind);
/* Gives a warning, once for each place and kind (any constant text). When memory for the text is out, gives none. */
void vs_bind_warn(vs_bind *b, const char *kind, const char *format, ...) __attribute__((format(printf, 3, 4)));

#endif
