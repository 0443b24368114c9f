/* Owns the running of POV-Ray: its private folder, the process, its progress and its complaints.
 *
 * POV-Ray says everything on standard error: progress in pieces that begin with a carriage return, messages as
 *   File '/tmp/.../scene.pov' line 12: Parse Error: ...
 * wrapped at 80 columns with one space in front of what continues. It ends with 0 after warnings that mean a wrong
 * picture, so any is a failure here. A message's line leads, by the table that the driver kept, to the place in the
 * user's model. It stays in our process group: what ends us from outside (the terminal, timeout) ends it too. */
#define _GNU_SOURCE /* prlimit, execvpe, pipe2 */
#include "backends/povray/povray_worker.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
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

#include "backends/povray/povray.h"
#include "backends/povray/povray_confine.h"
#include "backends/povray/povray_picture.h"
#include "model/store/array.h"

enum { POV_TEXT_ROOM = 1 << 16, POV_PATH_ROOM = 4096 };

typedef struct {
  char folder[POV_PATH_ROOM - 64];
  char picture[POV_PATH_ROOM], ini[POV_PATH_ROOM], state[POV_PATH_ROOM];
  pid_t process;
  int errors;                /* our end of its standard error */
  char text[POV_TEXT_ROOM];  /* messages, without the progress; cut at the front if ever too long */
  size_t used;
  char piece[256];           /* of the progress: since the last carriage return */
  size_t piece_used;
  bool in_piece;
  double fraction;
} pov_run;

static double run_now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* ---- what it says ---- */

static void run_piece(pov_run *r) {
  unsigned long done, all;
  r->piece[r->piece_used] = '\0';
  if (sscanf(r->piece, "Rendered %lu of %lu", &done, &all) == 2 && all > 0) r->fraction = (double)done / (double)all;
  r->piece_used = 0;
}

static void run_hear(pov_run *r, const char *bytes, size_t count) {
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
    if (r->used + 1 >= sizeof r->text) { /* the newest matters: errors come last */
      memmove(r->text, r->text + sizeof r->text / 2, r->used - sizeof r->text / 2);
      r->used -= sizeof r->text / 2;
    }
    r->text[r->used++] = c;
  }
  r->text[r->used] = '\0';
}

/* Joins lines that were wrapped. */
static void run_unwrap(char *text) {
  char *to = text;
  for (const char *from = text; *from != '\0'; from++)
    if (!(from[0] == '\n' && from[1] == ' ')) *to++ = *from;
  *to = '\0';
}

/* The first complaint about the scene: its line there, and the message, which is cut out of the text. */
static const char *run_complaint(char *text, unsigned long *line) {
  for (char *at = text; (at = strstr(at, "File '")) != NULL; at++) {
    char *end = strchr(at, '\n'), *number = strstr(at, "' line ");
    if (end != NULL) *end = '\0';
    /* an upright view is such a camera on purpose (povray_scene.c) */
    bool meant = strstr(at, "Warning: Camera vectors are not perpendicular") != NULL;
    if (number != NULL && (end == NULL || number < end) && !meant) {
      char *after;
      *line = strtoul(number + 7, &after, 10);
      if (strncmp(after, ": ", 2) == 0) { /* "Possible Parse Error: " says nothing to a modeller */
        const char *kind = strstr(after + 2, "Error: ");
        return kind != NULL && kind - after < 24 ? kind + 7 : after + 2;
      }
    }
    if (end != NULL) *end = '\n';
  }
  return NULL;
}

static const char *run_last_line(char *text) {
  size_t length = strlen(text);
  while (length > 0 && (text[length - 1] == '\n' || text[length - 1] == ' ')) text[--length] = '\0';
  char *line = strrchr(text, '\n');
  return line != NULL ? line + 1 : text;
}

/* ---- the process ---- */

/* Our own soft limit of memory is that of the model: a worker has the hard one. */
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

/* A file's name as POV-Ray takes it: it divides every argument at blanks and quotes once more. */
static void run_quote(char *out, size_t room, const char *option, const char *name) {
  char quote = strchr(name, '"') ? '\'' : '"';
  snprintf(out, room, "%s%c%s%c", option, quote, name, quote);
}

/* The child's part: what it hears, what it may do, and what it becomes. Only calls that are safe in a child of a
 * process with threads. */
static void run_become(const pov_run *r, const int errors[2], char *const *arguments, char *const *environment) {
  static const int usual[] = { SIGINT, SIGPIPE, SIGTERM, SIGHUP };
  sigset_t none;
  int nothing = open("/dev/null", O_RDWR);
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL); /* where we are killed ourselves, nobody else ends it */
#endif
  setpgid(0, 0); /* a group of its own, so that what it has started ends with it */
  for (size_t i = 0; i < sizeof usual / sizeof *usual; i++) signal(usual[i], SIG_DFL);
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, NULL);
  if (nothing < 0 || dup2(nothing, 0) < 0 || dup2(nothing, 1) < 0 || dup2(errors[1], 2) < 0) return;
  if (nothing > 2) close(nothing);
  close(errors[0]);
  if (errors[1] > 2) close(errors[1]);
  vs_povray_confine(r->folder);
  execvpe("povray", arguments, environment);
}

