/* Measures a command: `measure RUNS COMMAND ARGUMENT...` runs the command RUNS times, one after the other, and writes a
 * line. The line contains the median of its processor time (user and system) in milliseconds, the median of its elapsed
 * time, and its largest resident memory in kilobytes. The command's output of the first run goes to our own output;
 * that of later runs is discarded. Exit 1 if a run fails. */
#define _DEFAULT_SOURCE      /* for wait4, which returns the resources that a child used */
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { MOST = 1000 };

static int ascending(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static double median(double *at, int n) {
  qsort(at, (size_t)n, sizeof *at, ascending);
  return n % 2 ? at[n / 2] : (at[n / 2 - 1] + at[n / 2]) / 2;
}

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec * 1e3 + (double)t.tv_nsec / 1e6;
}

static double milliseconds(struct timeval t) { return (double)t.tv_sec * 1e3 + (double)t.tv_usec / 1e3; }

int main(int argc, char **argv) {
  double cpu[MOST], wall[MOST];
  long memory = 0;
  int runs = argc > 2 ? atoi(argv[1]) : 0;
  if (runs < 1 || runs > MOST) return fprintf(stderr, "usage: measure RUNS COMMAND...   (1 to %d runs)\n", MOST), 2;
  for (int i = 0; i < runs; i++) {
    struct rusage used;
    int state;
    double begin = now();
    pid_t child = fork();
    if (child < 0) return perror("measure"), 1;
    if (child == 0) {
      int nowhere = open("/dev/null", O_WRONLY);
      if (i > 0 && nowhere >= 0) dup2(nowhere, STDOUT_FILENO);
      execvp(argv[2], argv + 2);
      perror(argv[2]);
      _exit(127);
    }
    if (wait4(child, &state, 0, &used) != child) return perror("measure"), 1;
    if (!WIFEXITED(state) || WEXITSTATUS(state) != 0) return 1;
    wall[i] = now() - begin;
    cpu[i] = milliseconds(used.ru_utime) + milliseconds(used.ru_stime);
    if (used.ru_maxrss > memory) memory = used.ru_maxrss;
  }
  fprintf(stderr, "%.3f %.3f %ld\n", median(cpu, runs), median(wall, runs), memory);
  return 0;
}
