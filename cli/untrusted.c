/* Implements `vs --untrusted model.vs`: sets default limits, empties the environment, permits only files of the model's
 * folder, and confines the process.
 *
 * A path is opened name by name, from the model's folder. No name may be `..` or a symbolic link, and the result must
 * be a regular file. Therefore neither a link nor /proc, a device or a FIFO leads out of the folder, even if files
 * change meanwhile. */
#define _GNU_SOURCE /* declares clearenv, strchrnul and O_PATH */
#include "cli/untrusted.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/confine.h"
#include "cli/limits.h"

/* Limits of an untrusted model if no options are given: seconds of the model and of external programs; bytes of memory
 * and of printed text; triangles. */
#define SECONDS 10
#define WORKER_SECONDS 120
enum { MEMORY = 512 << 20, PRINTED = 10 << 20, TRIANGLES = 5000000 };
#define PROCESS_MEMORY ((size_t)2 << 30) /* memory limit in bytes of external programs, and hard limit of this
                                          * process */

/* ---- reading files ---- */

static bool refuse(cli_untrusted *u, const char *reason, const char **why) {
  snprintf(u->why, sizeof u->why, "%s", reason);
  *why = u->why;
  return false;
}

/* Refuses a file or folder that could not be opened, with a reason from errno. leads_out: it was not opened because the
 * path leaves the folder. If the system lacks resources, reports this, since the model did not cause it. */
static bool refuse_open(cli_untrusted *u, bool leads_out, const char *missing, const char *outside, const char **why) {
  int problem = leads_out ? ELOOP : errno;
  bool machine = problem == EMFILE || problem == ENFILE || problem == ENOMEM || problem == EIO;
  return refuse(u, problem == ENOENT   ? missing
                   : problem == ENOMEM ? "out of memory"
                   : machine           ? strerror(problem)
                                       : outside, why);
}

/* Opens a file below the folder. If it fails, returns -1 and sets errno, which is ELOOP for every path that leaves the
 * folder. */
static int open_beneath(int folder, const char *path) {
  int at = dup(folder);
  while (at >= 0) {
    char name[256];
    size_t length = strcspn(path, "/");
    const char *rest = path + length;
    while (*rest == '/') rest++;
    int next = -1;
    if (length >= sizeof name) errno = ENAMETOOLONG;
    else if (length == 0 || (length == 2 && !memcmp(path, "..", 2))) errno = ELOOP;
    else {
      memcpy(name, path, length);
      name[length] = 0;
      next =
          openat(at, name, (*rest ? O_PATH | O_DIRECTORY : O_RDONLY | O_NONBLOCK | O_NOCTTY) | O_NOFOLLOW | O_CLOEXEC);
    }
    int problem = errno;
    close(at);
    errno = problem;
    if (next < 0 || !*rest) return next;
    at = next;
    path = rest;
  }
  return -1;
}

bool cli_untrusted_read(cli_untrusted *u, const char *path, char **text, size_t *length, const char **why) {
  static const char outside[] = "an untrusted model reads only files of its own folder, and no links";
  size_t prefix = strlen(u->prefix);
  if (u->folder < 0 || strncmp(path, u->prefix, prefix) != 0) return refuse(u, outside, why);
  path += prefix;
  while (!strncmp(path, "./", 2)) path += 2;
  struct stat info;
  int file = *path == '/' ? -1 : open_beneath(u->folder, path);
  if (file < 0) return refuse_open(u, *path == '/', "no such file", outside, why);
  bool good = fstat(file, &info) == 0 && S_ISREG(info.st_mode) && info.st_size >= 0;
  if (!good || (size_t)info.st_size > u->most) {
    close(file);
    return refuse(u, good ? "larger than the available memory" : "is not an ordinary file", why);
  }
  size_t room = (size_t)info.st_size + 1, used = 0;
  char *to = malloc(room);
  bool memory = to != NULL;
  for (ssize_t n = 1; to && n != 0 && used < room;) {
    n = read(file, to + used, room - used);
    if (n > 0) used += (size_t)n;
    else if (n < 0 && errno != EINTR) free(to), to = NULL, n = 0;
  }
  close(file);
  if (!to) return refuse(u, memory ? "cannot be read" : "out of memory", why);
  *text = to, *length = used < room ? used : (size_t)info.st_size; /* if the file grows while it is read, omits the
                                                                    * added bytes */
  return true;
}

bool cli_untrusted_list(cli_untrusted *u, const char *path, bool (*take)(void *to, const char *name, size_t length),
                        void *to, const char **why) {
  static const char outside[] = "an untrusted model reads only its own folder and those in it, and no links";
  size_t prefix = strlen(u->prefix);
  /* if the path is the model's folder without the final slash, it is the folder itself */
  if (u->folder >= 0 && prefix && strlen(path) + 1 == prefix && strncmp(path, u->prefix, prefix - 1) == 0) path = ".";
  else if (u->folder < 0 || strncmp(path, u->prefix, prefix) != 0) return refuse(u, outside, why);
  else path += prefix;
  int file = *path == '/' ? -1 : open_beneath(u->folder, *path ? path : ".");
  if (file < 0) return refuse_open(u, *path == '/', "no such folder", outside, why);
  DIR *folder = fdopendir(file);
  if (!folder) return close(file), refuse(u, errno == ENOMEM ? "out of memory" : "is not a folder", why);
  bool ok = true;
  for (const struct dirent *entry; ok && (entry = readdir(folder));)
    if (strcmp(entry->d_name, ".") && strcmp(entry->d_name, "..")) ok = take(to, entry->d_name, strlen(entry->d_name));
  closedir(folder);
  return ok;
}

