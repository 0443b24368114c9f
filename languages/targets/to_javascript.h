/* Declares the output of programs in JavaScript. */
#ifndef VS_LANGUAGES_TARGETS_TO_JAVASCRIPT_H
#define VS_LANGUAGES_TARGETS_TO_JAVASCRIPT_H

#include "languages/translate/target.h"

void tr_javascript_program(tr_writer *w);

#endif
