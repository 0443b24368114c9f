/* Measures the longest time between two polls, in which vs checks for an interrupt: `gaps [-v] FILE FORMAT...` runs a
 * program and writes its drawing in each of the formats, discarding the bytes.
 *
 * For each format it prints this longest time, as processor time of all threads, so that other load on the machine does
 * not count. -v also prints the program's call stacks in that time, a line of addresses for each hundredth of a second,
 * for addr2line -f -e gaps (link it with -no-pie). */
#define _GNU_SOURCE
#include "visualscheme.h"

#include <execinfo.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <time.h>

enum { DEEP = 12, SAMPLES = 200 }; /* DEEP: stored addresses of a call stack. SAMPLES: stored call stacks; one is taken
                                    * each hundredth of a second */
static struct {
  double last, longest;
  void *frames[SAMPLES][DEEP], *longest_frames[SAMPLES][DEEP]; /* frames: call stacks since the last poll.
                                                                * longest_frames: call stacks of the longest time
                                                                * between two polls */
  int count, longest_count;
} seen;

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static bool look(void *context) {
  (void)context;
  double t = now();
  if (t - seen.last > seen.longest) {
    seen.longest = t - seen.last;
    seen.longest_count = seen.count;
    memcpy(seen.longest_frames, seen.frames, sizeof seen.frames);
  }
  seen.count = 0;
  seen.last = t;
  return false;
}

static void tick(int signal) {
  (void)signal;
  if (seen.count == SAMPLES) return;
  memset(seen.frames[seen.count], 0, sizeof *seen.frames);
  backtrace(seen.frames[seen.count++], DEEP);
}

static void told(void *context, const vs_diagnostic *d) {
  (void)context;
  if (d->severity == VS_SEVERITY_ERROR) fprintf(stderr, "gaps: %u: %s\n", d->at.line, d->message);
}
static bool drop(void *context, const void *bytes, size_t count) { return (void)context, (void)bytes, (void)count, true; }

static void print(const char *what, bool where) {
  printf("%.0f ms %s\n", 1e3 * seen.longest, what);
  for (int i = 0; where && i < seen.longest_count; i++) {
    /* the first two addresses belong to the signal handler */
    for (int j = 2; j < DEEP && seen.longest_frames[i][j]; j++) printf(" %p", seen.longest_frames[i][j]);
    printf("\n");
  }
  seen.longest = 0;
  seen.longest_count = seen.count = 0;
}

int main(int argc, char **argv) {
  bool where = argc > 1 && strcmp(argv[1], "-v") == 0;
  int file = where ? 2 : 1;
  if (argc <= file) return fprintf(stderr, "usage: gaps [-v] FILE FORMAT...\n"), 2;
  vs_options options = vs_options_default();
  options.host.poll = look, options.host.diagnose = told;
  vs_scheme *s = vs_new(&options);
  if (!s) return EXIT_FAILURE;
  void *warm[1];
  backtrace(warm, 1); /* the first call of backtrace loads a library, which must not happen in the signal handler */
  if (where) {
    signal(SIGPROF, tick);
    setitimer(ITIMER_PROF, &(struct itimerval){ { 0, 10000 }, { 0, 10000 } }, NULL);
  }
  seen.last = now();
  bool ok = vs_eval_file(s, argv[file], 0) == VS_OUTCOME_DONE;
  look(NULL);
  print("evaluating", where);
  for (int i = file + 1; ok && i < argc; i++) {
    seen.last = now();
    ok = vs_write_drawing_to(s, argv[i], NULL, drop, NULL) == VS_OUTCOME_DONE;
    look(NULL);
    print(argv[i], where);
  }
  seen.last = now();
  setitimer(ITIMER_PROF, &(struct itimerval){ { 0, 0 }, { 0, 0 } }, NULL);
  vs_free(s);
  seen.longest = now() - seen.last;
  print("giving back", false);
  return ok ? EXIT_SUCCESS : EXIT_FAILURE;
}
