/* Defines the context of a call of the kernel: its counted memory, error, progress and interrupts. Every working array
 * is counted in a context. */
#ifndef VS_KERNEL_MEMORY_H
#define VS_KERNEL_MEMORY_H

#include "kernel/kernel_options.h"

#include <stdatomic.h>

enum { VS_THREADS_MOST = 64 };

typedef struct vs_kernel {
  const vs_kernel_options *options; /* the caller's options; NULL: the default options */
  vs_kernel_error *error;
  struct vs_kernel *owner; /* in another thread: the context of the caller's thread, whose `bytes` and `stop` all
                            * threads use; in the caller's thread: NULL */
  uint32_t worker;         /* number of the thread; 0 is the caller's thread */
  uint32_t threads;        /* number of threads that may work at one time, including the caller's thread */
  _Atomic size_t bytes;    /* number of bytes that are allocated for arrays */
  _Atomic size_t peak;     /* largest value of `bytes` so far */
  _Atomic bool stop;       /* true if a thread has failed or the caller has interrupted the kernel; all threads then
                            * return */
  uint32_t ticks;          /* number of polls since the kernel last called vs_job_done */
  double done, share;      /* done: fraction of all work that was finished before the current cluster, 0 to 1; share:
                            * fraction of all work that the current cluster makes up, 0 to 1 */
  double part;             /* fraction of the current cluster's work that is finished, as last reported, 0 to 1 */
  double *laps, since;     /* laps: array of the seconds of each step, indexed by vs_step; NULL: no time is measured.
                            * since: time in seconds when the current step began */
} vs_kernel;

bool vs_kernel_fail(vs_kernel *k, vs_kernel_status status, uint32_t leaf, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
/* Sets the error to VS_KERNEL_OUT_OF_MEMORY: malloc or the limit max_bytes refused a request. Returns false. */
bool vs_kernel_no_memory(vs_kernel *k);
#define VS_BROKEN(k, why)                                                                                              \
  vs_kernel_fail(k, VS_KERNEL_INTERNAL, 0,                                                                             \
                 "the solids could not be combined: %s (a fault of vs, please report the model)", why)

/* Compares the number of pieces into which triangles have been cut with the limit. Returns false and sets the error if
 * it exceeds VS_ON_THE_WAY times the limit on the result's triangles. */
bool vs_kernel_on_the_way(vs_kernel *k, size_t pieces);

/* Enlarges the array whose address is in *slot to at least `need` elements of `size` bytes; *room is the number of
 * elements that it can hold. size is not 0. Returns false and sets the error if memory is out or the limit on memory is
 * exceeded. */
bool vs_kernel_grow(vs_kernel *k, void *slot, size_t *room, size_t need, size_t size);
/* Frees the array whose address is in *slot, and subtracts its bytes from the counted memory. */
void vs_kernel_free(vs_kernel *k, void *slot, size_t *room, size_t size);
#define VS_ROOM(k, array, room, need) ((need) <= (room) || vs_kernel_grow(k, &(array), &(room), need, sizeof *(array)))
#define VS_FREE(k, array, room) vs_kernel_free(k, &(array), &(room), sizeof *(array))

/* A growing array. count: number of elements; room: number of elements for which it has memory. */
#define VS_LIST(type) struct { type *at; size_t count, room; }
#define VS_PUSH(k, list, value)                                                                                        \
  (VS_ROOM(k, (list).at, (list).room, (list).count + 1) && ((list).at[(list).count++] = (value), true))
#define VS_DROP(k, list) ((list).count = 0, VS_FREE(k, (list).at, (list).room))

bool vs_kernel_report(vs_kernel *k, double part); /* reports to the caller that the fraction `part`, 0 to 1, of the
                                                   * cluster's work is finished; returns false if the caller
                                                   * interrupts */
static inline bool vs_kernel_poll(vs_kernel *k, double part) {
  return (++k->ticks & 1023) != 0 || vs_kernel_report(k, part);
}

/* Marks a function that only asks the processor to load memory early (prefetch). gcc must inline it, because it removes
 * calls of a function without effect. */
#define VS_AHEAD static inline __attribute__((always_inline)) void

/* vs_kernel_run calls task(k, context, 0) to task(k, context, count - 1) in any order, several at a time in several
 * threads. k is the context of the thread that runs the task. If a task returns false, the remaining tasks are not
 * run. */
typedef bool vs_task_fn(vs_kernel *k, void *context, size_t index);
/* Runs tasks as vs_kernel_run does. Also calls taker(k, context, i) for every i in increasing order, in the caller's
 * thread, after task i. At most VS_PIPELINE_WINDOW results wait for the taker, so task i can store its result at index
 * i % VS_PIPELINE_WINDOW. */
enum { VS_PIPELINE_WINDOW = 64 };

/* A function that returns true if a comes before b in a sort. vs_kernel_sort sorts the array `at` stably in this order;
 * scratch: an array with as many elements. */
typedef bool vs_less_fn(const void *context, uint32_t a, uint32_t b);
void vs_kernel_sort(uint32_t *at, uint32_t *scratch, size_t count, vs_less_fn *less, const void *context);

#endif
