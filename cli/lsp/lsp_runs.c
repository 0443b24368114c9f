/* Runs programs confined, in processes of their own. */
#include "cli/lsp/lsp_runs.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include "cli/confine.h"
#include "model/store/array.h"

/* MOST_RUNS: number of runs at a time; a further one is refused. MOST_SAID: bytes of output that a run keeps. */
enum { MOST_RUNS = 8, MOST_SAID = 64 << 20, PIECE = 65536, MOST_WORDS = 40 };

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Returns the folder whose files the run may read: that of the project if it contains the text, otherwise the
 * text's. */
static const char *readable(const lsp_server *s, const char *path) {
  size_t n = s->root ? strlen(s->root) : 0;
  return n > 1 && !strncmp(path, s->root, n) && path[n] == '/' ? s->root : ".";
}

/* Becomes the command. Returns its exit code. Without confinement nothing runs. */
static int become(const lsp_server *s, const char *path, const char *const *words, int output) {
  char *list[MOST_WORDS + 1] = { 0 };
  int count = 0, input = open("/dev/null", O_RDONLY);
  const char *slash = strrchr(path, '/'), *root = readable(s, path);
  char *folder = strdup(path);
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  if (!slash || !folder || input < 0 || dup2(input, STDIN_FILENO) < 0 || dup2(output, STDOUT_FILENO) < 0 ||
      dup2(output, STDERR_FILENO) < 0) return VS_OUTCOME_MACHINE;
  folder[slash - path + (slash == path)] = 0;
  if (chdir(folder) != 0 || !cli_confine(root, NULL, 0, NULL)) return VS_OUTCOME_MACHINE;
  if (s->interpreter->library_path) setenv("VS_LIBRARY_PATH", s->interpreter->library_path, 1);
  while (count < MOST_WORDS && words[count]) {
    list[count] = (char *)(uintptr_t)words[count];
    count++;
  }
  return s->run(count, list);
}

static void free_run(lsp_run *r) {
  free(r->uri);
  free(r->id);
  free(r->text);
  free(r->range);
  free(r->said);
}

bool lsp_run_start(lsp_server *s, lsp_run *r, const lsp_document *d, const char *const *words, double seconds) {
  int ends[2] = { -1, -1 };
  bool ok = s->run_count < MOST_RUNS && VS_GROW(s->runs, s->run_room, s->run_count + 1) &&
            VS_GROW(r->said, r->room, 1) && (r->uri = strdup(d->uri)) != NULL && pipe(ends) == 0;
  fflush(stdout);
  pid_t process = ok ? fork() : -1;
  if (process == 0) {
    close(ends[0]);
    exit(become(s, d->path, words, ends[1]));
  }
  if (ends[1] >= 0) close(ends[1]);
  if (process < 0) {
    if (ends[0] >= 0) close(ends[0]);
    free_run(r);
    return false;
  }
  *r->said = 0;
  r->process = process, r->from = ends[0], r->end = now() + seconds;
  s->runs[s->run_count++] = *r;
  return true;
}

/* Removes the run number i, whose process has ended or is killed. */
static lsp_run take_run(lsp_server *s, size_t i) {
  lsp_run r = s->runs[i];
  s->runs[i] = s->runs[--s->run_count];
  close(r.from);
  kill(r.process, SIGKILL);
  while (waitpid(r.process, NULL, 0) < 0 && errno == EINTR) {}
  return r;
}

static void finish(lsp_server *s, size_t i, bool whole) {
  lsp_run r = take_run(s, i);
  r.done(s, &r, whole);
  free_run(&r);
}

void lsp_run_stop(lsp_server *s, const lsp_document *d, void (*done)(lsp_server *, const lsp_run *, bool)) {
  for (size_t i = s->run_count; i-- > 0;) {
    if (s->runs[i].done != done || strcmp(s->runs[i].uri, d->uri)) continue;
    lsp_run r = take_run(s, i);
    free_run(&r);
  }
}

/* Adds output of the run. Returns false at its end. */
static bool take_said(lsp_run *r) {
  char piece[PIECE];
  ssize_t n = read(r->from, piece, sizeof piece);
  if (n < 0) return errno == EINTR;
  if (n > 0 && r->count + (size_t)n < MOST_SAID && VS_GROW(r->said, r->room, r->count + (size_t)n + 1)) {
    memcpy(r->said + r->count, piece, (size_t)n);
    r->count += (size_t)n;
    r->said[r->count] = 0;
  }
  return n > 0;
}

/* Returns the time until the first run is too long, in milliseconds. */
static int time_left(const lsp_server *s) {
  double left = 3600, moment = now();
  for (size_t i = 0; i < s->run_count; i++)
    if (s->runs[i].end - moment < left) left = s->runs[i].end - moment;
  return left <= 0 ? 0 : (int)(1000 * left) + 1;
}

void lsp_runs_wait(lsp_server *s) {
  while (s->run_count) {
    struct pollfd ready[MOST_RUNS + 1] = { { .fd = STDIN_FILENO, .events = POLLIN } };
    for (size_t i = 0; i < s->run_count; i++) ready[i + 1] = (struct pollfd){ .fd = s->runs[i].from, .events = POLLIN };
    if (poll(ready, (nfds_t)s->run_count + 1, time_left(s)) < 0) continue;
    for (size_t i = s->run_count; i-- > 0;) {
      if (ready[i + 1].revents && !take_said(&s->runs[i])) finish(s, i, true);
      else if (now() >= s->runs[i].end) finish(s, i, false);
    }
    if (ready[0].revents) return;
  }
}

void lsp_runs_end(lsp_server *s) {
  while (s->run_count) {
    lsp_run r = take_run(s, 0);
    free_run(&r);
  }
  free(s->runs);
  s->runs = NULL;
}