/* Starts it. 0, or errno where it did not. */
static int run_start(pov_run *r, const int errors[2], char *const *arguments, char *const *environment) {
  int said[2], problem = 0;
  if (pipe2(said, O_CLOEXEC) != 0) return errno;
  r->process = fork();
  if (r->process == 0) {
    run_become(r, errors, arguments, environment);
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

static bool run_spawn(vs_emitter *e, pov_run *r, const char *scene) {
  int pipe_ends[2];
  if (pipe(pipe_ends) != 0) return vs_error_set(e->error, VS_ERROR_MEMORY, NULL, "cannot talk to POV-Ray: no pipe");
  int width = e->options->width > 0 ? e->options->width : 1024,
      height = e->options->height > 0 ? e->options->height : 768;
  char wide[24], high[24], in[POV_PATH_ROOM + 8], out[POV_PATH_ROOM + 8];
  char home[POV_PATH_ROOM], ini[POV_PATH_ROOM + 8], path[POV_PATH_ROOM];
  snprintf(wide, sizeof wide, "+W%d", width);
  snprintf(high, sizeof high, "+H%d", height);
  run_quote(in, sizeof in, "+I", scene);
  run_quote(out, sizeof out, "+O", r->picture);
  snprintf(home, sizeof home, "HOME=%s", r->folder);
  snprintf(ini, sizeof ini, "POVINI=%s", r->ini);
  const char *where = getenv("PATH");
  snprintf(path, sizeof path, "PATH=%s", where != NULL ? where : "/usr/local/bin:/usr/bin:/bin");
  /* Jitter, which POV-Ray has unless it is told, makes dots of upright edges; without it they are even at no cost. */
  char *smooth[] = { "+A0.1", "+AM2", "+R2", "-J" };
  if (e->options->quality == VS_RENDER_DRAFT) smooth[0] = "-A", smooth[1] = NULL;
  else if (e->options->quality == VS_RENDER_FINAL) smooth[0] = "+A0.05", smooth[2] = "+R3";
  const int *crop = e->options->crop;
  char part[4][24];
  if (crop[2]) { /* the first and the last column and row, counted from 1 */
    snprintf(part[0], sizeof part[0], "+SC%d", crop[0] + 1);
    snprintf(part[1], sizeof part[1], "+EC%d", crop[0] + crop[2]);
    snprintf(part[2], sizeof part[2], "+SR%d", crop[1] + 1);
    snprintf(part[3], sizeof part[3], "+ER%d", crop[1] + crop[3]);
  }
  char *arguments[19] = { "povray", in, wide, high, out, "+FE", "-D", "-GD", "-GR", "-GS" };
  size_t count = 10;
  for (int i = 0; i < 4 && crop[2]; i++) arguments[count++] = part[i];
  for (int i = 0; i < 4 && smooth[i]; i++) arguments[count++] = smooth[i];
  char *environment[] = { home, ini, path, "LC_ALL=C", NULL };
  int problem = run_start(r, pipe_ends, arguments, environment);
  close(pipe_ends[1]);
  r->errors = pipe_ends[0];
  if (problem == 0) {
    run_give_memory(r->process);
    return true;
  }
  close(r->errors);
  if (problem == ENOENT)
    return vs_error_set(e->error, VS_ERROR_WORKER, NULL,
                        "POV-Ray is not installed: pictures need the package povray (sudo apt-get install povray)");
  return vs_error_set(e->error, VS_ERROR_WORKER, NULL, "POV-Ray did not start: %s", strerror(problem));
}

static void run_pause(void) { nanosleep(&(struct timespec){ .tv_nsec = 20000000 }, NULL); }

/* Has it ended? Then whatever it started and left goes, too, while its number is still its own. */
static bool run_ended(pov_run *r, int *status) {
  siginfo_t how = { .si_pid = 0 };
  if (waitid(P_PID, (id_t)r->process, &how, WEXITED | WNOHANG | WNOWAIT) == 0 && how.si_pid == 0) return false;
  kill(-r->process, SIGKILL);
  while (waitpid(r->process, status, 0) < 0 && errno == EINTR) continue;
  return true;
}

/* Ends it, hard if it does not listen within two seconds; its exit status either way. */
static int run_stop(pov_run *r) {
  int status = 0;
  kill(-r->process, SIGTERM);
  for (int i = 0; i < 100; i++) {
    if (run_ended(r, &status)) return status;
    run_pause();
  }
  kill(-r->process, SIGKILL);
  while (!run_ended(r, &status)) run_pause();
  return status;
}

/* Listens until it ends, also where it has closed its side before. False: stopped, and the error says why. */
static bool run_listen(vs_emitter *e, pov_run *r, int *status) {
  double begun = run_now(), told = 0;
  for (bool talks = true; talks || !run_ended(r, status);) {
    struct pollfd wait = { .fd = r->errors, .events = POLLIN };
    char bytes[4096];
    if (!talks) {
      run_pause();
    } else if (poll(&wait, 1, 100) > 0) {
      ssize_t count = read(r->errors, bytes, sizeof bytes);
      if (count > 0) run_hear(r, bytes, (size_t)count);
      talks = count != 0;
    }
    double now = run_now();
    if (now - told > 0.1) {
      told = now;
      if (!vs_emit_progress(e, "rendering", r->fraction)) {
        *status = run_stop(r);
        return false;
      }
    }
    if (e->options->worker_seconds > 0 && now - begun > e->options->worker_seconds) {
      *status = run_stop(r);
      return vs_error_set(e->error, VS_ERROR_WORKER, NULL, "POV-Ray was stopped after %g seconds",
                          e->options->worker_seconds);
    }
  }
  return vs_emit_progress(e, "rendering", r->fraction); /* an interrupt may have ended it before us */
}

/* ---- what came of it ---- */

static bool run_judge(vs_emitter *e, pov_run *r, int status) {
  unsigned long line = 0;
  run_unwrap(r->text);
  const char *complaint = run_complaint(r->text, &line);
  if (complaint != NULL)
    return vs_error_set(e->error, VS_ERROR_WORKER, vs_emit_line_origin(e, (uint32_t)line), "POV-Ray: %s", complaint);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return true;
  if (WIFSIGNALED(status))
    return vs_error_set(e->error, VS_ERROR_WORKER, NULL, "POV-Ray was ended by signal %d", WTERMSIG(status));
  const char *last = run_last_line(r->text);
  return vs_error_set(e->error, VS_ERROR_WORKER, NULL, "POV-Ray failed%s%s", *last ? ": " : " and said nothing", last);
}

/* POV-Ray gives its own threads a few seconds to start and then gives up, which happens on a machine with much other
 * work and says nothing about the scene. */
static bool run_was_starved(const pov_run *r, int status) {
  bool done = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  return !done && strstr(r->text, "Timed out waiting for worker thread startup");
}

static bool run_prepare(vs_emitter *e, pov_run *r, const char *scene) {
  const char *slash = strrchr(scene, '/');
  size_t length = slash != NULL ? (size_t)(slash - scene) : 0;
  if (length == 0 || length >= sizeof r->folder)
    return vs_error_set(e->error, VS_ERROR_FILE, NULL, "the temporary folder's name is too long");
  memcpy(r->folder, scene, length);
  r->folder[length] = '\0';
  snprintf(r->picture, sizeof r->picture, "%s/picture.exr", r->folder);
  snprintf(r->ini, sizeof r->ini, "%s/povray.ini", r->folder);
  snprintf(r->state, sizeof r->state, "%s/picture.pov-state", r->folder);
  static const char words[] = "Library_Path=\"/usr/share/povray-3.7/include\"\n";
  int file = open(r->ini, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  bool ok = file >= 0 && write(file, words, sizeof words - 1) == (ssize_t)(sizeof words - 1);
  if (file >= 0 && close(file) != 0) ok = false;
  return ok || vs_error_set(e->error, VS_ERROR_FILE, NULL, "cannot write %s: %s", r->ini,
                            errno == ENOSPC ? "the disk is full" : strerror(errno));
}

static bool run_render(vs_emitter *e, const char *scene, const char *output, bool develop) {
  pov_run *r = vs_zeros(1, sizeof *r);
  if (r == NULL) return vs_emit_no_memory(e);
  enum { STARTS = 5 };
  int status = 0, starts = 0;
  bool ok = run_prepare(e, r, scene), again = ok;
  while (again) {
    r->used = r->piece_used = 0;
    r->text[0] = 0;
    r->in_piece = false;
    ok = run_spawn(e, r, scene);
    if (!ok) break;
    ok = run_listen(e, r, &status);
    close(r->errors);
    again = ok && ++starts < STARTS && run_was_starved(r, status);
    if (!again) ok = ok && run_judge(e, r, status);
  }
  if (ok)
    ok = develop ? vs_povray_develop_picture(e, r->picture, output) : vs_povray_take_picture(e, r->picture, output);
  unlink(r->picture);
  unlink(r->ini);
  unlink(r->state);
  free(r);
  return ok;
}

bool vs_povray_render_png(vs_emitter *e, const char *scene, const char *output) {
  return run_render(e, scene, output, true);
}
bool vs_povray_render_exr(vs_emitter *e, const char *scene, const char *output) {
  return run_render(e, scene, output, false);
}
