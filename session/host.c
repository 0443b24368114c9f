/* Implements the system calls of the interpreter: memory, time, files, console. They use the embedder's callbacks where
 * it has set them. The VM makes no other system calls. */
#include "session/host.h"

#include "session/profile/call_profile.h"
#include "session/report.h"
#include "session/session.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "model/store/cache.h"

/* ---- memory ---- */

static void *session_memory(vs_session *s, void *old, size_t old_bytes, size_t bytes) {
  const vs_options *o = &s->options;
  if (bytes > old_bytes && o->limit_memory &&
      (bytes - old_bytes > o->limit_memory || s->bytes > o->limit_memory - (bytes - old_bytes)))
    return s->limited = true, NULL;
  void *p = NULL;
  if (o->alloc) p = o->alloc(o->alloc_context, old, old_bytes, bytes);
  else if (bytes) p = realloc(old, bytes);
  else free(old);
  if (bytes && !p) return s->limited = false, NULL;
  s->bytes += bytes - old_bytes;
  if (s->bytes > s->tally.high) s->tally.high = s->bytes;
  return p;
}

void vs_session_take_options(void *own, size_t room, size_t first, const void *given) {
  size_t size = 0;
  VS_ASSERT(own && sizeof size <= first && first <= room);
  if (given) memcpy(&size, given, sizeof size), memcpy(own, given, !size ? first : size < room ? size : room);
  memcpy(own, &room, sizeof room);
}

void vs_session_give_options(void *given, size_t size, const void *own, size_t room) {
  VS_ASSERT(size >= sizeof size && room >= sizeof room);
  memset(given, 0, size);
  memcpy(given, own, size < room ? size : room);
  memcpy(given, &size, sizeof size);
}

/* Allocates, reallocates or frees memory. If memory is out, removes results from the cache and allocates again. */
void *vs_session_memory(void *session, void *old, size_t old_bytes, size_t bytes) {
  vs_session *s = session;
  void *p = session_memory(s, old, old_bytes, bytes);
  if (p || !bytes) return p;
  if (s->bind.store && vs_cache_shrink(vs_store_cache(s->bind.store), bytes))
    p = session_memory(s, old, old_bytes, bytes);
  if (!p) s->bind.refused++;
  return p;
}

/* ---- time and interrupts ---- */

double vs_session_clock(void *session) {
  (void)session;
  return vs_clock();
}

/* Returns true. If the host ends the process after an interrupt, leaves the model's memory to the system. */
static bool interrupt(vs_session *s) {
  if (s->options.ends_after_interrupt && s->bind.store) vs_store_abandon(s->bind.store);
  return true;
}

bool vs_session_interrupted(void *session) {
  vs_session *s = session;
  const vs_host *h = &s->options.host;
  if (s->writing && vs_job_late(s->writing)) return true;
  if (s->profiling && !s->writing) vs_session_look(s);
  if (h->progress && s->phase) {
    double now = vs_session_clock(s);
    if (now - s->told_progress > .1) {
      s->told_progress = now;
      h->progress(h->context, &(vs_progress){ .phase = s->phase, .fraction = -1 });
    }
  }
  if (h->poll && h->poll(h->context)) return interrupt(s);
  return atomic_exchange(&s->interrupted, false) && interrupt(s);
}

bool vs_session_going(void *session, const char *stage, double fraction) {
  (void)stage, (void)fraction;
  return !vs_session_interrupted(session);
}

vs_job vs_session_job(vs_session *s) {
  return (vs_job){ .going = vs_session_going, .warn = vs_session_warn, .context = s, .tally = &s->tally };
}

