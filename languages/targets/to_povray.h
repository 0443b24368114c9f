/* Declares the output of programs in POV-Ray's scene language. */
#ifndef VS_LANGUAGES_TARGETS_TO_POVRAY_H
#define VS_LANGUAGES_TARGETS_TO_POVRAY_H

#include "languages/translate/target.h"

void tr_povray_program(tr_writer *w);

#endif
