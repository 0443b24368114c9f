/* Owns how a model from a stranger is run: see untrusted.c. */
#ifndef VS_CLI_UNTRUSTED_H
#define VS_CLI_UNTRUSTED_H

#include "cli/options.h"

typedef struct {
  int folder;            /* the model's, open; -1: none, and nothing is read */
  char *prefix;          /* of the paths of files in it: "models/", or "" */
  char *scratch;         /* a folder of our own for the worker; NULL: none */
  int keeper, alive;     /* a child that removes scratch when we end, and the end of a pipe that tells it so; 0 and -1:
                          * none */
  size_t most;           /* bytes of a file */
  char why[96];
} cli_untrusted;

/* Gives the options of an untrusted model what they do not have: limits, no environment; opens the model's folder, and
 * confines the process. False: said on standard error. */
bool cli_untrusted_begin(cli_untrusted *u, cli_options *o);
/* A file beneath the model's folder; as vs_host.read_file. */
bool cli_untrusted_read(cli_untrusted *u, const char *path, char **text, size_t *length, const char **why);
/* The names in a folder beneath the model's, or in that; as vs_host.list_folder. */
bool cli_untrusted_list(cli_untrusted *u, const char *path, bool (*take)(void *to, const char *name, size_t length),
                        void *to, const char **why);
void cli_untrusted_end(cli_untrusted *u);

#endif
