/* Owns the questions that long work asks its caller now and then: may it go on? Who answers false keeps the reason. */
#ifndef VS_MODEL_LONG_WORK_H
#define VS_MODEL_LONG_WORK_H

#include <stdbool.h>

/* Work whose end nobody can foresee. The answer false stops it; NULL: nobody is asked. */
typedef struct { bool (*ask)(void *context); void *context; } vs_poller;

/* Work that can tell how much of it is done: a share from 0 to 1. The answer false stops it. */
typedef struct { bool (*going)(void *context, double done); void *context; } vs_long_work;

#endif
