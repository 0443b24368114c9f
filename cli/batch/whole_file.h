/* Declares files that get their names only when they are complete. */
#ifndef VS_CLI_BATCH_WHOLE_FILE_H
#define VS_CLI_BATCH_WHOLE_FILE_H

#include <stdbool.h>
#include <stdio.h>

/* A file that is being written: PATH.part. The path lives as long as this. */
typedef struct { FILE *to; const char *path; char part[4096]; } cli_whole_file;

/* Opens PATH.part for writing. Returns its stream, or NULL with the reason in errno. */
FILE *cli_whole_begin(cli_whole_file *f, const char *path);
/* Closes the file. If `ok` is true and all was written, PATH.part becomes PATH in a single step; otherwise it is
 * removed. Returns false, with the reason in errno, if PATH is unchanged, and also if cli_whole_begin has failed. */
bool cli_whole_end(cli_whole_file *f, bool ok);

#endif
