/* Owns the callbacks by which long work asks its caller now and then whether it may continue. A callback that returns
 * false keeps the reason. */
#ifndef VS_MODEL_LONG_WORK_H
#define VS_MODEL_LONG_WORK_H

#include <stdbool.h>

/* For work of unknown length. If `ask` returns false, the work stops; NULL: it never does. */
typedef struct { bool (*ask)(void *context); void *context; } vs_poller;

/* For work that knows the fraction that is done, from 0 to 1. If `going` returns false, the work stops. */
typedef struct { bool (*going)(void *context, double done); void *context; } vs_long_work;

#endif
