/* Owns the commands that read a program without running it. */
#ifndef VS_CLI_STUDY_H
#define VS_CLI_STUDY_H

#include <stdio.h>

#include "cli/options.h"

/* vs ast, vs check, ...: as o->command says. Writes to standard output; returns the exit code. */
vs_outcome cli_study(const cli_options *o);

/* The findings of vs check in a text that stands in place of the file's, as JSON; a text that cannot be read is a
 * finding "unreadable"; a program in a language that is not looked into has none. May be called by any thread.
 * False: out of memory. */
bool cli_study_check_text(const vs_options *interpreter, const char *path, const char *text, size_t length, FILE *to);

#endif
