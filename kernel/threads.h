/* Declares the functions of threads.c for running tasks in threads, and the kernel's clock. */
#ifndef VS_KERNEL_THREADS_H
#define VS_KERNEL_THREADS_H

#include "kernel/memory.h"

/* vs_kernel_time starts the clock; if laps is NULL, no time is measured. vs_kernel_lap adds the seconds since then, or
 * since its last call, to laps[step]. It always returns true, so that it can be an operand of &&. */
void vs_kernel_time(vs_kernel *k, double laps[VS_STEP_COUNT]);
/* Ends a step of the kernel and adds its seconds to its account. `step` must be a row of steps.def. */
bool vs_kernel_lap(vs_kernel *k, vs_step step);
bool vs_kernel_run(vs_kernel *k, size_t count, vs_task_fn *task, void *context);
bool vs_kernel_pipeline(vs_kernel *k, size_t count, vs_task_fn *task, vs_task_fn *taker, void *context);
uint32_t vs_kernel_threads(const vs_kernel_options *options); /* returns the number of threads to use: the number in
                                                               * options if it is not 0, else the number of
                                                               * processors */

#endif
