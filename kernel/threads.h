/* Owns the interface of threads.c: the threads and the clock. */
#ifndef VS_KERNEL_THREADS_H
#define VS_KERNEL_THREADS_H

#include "kernel/memory.h"

/* vs_kernel_time starts the first step. vs_kernel_lap ends a step and adds its seconds to the step's sum; returns true,
 * for use in a chain of steps. */
void vs_kernel_time(vs_kernel *k, double laps[VS_STEP_COUNT]);
/* step is one of steps.def. */
bool vs_kernel_lap(vs_kernel *k, vs_step step);
bool vs_kernel_run(vs_kernel *k, size_t count, vs_task_fn *task, void *context);
bool vs_kernel_pipeline(vs_kernel *k, size_t count, vs_task_fn *task, vs_task_fn *taker, void *context);
uint32_t vs_kernel_threads(const vs_kernel_options *options); /* returns the number of threads to use */

#endif
