/* Enforces the limits of memory and time for work that the library cannot count or stop. Such work is done in GEOS,
 * FreeType, OpenEXR and libpng, in temporary memory of geometric algorithms, and between two distant polls.
 *
 * Memory: the library counts the heap, the model and the kernel's meshes, and refuses more with a message that has a
 * place. All other memory comes from malloc. The system makes malloc fail beyond RLIMIT_DATA, which is an error like
 * any other. The command sets only the soft limit, so that an external program can have a higher limit.
 *
 * Time: the library polls often, and ends by itself at its limit. A thread watches it. If the limit has passed and
 * there was no poll for a while, the process reports this and ends. Output files get their names only when they are
 * complete, so that none is left incomplete. */
#define _GNU_SOURCE
#include "cli/limits.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <semaphore.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include "model/signals.h"
#include "visualscheme.h"

#define GRACE 0.3         /* seconds after the time limit and without a poll, after which the process ends */
#define GRACE_AT_PROMPT 3 /* as GRACE, but at the prompt, where the end of the process loses the typed text */
#define ASLEEP 5  /* seconds without a poll after which a step that waits is ended, even if it uses no processor time */

enum {
  BESIDE = 4 << 20 /* bytes that the memory limit of the process exceeds 1.1 times the user's limit, for stacks of
                    * threads and tables of libraries */,
  STACK = 256 << 10
};

/* ---- limiting memory ---- */

/* Returns the number of bytes of data that the process has now. */
static size_t data_now(void) {
  unsigned long pages = 0;
  FILE *f = fopen("/proc/self/statm", "r");
  if (f && fscanf(f, "%*u %*u %*u %*u %*u %lu", &pages) != 1) pages = 0;
  if (f) fclose(f);
  return (size_t)pages * (size_t)sysconf(_SC_PAGESIZE);
}

/* Lowers the soft limit of data to `most` bytes. With for_good, also lowers the hard limit, which the process cannot
 * raise again. */
static void lower_data_limit(rlim_t most, bool for_good) {
#ifdef __SANITIZE_ADDRESS__
  return; /* no limit with the address sanitizer, which needs several times the memory, and ends a process when it is
           * refused any */
#endif
  struct rlimit r;
  if (getrlimit(RLIMIT_DATA, &r) != 0) return;
  if (r.rlim_cur > most) r.rlim_cur = most; /* RLIM_INFINITY, "no limit", is the largest number, so the comparison is
                                             * correct for it, too */
  if (for_good && r.rlim_max > most) r.rlim_max = most;
  setrlimit(RLIMIT_DATA, &r);
}

void cli_limits_memory(size_t limit) {
  lower_data_limit((rlim_t)data_now() + limit + limit / 10 + BESIDE, false);
}

void cli_limits_memory_for_good(size_t most) { lower_data_limit((rlim_t)most, true); }

/* ---- limiting time ---- */

static double seconds(clockid_t clock) {
  struct timespec t;
  clock_gettime(clock, &t);
  return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

static double now(void) { return seconds(CLOCK_MONOTONIC); }

/* Returns the seconds for which the process was ready to run but had no processor. Such seconds do not count towards
 * the time limit. */
static double starved(int file) {
  char text[100];
  unsigned long long ran, waited = 0;
  ssize_t n = file >= 0 ? pread(file, text, sizeof text - 1, 0) : 0;
  if (n > 0) text[n] = 0;
  return n > 0 && sscanf(text, "%llu %llu", &ran, &waited) == 2 ? (double)waited * 1e-9 : 0;
}

static void end_here(cli_watch *w) {
  char text[400];
  int n =
      snprintf(text, sizeof text, "%.200s: stopped after %g seconds, the limit, in a step that cannot be interrupted\n",
               w->name, w->limit);
  if (ftrylockfile(stdout) == 0) fflush_unlocked(stdout); /* writes the text that the program has printed so far, unless
                                                           * another thread is printing now */
  if (!atomic_load(&w->told) && n > 0 && write(STDERR_FILENO, text, (size_t)n) < 0) { /* ignores a failed write: nobody
                                                                                       * reads standard error */
  }
  _exit(VS_OUTCOME_MACHINE);
}

/* Waits until the watch is closed, but at most this number of nanoseconds. Returns true if it is closed. */
static bool closed_within(cli_watch *w, long nanoseconds) {
  struct timespec until;
  clock_gettime(CLOCK_MONOTONIC, &until);
  until.tv_nsec += nanoseconds;
  if (until.tv_nsec >= 1000000000) until.tv_sec++, until.tv_nsec -= 1000000000;
  return sem_clockwait(&w->closed, CLOCK_MONOTONIC, &until) == 0;
}

static void *look_on(void *context) {
  cli_watch *w = context;
  double began_seen = 0, polled_seen = 0, began_starved = 0, polled_starved = 0, began_ran = 0, polled_ran = 0;
  for (;;) {
    if (closed_within(w, 25000000)) return NULL;
    double at = now(), began = atomic_load(&w->began), polled = atomic_load(&w->polled), lost = starved(w->scheduling);
    double ran = seconds(CLOCK_PROCESS_CPUTIME_ID), grace = w->prompt ? GRACE_AT_PROMPT : GRACE;
    if (began != began_seen) began_seen = began, began_starved = lost, began_ran = ran;
    if (polled != polled_seen) polled_seen = polled, polled_starved = lost, polled_ran = ran;
    if (began == 0 || at - began <= w->limit + grace) continue;
    /* The system counts a wait for a processor only when it ends. During such a wait the clock advances without a poll,
     * although the library is not at fault. The processor time, which does not advance, shows this. */
    double since_began = at - began - (lost - began_starved), since_polled = at - polled - (lost - polled_starved),
           most = w->limit + grace + 0.1;
    bool silent = since_polled > grace && ran - polled_ran > grace, asleep = at - polled > ASLEEP;
    bool deaf = atomic_load(&w->evaluating) && since_began > most && ran - began_ran > most;
    if (silent || asleep || deaf) end_here(w);
  }
}

bool cli_limits_watch(cli_watch *w) {
  pthread_attr_t how;
  if (pthread_attr_init(&how) != 0) return false;
  pthread_attr_setstacksize(&how, STACK);
  w->watching = sem_init(&w->closed, 0, 0) == 0 && vs_thread_start(&w->thread, &how, look_on, w) == 0;
  pthread_attr_destroy(&how);
  return w->watching;
}

void cli_watch_open(cli_watch *w) {
  *w = (cli_watch){ .name = "vs", .scheduling = open("/proc/self/schedstat", O_RDONLY | O_CLOEXEC) };
}

void cli_watch_close(cli_watch *w) {
  if (!w->watching) return;
  w->watching = false;
  sem_post(&w->closed);
  pthread_join(w->thread, NULL);
}

void cli_watch_poll(cli_watch *w) {
  if (w->limit > 0) atomic_store(&w->polled, now());
}

void cli_watch_begin(cli_watch *w, bool evaluating) {
  if (w->limit <= 0) return;
  double at = now();
  atomic_store(&w->told, false);
  atomic_store(&w->evaluating, evaluating);
  atomic_store(&w->polled, at);
  atomic_store(&w->began, at);
}

void cli_watch_end(cli_watch *w) { atomic_store(&w->began, 0); }
