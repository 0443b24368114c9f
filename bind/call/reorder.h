/* Declares advice for arguments in a wrong order, implemented in reorder.c. */
#ifndef VS_BIND_CALL_REORDER_H
#define VS_BIND_CALL_REORDER_H

#include "bind/call/call.h"

/* Called after an error about an argument's type. If the n arguments fit a form of the procedure in another order, the
 * error's payload becomes a text that shows them in this order (for session/advice.c). */
void vs_bind_reorder(vs_args *f, const vs_value *a, int n);

#endif
