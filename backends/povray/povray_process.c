/* Runs a process of POV-Ray: its input and permissions, its progress and its messages.
 *
 * POV-Ray writes everything to standard error. Progress comes in pieces that begin with a carriage return. Messages
 * look like
 *   File '/tmp/.../scene.pov' line 12: Parse Error: ...
 * They are wrapped at 80 columns, with one space before each continuation. POV-Ray exits with 0 after warnings that
 * mean a wrong picture. Any warning that povray_warnings.def does not list is therefore a fault of the picture: vs
 * keeps the picture, reports the warning and fails. A table of the driver maps the line number in a message to the
 * place in the user's model. POV-Ray and the processes that it starts form a process group. On Linux the group ends
 * when vs is killed. */
#define _GNU_SOURCE /* declares prlimit, execvpe, pipe2 */
#include "backends/povray/povray_process.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "backends/povray/povray_confine.h"

/* ---- the output of POV-Ray ---- */

static void run_piece(vs_povray_process *r) {
  unsigned long done, all;
  r->piece[r->piece_used] = '\0';
  if (sscanf(r->piece, "Rendered %lu of %lu", &done, &all) == 2 && all > 0)
    r->fraction = fmax(r->fraction, (double)done / (double)all);
  r->piece_used = 0;
}

static void run_hear(vs_povray_process *r, const char *bytes, size_t count) {
  for (size_t i = 0; i < count; i++) {
    char c = bytes[i];
    if (c == '\r' || c == '\n') {
      if (r->in_piece) run_piece(r);
      r->in_piece = c == '\r';
    }
    if (c == '\r') continue;
    if (r->in_piece) {
      if (r->piece_used + 1 < sizeof r->piece) r->piece[r->piece_used++] = c;
      continue;
    }
    if (r->used + 1 >= sizeof r->text) { /* if the text is too long, drops its beginning, because errors come last */
      memmove(r->text, r->text + sizeof r->text / 2, r->used - sizeof r->text / 2);
      r->used -= sizeof r->text / 2;
    }
    r->text[r->used++] = c;
  }
  r->text[r->used] = '\0';
}

/* Joins lines that POV-Ray has wrapped. */
static void run_unwrap(char *text) {
  char *to = text;
  for (const char *from = text; *from != '\0'; from++)
    if (!(from[0] == '\n' && from[1] == ' ')) *to++ = *from;
  *to = '\0';
}

/* A message of POV-Ray about a line of the scene. line: number of that line. warning: whether the message is only a
 * warning. */
typedef struct { const char *text; int length; unsigned long line; bool warning; } run_message;

/* Reads the next message from *at on, and moves *at to the end of the message. Returns false if there is no further
 * message. */
static bool run_next(const char **at, run_message *m) {
  for (const char *from = *at; (from = strstr(from, "File '")) != NULL; from++) {
    const char *end = from + strcspn(from, "\n"), *number = strstr(from, "' line ");
    if (number == NULL || number > end) continue;
    char *after;
    m->line = strtoul(number + 7, &after, 10);
    if (strncmp(after, ": ", 2) != 0) continue;
    const char *kind = strstr(after, "Error: ");
    m->text = kind != NULL && kind < end && kind - after < 26 ? kind + 7 : after + 2;
    if (m->text == after + 2 && strncmp(m->text, "Parse Warning: ", 15) == 0) m->text += 15;
    m->warning = m->text == after + 17;
    m->length = (int)(end - m->text);
    *at = end;
    return true;
  }
  return false;
}

static bool run_is_harmless(const run_message *m) {
  static const char *const known[] = {
#define HARMLESS(text) text,
#include "backends/povray/povray_warnings.def"
#undef HARMLESS
  };
  for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
    const char *found = strstr(m->text, known[i]);
    if (m->warning && found != NULL && found < m->text + m->length) return true;
  }
  return false;
}

/* Finds the first error or, if `warning` is true, the first warning that is not harmless. Returns false if there is
 * none. */
static bool run_complaint(const char *text, bool warning, run_message *m) {
  while (run_next(&text, m))
    if (m->warning == warning && !run_is_harmless(m)) return true;
  return false;
}

