/* Implements `vs test FILE...`: runs programs with their checks, prints failed checks with their reasons, and counts
 * all checks.
 *
 * Each file has its own process, which sends each result as a byte through a pipe. A program that ends or crashes its
 * process therefore affects neither later files nor its earlier results. Programs print to standard error, so that
 * standard output has only the results. */
#define _GNU_SOURCE
#include "cli/test_command.h"

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/difference.h"

/* Limits of a program, and of each check, if no options are given: SECONDS of time, and bytes of memory (MEMORY) and of
 * printed text (PRINTED). */
#define SECONDS 10
enum { MEMORY = 1 << 30, PRINTED = 10 << 20 };

/* Bytes that a process sends: a check passed, a check failed, something else failed, a file could not be read, an
 * interrupt, and the end. */
enum { PASSED = '+', FAILED = '-', BROKEN = '!', UNREAD = '?', INTERRUPTED = '^', END = '.' };

/* ---- functions in the process of a file ---- */

static void tell(const cli_session *c, char what) {
  fflush(stdout);
  while (write(c->options->results, &what, 1) < 0 && errno == EINTR) {
  }
}

static void print_check(void *context, const vs_checked *r) {
  cli_session *c = context;
  cli_report_settle(&c->reporter);
  if (!r->passed) {
    if (r->at.file) printf("%s:%u:%u: ", r->at.file, (unsigned)r->at.line, (unsigned)r->at.column);
    printf("%s failed: %s\n  gives    %s\n  expected %s\n", r->form, r->expression, r->gives, r->expected);
  }
  tell(c, r->passed ? PASSED : FAILED);
}

static bool print_part(void *context, vs_part_difference what, const vs_part_info *before, const vs_part_info *after) {
  (void)context;
  cli_difference_print(what, before, after);
  return true;
}

/* Reports a failure of the program itself, not of a check. */
static void broken(const cli_session *c, const char *path, const char *first, const char *more) {
  printf("%s: %s%s\n", path, first, more);
  tell(c, BROKEN);
}

vs_outcome cli_test_run(cli_session *c, vs_outcome (*run_file)(cli_session *c, const char *path, unsigned flags)) {
  const char *path = c->options->sources[0].text;
  int code;
  c->watch.name = path;
  vs_outcome outcome = run_file(c, path, VS_EVAL_CHECK_LATER | VS_EVAL_PASS);
  if (outcome == VS_OUTCOME_INTERRUPTED) return tell(c, INTERRUPTED), outcome;
  if (outcome == VS_OUTCOME_USAGE) tell(c, UNREAD);
  if (outcome == VS_OUTCOME_USAGE) broken(c, path, "the program did not run", "");
  else if (outcome != VS_OUTCOME_DONE) broken(c, path, "the program stopped before its end", "");
  else if (vs_exit_requested(c->scheme, &code)) broken(c, path, "(exit) ended the program before its end", "");
  const char *own = vs_check_redefined(c->scheme);
  if (own) broken(c, path, own, " is redefined by the program: its uses are no checks");
  bool any = vs_check_waits(c->scheme);
  if (!any && outcome == VS_OUTCOME_DONE && !own) printf("%s: no checks\n", path);
  while (vs_check_waits(c->scheme)) {
    cli_watch_begin(&c->watch, true);
    vs_outcome one = vs_check_next(c->scheme, &(vs_check_listener){ c, print_check, print_part });
    cli_watch_end(&c->watch);
    if (one != VS_OUTCOME_DONE) return tell(c, INTERRUPTED), one;
  }
  tell(c, END);
  return outcome;
}

/* ---- starting processes and counting results ---- */

typedef struct { size_t passed, failed; bool ended, unread, interrupted; } tally;

/* Starts the process for a file. Sets *from to the reading end of its pipe. If it fails, prints a message on standard
 * error and returns -1. */
static pid_t start(cli_options *o, cli_source *source, int *from, int (*run)(cli_options *)) {
  int ends[2];
  fflush(stdout);
  fflush(stderr);
  pid_t process = pipe(ends) == 0 ? fork() : -1;
  if (process < 0) return fprintf(stderr, "vs: a process for %s: %s\n", source->text, strerror(errno)), -1;
  if (process == 0) {
    close(ends[0]);
    o->sources = source, o->source_count = 1; /* the child process ends before the arrays of *o are freed */
    o->words[0] = source->text;
    o->results = ends[1];
    int code = run(o);
    exit(code);
  }
  close(ends[1]);
  *from = ends[0];
  return process;
}

/* Counts the results that the process sends until it ends. Returns its exit status. */
static int listen(pid_t process, int from, const volatile sig_atomic_t *interrupts, tally *t) {
  char told[256];
  ssize_t n;
  int status = 0;
  t->ended = false;
  while ((n = read(from, told, sizeof told)) > 0 || (n < 0 && errno == EINTR)) {
    if (n < 0 && *interrupts) kill(process, SIGINT); /* a signal may have reached only this process: sends it to the
                                                      * file's process */
    for (ssize_t i = 0; i < n; i++) {
      t->passed += told[i] == PASSED;
      t->failed += told[i] == FAILED || told[i] == BROKEN;
      t->ended = t->ended || told[i] == END;
      t->unread = t->unread || told[i] == UNREAD;
      t->interrupted = t->interrupted || told[i] == INTERRUPTED;
    }
  }
  close(from);
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

static void set_limits(vs_options *i) {
  if (i->limit_time <= 0) i->limit_time = SECONDS;
  if (!i->limit_memory) i->limit_memory = MEMORY;
  if (!i->limit_output) i->limit_output = PRINTED;
}

int cli_test_command(cli_options *o, const volatile sig_atomic_t *interrupts, int (*run)(cli_options *o)) {
  tally t = { 0 };
  if (!o->untrusted) set_limits(&o->interpreter); /* for an untrusted program, cli_untrusted_begin sets other limits */
  o->quiet = true;
  for (size_t i = 0; i < o->source_count; i++) {
    int from;
    pid_t process = start(o, &o->sources[i], &from, run);
    if (process < 0) return VS_OUTCOME_MACHINE;
    int status = listen(process, from, interrupts, &t), code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    if (*interrupts || t.interrupted) return VS_OUTCOME_INTERRUPTED;
    if (t.ended) continue;
    t.failed++;
    if (code == VS_OUTCOME_USAGE) t.unread = true;
    if (code < 0) printf("%s: the run was killed by signal %d\n", o->sources[i].text, WTERMSIG(status));
    else printf("%s: the run ended before its last check\n", o->sources[i].text);
  }
  printf("%zu passed, %zu failed\n", t.passed, t.failed);
  return t.unread ? VS_OUTCOME_USAGE : t.failed ? VS_OUTCOME_MODEL : VS_OUTCOME_DONE;
}
