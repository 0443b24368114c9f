/* Implements --watch. The runs send the names of the files that they read, as to `vs render` (inputs_told.h). The
 * states of the files are asked ten times a second: that works on all file systems, those of a network too. */
#define _GNU_SOURCE
#include "cli/batch/watch.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "cli/batch/inputs_told.h"
#include "model/store/array.h"

enum { PAUSE = 100000000 /* nanoseconds between two checks of the files */ };

/* A file, with its state when the run had ended. */
typedef struct { char *path; struct stat is; bool there; } watched;
typedef struct { watched *at; size_t count, room; } watched_list;

static void pause_once(void) { nanosleep(&(struct timespec){.tv_nsec = PAUSE}, NULL); }

static bool is_same(const struct stat *a, const struct stat *b) {
  return a->st_ino == b->st_ino && a->st_size == b->st_size && a->st_mtim.tv_sec == b->st_mtim.tv_sec &&
         a->st_mtim.tv_nsec == b->st_mtim.tv_nsec;
}

static bool is_after(struct timespec a, struct timespec b) {
  return a.tv_sec != b.tv_sec ? a.tv_sec > b.tv_sec : a.tv_nsec >= b.tv_nsec;
}

/* ---- a run ---- */

/* Runs the command once. Sets *list to the descriptor of the file with the names of the files that it read. Returns the
 * exit code. */
static int run_once(const volatile sig_atomic_t *ended, char **words, int (*run)(int argc, char **argv), int *list) {
  int status = 0, count = 0;
  pid_t parent = getpid();
  bool asked = false;
  while (words[count]) count++;
  *list = cli_inputs_begin();
  fflush(NULL);
  pid_t child = fork();
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    exit(getppid() == parent ? run(count, words) : VS_OUTCOME_INTERRUPTED);
  }
  for (pid_t one = 0; child > 0 && one == 0;) {
    one = waitpid(child, &status, WNOHANG);
    if (one < 0 && errno == EINTR) one = 0;
    if (one == 0 && *ended && !asked) asked = true, kill(child, SIGTERM);
    else if (one == 0) nanosleep(&(struct timespec){.tv_nsec = 5000000}, NULL);
  }
  return child > 0 && WIFEXITED(status) ? WEXITSTATUS(status) : VS_OUTCOME_MACHINE;
}

/* ---- the files ---- */

static void forget(watched_list *l) {
  for (size_t i = 0; i < l->count; i++) free(l->at[i].path);
  l->count = 0;
}

/* Fills the list with the files that the run has read, and the files of the command line. Returns false if the run has
 * read no file, or memory is out. */
static bool take_names(const cli_options *o, int list, watched_list *l) {
  vs_scheme *s = vs_new(&o->interpreter);
  const char *name;
  if (!s) return false;
  cli_inputs_hear(list, s);
  bool any = vs_input_name(s, 0) != NULL, ok = true;
  for (size_t i = 0; i < o->source_count; i++)
    if (o->sources[i].kind == CLI_SOURCE_FILE && strcmp(o->sources[i].text, "-")) vs_note_input(s, o->sources[i].text);
  for (size_t i = 0; i < o->set_count; i++)
    if (!strchr(o->sets[i], '=')) vs_note_input(s, o->sets[i]);
  for (size_t i = 0; ok && (name = vs_input_name(s, i)) != NULL; i++) {
    watched w = {.path = strdup(name)};
    ok = w.path && VS_GROW(l->at, l->room, l->count + 1);
    if (!ok) free(w.path);
    else w.there = stat(name, &w.is) == 0, l->at[l->count++] = w;
  }
  vs_free(s);
  return any && ok;
}

/* Waits until a file changes, and then until it no longer changes. A file that was written between `began` and `done`,
 * while the command ran, counts as changed. Returns its path, or NULL when the command is to end. */
static const char *await_change(watched_list *l, struct timespec began, struct timespec done,
                                const volatile sig_atomic_t *ended) {
  struct stat is, next;
  for (; !*ended; pause_once())
    for (size_t i = 0; i < l->count && !*ended; i++) {
      watched *w = &l->at[i];
      bool there = stat(w->path, &is) == 0;
      bool during = is_after(is.st_mtim, began) && !is_after(is.st_mtim, done);
      if (!there || (w->there && is_same(&is, &w->is) && !during)) continue;
      do pause_once();
      while (!*ended && (stat(w->path, &next) != 0 || (!is_same(&is, &next) && (is = next, true))));
      return *ended ? NULL : w->path;
    }
  return NULL;
}

int cli_watch_files(const cli_options *o, const volatile sig_atomic_t *ended, char **words,
                    int (*run)(int argc, char **argv)) {
  watched_list files = {0};
  const char *changed = "";
  int code = VS_OUTCOME_DONE;
  while (changed && !*ended) {
    struct timespec began, done;
    int list;
    clock_gettime(CLOCK_REALTIME, &began);
    code = run_once(ended, words, run, &list);
    forget(&files);
    bool any = take_names(o, list, &files);
    clock_gettime(CLOCK_REALTIME, &done);
    if (list >= 0) close(list);
    if (!any || *ended) break;
    if (!o->quiet) fprintf(stderr, "vs: watches %zu file%s; Ctrl-C ends it\n", files.count,
                            files.count == 1 ? "" : "s");
    changed = await_change(&files, began, done, ended);
    if (changed && !o->quiet) fprintf(stderr, "vs: %s has changed\n", changed);
  }
  forget(&files);
  free(files.at);
  return *ended ? VS_OUTCOME_INTERRUPTED : code;
}
