/* Tests that a signal at a random moment loses no file: `stopped COUNT OLD NEW OUT VS ARGUMENT...` starts VS with its
 * arguments COUNT times. It sends each process INT, TERM, HUP or KILL after a random part of the time that a run takes.
 * After each run the file OUT must equal the file OLD or the file NEW, and its folder must contain nothing else. Prints
 * the number of runs for each ending; exits with 1 if a file was lost.
 *
 * A KILL between the call that names the new file and the call that replaces the old file leaves the complete new file
 * beside OUT. This is rare, and counted separately. */
#define _GNU_SOURCE
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { MOST = 1 << 22, TOLD = 12 };

typedef struct {
  char at[MOST];
  size_t count;
} bytes;

static bool take(const char *path, bytes *b) {
  FILE *f = fopen(path, "rb");
  if (!f) return false;
  b->count = fread(b->at, 1, sizeof b->at, f);
  return fclose(f) == 0;
}

static bool put(const char *path, const bytes *b) {
  FILE *f = fopen(path, "wb");
  return f && fwrite(b->at, 1, b->count, f) == b->count && fclose(f) == 0;
}

static bool same(const bytes *a, const bytes *b) { return a->count == b->count && memcmp(a->at, b->at, a->count) == 0; }

/* Deletes all files except OUT in its folder. Returns the name of a deleted file, or NULL if there was none. */
static const char *left_beside(const char *out) {
  static char folder[4096], name[300];
  const char *slash = strrchr(out, '/');
  struct dirent *d;
  snprintf(folder, sizeof folder, "%.*s", (int)(slash - out), out);
  DIR *all = opendir(folder);
  *name = 0;
  while (all && (d = readdir(all)) != NULL)
    if (strcmp(d->d_name, ".") && strcmp(d->d_name, "..") && strcmp(d->d_name, slash + 1)) {
      snprintf(name, sizeof name, "%s", d->d_name);
      unlinkat(dirfd(all), name, 0);
    }
  if (all) closedir(all);
  return *name ? name : NULL;
}

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

int main(int argc, char **argv) {
  static const int kinds[] = { SIGINT, SIGTERM, SIGHUP, SIGKILL };
  static bytes old, new, found;
  if (argc < 6 || !strchr(argv[4], '/') || !take(argv[2], &old) || !take(argv[3], &new) || !put(argv[4], &old)) {
    return fprintf(stderr, "usage: stopped COUNT OLD NEW OUT VS ARGUMENT...\n"), 2;
  }
  long count = atol(argv[1]), wrong = 0, whole = 0, unchanged = 0, finished = 0, behind = 0;
  double takes = 0.05; /* estimated duration of a complete run in seconds */
  srand(7);
  for (long i = 0; i < count; i++) {
    const int kind = kinds[i % 4];
    const double wait = takes * 1.2 * rand() / RAND_MAX, began = now();
    const struct timespec t = { (time_t)wait, (long)((wait - (double)(time_t)wait) * 1e9) };
    int status;
    const pid_t process = fork();
    if (process == 0) {
      const int nothing = open("/dev/null", O_RDWR);
      for (int k = 0; k < 3; k++) dup2(nothing, k);
      for (int k = 0; k < 4; k++) signal(kinds[k], SIG_DFL);
      execv(argv[5], argv + 5);
      _exit(127);
    }
    if (process < 0) return perror("fork"), 2;
    nanosleep(&t, NULL);
    kill(process, kind);
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) {}
    const int code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
    if (code == 0)
      finished++, takes += 0.1 * (now() - began - takes);
    else
      takes *= 1.01; /* raises the estimated duration by 1 % after each run that was stopped, since runs take longer on
                      * a busy machine */
    const char *beside = left_beside(argv[4]);
    const bool there = take(argv[4], &found), is_old = there && same(&found, &old),
               is_new = there && same(&found, &new);
    /* A signal that arrives before the program handles signals ends the program with 128 plus the signal's number. */
    const char *why = !is_old && !is_new     ? "the file is neither the old one nor the new one"
                      : code == 0 && !is_new ? "ended with 0, and the file is not the new one"
                      : code != 0 && code != 130 && code != 128 + kind ? "no defined exit code"
                                                                       : beside;
    if (why && why == beside && kind == SIGKILL && behind++ < 1 + count / 1000) why = NULL;
    if (why && wrong++ < TOLD) printf("%s after %.4f s: ended with %d: %s\n", strsignal(kind), wait, code, why);
    if (is_new)
      whole++;
    else
      unchanged++;
    if (!is_old && !put(argv[4], &old)) return perror(argv[4]), 2;
  }
  printf("%ld runs: the new file after %ld, the old one after %ld; %ld came to their end; %ld left a file at KILL; %ld "
         "lost "
         "something\n",
         count, whole, unchanged, finished, behind, wrong);
  return wrong != 0;
}
