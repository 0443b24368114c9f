/* Owns the commands that read a program without running it. */
#ifndef VS_CLI_STUDY_H
#define VS_CLI_STUDY_H

#include <stdio.h>

#include "cli/options.h"

/* Runs vs ast, vs check, ..., by o->command. Writes to standard output; returns the exit code. */
vs_outcome cli_study(const cli_options *o);

/* Writes the findings of vs check, as JSON, in a text that replaces the file's. A text that cannot be read is a finding
 * "unreadable"; a program in a language without an analysis has none. Any thread may call it. Returns false when memory
 * is out. */
bool cli_study_check_text(const vs_options *interpreter, const char *path, const char *text, size_t length, FILE *to);

#endif
