/* Owns programs in OpenSCAD's language. */
#ifndef VS_KNOWLEDGE_TARGETS_TO_OPENSCAD_H
#define VS_KNOWLEDGE_TARGETS_TO_OPENSCAD_H

#include "knowledge/translate/target.h"

void tr_openscad_program(tr_writer *w);

#endif
