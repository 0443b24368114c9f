/* Owns the commands that read a program without running it. */
#ifndef VS_CLI_STUDY_H
#define VS_CLI_STUDY_H

#include "cli/options.h"

/* vs ast, vs check, ...: as o->command says. Writes to standard output; returns the exit code. */
vs_outcome cli_study(const cli_options *o);

#endif
