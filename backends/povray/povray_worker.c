/* Renders a picture with POV-Ray. Starts the runs (processes) of the plan in povray_plan.c, as many at a time as there
 * are processors, and reports their combined progress. Ends all runs when one fails or the time limit is reached.
 * Manages the private folder and the samples of bounced light, which the runs share. */
#define _GNU_SOURCE
#include "backends/povray/povray_worker.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "backends/povray/povray_picture.h"
#include "backends/povray/povray_plan.h"
#include "backends/povray/povray_process.h"
#include "geometry/measure/bounds.h"

enum { AT_ONCE = 64, STARTS = 5, NAME_ROOM = VS_POVRAY_PATH_ROOM + 40, WORDS = 25 };
/* Estimated time of the first pass, as a fraction of the time of all runs: it takes about half as long as the
 * strips. */
static const double pass_share = 0.35;
/* Limit of the exposure in stops. If an exposure darkens the picture by more, the file of light samples, which has four
 * digits after the point, is too coarse. */
static const double darkest = 5;
/* Limit of the drawing's distance from the origin, as a multiple of its size. At larger distances, the six digits in
 * the file of samples are too few for positions. */
static const double farthest = 50;

typedef struct {
  vs_emitter *e;
  char folder[VS_POVRAY_PATH_ROOM - 64];
  const char *scene;
  uint64_t scene_size;
  double begun, told;    /* begun: time at which the work began; told: time of the last report of progress; both in
                          * seconds, by the clock */
  double done, share;    /* fractions of all work. done: part that was completed before the current runs; share: part
                          * that the current runs do */
  vs_povray_plan plan;
} pov_work;

/* The jobs of one step of the plan, and the runs (processes) of POV-Ray that do them. */
typedef struct {
  const vs_povray_job *jobs;
  size_t count, next, room; /* count: number of jobs; next: index of the next job to start; room: number of entries of
                             * `at` */
  double pixels;            /* number of pixels of all jobs */
  double finished;          /* number of pixels of the finished jobs */
  struct { size_t job; int starts; } of[AT_ONCE];
  vs_povray_process *at;
} pov_crew;

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* ---- the arguments of a run ---- */

typedef struct { char *at[WORDS]; size_t count, used; char text[4 * NAME_ROOM + 512]; } words;

__attribute__((format(printf, 2, 3))) static void word(words *w, const char *format, ...) {
  va_list values;
  va_start(values, format);
  int length = vsnprintf(w->text + w->used, sizeof w->text - w->used, format, values);
  va_end(values);
  w->at[w->count++] = w->text + w->used;
  w->used += (size_t)length + 1;
}

/* Adds a file in the folder as an argument of POV-Ray. POV-Ray divides every argument again at blanks and quotes, so
 * the file's name is quoted. */
static void file_word(words *w, const char *option, const char *folder, const char *name, const char *ending) {
  char quote = strchr(folder, '"') ? '\'' : '"';
  word(w, "%s%c%s/%s%s%c", option, quote, folder, name, ending, quote);
}

static void words_of(const pov_work *work, const vs_povray_job *job, words *w) {
  const vs_exr_part *p = &job->part;
  vs_render_quality quality = work->e->options->quality;
  word(w, "povray");
  file_word(w, "+I", work->folder, strrchr(work->scene, '/') + 1, "");
  file_word(w, "+O", work->folder, job->name, ".exr");
  word(w, "+W%u", job->columns);
  word(w, "+H%u", job->rows);
  word(w, "+WT1");
  /* Sets the size, in megabytes, up to which POV-Ray keeps the picture in memory. Its own limit is 128. */
  if (vs_povray_fits(job)) word(w, "+MI%.0f", vs_povray_megabytes(job) + 1);
  static const char *const usual[] = { "+FE", "-D", "-GD", "-GR", "-GS" };
  for (size_t i = 0; i < sizeof usual / sizeof *usual; i++) word(w, "%s", usual[i]);
  /* The wanted part of the picture: columns and rows are counted from 1, and the last column and row are included.
   * POV-Ray reads the number 1 for the last column as the entire width. */
  if (p->left > 0) word(w, "+SC%u", p->left + 1);
  if (p->top > 0) word(w, "+SR%u", p->top + 1);
  if (p->left + p->columns < job->columns) word(w, "+EC%u", p->left + p->columns);
  if (p->top + p->rows < job->rows) word(w, "+ER%u", p->top + p->rows);
  /* Turns off jitter, which POV-Ray uses by default. With jitter, vertical edges become dotted; without jitter they are
   * even, at no cost. */
  if (!job->smooth || quality == VS_RENDER_DRAFT) {
    word(w, "-A");
  } else {
    word(w, quality == VS_RENDER_FINAL ? "+A0.05" : "+A0.1");
    word(w, "+AM2");
    word(w, quality == VS_RENDER_FINAL ? "+R3" : "+R2");
    word(w, "-J");
  }
  if (job->samples == VS_SAMPLES_KEPT) {
    word(w, "+RFO");
    file_word(w, "+RF", work->folder, job->name, ".rca");
  } else if (job->samples == VS_SAMPLES_GIVEN) {
    word(w, "+RFI");
    word(w, "Declare=VS_Samples=1");
    file_word(w, "+RF", work->folder, "samples", ".rca");
  }
  w->at[w->count] = NULL;
}

