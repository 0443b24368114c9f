/* Declares the functions of reorder.c. */
#ifndef VS_BIND_CALL_REORDER_H
#define VS_BIND_CALL_REORDER_H

#include "bind/call/call.h"

/* After an error of type: if the n arguments fit a form of the procedure in another order, the error's payload becomes
 * a text that shows it (session/advice.c). */
void vs_bind_reorder(vs_args *f, const vs_value *a, int n);

#endif
