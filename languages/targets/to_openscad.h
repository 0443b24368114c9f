/* Declares the output of programs in OpenSCAD's language. */
#ifndef VS_LANGUAGES_TARGETS_TO_OPENSCAD_H
#define VS_LANGUAGES_TARGETS_TO_OPENSCAD_H

#include "languages/translate/target.h"

void tr_openscad_program(tr_writer *w);

#endif
