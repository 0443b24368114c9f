/* Declares the callbacks by which a long computation asks its caller whether to continue. A callback that returns false
 * has stored the reason itself. */
#ifndef VS_MODEL_LONG_WORK_H
#define VS_MODEL_LONG_WORK_H

#include <stdbool.h>

/* Callback of a computation of unknown length. The computation stops when `ask` returns false; if `ask` is NULL, it
 * never stops early. */
typedef struct { bool (*ask)(void *context); void *context; } vs_poller;

/* Callback of a computation that reports its progress: `done` is from 0 to 1. The computation stops when `going`
 * returns false. */
typedef struct { bool (*going)(void *context, double done); void *context; } vs_long_work;

#endif
