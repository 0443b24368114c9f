/* Writes a drawing to a file: finds the format, opens a temporary file beside the target, writes the text, checks for
 * failures, and renames the file.
 *
 * A file appears completely or not at all (publish.c): it is flushed to disk before it gets its name. For a rendered
 * format, the text goes to a private folder (povray/povray_worker.c), and the picture to a temporary file beside the
 * target. */
#define _XOPEN_SOURCE 700
#include "backends/export.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "backends/backend.h"
#include "backends/driver.h"
#include "backends/publish.h"
#include "model/store/array.h"
#include "model/job.h"

void vs_export_options_init(vs_export_options *o) { *o = (vs_export_options){ .width = 0 }; }

/* ---- formats ---- */

static const vs_format formats[] = {
#define VS_FORMAT(suffix, backend, name, worker, binary, doc)                                                          \
  { #suffix, name, doc, worker, binary, &vs_backend_##backend },
#include "backends/backends.def"
};

static bool given_begin(vs_emitter *e) { return vs_put(e->out, e->options->given, e->options->given_size); }
static bool given_end(vs_emitter *e) { return !e->out->failed; }
const vs_backend vs_backend_given = { .begin = given_begin, .end = given_end, .traits = VS_VERBATIM };

size_t vs_export_format_count(void) { return sizeof formats / sizeof *formats; }
const vs_format *vs_export_format_at(size_t index) { return &formats[index]; }

const vs_format *vs_export_format_find(const char *text) {
  const char *dot = strrchr(text, '.'), *slash = strrchr(text, '/');
  const char *suffix = dot != NULL && (slash == NULL || dot > slash) ? dot + 1 : text;
  for (size_t i = 0; i < sizeof formats / sizeof *formats; i++)
    if (strcasecmp(formats[i].suffix, suffix) == 0 || strcasecmp(formats[i].name, text) == 0) return &formats[i];
  return NULL;
}

/* ---- files ---- */

typedef struct { int file; int problem; /* errno of the first failure, or 0 */ } export_file;

static bool export_file_sink(void *context, const void *bytes, size_t count) {
  export_file *f = context;
  const char *from = bytes;
  while (count > 0) {
    ssize_t part = write(f->file, from, count);
    if (part < 0 && errno == EINTR) continue;
    if (part <= 0) {
      f->problem = part < 0 ? errno : EIO;
      return false;
    }
    from += part;
    count -= (size_t)part;
  }
  return true;
}

static bool export_problem(vs_error *e, const char *path, int problem) {
  char why[128];
  if (problem == ENOMEM) return vs_error_memory(e, NULL);
  if (strerror_r(problem, why, sizeof why) != 0) snprintf(why, sizeof why, "error %d", problem);
  return vs_error_set(e, VS_ERROR_FILE, NULL, "cannot write %s: %s", path,
                      problem == ENOSPC ? "the disk is full" : why);
}

/* ---- one export ---- */

static bool export_text(vs_emitter *e, vs_writer *w) {
  e->out = w;
  bool ok = vs_drive_scene(e) && vs_writer_flush(w);
  vs_tally *tally = vs_store_tally(e->scene->store);
  if (ok && tally != NULL && e->backend->render == NULL) tally->written += w->bytes;
  if (!ok && w->full)
    vs_error_set(e->error, VS_ERROR_MODEL, NULL, "the output is larger than its limit of %llu MB",
                 (unsigned long long)(w->limit >> 20));
  return ok;
}

static void export_close(vs_emitter *e) {
  vs_job_stage(e->job, NULL);
  if (e->backend->close != NULL && e->drive != NULL) e->backend->close(e);
  vs_drive_free(e);
}

static vs_writer *export_writer(vs_emitter *e, vs_sink_fn *sink, void *context) {
  vs_writer *w = vs_fresh(1, sizeof *w);
  if (w == NULL) {
    vs_emit_no_memory(e);
    return NULL;
  }
  vs_writer_init(w, sink, context);
  vs_emit_watch(e, w);
  w->limit = e->job->limits.output_bytes;
  return w;
}

/* Writes the text (for a rendered format: the scene) to an open file. Returns false, with the reason in e's error, on
 * any failure, including a failure to write the file. */
static bool export_to_file(vs_emitter *e, int file, const char *path, bool sync) {
  export_file f = { file, 0 };
  vs_writer *w = export_writer(e, export_file_sink, &f);
  if (w == NULL) return false;
  bool ok = export_text(e, w);
  if (ok && sync && fsync(file) != 0 && errno != EINVAL && errno != EROFS) {
    f.problem = errno;
    ok = false;
  }
  free(w);
  if (f.problem != 0) export_problem(e->error, path, f.problem);
  return ok;
}

static char *export_join(const char *a, const char *b, unsigned long number) {
  size_t room = strlen(a) + strlen(b) + 32;
  char *text = vs_fresh(room, 1);
  if (text != NULL && number > 0) snprintf(text, room, "%s%s%lu", a, b, number);
  else if (text != NULL) snprintf(text, room, "%s%s", a, b);
  return text;
}

/* Returns false if path is an input file of the model, which no export replaces. */
static bool export_may_write(vs_emitter *e, const char *path) {
  return !vs_known_files_read(e->options->inputs, path) ||
         vs_error_set(e->error, VS_ERROR_FILE, NULL, "cannot write %s: the model has read it", path);
}

bool vs_emit_file(vs_emitter *e, const char *path, bool (*fill)(vs_emitter *e)) {
  vs_writer *was = e->out;
  vs_publish p;
  if (!export_may_write(e, path)) return false;
  if (!vs_publish_begin(&p, path, false)) return export_problem(e->error, path, errno);
  export_file f = { p.file, 0 };
  e->out = export_writer(e, export_file_sink, &f);
  bool ok = e->out != NULL && fill(e) && vs_writer_flush(e->out);
  if (ok && vs_store_tally(e->scene->store) != NULL) vs_store_tally(e->scene->store)->written += e->out->bytes;
  free(e->out);
  e->out = was;
  if (ok && fsync(f.file) != 0 && errno != EINVAL && errno != EROFS) f.problem = errno;
  if (!vs_publish_end(&p, ok && f.problem == 0) && f.problem == 0) f.problem = errno;
  return f.problem != 0 ? export_problem(e->error, path, f.problem) : ok;
}

/* Writes the scene of a rendered format into a private folder, runs the worker program, and moves the picture to
 * `output`. */
static bool export_render(vs_emitter *e, const char *output) {
  const char *base = getenv("TMPDIR");
  if (base == NULL || base[0] != '/') base = "/tmp";
  vs_publish_sweep(base, "visualscheme-work-", "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789");
  char *folder = export_join(base, "/visualscheme-work-XXXXXX", 0);
  char *text = NULL;
  int lock = -1; /* lock: descriptor of the folder, which is locked while this process runs, so that other processes do
                  * not remove it */
  bool made = false, ok = false;
  if (folder == NULL) {
    vs_emit_no_memory(e);
  } else if (mkdtemp(folder) == NULL) {
    export_problem(e->error, folder, errno);
  } else if (made = true, (text = export_join(folder, "/scene.pov", 0)) == NULL) {
    vs_emit_no_memory(e);
  } else {
    lock = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (lock >= 0) flock(lock, LOCK_EX | LOCK_NB);
    int file = open(text, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    e->folder = folder;
    ok = file >= 0 ? export_to_file(e, file, text, false) : export_problem(e->error, text, errno);
    if (file >= 0 && close(file) != 0 && ok) ok = export_problem(e->error, text, errno);
    vs_tally *tally = vs_store_tally(e->scene->store);
    vs_work_phase was = vs_tally_enter(tally, VS_WORK_WORKER);
    struct stat picture;
    ok = ok && e->backend->render(e, text, output);
    if (ok && tally != NULL && stat(output, &picture) == 0) tally->written += (uint64_t)picture.st_size;
    vs_tally_enter(tally, was);
  }
  e->folder = NULL;
  if (made) vs_publish_clear(folder);
  if (lock >= 0) close(lock);
  free(text);
  free(folder);
  return ok;
}

static bool export_sync(const char *path, vs_error *e, const char *shown) {
  int file = open(path, O_RDONLY | O_CLOEXEC);
  if (file < 0) return export_problem(e, shown, errno);
  bool ok = fsync(file) == 0 || errno == EINVAL || errno == EROFS || export_problem(e, shown, errno);
  close(file);
  return ok;
}

static bool export_named(vs_emitter *e, const char *path) {
  struct stat info;
  bool exists = stat(path, &info) == 0;
  if (!export_may_write(e, path)) return false;
  if (exists && S_ISDIR(info.st_mode))
    return vs_error_set(e->error, VS_ERROR_FILE, NULL, "cannot write %s: it is a folder", path);
  /* The output is a pipe or a device such as /dev/full: there is no file to replace by renaming. */
  if (exists && !S_ISREG(info.st_mode) && e->backend->render == NULL) {
    int file = open(path, O_WRONLY | O_CLOEXEC);
    bool ok = file >= 0 ? export_to_file(e, file, path, true) : export_problem(e->error, path, errno);
    if (file >= 0 && close(file) != 0 && ok) ok = export_problem(e->error, path, errno);
    return ok;
  }
  if (exists && access(path, W_OK) != 0) return export_problem(e->error, path, errno);
  bool renders = e->backend->render != NULL;
  vs_publish p;
  bool ok = vs_publish_begin(&p, path, renders) || export_problem(e->error, path, errno);
  if (ok) {
    if (exists) (void)!fchmod(p.file, info.st_mode & 0777);
    ok = renders ? export_render(e, p.name) && export_sync(p.name, e->error, path)
                 : export_to_file(e, p.file, path, true);
    ok = ok && (e->backend->beside == NULL || e->backend->beside(e));
    if (!vs_publish_end(&p, ok) && ok) ok = export_problem(e->error, path, errno);
  }
  return ok;
}

/* Renders a picture into a temporary file and copies it to standard output or a sink. */
static bool export_render_to(vs_emitter *e, vs_sink_fn *sink, void *context) {
  char name[] = "/tmp/visualscheme-picture-XXXXXX";
  int file = mkstemp(name);
  if (file < 0) return export_problem(e->error, name, errno);
  bool ok = export_render(e, name);
  char *part = ok ? vs_fresh(VS_WRITER_ROOM, 1) : NULL;
  if (ok && part == NULL) ok = vs_emit_no_memory(e);
  while (ok) {
    ssize_t count = read(file, part, VS_WRITER_ROOM);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) ok = export_problem(e->error, name, errno);
    if (count <= 0) break;
    if (!sink(context, part, (size_t)count))
      ok = vs_error_set(e->error, VS_ERROR_FILE, NULL, "the output could not be written");
  }
  close(file);
  unlink(name);
  free(part);
  return ok;
}

const char *vs_export_family(const vs_format *format) { return format->backend->family; }

/* Places each drawn object by `place`. */
static bool place_drawn(vs_scene *scene, const struct vs_transform *place, vs_error *e) {
  for (size_t i = 0; i < scene->drawn_count; i++) {
    vs_node *placed = vs_node_new(scene->store, VS_TRANSFORM, place, &scene->drawn[i], 1);
    if (placed == NULL) return vs_error_memory(e, NULL);
    vs_node_release(scene->drawn[i].node);
    scene->drawn[i].node = placed;
  }
  return true;
}

/* Rotates the drawing from Z upwards to Y upwards: x, y and z become x, z and -y. */
static bool turn_up(vs_scene *scene, vs_error *e) {
  static const struct vs_transform turn = { .matrix = { { { 1, 0, 0, 0 }, { 0, 0, 1, 0 }, { 0, -1, 0, 0 } } } };
  return place_drawn(scene, &turn, e);
}

double vs_export_units(const vs_scene *scene, const char *units) {
  return units == NULL ? 1 : vs_scene_metres(scene) / vs_unit_metres(units);
}

/* Converts the drawn objects, and the tolerance, to another unit of length. */
static bool convert_units(vs_scene *scene, const char *units, vs_error *e) {
  double factor = vs_export_units(scene, units);
  const struct vs_transform scale = { .matrix = { { { factor, 0, 0, 0 }, { 0, factor, 0, 0 }, { 0, 0, factor, 0 } } } };
  scene->units = units;
  scene->tolerance *= factor;
  return factor == 1 || place_drawn(scene, &scale, e);
}

bool vs_export_sugar(vs_scene *scene, const vs_format *format, const vs_export_options *options, vs_error *e) {
  const vs_backend *b = format->backend;
  char output[24];
  snprintf(output, sizeof output, ".%.20s", format->suffix);
  vs_sugar_options o = { .output = output,
                          .strict = options->strict,
                          .highlights = b->highlights,
                          .ghosts = b->ghosts,
                          .faults = b->highlights,
                          .target = b->native,
                          .muted = options->safe,
                          .keeps_parts = options->keeps_parts || vs_backend_has(b, VS_NAMES),
                          .job = options->job };
  if (vs_backend_has(b, VS_SHOWS_GHOSTS_IN_DRAFTS) && options->quality != VS_RENDER_DRAFT) o.ghosts = VS_MARKS_DROP;
  return vs_scene_sugar(scene, &o, e) &&
         (!options->up_y || !vs_backend_has(b, VS_TURNS) || turn_up(scene, e)) &&
         (options->units == NULL || !vs_backend_has(b, VS_UNITS) || convert_units(scene, options->units, e));
}

/* Data of an export: its emitter, and the options, job and error that are used if the caller passes NULL for them. */
typedef struct {
  vs_emitter emitter;
  vs_export_options defaults;
  vs_job idle;
  vs_error unread;
} export_run;

/* Initialises the emitter in *run and returns it. It contains pointers to *run, which must therefore not be moved.
 * options and e may be NULL. */
static vs_emitter *export_begin(export_run *run, const vs_scene *scene, const vs_format *format,
                                const vs_export_options *options, vs_error *e) {
  vs_export_options_init(&run->defaults);
  run->idle = (vs_job){ .going = NULL };
  run->unread = (vs_error){ VS_ERROR_NONE, NULL, "" };
  if (options == NULL) options = &run->defaults;
  run->emitter = (vs_emitter){ .scene = scene,
                               .options = options,
                               .job = options->job != NULL ? options->job : &run->idle,
                               .backend = format->backend,
                               .error = e != NULL ? e : &run->unread };
  return &run->emitter;
}

/* Returns ok. But if the completed file has a fault (e->flaw), sets the error and returns false. */
static bool export_tell_flaw(vs_emitter *e, bool ok) {
  if (!ok || e->flaw.kind == VS_ERROR_NONE) return ok;
  *e->error = e->flaw;
  return false;
}

bool vs_export_to(const vs_scene *scene, const vs_format *format, vs_sink_fn *sink, void *context,
                  const vs_export_options *options, vs_error *e) {
  export_run run;
  vs_emitter *emitter = export_begin(&run, scene, format, options, e);
  bool ok;
  if (format->backend->render != NULL) {
    ok = export_render_to(emitter, sink, context);
  } else {
    vs_writer *w = export_writer(emitter, sink, context);
    ok = w != NULL && export_text(emitter, w);
    if (!ok && emitter->error->kind == VS_ERROR_NONE)
      vs_error_set(emitter->error, VS_ERROR_FILE, NULL, "the output could not be written");
    free(w);
  }
  ok = export_tell_flaw(emitter, ok);
  export_close(emitter);
  return ok;
}

bool vs_export(const vs_scene *scene, const vs_format *format, const char *path, const vs_export_options *options,
               vs_error *e) {
  vs_error unread = { VS_ERROR_NONE, NULL, "" };
  if (e == NULL) e = &unread;
  e->kind = VS_ERROR_NONE;
  if (format == NULL) format = vs_export_format_find(path);
  if (format == NULL) return vs_error_set(e, VS_ERROR_FILE, NULL, "%s: no format has this ending", path);
  if (strcmp(path, "-") == 0) {
    export_file f = { STDOUT_FILENO, 0 };
    bool ok = vs_export_to(scene, format, export_file_sink, &f, options, e);
    if (f.problem != 0) export_problem(e, "standard output", f.problem);
    return ok;
  }
  export_run run;
  vs_emitter *emitter = export_begin(&run, scene, format, options, e);
  emitter->path = path;
  bool ok = export_tell_flaw(emitter, export_named(emitter, path));
  export_close(emitter);
  return ok;
}
