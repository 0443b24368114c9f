/* Owns the kernel's context: accounted memory, the error, progress and interrupts. Every working array hangs off it or
 * off a task. */
#ifndef VS_KERNEL_MEMORY_H
#define VS_KERNEL_MEMORY_H

#include "kernel/kernel_options.h"

#include <stdatomic.h>

enum { VS_THREADS_MOST = 64 };

typedef struct vs_kernel {
  const vs_kernel_options *options; /* or NULL */
  vs_kernel_error *error;
  struct vs_kernel *owner; /* of a thread's: the one whose bytes and stop count; else NULL */
  uint32_t worker;         /* 0 is the caller's thread */
  uint32_t threads;        /* how many may work, itself among them */
  _Atomic size_t bytes;    /* held by grown arrays */
  _Atomic size_t peak;     /* the most of them so far */
  _Atomic bool stop;       /* a thread has failed, or the caller gave up: all leave */
  uint32_t ticks;          /* since the last call of progress */
  double done, share;      /* progress before this cluster, and what the cluster adds */
  double part;             /* of the cluster, as last reported */
  double *laps, since;     /* seconds of each step (vs_step), and when the one that goes on began; NULL: nobody asks */
} vs_kernel;

bool vs_kernel_fail(vs_kernel *k, vs_kernel_status status, uint32_t leaf, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
#define VS_BROKEN(k, why)                                                                                              \
  vs_kernel_fail(k, VS_KERNEL_INTERNAL, 0,                                                                             \
                 "the solids could not be combined: %s (a fault of vs, please report the model)", why)

/* The number of pieces that shapes have been cut into. False: more than the limit on the result leaves room for on the
 * way to it. */
bool vs_kernel_on_the_way(vs_kernel *k, size_t pieces);

/* Makes room for `need` elements of `size` bytes in the array whose address stands in *slot; *room is in elements. size
 * is not 0. */
bool vs_kernel_grow(vs_kernel *k, void *slot, size_t *room, size_t need, size_t size);
/* Frees the array, whose bytes are among those counted. */
void vs_kernel_free(vs_kernel *k, void *slot, size_t *room, size_t size);
#define VS_ROOM(k, array, room, need) ((need) <= (room) || vs_kernel_grow(k, &(array), &(room), need, sizeof *(array)))
#define VS_FREE(k, array, room) vs_kernel_free(k, &(array), &(room), sizeof *(array))

/* An array with its counts, for the many that only grow. */
#define VS_LIST(type) struct { type *at; size_t count, room; }
#define VS_PUSH(k, list, value)                                                                                        \
  (VS_ROOM(k, (list).at, (list).room, (list).count + 1) && ((list).at[(list).count++] = (value), true))
#define VS_DROP(k, list) ((list).count = 0, VS_FREE(k, (list).at, (list).room))

bool vs_kernel_report(vs_kernel *k, double part); /* part of the cluster done, 0..1; false: interrupted */
static inline bool vs_kernel_poll(vs_kernel *k, double part) {
  return (++k->ticks & 1023) != 0 || vs_kernel_report(k, part);
}

/* For procedures that only prefetch: gcc takes one that is not inlined at once for one that does nothing. */
#define VS_AHEAD static inline __attribute__((always_inline)) void

/* Calls task(k, context, 0) to task(k, context, count - 1), in any order and at once where there are threads. k is not
 * the caller's in each of them. */
typedef bool vs_task_fn(vs_kernel *k, void *context, size_t index);
/* The same, and taker(k, context, i) in the caller's thread for every i in order, after its task and while later ones
 * are still done. The result of a task may lie in place i % VS_PIPELINE_WINDOW: no more wait to be taken. Tasks must
 * not read what the taker changes. */
enum { VS_PIPELINE_WINDOW = 64 };

/* Stable merge sort of numbers by a strict order; scratch as large as the array. */
typedef bool vs_less_fn(const void *context, uint32_t a, uint32_t b);
void vs_kernel_sort(uint32_t *at, uint32_t *scratch, size_t count, vs_less_fn *less, const void *context);

#endif