static const char *run_last_line(char *text) {
  size_t length = strlen(text);
  while (length > 0 && (text[length - 1] == '\n' || text[length - 1] == ' ')) text[--length] = '\0';
  char *line = strrchr(text, '\n');
  return line != NULL ? line + 1 : text;
}

/* ---- the process ---- */

/* Raises the limit of the process's memory from the soft to the hard limit. The soft limit of vs applies to the model,
 * not to a worker. */
static void run_give_memory(pid_t process) {
#ifdef __linux__
  struct rlimit own;
  if (getrlimit(RLIMIT_DATA, &own) != 0 || own.rlim_cur == own.rlim_max) return;
  own.rlim_cur = own.rlim_max;
  prlimit(process, RLIMIT_DATA, &own, NULL);
#else
  (void)process;
#endif
}

/* Runs in the child process: sets input and permissions, then replaces the child by POV-Ray (exec). Uses only calls
 * that are safe in a child of a process with threads. */
static void run_become(const char *folder, const int errors[2], char *const *arguments, char *const *environment) {
  static const int usual[] = { SIGINT, SIGPIPE, SIGTERM, SIGHUP };
  sigset_t none;
  int nothing = open("/dev/null", O_RDWR);
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL); /* asks the kernel to end POV-Ray if vs is killed; nothing else does this */
#endif
  setpgid(0, 0); /* makes a process group for POV-Ray, so that the processes that it starts end with it */
  for (size_t i = 0; i < sizeof usual / sizeof *usual; i++) signal(usual[i], SIG_DFL);
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, NULL);
  if (nothing < 0 || dup2(nothing, 0) < 0 || dup2(nothing, 1) < 0 || dup2(errors[1], 2) < 0) return;
  if (nothing > 2) close(nothing);
  if (errors[1] == 2) fcntl(2, F_SETFD, 0); /* file descriptors other than standard input, output and error close at
                                             * exec */
  vs_povray_confine(folder);
  execvpe("povray", arguments, environment);
}

/* Starts POV-Ray. Returns 0, or errno on failure. */
static int run_start(vs_povray_process *r, const char *folder, const int errors[2], char *const *arguments,
                     char *const *environment) {
  int said[2], problem = 0;
  if (pipe2(said, O_CLOEXEC) != 0) return errno;
  r->process = fork();
  if (r->process == 0) {
    run_become(folder, errors, arguments, environment);
    problem = errno;
    _exit(write(said[1], &problem, sizeof problem) < 0 ? 126 : 127);
  }
  if (r->process < 0) problem = errno;
  close(said[1]);
  while (r->process > 0 && read(said[0], &problem, sizeof problem) < 0 && errno == EINTR) continue;
  close(said[0]);
  if (r->process > 0) setpgid(r->process, r->process);
  if (r->process > 0 && problem != 0) waitpid(r->process, NULL, 0);
  return problem;
}

bool vs_povray_start(vs_emitter *e, vs_povray_process *r, const char *folder, char *const *arguments) {
  int ends[2];
  char home[VS_POVRAY_PATH_ROOM], ini[VS_POVRAY_PATH_ROOM], path[VS_POVRAY_PATH_ROOM], large[VS_POVRAY_PATH_ROOM];
  const char *where = getenv("PATH");
  r->used = r->piece_used = 0;
  r->text[0] = 0;
  r->in_piece = false;
  r->process = 0;
  if (pipe2(ends, O_CLOEXEC) != 0)
    return vs_error_set(e->error, VS_ERROR_LIMIT, NULL, "cannot talk to POV-Ray: no pipe");
  snprintf(home, sizeof home, "HOME=%s", folder);
  snprintf(ini, sizeof ini, "POVINI=%s/povray.ini", folder);
  snprintf(path, sizeof path, "PATH=%s", where != NULL ? where : "/usr/local/bin:/usr/bin:/bin");
  /* If a picture is too large for memory, POV-Ray keeps it in a file in this folder. The confinement forbids the folder
   * that POV-Ray would choose. */
  snprintf(large, sizeof large, "POV_TEMP_DIR=%s", folder);
  char *environment[] = { home, ini, path, large, "LC_ALL=C", NULL };
  int problem = run_start(r, folder, ends, arguments, environment);
  close(ends[1]);
  r->errors = ends[0];
  if (problem == 0) {
    run_give_memory(r->process);
    return true;
  }
  close(r->errors);
  r->process = 0;
  if (problem == ENOENT)
    return vs_error_set(e->error, VS_ERROR_WORKER, NULL,
                        "POV-Ray is not installed: pictures need the package povray (sudo apt-get install povray)");
  return vs_error_set(e->error, VS_ERROR_WORKER, NULL, "POV-Ray did not start: %s", strerror(problem));
}

