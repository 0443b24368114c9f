/* Declares the confinement of an untrusted model's process, implemented in confine.c. */
#ifndef VS_CLI_CONFINE_H
#define VS_CLI_CONFINE_H

#include <stdbool.h>
#include <stddef.h>

/* Removes rights of this process and its descendants permanently: the network, tracing of processes and the like, and
 * access to most files. These remain accessible: programs and libraries of the system (read, execute), files below
 * `model` (read), files directly in the folders `written` and below `scratch` (write; scratch may be NULL). Open
 * descriptors can still be used. Returns false if the system has no Landlock; all files then remain accessible. */
bool cli_confine(const char *model, const char *const *written, size_t count, const char *scratch);

#endif
