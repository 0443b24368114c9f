/* Owns the threads: tasks handed out one by one to as many as there are processors. What a task makes depends on its number alone, so the result
 * does not depend on who did it. The caller's thread works too, and is the only one that reports progress. */
#include "kernel/memory.h"

#include <errno.h>
#include <pthread.h>
#include <time.h>
#include <unistd.h>

enum { MOST = VS_THREADS_MOST };

typedef struct {
  vs_kernel *k;
  vs_task_fn *task;
  void *context;
  size_t count;
  _Atomic size_t next;
  pthread_mutex_t lock; /* of the rest */
  pthread_cond_t done;
  size_t running, failed; /* failed: the least task that did */
  vs_kernel_error error;
} crew;
typedef struct { crew *crew; vs_kernel k; vs_kernel_error error; } worker;

static void work(crew *c, vs_kernel *k) {
  for (;;) {
    size_t i = atomic_fetch_add(&c->next, 1);
    if (i >= c->count || atomic_load(&c->k->stop)) return;
    if (c->task(k, c->context, i)) continue;
    pthread_mutex_lock(&c->lock);
    if (k->error->status != VS_KERNEL_FINE && i < c->failed) { /* one that was only stopped has nothing to say */
      c->failed = i;
      c->error = *k->error;
    }
    pthread_mutex_unlock(&c->lock);
    atomic_store(&c->k->stop, true);
    return;
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

uint32_t vs_kernel_threads(const vs_kernel_options *options) {
  long n = options && options->threads ? (long)options->threads : sysconf(_SC_NPROCESSORS_ONLN);
  return n < 1 ? 1 : n > MOST ? MOST : (uint32_t)n;
}

bool vs_kernel_run(vs_kernel *k, size_t count, vs_task_fn *task, void *context) {
  if (k->threads < 2 || count < 2) {
    for (size_t i = 0; i < count; i++)
      if (!task(k, context, i)) return false;
    return true;
  }
  crew c = { .k = k, .task = task, .context = context, .count = count, .failed = SIZE_MAX };
  worker workers[MOST];
  pthread_t threads[MOST];
  uint32_t started = 0;
  atomic_store(&k->stop, false);
  if (pthread_mutex_init(&c.lock, NULL) != 0) return vs_kernel_fail(k, VS_KERNEL_OUT_OF_MEMORY, 0, "out of memory while combining solids");
  if (pthread_cond_init(&c.done, NULL) != 0) {
    pthread_mutex_destroy(&c.lock);
    return vs_kernel_fail(k, VS_KERNEL_OUT_OF_MEMORY, 0, "out of memory while combining solids");
  }
  for (uint32_t i = 1; i < k->threads && i < count; i++) {
    worker *w = &workers[started];
    w->crew = &c;
    w->error = (vs_kernel_error){ VS_KERNEL_FINE, 0, "" };
    w->k = (vs_kernel){ .options = k->options, .error = &w->error, .owner = k, .worker = started + 1, .threads = 1 };
    pthread_mutex_lock(&c.lock);
    c.running++;
    pthread_mutex_unlock(&c.lock);
    if (pthread_create(&threads[started], NULL, begin, w) != 0) { /* with fewer, then */
      pthread_mutex_lock(&c.lock);
      c.running--;
      pthread_mutex_unlock(&c.lock);
      break;
    }
    started++;
  }
  uint32_t own = k->threads;
  k->threads = 1; /* a task has no threads of its own */
  work(&c, k);
  k->threads = own;
  pthread_mutex_lock(&c.lock);
  while (c.running) { /* wait, and keep reporting */
    struct timespec until;
    clock_gettime(CLOCK_REALTIME, &until);
    until.tv_nsec += 20000000;
    if (until.tv_nsec >= 1000000000) until.tv_sec++, until.tv_nsec -= 1000000000;
    if (pthread_cond_timedwait(&c.done, &c.lock, &until) == ETIMEDOUT && !atomic_load(&k->stop)) {
      pthread_mutex_unlock(&c.lock);
      if (!vs_kernel_report(k, k->part)) atomic_store(&k->stop, true);
      pthread_mutex_lock(&c.lock);
    }
  }
  pthread_mutex_unlock(&c.lock);
  for (uint32_t i = 0; i < started; i++) pthread_join(threads[i], NULL);
  pthread_cond_destroy(&c.done);
  pthread_mutex_destroy(&c.lock);
  if (k->error->status == VS_KERNEL_FINE && c.failed != SIZE_MAX) *k->error = c.error;
  return !atomic_load(&k->stop);
}