/* ---- several runs at a time ---- */

static bool crew_start(pov_work *work, pov_crew *c, size_t slot) {
  words w = { .count = 0 };
  const vs_povray_job *job = &c->jobs[c->of[slot].job];
  words_of(work, job, &w);
  c->of[slot].starts++;
  c->at[slot].fraction = 0;
  c->at[slot].room.megabytes = vs_povray_megabytes(job);
  c->at[slot].room.folder = vs_povray_fits(job) ? NULL : work->folder;
  return vs_povray_start(work->e, &c->at[slot], work->folder, w.at);
}

static double job_pixels(const vs_povray_job *job) { return (double)job->part.columns * job->part.rows; }

/* Starts runs of POV-Ray in all free slots, as long as there are jobs. */
static bool crew_fill(pov_work *work, pov_crew *c) {
  for (size_t i = 0; i < c->room && c->next < c->count; i++) {
    if (c->at[i].process > 0) continue;
    c->of[i].job = c->next++;
    c->of[i].starts = 0;
    if (!crew_start(work, c, i)) return false;
  }
  return true;
}

/* Reads the runs' output for a short time. Returns the number of runs that have not ended. */
static size_t crew_hear(pov_crew *c) {
  struct pollfd wait[AT_ONCE];
  size_t of[AT_ONCE], talking = 0, running = 0;
  for (size_t i = 0; i < c->room; i++) {
    if (c->at[i].process <= 0) continue;
    running++;
    if (c->at[i].errors < 0) continue;
    of[talking] = i;
    wait[talking++] = (struct pollfd){ .fd = c->at[i].errors, .events = POLLIN };
  }
  int heard = running > 0 ? poll(wait, talking, talking < running ? 20 : 100) : 0;
  for (size_t i = 0; heard > 0 && i < talking; i++)
    if (wait[i].revents) vs_povray_hear(&c->at[of[i]]);
  return running;
}

/* Processes the results of the runs that have ended. */
static bool crew_take(pov_work *work, pov_crew *c) {
  int status = 0;
  bool ok = true;
  for (size_t i = 0; ok && i < c->room; i++) {
    vs_povray_process *p = &c->at[i];
    if (p->process <= 0 || p->errors >= 0 || !vs_povray_ended(p, &status)) continue;
    if (c->of[i].starts < STARTS && vs_povray_was_starved(p, status)) {
      ok = crew_start(work, c, i);
      continue;
    }
    /* reports the progress first: if the user interrupted, POV-Ray may have ended before vs noticed it */
    ok = vs_emit_progress(work->e, "rendering", work->done) && vs_povray_judge(work->e, p, status);
    c->finished += job_pixels(&c->jobs[c->of[i].job]);
  }
  return ok;
}

/* Reports the progress ten times a second. Returns false, with the error set, if the work must stop. */
static bool crew_tell(pov_work *work, const pov_crew *c) {
  double at = now(), limit = work->e->job->limits.worker_seconds, pixels = c->finished;
  if (limit > 0 && at - work->begun > limit)
    return vs_error_set(work->e->error, VS_ERROR_WORKER, NULL,
                        "POV-Ray was stopped after %g seconds, the limit; --limit-worker sets another", limit);
  if (at - work->told < 0.1) return true;
  work->told = at;
  for (size_t i = 0; i < c->room; i++)
    if (c->at[i].process > 0) pixels += c->at[i].fraction * job_pixels(&c->jobs[c->of[i].job]);
  return vs_emit_progress(work->e, "rendering", work->done + work->share * fmin(1, pixels / c->pixels));
}

/* Runs the jobs to their end. share: fraction of all work that these jobs are. */
static bool work_do(pov_work *work, const vs_povray_job *jobs, size_t count, double share) {
  vs_store *store = work->e->scene->store;
  size_t room = vs_povray_at_once(work->e->options, jobs, work->scene_size);
  pov_crew c = { .jobs = jobs, .count = count };
  c.room = room < count ? room : count;
  if (c.room > AT_ONCE) c.room = AT_ONCE;
  for (size_t i = 0; i < count; i++) c.pixels += job_pixels(&jobs[i]);
  c.at = vs_store_realloc(store, NULL, 0, c.room * sizeof *c.at);
  if (c.at == NULL) return vs_emit_no_memory(work->e);
  for (size_t i = 0; i < c.room; i++) c.at[i].process = 0, c.at[i].errors = -1;
  work->share = share;
  bool ok = crew_fill(work, &c);
  while (ok && crew_hear(&c) > 0) ok = crew_take(work, &c) && crew_tell(work, &c) && crew_fill(work, &c);
  vs_povray_stop(c.at, c.room);
  vs_store_realloc(store, c.at, c.room * sizeof *c.at, 0);
  work->done += share;
  return ok;
}

/* ---- data that runs share ---- */

static void name_of(const pov_work *work, const char *name, const char *ending, char out[NAME_ROOM]) {
  snprintf(out, NAME_ROOM, "%s/%s%s", work->folder, name, ending);
}

