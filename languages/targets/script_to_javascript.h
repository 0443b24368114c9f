/* Declares the output of scripts as modules for three.js. */
#ifndef VS_LANGUAGES_TARGETS_SCRIPT_TO_JAVASCRIPT_H
#define VS_LANGUAGES_TARGETS_SCRIPT_TO_JAVASCRIPT_H

#include "languages/translate/target.h"

/* Copies the script's own text into a function of a module, with the values of parameters that the user has set. */
void tr_script_program(tr_writer *w);

#endif
