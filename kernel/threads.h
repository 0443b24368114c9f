/* Owns the interface of threads.c: the threads. */
#ifndef VS_KERNEL_THREADS_H
#define VS_KERNEL_THREADS_H

#include "kernel/memory.h"

/* A step ends, the first one begun by vs_kernel_time: its seconds are added to what it had. True, so that it may stand
 * between steps. */
void vs_kernel_time(vs_kernel *k, double laps[VS_STEP_COUNT]);
/* step is one of steps.def. */
bool vs_kernel_lap(vs_kernel *k, vs_step step);
bool vs_kernel_run(vs_kernel *k, size_t count, vs_task_fn *task, void *context);
bool vs_kernel_pipeline(vs_kernel *k, size_t count, vs_task_fn *task, vs_task_fn *taker, void *context);
uint32_t vs_kernel_threads(const vs_kernel_options *options); /* how many there may be */

#endif