/* ---- the temporary folder of external programs ---- */

static int remove_one(const char *path, const struct stat *info, int kind, struct FTW *where) {
  return (void)info, (void)kind, (void)where, remove(path), 0;
}

/* Starts a child process (the keeper) that removes the temporary folder when this process ends. A confined process
 * cannot remove the folder itself. */
static bool keep_scratch(cli_untrusted *u) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return false;
  u->keeper = fork();
  if (u->keeper == 0) {
    char byte;
    setsid(); /* puts the keeper into a new session, which signals of the terminal do not reach */
    signal(SIGTERM, SIG_IGN);
    for (int i = 0; i <= STDERR_FILENO; i++) close(i);
    close(ends[1]);
    while (read(ends[0], &byte, 1) < 0 && errno == EINTR) continue;
    nftw(u->scratch, remove_one, 8, FTW_DEPTH | FTW_PHYS);
    _exit(0);
  }
  close(ends[0]);
  u->alive = ends[1];
  return u->keeper > 0;
}

/* ---- starting an untrusted run ---- */

static char *folder_of(const char *path) {
  const char *slash = strrchr(path, '/');
  return slash ? strndup(path, slash == path ? 1 : (size_t)(slash - path)) : strdup(".");
}

static bool failed(const char *what) {
  fprintf(stderr, "vs: --untrusted: %s: %s\n", what, strerror(errno));
  return false;
}

static bool open_model(cli_untrusted *u, const cli_options *o, char **model) {
  for (size_t i = o->source_count; i-- > 0;) {
    const char *path = o->sources[i].text, *slash = strrchr(path, '/');
    if (o->sources[i].kind != CLI_SOURCE_FILE || !strcmp(path, "-")) continue;
    *model = folder_of(path);
    u->prefix = slash ? strndup(path, (size_t)(slash + 1 - path)) : strdup("");
    if (!*model || !u->prefix) return failed("memory");
    u->folder = open(*model, O_PATH | O_DIRECTORY | O_CLOEXEC);
    return u->folder >= 0 || failed(*model);
  }
  *model = strdup("/dev/null"); /* an expression of the command line, or standard input, has no folder */
  u->prefix = strdup("");
  return (*model && u->prefix) || failed("memory");
}

bool cli_untrusted_begin(cli_untrusted *u, cli_options *o) {
  vs_options *i = &o->interpreter;
  char *model = NULL, **written = calloc(o->target_count + 1, sizeof *written);
  size_t count = 0;
  bool worker = false, ok = written != NULL;
  *u = (cli_untrusted){ .folder = -1, .alive = -1 };
  i->untrusted = true;
  i->library_path = NULL;
  if (i->limit_time <= 0) i->limit_time = SECONDS;
  if (!i->limit_memory) i->limit_memory = MEMORY;
  if (!i->limit_output) i->limit_output = PRINTED;
  if (!i->limit_triangles) i->limit_triangles = TRIANGLES;
  if (i->limit_worker <= 0) i->limit_worker = WORKER_SECONDS;
  u->most = i->limit_memory;
  ok = ok && open_model(u, o, &model);
  for (; ok && count < o->target_count; count++) {
    {
    /* A format that the program defines needs no external program. */
    const vs_format_info *format = o->targets[count].format ? vs_format_find(o->targets[count].format) : NULL;
    worker = worker || (format && format->worker);
  }
    ok = (written[count] = folder_of(o->targets[count].path)) != NULL || failed("memory");
  }
  const char *temporary = getenv("TMPDIR");
  if (ok && worker) {
    size_t room = (temporary ? strlen(temporary) : 0) + 40;
    u->scratch = malloc(room);
    if (u->scratch)
      snprintf(u->scratch, room, "%s/visualscheme-XXXXXX", temporary && *temporary == '/' ? temporary : "/tmp");
    if (!u->scratch || !mkdtemp(u->scratch)) ok = failed("a private folder"), free(u->scratch), u->scratch = NULL;
    else if (!keep_scratch(u)) ok = failed("a private folder"), rmdir(u->scratch);
  }
  clearenv();
  cli_limits_memory_for_good(PROCESS_MEMORY);
  if (ok && u->scratch) ok = setenv("TMPDIR", u->scratch, 1) == 0 || failed("memory");
  if (ok && !cli_confine(model, (const char *const *)written, count, u->scratch) && worker) {
    fputs("vs: --untrusted: pictures need a worker program, and this system cannot confine it (no Landlock)\n", stderr);
    ok = false;
  }
  for (size_t k = 0; written && k < count; k++) free(written[k]);
  free(written);
  free(model);
  if (!ok) cli_untrusted_end(u);
  return ok;
}

void cli_untrusted_end(cli_untrusted *u) {
  if (u->folder >= 0) close(u->folder);
  if (u->alive >= 0) close(u->alive);
  if (u->keeper > 0)
    while (waitpid(u->keeper, NULL, 0) < 0 && errno == EINTR) continue;
  free(u->prefix);
  free(u->scratch);
  *u = (cli_untrusted){ .folder = -1, .alive = -1 };
}