static double now_of_day(void *session) {
  struct timespec t;
  (void)session;
  clock_gettime(CLOCK_REALTIME, &t);
  return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

static const char *environment(void *session, const char *name) {
  return ((vs_session *)session)->options.untrusted ? NULL : getenv(name);
}

extern char **environ; /* POSIX requires each program to declare `environ` itself */

static const char *variable(void *session, size_t i) {
  return ((vs_session *)session)->options.untrusted ? NULL : environ[i];
}

/* ---- reading whole files ---- */

static bool refuse(vs_session *s, const char *reason, const char **why) {
  snprintf(s->why, sizeof s->why, "%s", reason);
  *why = s->why;
  return false;
}

/* Returns a text for the errno value `error`: plain English for frequent errors, otherwise the system's text. */
static const char *reason(int error) {
  if (error == ENOENT) return "no such file";
  if (error == EACCES) return "not permitted to read it";
  if (error == EISDIR) return "is a folder, not a file";
  if (error == ENOTDIR) return "is not a folder";
  if (error == ENOMEM) return VS_IO_NO_MEMORY;
  return strerror(error);
}

static bool slurp(vs_session *s, const char *path, char **text, size_t *length, const char **why) {
  struct stat st;
  if (s->options.untrusted) return refuse(s, "reading files is switched off", why);
  FILE *f = fopen(path, "rb");
  if (!f) return refuse(s, reason(errno), why);
  if (fstat(fileno(f), &st) == 0 && S_ISDIR(st.st_mode)) return fclose(f), refuse(s, reason(EISDIR), why);
  if (!vs_known_files_add(&s->inputs, path, fileno(f), false)) return fclose(f), refuse(s, VS_IO_NO_MEMORY, why);
  size_t room = st.st_size > 0 ? (size_t)st.st_size + 1 : 65536, used = 0;
  char *at = NULL;
  bool over = false;
  for (;;) {
    char *grown = over ? NULL : realloc(at, room);
    if (!grown) {
      free(at), at = NULL;
      break;
    }
    at = grown;
    used += fread(at + used, 1, room - used, f);
    if (used < room) break;
    over = s->options.limit_memory && room > s->options.limit_memory;
    room *= 2;
  }
  int error = at && ferror(f) ? errno : 0;
  fclose(f);
  if (!at) return refuse(s, over ? "larger than the available memory" : VS_IO_NO_MEMORY, why);
  if (error) return free(at), refuse(s, reason(error), why);
  *text = at, *length = used;
  return true;
}

static bool read_whole(vs_session *s, const char *path, char **text, size_t *length, const char **why) {
  const vs_host *h = &s->options.host;
  if (!h->read_file) return slurp(s, path, text, length, why);
  if (!h->read_file(h->context, path, text, length, why)) return false;
  return vs_known_files_add_path(&s->inputs, path) || (free(*text), refuse(s, VS_IO_NO_MEMORY, why));
}

bool vs_session_read(vs_session *s, const char *path, bool source, char **text, size_t *length, const char **why) {
  return read_whole(s, path, text, length, why) && (!source || vs_session_keep_source(s, path, 1, *text, *length) ||
                                                    (free(*text), refuse(s, VS_IO_NO_MEMORY, why)));
}

vs_outcome vs_session_unread(vs_session *s, const char *path, const char *why) {
  vs_outcome outcome = strcmp(why, VS_IO_NO_MEMORY) ? VS_OUTCOME_USAGE : VS_OUTCOME_MACHINE;
  vs_session_report_at(s, VS_SEVERITY_ERROR, outcome, (vs_span){ .file = path }, why);
  return outcome;
}

/* ---- source texts, kept because messages show their lines ---- */

static void drop(vs_session *s, vs_source *source) {
  vs_session_memory(s, source->name, source->name_bytes, 0);
  vs_session_memory(s, source->text, source->room, 0);
}

/* Replaces each \r that is not followed by \n by \n. */
static void unify_line_ends(char *text, size_t length) {
  for (size_t i = 0; i < length; i++)
    if (text[i] == '\r' && (i + 1 == length || text[i + 1] != '\n')) text[i] = '\n';
}

static size_t count_lines(const char *text, size_t length) {
  size_t lines = 0;
  for (size_t i = 0; i < length; i++) lines += text[i] == '\n';
  return lines;
}

/* Appends lines that were typed at a prompt to the text of a source, so that messages can show them later. Inserts
 * blank lines for missing line numbers. Returns false if the lines precede the end of the source, or memory is out. */
static bool continue_source(vs_session *s, vs_source *old, unsigned first_line, const char *text, size_t length) {
  enum { MOST = 1 << 18 };
  size_t gap;
  if (first_line <= old->first_line || !old->length || old->text[old->length - 1] != '\n') return false;
  if (first_line < old->first_line + old->lines) return false;
  gap = first_line - old->first_line - old->lines;
  if (gap > MOST || length > MOST || old->length + gap + length > MOST) return false;
  char *grown = vs_session_memory(s, old->text, old->room, old->length + gap + length + 1);
  if (!grown) return false;
  old->room = old->length + gap + length + 1;
  old->text = grown;
  memset(grown + old->length, '\n', gap);
  memcpy(grown + old->length + gap, text, length);
  old->before = false;
  old->length += gap + length;
  old->lines += gap + count_lines(text, length);
  grown[old->length] = 0;
  return true;
}

/* A text longer than MOST bytes is cut; messages about places after the cut show no source line. */
bool vs_session_keep_source(vs_session *s, const char *name, unsigned first_line, const char *text, size_t length) {
  enum { MOST = 1 << 22 };
  size_t i = 0, bytes = strlen(name) + 1, room = length < MOST ? length : MOST;
  if (room > 0 && !memchr(text, '\n', room) && room == MOST) room = 0; /* a long text without a line end is probably
                                                                        * binary data, and is not kept */
  while (i < s->source_count && strcmp(s->sources[i].name, name)) i++;
  if (i < s->source_count && continue_source(s, &s->sources[i], first_line, text, length)) return true;
  if (i == s->source_room) {
    size_t more = i ? 2 * i : 4;
    vs_source *grown = vs_session_memory(s, s->sources, i * sizeof *grown, more * sizeof *grown);
    if (!grown) return false;
    s->sources = grown, s->source_room = more;
  }
  vs_source fresh = { .name = vs_session_memory(s, NULL, 0, bytes),
                      .name_bytes = bytes,
                      .length = room,
                      .room = room + 1,
                      .first_line = first_line };
  if (fresh.name) fresh.text = vs_session_memory(s, NULL, 0, fresh.room);
  if (!fresh.text) {
    if (fresh.name) vs_session_memory(s, fresh.name, bytes, 0);
    return false;
  }
  memcpy(fresh.name, name, bytes);
  if (room) memcpy(fresh.text, text, room);
  fresh.text[room] = 0;
  unify_line_ends(fresh.text, room);
  fresh.lines = count_lines(fresh.text, room);
  if (i < s->source_count) drop(s, &s->sources[i]);
  else s->source_count++;
  s->sources[i] = fresh;
  return true;
}

void vs_session_free_sources(vs_session *s) {
  for (size_t i = 0; i < s->source_count; i++) drop(s, &s->sources[i]);
  vs_session_memory(s, s->sources, s->source_room * sizeof *s->sources, 0);
  s->sources = NULL, s->source_count = s->source_room = 0;
}

/* ---- files and streams ---- */

static int64_t open_stream(void *session, const char *path, vs_io_mode mode, const char **why) {
  vs_session *s = session;
  int64_t i = VS_IO_STDERR + 1;
  while (i < VS_STREAMS && s->stream[i].open) i++;
  if (i == VS_STREAMS) return refuse(s, "too many files are open", why), -1;
  vs_stream fresh = { .open = true, .reading = mode == VS_IO_READ };
  if (mode == VS_IO_READ) {
    if (!vs_session_read(s, path, true, &fresh.text, &fresh.length, why)) return -1;
  } else {
    if (s->options.untrusted) return refuse(s, "writing files is switched off", why), -1;
    if (s->flags & VS_EVAL_TRY) return refuse(s, "save the program first: an unsaved one writes no files", why), -1;
    fresh.file = fopen(path, mode == VS_IO_WRITE ? "wb" : "ab");
    if (!fresh.file) return refuse(s, errno == EACCES ? "not permitted to write it" : reason(errno), why), -1;
    if (mode == VS_IO_WRITE && !vs_known_files_add(&s->inputs, path, fileno(fresh.file), true))
      return fclose(fresh.file), refuse(s, VS_IO_NO_MEMORY, why), -1;
  }
  s->stream[i] = fresh;
  return i;
}

static ptrdiff_t read_console(vs_session *s, void *to, size_t room) {
  const vs_host *h = &s->options.host;
  vs_stream *in = &s->stream[VS_IO_STDIN]; /* at the end of standard input, text after the last line end counts as a
                                            * line */
  if (in->at == in->length) {
    size_t n;
    const char *line = h->input ? h->input(h->context, &n) : NULL;
    if (!line || n == 0) return 0;
    char *copy = realloc(in->text, n);
    if (!copy) return -1;
    memcpy(copy, line, n);
    in->text = copy, in->length = n, in->at = 0;
  }
  size_t n = in->length - in->at < room ? in->length - in->at : room;
  memcpy(to, in->text + in->at, n);
  in->at += n;
  return (ptrdiff_t)n;
}

static ptrdiff_t read_stream(void *session, int64_t i, void *to, size_t room) {
  vs_session *s = session;
  if (i == VS_IO_STDIN) return read_console(s, to, room);
  if (i <= VS_IO_STDERR || i >= VS_STREAMS || !s->stream[i].reading) return -1;
  vs_stream *in = &s->stream[i];
  size_t n = in->length - in->at < room ? in->length - in->at : room;
  if (n) memcpy(to, in->text + in->at, n);
  in->at += n;
  return (ptrdiff_t)n;
}

static bool write_console(vs_session *s, const char *bytes, size_t n) {
  const vs_host *h = &s->options.host;
  return !h->output || h->output(h->context, bytes, n);
}

static bool write_stream(void *session, int64_t i, const char *bytes, size_t n) {
  vs_session *s = session;
  if (i == VS_IO_STDOUT) return write_console(s, bytes, n);
  if (i == VS_IO_STDERR) return s->options.untrusted ? write_console(s, bytes, n) : fwrite(bytes, 1, n, stderr) == n;
  return i > VS_IO_STDERR && i < VS_STREAMS && s->stream[i].file && fwrite(bytes, 1, n, s->stream[i].file) == n;
}

static bool flush_stream(void *session, int64_t i) {
  vs_session *s = session;
  return i <= VS_IO_STDERR || i >= VS_STREAMS || !s->stream[i].file || fflush(s->stream[i].file) == 0;
}

static bool close_stream(void *session, int64_t i) {
  vs_session *s = session;
  if (i <= VS_IO_STDERR || i >= VS_STREAMS || !s->stream[i].open) return true;
  vs_stream old = s->stream[i];
  s->stream[i] = (vs_stream){ 0 };
  free(old.text);
  return !old.file || fclose(old.file) == 0;
}

void vs_session_close_files(vs_session *s) {
  for (int64_t i = VS_IO_STDERR + 1; i < VS_STREAMS; i++) close_stream(s, i);
  free(s->stream[VS_IO_STDIN].text);
  s->stream[VS_IO_STDIN] = (vs_stream){ 0 };
}

static bool exists(void *session, const char *path) {
  vs_session *s = session;
  if (!s->options.host.read_file) return !s->options.untrusted && access(path, F_OK) == 0;
  char *text;
  size_t length;
  const char *why;
  if (!read_whole(s, path, &text, &length, &why)) return false;
  free(text);
  return true;
}

static bool remove_file(void *session, const char *path, const char **why) {
  vs_session *s = session;
  if (s->options.untrusted) return refuse(s, "deleting files is switched off", why);
  if (s->flags & VS_EVAL_TRY) return refuse(s, "save the program first: an unsaved one deletes no files", why);
  return unlink(path) == 0 || refuse(s, errno == EACCES ? "not permitted to delete it" : reason(errno), why);
}

static bool list_folder(void *session, const char *path, bool (*take)(void *context, const char *name, size_t length),
                        void *context, const char **why) {
  vs_session *s = session;
  const vs_host *h = &s->options.host;
  if (h->list_folder) return h->list_folder(h->context, path, take, context, why);
  if (s->options.untrusted || s->options.host.read_file) return refuse(s, "reading folders is switched off", why);
  DIR *folder = opendir(*path ? path : ".");
  if (!folder) return refuse(s, errno == ENOENT ? "no such folder" : reason(errno), why);
  bool ok = true;
  for (const struct dirent *entry; ok && (entry = readdir(folder));)
    if (strcmp(entry->d_name, ".") && strcmp(entry->d_name, ".."))
      ok = take(context, entry->d_name, strlen(entry->d_name));
  closedir(folder);
  return ok;
}

const vs_io vs_session_io = {
  .open = open_stream, .read = read_stream, .write = write_stream, .flush = flush_stream, .close = close_stream,
  .exists = exists, .remove = remove_file, .list = list_folder, .now = now_of_day, .getenv = environment,
  .variable = variable,
};
