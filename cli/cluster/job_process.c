/* Runs other programs, and measures them. */
#define _GNU_SOURCE
#include "cli/cluster/job_process.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { KILLED = 137, WAIT = 100 /* milliseconds between two checks for a signal */ };

static double seconds_of(struct timeval t) { return (double)t.tv_sec + 1e-6 * (double)t.tv_usec; }

/* Copies the pipe's bytes to the stream until all writers have closed the pipe. */
static void read_all(int from, FILE *to, pid_t process, const volatile sig_atomic_t *ended) {
  char part[4096];
  for (bool asked = false;;) {
    struct pollfd ready = {.fd = from, .events = POLLIN};
    if (*ended && !asked) asked = true, kill(process, SIGTERM);
    if (poll(&ready, 1, WAIT) <= 0) continue;
    ssize_t n = read(from, part, sizeof part);
    if (n > 0 && to) fwrite(part, 1, (size_t)n, to);
    else if (n == 0 || (n < 0 && errno != EINTR)) return;
  }
}

static int wait_for(pid_t process, const volatile sig_atomic_t *ended, struct rusage *used) {
  int status = 0;
  bool asked = false;
  for (pid_t one = 0; one == 0;) {
    one = wait4(process, &status, WNOHANG, used);
    if (one < 0 && errno == EINTR) one = 0;
    if (one == 0 && *ended && !asked) asked = true, kill(process, SIGTERM);
    else if (one == 0) nanosleep(&(struct timespec){.tv_nsec = 2000000}, NULL);
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : KILLED;
}

int job_run(const char *const *words, const volatile sig_atomic_t *ended, char **text, job_use *use) {
  int ends[2] = {-1, -1};
  size_t size = 0;
  struct timespec from, to;
  struct rusage used = {0};
  pid_t parent = getpid();
  if (text && pipe2(ends, O_CLOEXEC) != 0) return KILLED;
  fflush(NULL);
  clock_gettime(CLOCK_MONOTONIC, &from);
  pid_t child = fork();
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(KILLED);
    if (text) dup2(ends[1], STDOUT_FILENO);
    execvp(words[0], (char **)(uintptr_t)words);
    _exit(JOB_NO_PROGRAM);
  }
  if (text) close(ends[1]);
  FILE *stream = text ? open_memstream(text, &size) : NULL;
  if (text && child > 0) read_all(ends[0], stream, child, ended);
  if (text) close(ends[0]);
  if (stream) fclose(stream);
  int code = child > 0 ? wait_for(child, ended, &used) : KILLED;
  clock_gettime(CLOCK_MONOTONIC, &to);
  if (use)
    *use = (job_use){(double)(to.tv_sec - from.tv_sec) + 1e-9 * (double)(to.tv_nsec - from.tv_nsec),
                     seconds_of(used.ru_utime) + seconds_of(used.ru_stime), (double)used.ru_maxrss / 1024};
  return code;
}
