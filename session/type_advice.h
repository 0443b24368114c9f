/* Declares the advice for a value that a procedure does not accept, implemented in type_advice.c. */
#ifndef VS_SESSION_TYPE_ADVICE_H
#define VS_SESSION_TYPE_ADVICE_H

#include "vm/values/text.h"
#include "vm/values/value.h"

/* Appends the advice of advice.def for the error object c to t, the error's text. Returns false when memory is out. */
bool vs_session_advise_value(vs_scheme *vm, const vs_condition *c, vs_text *t);

#endif
