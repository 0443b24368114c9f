/* Owns the rights of an untrusted model's process: see confine.c. */
#ifndef VS_CLI_CONFINE_H
#define VS_CLI_CONFINE_H

#include <stdbool.h>
#include <stddef.h>

/* Removes rights, for this process and its descendants, for good: sockets, tracing and the like, and all files except
 * these: the system's programs and libraries (to read and to start), files below `model` (to read), files directly in
 * `written` and below `scratch` (to write; NULL: none). Open descriptors stay. Returns false if the system has no
 * Landlock, so that files stay accessible. */
bool cli_confine(const char *model, const char *const *written, size_t count, const char *scratch);

#endif
