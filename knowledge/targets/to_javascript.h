/* Owns programs in JavaScript. */
#ifndef VS_KNOWLEDGE_TARGETS_TO_JAVASCRIPT_H
#define VS_KNOWLEDGE_TARGETS_TO_JAVASCRIPT_H

#include "knowledge/translate/target.h"

void tr_javascript_program(tr_writer *w);

#endif