void vs_povray_hear(vs_povray_process *r) {
  char bytes[4096];
  ssize_t count = read(r->errors, bytes, sizeof bytes);
  if (count > 0) run_hear(r, bytes, (size_t)count);
  if (count != 0) return;
  close(r->errors);
  r->errors = -1;
}

bool vs_povray_ended(vs_povray_process *r, int *status) {
  siginfo_t how = { .si_pid = 0 };
  if (waitid(P_PID, (id_t)r->process, &how, WEXITED | WNOHANG | WNOWAIT) == 0 && how.si_pid == 0) return false;
  kill(-r->process, SIGKILL); /* The process group's number cannot be reused before waitpid, so the signal reaches only
                               * processes of POV-Ray. */
  while (waitpid(r->process, status, 0) < 0 && errno == EINTR) continue;
  r->process = 0;
  if (r->errors >= 0) close(r->errors);
  r->errors = -1;
  return true;
}

void vs_povray_stop(vs_povray_process *at, size_t count) {
  int status;
  size_t left = 1;
  for (int tries = 0; left > 0; tries++) {
    left = 0;
    for (size_t i = 0; i < count; i++) {
      if (at[i].process <= 0) continue;
      if (tries == 0) kill(-at[i].process, SIGTERM);
      if (tries == 100) kill(-at[i].process, SIGKILL);
      if (!vs_povray_ended(&at[i], &status)) left++;
    }
    if (left > 0) nanosleep(&(struct timespec){ .tv_nsec = 20000000 }, NULL);
  }
}

/* ---- the result of POV-Ray ---- */

/* If a run ended because it had no memory or disk space for its picture, sets this error and returns true. POV-Ray
 * itself reports an unknown error. */
static bool run_has_no_room(vs_emitter *e, const vs_povray_process *r) {
  return vs_error_set(e->error, VS_ERROR_WORKER, NULL, "POV-Ray has no room for the picture: it needs %.0f MB %s%s",
                      r->room.megabytes, r->room.folder ? "on the disk in " : "of memory",
                      r->room.folder ? r->room.folder : "");
}

/* Records a warning of a run that has rendered its picture. Only the first warning of all runs is kept. */
static void run_note_flaw(vs_emitter *e, const run_message *m) {
  if (e->flaw.kind != VS_ERROR_NONE) return;
  vs_error_set(&e->flaw, VS_ERROR_WORKER, vs_emit_line_origin(e, (uint32_t)m->line),
               "the picture may differ from the model: POV-Ray: %.*s", m->length, m->text);
}

bool vs_povray_judge(vs_emitter *e, vs_povray_process *r, int status) {
  run_message m;
  bool done = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  run_unwrap(r->text);
  if (run_complaint(r->text, false, &m) || (!done && run_complaint(r->text, true, &m)))
    return vs_error_set(e->error, VS_ERROR_WORKER, vs_emit_line_origin(e, (uint32_t)m.line), "POV-Ray: %.*s", m.length,
                        m.text);
  if (done && run_complaint(r->text, true, &m)) run_note_flaw(e, &m);
  if (done) return true;
  if (WIFSIGNALED(status))
    return vs_error_set(e->error, VS_ERROR_WORKER, NULL, "POV-Ray was ended by signal %d", WTERMSIG(status));
  if (strstr(r->text, "Unknown error code") != NULL) return run_has_no_room(e, r);
  const char *last = run_last_line(r->text);
  return vs_error_set(e->error, VS_ERROR_WORKER, NULL, "POV-Ray failed%s%s", *last ? ": " : " and said nothing", last);
}

/* Returns true if POV-Ray gave up because its own threads did not start within a few seconds. This happens on a busy
 * machine, and is no fault of the scene. */
bool vs_povray_was_starved(const vs_povray_process *r, int status) {
  bool done = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  return !done && strstr(r->text, "Timed out waiting for worker thread startup");
}
