/* Declares the run of an untrusted model, implemented in untrusted.c. */
#ifndef VS_CLI_UNTRUSTED_H
#define VS_CLI_UNTRUSTED_H

#include "cli/options.h"

typedef struct {
  int folder;            /* descriptor of the model's folder; -1: the model has no folder, and no file is read */
  char *prefix;          /* prefix of the paths of files in the folder: "models/", or "" */
  char *scratch;         /* path of a private temporary folder for external programs, or NULL */
  int keeper, alive;     /* keeper: child process that removes the folder `scratch` when this process ends, or 0; alive:
                          * writing end of the pipe to it, which closes when this process ends, or -1 */
  size_t most;           /* greatest size in bytes of a file that the model may read */
  char why[96];
} cli_untrusted;

/* Completes the options for an untrusted model: sets limits, empties the environment, opens the model's folder, and
 * confines the process. Returns false after a message on standard error. */
bool cli_untrusted_begin(cli_untrusted *u, cli_options *o);
/* Reads a file below the model's folder, as vs_host.read_file does. */
bool cli_untrusted_read(cli_untrusted *u, const char *path, char **text, size_t *length, const char **why);
/* Lists the model's folder or a folder below it, as vs_host.list_folder does. */
bool cli_untrusted_list(cli_untrusted *u, const char *path, bool (*take)(void *to, const char *name, size_t length),
                        void *to, const char **why);
void cli_untrusted_end(cli_untrusted *u);

#endif
