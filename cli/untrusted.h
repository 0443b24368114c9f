/* Owns the run of an untrusted model: see untrusted.c. */
#ifndef VS_CLI_UNTRUSTED_H
#define VS_CLI_UNTRUSTED_H

#include "cli/options.h"

typedef struct {
  int folder;            /* the model's folder, open; -1: none, and no file is read */
  char *prefix;          /* of the paths of files in it: "models/", or "" */
  char *scratch;         /* a private folder for the worker; NULL: none */
  int keeper, alive;     /* a child that removes scratch when this process ends, and the end of a pipe that signals the
                          * end; 0 and -1: none */
  size_t most;           /* the most bytes of a file */
  char why[96];
} cli_untrusted;

/* Completes the options of an untrusted model with limits and an empty environment, opens the model's folder, and
 * confines the process. Returns false after a message on standard error. */
bool cli_untrusted_begin(cli_untrusted *u, cli_options *o);
/* Reads a file below the model's folder; works as vs_host.read_file. */
bool cli_untrusted_read(cli_untrusted *u, const char *path, char **text, size_t *length, const char **why);
/* Lists the model's folder, or one below it; works as vs_host.list_folder. */
bool cli_untrusted_list(cli_untrusted *u, const char *path, bool (*take)(void *to, const char *name, size_t length),
                        void *to, const char **why);
void cli_untrusted_end(cli_untrusted *u);

#endif
