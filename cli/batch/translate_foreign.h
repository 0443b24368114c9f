/* Declares the translation of programs in OpenSCAD to Scheme. */
#ifndef VS_CLI_BATCH_TRANSLATE_FOREIGN_H
#define VS_CLI_BATCH_TRANSLATE_FOREIGN_H

#include "cli/options.h"

/* Returns true if the command line asks to translate a program in OpenSCAD to one in Scheme. */
bool cli_translates_foreign(const cli_options *o);
/* Translates the program and writes it. The library (openscad) prints the text of the translation. */
vs_outcome cli_translate_foreign(const cli_options *o);

#endif