static bool work_failed(const pov_work *work, const char *path) {
  return vs_error_set(work->e->error, VS_ERROR_FILE, NULL, "cannot write %s: %s", path,
                      errno == ENOSPC ? "the disk is full" : strerror(errno));
}

/* Appends the file at path to the open file `to`. */
static bool append(int to, const char *path) {
  char part[1 << 14];
  int from = open(path, O_RDONLY | O_CLOEXEC);
  ssize_t count = from < 0 ? -1 : 1;
  while (count > 0) {
    count = read(from, part, sizeof part);
    if (count < 0 && errno == EINTR) count = 1;
    else if (count > 0 && write(to, part, (size_t)count) != count) count = -1, errno = ENOSPC;
  }
  int problem = errno;
  if (from >= 0) close(from);
  errno = problem;
  return count == 0;
}

/* Joins the samples of the first pass into a single file, and removes the files of its parts. */
static bool join_samples(const pov_work *work) {
  char path[NAME_ROOM], part[NAME_ROOM];
  name_of(work, "samples", ".rca", path);
  int to = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  bool ok = to >= 0;
  for (size_t i = 0; ok && i < work->plan.pass_count; i++) {
    name_of(work, work->plan.jobs[i].name, ".rca", part);
    ok = append(to, part);
    unlink(part);
  }
  if (to >= 0 && close(to) != 0) ok = false;
  return ok || work_failed(work, path);
}

static bool work_prepare(pov_work *work) {
  const char *slash = strrchr(work->scene, '/');
  size_t length = slash != NULL ? (size_t)(slash - work->scene) : 0;
  struct stat info;
  char ini[NAME_ROOM];
  if (length == 0 || length >= sizeof work->folder)
    return vs_error_set(work->e->error, VS_ERROR_FILE, NULL, "the temporary folder's name is too long");
  memcpy(work->folder, work->scene, length);
  work->folder[length] = '\0';
  if (stat(work->scene, &info) == 0) work->scene_size = (uint64_t)info.st_size;
  name_of(work, "povray", ".ini", ini);
  static const char text[] = "Library_Path=\"/usr/share/povray-3.7/include\"\n";
  int file = open(ini, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  bool ok = file >= 0 && write(file, text, sizeof text - 1) == (ssize_t)(sizeof text - 1);
  if (file >= 0 && close(file) != 0) ok = false;
  return ok || work_failed(work, ini);
}

/* ---- the picture ---- */

/* Returns true if the drawing is so far from the origin that the positions in the file of samples have too few
 * digits. */
static bool is_far(const vs_emitter *e) {
  double away = 0;
  const double at[] = { e->bounds.min.x, e->bounds.min.y, e->bounds.min.z,
                        e->bounds.max.x, e->bounds.max.y, e->bounds.max.z };
  for (int i = 0; i < 6; i++) away = fmax(away, fabs(at[i]));
  return away > farthest * vs_bounds_diagonal(&e->bounds);
}

/* Renders all pictures of the plan, and sets *tone to the exposure that the first pass gives. If the file of samples
 * would be too coarse for a dark picture, renders the picture again in a single run. */
static bool work_all(pov_work *work, vs_tone *tone) {
  vs_povray_plan *p = &work->plan;
  double stops = 0, dark = 0;
  if (!p->bounced || p->pass_count == 0) {
    if (!work_do(work, p->jobs, p->count, 1)) return false;
    if (p->pass_count > 0 && !vs_povray_meter(work->e, work->folder, p, tone->curve, &stops)) return false;
  } else {
    bool ok = work_do(work, p->jobs, p->pass_count, pass_share) &&
              vs_povray_meter(work->e, work->folder, p, tone->curve, &stops) &&
              vs_povray_meter(work->e, work->folder, p, VS_TONE_NEUTRAL, &dark);
    if (ok && dark > darkest) *p = vs_povray_plan_of(work->e->options, 0, p->metered, true);
    else ok = ok && join_samples(work);
    if (!ok || !work_do(work, p->jobs + p->pass_count, p->count - p->pass_count, 1 - pass_share)) return false;
  }
  if (p->pass_count > 0 && p->metered) tone->fixed = true, tone->stops += stops;
  return true;
}

static bool run_render(vs_emitter *e, const char *scene, const char *output, bool develop) {
  pov_work work = { .e = e, .scene = scene, .begun = now() };
  vs_tone tone = e->options->tone;
  work.plan = vs_povray_plan_of(e->options, e->triangles, develop && !tone.fixed, is_far(e));
  if (!work_prepare(&work) || !work_all(&work, &tone)) return false;
  vs_povray_result r = { work.folder, &work.plan, &tone };
  return develop ? vs_povray_develop_picture(e, &r, output) : vs_povray_take_picture(e, &r, output);
}

bool vs_povray_render_png(vs_emitter *e, const char *scene, const char *output) {
  return run_render(e, scene, output, true);
}
bool vs_povray_render_exr(vs_emitter *e, const char *scene, const char *output) {
  return run_render(e, scene, output, false);
}
