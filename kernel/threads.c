/* Implements the running of tasks in threads (threads.h). As many threads as there are processors take tasks one after
 * another. The result of a task depends only on its number, not on the thread. The caller's thread works too, and only
 * this thread reports progress. The clock serves statistics only. */
#include "kernel/threads.h"

#include "kernel/memory.h"
#include "model/signals.h"

#include <errno.h>
#include <pthread.h>
#include <time.h>
#include <unistd.h>

enum {
  MOST = VS_THREADS_MOST,
  WINDOW = VS_PIPELINE_WINDOW,
  STACK = 1 << 20 /* Bytes of each thread's stack. A small stack suffices because tasks do not recurse. It counts
                   * towards the process's memory limit. */
};

typedef struct {
  vs_kernel *k;
  vs_task_fn *task;
  void *context;
  size_t count, window;   /* count: number of tasks; window: number of finished results that may wait until the function
                           * `taker` reads them; 0: there is no `taker` */
  _Atomic size_t next, taken;
  _Atomic bool *ready;    /* ready[i % window]: true if task i is complete and `taker` has not read its result */
  pthread_mutex_t lock;   /* protects `running`, `failed` and `error` */
  pthread_cond_t done, space; /* done: signalled when a thread ends or a result is complete; space: signalled when
                               * `taker` has read a result */
  size_t running, failed; /* running: number of started threads that still run; failed: lowest number of a task that
                           * failed, or SIZE_MAX */
  vs_kernel_error error;
} crew;
typedef struct { crew *crew; vs_kernel k; vs_kernel_error error; } worker;

/* Runs task number i. Returns false if it fails. */
static bool do_task(crew *c, vs_kernel *k, size_t i) {
  VS_ASSERT(i < c->count);
  if (c->task(k, c->context, i)) {
    if (!c->window) return true;
    pthread_mutex_lock(&c->lock);
    atomic_store(&c->ready[i % c->window], true);
    pthread_cond_signal(&c->done);
    pthread_mutex_unlock(&c->lock);
    return true;
  }
  pthread_mutex_lock(&c->lock);
  if (k->error->status != VS_KERNEL_FINE && i < c->failed) { /* a task that ended only because another task failed
                                                              * (`stop`) has no error */
    c->failed = i;
    c->error = *k->error;
  }
  atomic_store(&c->k->stop, true);
  pthread_cond_broadcast(&c->space);
  pthread_mutex_unlock(&c->lock);
  return false;
}

static void work(crew *c, vs_kernel *k) {
  for (;;) {
    size_t i = atomic_fetch_add(&c->next, 1);
    if (i >= c->count) return;
    if (c->window && i >= atomic_load(&c->taken) + c->window) {
      pthread_mutex_lock(&c->lock);
      while (i >= atomic_load(&c->taken) + c->window && !atomic_load(&c->k->stop))
        pthread_cond_wait(&c->space, &c->lock);
      pthread_mutex_unlock(&c->lock);
    }
    if (atomic_load(&c->k->stop) || !do_task(c, k, i)) return;
  }
}

static void stop(crew *c) {
  pthread_mutex_lock(&c->lock);
  atomic_store(&c->k->stop, true);
  pthread_cond_broadcast(&c->space);
  pthread_mutex_unlock(&c->lock);
}

/* Waits until a result or thread is complete, or a short time has passed, and reports progress. */
static void wait_a_while(crew *c) {
  struct timespec until;
  clock_gettime(CLOCK_REALTIME, &until);
  until.tv_nsec += 20000000;
  if (until.tv_nsec >= 1000000000) until.tv_sec++, until.tv_nsec -= 1000000000;
  if (pthread_cond_timedwait(&c->done, &c->lock, &until) != ETIMEDOUT || atomic_load(&c->k->stop)) return;
  pthread_mutex_unlock(&c->lock);
  if (!vs_kernel_report(c->k, c->k->part)) stop(c);
  pthread_mutex_lock(&c->lock);
}

/* Calls `taker` for the results of all tasks in order. While the next result is not ready, runs other tasks itself.
 * c->window must not be 0. */
static void take(crew *c, vs_task_fn *taker) {
  vs_kernel *k = c->k;
  VS_ASSERT(c->window > 0);
  for (size_t at = 0; at < c->count && !atomic_load(&k->stop);) {
    if (atomic_load(&c->ready[at % c->window])) {
      atomic_store(&c->ready[at % c->window], false);
      if (!taker(k, c->context, at) || !vs_kernel_report(k, k->part)) { /* Only the caller's thread can detect an
                                                                         * interrupt, because it alone calls
                                                                         * vs_job_done. */
        stop(c);
        return;
      }
      at++;
      pthread_mutex_lock(&c->lock);
      atomic_store(&c->taken, at);
      pthread_cond_broadcast(&c->space); /* wakes all threads that wait for space in the window, because any of them may
                                          * have the next task */
      pthread_mutex_unlock(&c->lock);
      continue;
    }
    size_t i = atomic_load(&c->next);
    if (i < c->count && i < at + c->window) {
      if (atomic_compare_exchange_strong(&c->next, &i, i + 1) && !do_task(c, k, i)) return;
      continue;
    }
    pthread_mutex_lock(&c->lock);
    if (!atomic_load(&c->ready[at % c->window]) && !atomic_load(&k->stop)) wait_a_while(c);
    pthread_mutex_unlock(&c->lock);
  }
}

