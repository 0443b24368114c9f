/* Owns what the process of an untrusted model may do: see confine.c. */
#ifndef VS_CLI_CONFINE_H
#define VS_CLI_CONFINE_H

#include <stdbool.h>
#include <stddef.h>

/* Takes away, for this process and all it starts, for good: sockets, tracing and the like, and every file but: the
 * system's programs and libraries (to read and to start), what is beneath `model` (to read), what is directly in
 * `written` and below `scratch` (to write; NULL: none). Descriptors that are open stay. Returns whether files could be
 * taken away, too: false where the system has no Landlock. */
bool cli_confine(const char *model, const char *const *written, size_t count, const char *scratch);

#endif
