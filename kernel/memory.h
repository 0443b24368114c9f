/* Owns the kernel's context: accounted memory, the error, progress and interrupts. Every working array belongs to the
 * context or to a task. */
#ifndef VS_KERNEL_MEMORY_H
#define VS_KERNEL_MEMORY_H

#include "kernel/kernel_options.h"

#include <stdatomic.h>

enum { VS_THREADS_MOST = 64 };

typedef struct vs_kernel {
  const vs_kernel_options *options; /* may be NULL */
  vs_kernel_error *error;
  struct vs_kernel *owner; /* in another thread: the caller's kernel, whose bytes and stop count; else NULL */
  uint32_t worker;         /* 0 is the caller's thread */
  uint32_t threads;        /* number of threads that may work, including this one */
  _Atomic size_t bytes;    /* allocated for arrays */
  _Atomic size_t peak;     /* the largest value of bytes so far */
  _Atomic bool stop;       /* a thread has failed, or the caller interrupted: all threads return */
  uint32_t ticks;          /* polls since the last call of progress */
  double done, share;      /* progress before this cluster, and the cluster's part of the whole */
  double part;             /* progress of the cluster, as last reported */
  double *laps, since;     /* seconds of each step (vs_step), and the start of the current step; NULL: no times are
                            * wanted */
} vs_kernel;

bool vs_kernel_fail(vs_kernel *k, vs_kernel_status status, uint32_t leaf, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
#define VS_BROKEN(k, why)                                                                                              \
  vs_kernel_fail(k, VS_KERNEL_INTERNAL, 0,                                                                             \
                 "the solids could not be combined: %s (a fault of vs, please report the model)", why)

/* Checks the number of pieces into which shapes have been cut. Returns false and sets the error if it exceeds the
 * number that the limit on the result allows for intermediate pieces. */
bool vs_kernel_on_the_way(vs_kernel *k, size_t pieces);

/* Makes room for `need` elements of `size` bytes in the array whose address is in *slot; *room counts elements. size is
 * not 0. Returns false and sets the error if the memory is out or the limit is reached. */
bool vs_kernel_grow(vs_kernel *k, void *slot, size_t *room, size_t need, size_t size);
/* Frees the array and subtracts its bytes from the account. */
void vs_kernel_free(vs_kernel *k, void *slot, size_t *room, size_t size);
#define VS_ROOM(k, array, room, need) ((need) <= (room) || vs_kernel_grow(k, &(array), &(room), need, sizeof *(array)))
#define VS_FREE(k, array, room) vs_kernel_free(k, &(array), &(room), sizeof *(array))

/* A growing array with its counts. */
#define VS_LIST(type) struct { type *at; size_t count, room; }
#define VS_PUSH(k, list, value)                                                                                        \
  (VS_ROOM(k, (list).at, (list).room, (list).count + 1) && ((list).at[(list).count++] = (value), true))
#define VS_DROP(k, list) ((list).count = 0, VS_FREE(k, (list).at, (list).room))

bool vs_kernel_report(vs_kernel *k, double part); /* part: of the cluster done, 0..1; returns false if interrupted */
static inline bool vs_kernel_poll(vs_kernel *k, double part) {
  return (++k->ticks & 1023) != 0 || vs_kernel_report(k, part);
}

/* For functions that only prefetch: gcc removes a call of one that is not inlined early, as if it did nothing. */
#define VS_AHEAD static inline __attribute__((always_inline)) void

/* Calls task(k, context, 0) to task(k, context, count - 1), in any order, and at the same time if there are threads.
 * Each thread passes its own k. */
typedef bool vs_task_fn(vs_kernel *k, void *context, size_t index);
/* Does the same, and calls taker(k, context, i) in the caller's thread for every i in order, after task i and while
 * later tasks still run. The result of a task may be at place i % VS_PIPELINE_WINDOW: no more results wait for the
 * taker. Tasks must not read data that the taker changes. */
enum { VS_PIPELINE_WINDOW = 64 };

/* Sorts the numbers by a strict order, stably, by merging; scratch is as large as the array. */
typedef bool vs_less_fn(const void *context, uint32_t a, uint32_t b);
void vs_kernel_sort(uint32_t *at, uint32_t *scratch, size_t count, vs_less_fn *less, const void *context);

#endif