static void *begin(void *argument) {
  worker *w = argument;
  work(w->crew, &w->k);
  pthread_mutex_lock(&w->crew->lock);
  w->crew->running--;
  pthread_cond_signal(&w->crew->done);
  pthread_mutex_unlock(&w->crew->lock);
  return NULL;
}

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

void vs_kernel_time(vs_kernel *k, double laps[VS_STEP_COUNT]) {
  k->laps = laps;
  if (laps) k->since = now();
}

bool vs_kernel_lap(vs_kernel *k, vs_step step) {
  VS_ASSERT((size_t)step < VS_STEP_COUNT);
  if (!k->laps) return true;
  double at = now();
  k->laps[step] += at - k->since;
  k->since = at;
  return true;
}

uint32_t vs_kernel_threads(const vs_kernel_options *options) {
  long n = options && options->threads ? (long)options->threads : sysconf(_SC_NPROCESSORS_ONLN);
  return n < 1 ? 1 : n > MOST ? MOST : (uint32_t)n;
}

/* Runs at least two tasks on at least two threads. taker may be NULL. Returns false and sets the error if a task fails
 * or the caller interrupts. */
static bool run(vs_kernel *k, size_t count, size_t window, vs_task_fn *task, vs_task_fn *taker, void *context) {
  VS_ASSERT(k->threads >= 2 && count >= 2);
  _Atomic bool ready[WINDOW] = { false };
  crew c = {
    .k = k, .task = task, .context = context, .count = count, .window = window, .ready = ready, .failed = SIZE_MAX
  };
  worker workers[MOST];
  pthread_t threads[MOST];
  uint32_t started = 0;
  atomic_store(&k->stop, false);
  bool made = pthread_mutex_init(&c.lock, NULL) == 0, can_done = made && pthread_cond_init(&c.done, NULL) == 0;
  if (!can_done || pthread_cond_init(&c.space, NULL) != 0) {
    if (can_done) pthread_cond_destroy(&c.done);
    if (made) pthread_mutex_destroy(&c.lock);
    return vs_kernel_no_memory(k);
  }
  pthread_attr_t how;
  bool small = pthread_attr_init(&how) == 0 && pthread_attr_setstacksize(&how, STACK) == 0;
  for (uint32_t i = 1; i < k->threads && i < count; i++) {
    worker *w = &workers[started];
    w->crew = &c;
    w->error = (vs_kernel_error){ VS_KERNEL_FINE, 0, "" };
    w->k = (vs_kernel){ .options = k->options, .error = &w->error, .owner = k, .worker = started + 1, .threads = 1 };
    pthread_mutex_lock(&c.lock);
    c.running++;
    pthread_mutex_unlock(&c.lock);
    if (vs_thread_start(&threads[started], small ? &how : NULL, begin, w) != 0) { /* if a thread cannot be started,
                                                                                   * fewer threads do the work */
      pthread_mutex_lock(&c.lock);
      c.running--;
      pthread_mutex_unlock(&c.lock);
      break;
    }
    started++;
  }
  if (small) pthread_attr_destroy(&how);
  uint32_t own = k->threads;
  k->threads = 1; /* tasks that run in a thread must not start more threads */
  if (taker) take(&c, taker);
  else work(&c, k);
  k->threads = own;
  pthread_mutex_lock(&c.lock);
  while (c.running) wait_a_while(&c); /* while other threads still run, waits and reports progress */
  pthread_mutex_unlock(&c.lock);
  for (uint32_t i = 0; i < started; i++) pthread_join(threads[i], NULL);
  pthread_cond_destroy(&c.space);
  pthread_cond_destroy(&c.done);
  pthread_mutex_destroy(&c.lock);
  /* Copies the error of the failed task with the lowest number, which may have run in another thread. */
  if (k->error->status != VS_KERNEL_INTERRUPTED && c.failed != SIZE_MAX) *k->error = c.error;
  return !atomic_load(&k->stop);
}

bool vs_kernel_run(vs_kernel *k, size_t count, vs_task_fn *task, void *context) {
  if (k->threads >= 2 && count >= 2) return run(k, count, 0, task, NULL, context);
  for (size_t i = 0; i < count; i++)
    if (!task(k, context, i)) return false;
  return true;
}

bool vs_kernel_pipeline(vs_kernel *k, size_t count, vs_task_fn *task, vs_task_fn *taker, void *context) {
  if (k->threads >= 2 && count >= 2) return run(k, count, WINDOW, task, taker, context);
  for (size_t i = 0; i < count; i++)
    if (!task(k, context, i) || !taker(k, context, i)) return false;
  return true;
}
