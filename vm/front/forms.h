/* Declares the expansion of the syntax of choice and sequence, implemented in forms.c. */
#ifndef VS_VM_FRONT_FORMS_H
#define VS_VM_FRONT_FORMS_H

#include "vm/front/expand.h"

bool vs_quasi_step(vs_expansion *x);
bool vs_case_step(vs_expansion *x);

#endif
