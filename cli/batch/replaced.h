/* Declares the list of files that frames of --frames have replaced. A later frame may read one of them: the run then
 * puts the old file back, so that no output destroys an input. */
#ifndef VS_CLI_BATCH_REPLACED_H
#define VS_CLI_BATCH_REPLACED_H

#include <stdbool.h>
#include <stddef.h>

#include "visualscheme.h"

/* A file that an output replaces. path: its name after all symbolic links; old: the temporary name of the old file. */
typedef struct { char *path, *old; } cli_replaced_file;
typedef struct { cli_replaced_file *at; size_t count, room; } cli_replaced;

/* Keeps the file at path under a second name beside it, until cli_replaced_end. Does nothing if there is no such file,
 * or this run wrote it. Returns false, with the reason in errno, if the system refuses. */
bool cli_replaced_keep(cli_replaced *r, const char *path);
/* Puts back each replaced file that s has read, and prints a message with the number of the frame that reads it.
 * Returns false if a file was put back. */
bool cli_replaced_unread(cli_replaced *r, const vs_scheme *s, long frame);
/* Removes the old files, and frees the list. */
void cli_replaced_end(cli_replaced *r);

#endif
