/* Declares the commands that analyse a program without running it. */
#ifndef VS_CLI_STUDY_H
#define VS_CLI_STUDY_H

#include <stdio.h>

#include "cli/options.h"

/* Runs the command o->command, such as vs ast or vs check. Writes to standard output, and returns the exit status. */
vs_outcome cli_study(const cli_options *o);

/* Writes the findings of vs check as JSON, for a text that replaces that of the file at `path`. A text with a syntax
 * error has the finding "unreadable". A program in a language without analysis has no findings. Any thread may call the
 * function. Returns false when memory is out. */
bool cli_study_check_text(const vs_options *interpreter, const char *path, const char *text, size_t length, FILE *to);

#endif
