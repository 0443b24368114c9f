/* Implements the fit of a program's parameters to a scan (visualscheme.h). Runs the program with many values of its
 * parameters for geometry/fitting/, and reports the quality of the result. */
#include "session/fit/scan_fit.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "backends/publish.h"
#include "bind/call/precision.h"
#include "bind/parameters.h"
#include "geometry/fitting/distance_map.h"
#include "geometry/fitting/model_fit.h"
#include "geometry/fitting/robust_squares.h"
#include "geometry/fitting/scan_points.h"
#include "model/store/array.h"
#include "session/handles.h"
#include "session/host.h"
#include "session/report.h"
#include "session/spine.h"
#include "solids/solid_meshes.h"

/* USUAL_POINTS: greatest number of points of the scan that are used by default. MOST_NAMES, MOST_DOUBT: greatest
 * lengths of texts in bytes */
enum { USUAL_POINTS = 20000, MOST_NAMES = 300, MOST_DOUBT = 600 };

typedef struct {
  const char *name;
  vs_fit_state state;
  double start, value, error, low, high;
  vs_span at;
} fitted;

struct vs_scan_fit {
  vs_scan_points scan;
  vs_model_fit fit;
  fitted *parameters; /* all parameters of the program, in the program's order; the store owns their names */
  size_t *number;     /* number[i]: index in `parameters` of the i-th parameter that is fitted */
  size_t parameter_count, number_count;
  double *distances; /* distances[i]: distance of point i of the file from the model */
};

void vs_fit_options_init(vs_fit_options *o, size_t size) {
  const vs_fit_options usual = { .size = sizeof usual, .points = USUAL_POINTS, .confidence = .95 };
  vs_session_give_options(o, size, &usual, sizeof usual);
}

void vs_session_free_fit(vs_session *s) {
  vs_scan_fit *f = s->fit;
  if (!f) return;
  vs_scan_points_free(&f->scan);
  vs_model_fit_free(&f->fit);
  free(f->parameters), free(f->number), free(f->distances);
  free(f);
  s->fit = NULL;
}

/* ---- running the program ---- */

typedef struct {
  vs_session *session;
  vs_scheme *vm;
  const char *model;
  vs_scan_fit *f;
  vs_host host; /* the embedder's callbacks; during trial runs, output is not passed to them */
  double began;
  bool late;
  char message[200]; /* text of the last error in a trial run */
  char phase[100];
} job;

static void keep_message(void *context, const vs_diagnostic *d) {
  job *j = context;
  if (d->severity == VS_SEVERITY_ERROR) snprintf(j->message, sizeof j->message, "%s", d->message);
}
static bool drop_output(void *context, const char *text, size_t length) {
  return (void)context, (void)text, (void)length, true;
}
static bool poll_embedder(void *context) {
  job *j = context;
  return j->host.poll && j->host.poll(j->host.context);
}
static bool read_embedder(void *context, const char *path, char **text, size_t *length, const char **why) {
  job *j = context;
  return j->host.read_file(j->host.context, path, text, length, why);
}
static bool list_embedder(void *context, const char *path, bool (*take)(void *to, const char *name, size_t length),
                          void *to, const char **why) {
  job *j = context;
  return j->host.list_folder(j->host.context, path, take, to, why);
}

/* Replaces the embedder's callbacks, so that output and messages of trial runs are not shown. The program can still
 * read files. */
static void hush(job *j) {
  vs_host *h = &j->session->options.host;
  *h = (vs_host){ .context = j,
                  .output = drop_output,
                  .diagnose = keep_message,
                  .poll = poll_embedder,
                  .read_file = j->host.read_file ? read_embedder : NULL,
                  .list_folder = j->host.list_folder ? list_embedder : NULL };
}
static void unhush(job *j) { j->session->options.host = j->host; }

static bool going(void *context) {
  job *j = context;
  vs_session *s = j->session;
  if (s->options.limit_time > 0 && vs_session_clock(s) - j->began > s->options.limit_time) j->late = true;
  s->phase = NULL; /* the fit reports its own progress */
  return !vs_session_interrupted(s) && !j->late;
}

static void progress(void *context, unsigned iteration, double spread) {
  job *j = context;
  double now = vs_session_clock(j->session);
  if (!j->host.progress || now - j->session->told_progress < .1) return;
  j->session->told_progress = now;
  snprintf(j->phase, sizeof j->phase, "fitting: iteration %u, spread %.4g", iteration, spread);
  j->host.progress(j->host.context, &(vs_progress){ .phase = j->phase, .fraction = -1 });
}

/* Returns true until twice the time limit has passed. The fit ends at the limit; the additional time is for the
 * evaluation of its best result. */
static bool keep_combining(void *context, const char *stage, double done) {
  job *j = context;
  bool go = going(j);
  (void)stage, (void)done;
  return go || (j->late && vs_session_clock(j->session) - j->began < 2 * j->session->options.limit_time);
}

/* Runs the program with the current values of its parameters. */
static vs_outcome run(job *j) {
  vs_outcome outcome = vs_restart(j->vm);
  return outcome == VS_OUTCOME_DONE ? vs_eval_file(j->vm, j->model, VS_EVAL_CHECK_LATER) : outcome;
}

/* Sets *e to the error that the outcome and the last message of a run describe. Returns false. */
static bool failed(const job *j, vs_outcome outcome, vs_error *e) {
  vs_error_kind kind = outcome == VS_OUTCOME_INTERRUPTED ? VS_ERROR_INTERRUPT
                       : outcome == VS_OUTCOME_MACHINE   ? VS_ERROR_LIMIT
                                                         : VS_ERROR_MODEL;
  return vs_error_set(e, kind, NULL, "%s", j->message);
}

/* Computes the mesh of the drawing with this tolerance in model units; 0: the drawing's own tolerance. */
static bool mesh_drawn(job *j, double tolerance, vs_mesh *out, vs_error *e) {
  vs_session *s = j->session;
  vs_ref *refs;
  size_t count;
  vs_fineness facets = { .tolerance = tolerance, .segments = vs_bind_segments(s->bind.vm) };
  if (tolerance <= 0) facets.tolerance = vs_bind_tolerance(s->bind.vm);
  if (facets.tolerance <= 0) {
    vs_summary sum;
    vs_outcome outcome = vs_drawing_summary(j->vm, &sum);
    if (outcome != VS_OUTCOME_DONE) return failed(j, outcome, e);
    if (!sum.has_bounds) return true;
    vs_bounds b = { vs_v3(sum.min[0], sum.min[1], sum.min[2]), vs_v3(sum.max[0], sum.max[1], sum.max[2]) };
    facets.tolerance = vs_fineness_tolerance(&b);
  }
  vs_outcome outcome = vs_session_take(s, &refs, &count);
  if (outcome != VS_OUTCOME_DONE) return failed(j, outcome, e);
  vs_job work = { .going = keep_combining, .context = j };
  vs_kernel_options options = { .job = &work, .cache = vs_store_cache(s->bind.store) };
  vs_solid solid = { 0 };
  bool ok = vs_solid_evaluate(refs, count, &facets, &options, &solid, e);
  if (ok) *out = solid.mesh, solid.mesh = (vs_mesh){ 0 };
  vs_solid_free(&solid);
  for (size_t i = 0; i < count; i++) vs_node_release(refs[i].node);
  vs_store_realloc(s->bind.store, refs, (count + 1) * sizeof *refs, 0);
  return ok;
}

static bool set_numbers(job *j, const double *numbers) {
  char text[40];
  for (size_t i = 0; i < j->f->number_count; i++) {
    snprintf(text, sizeof text, "%.15g", numbers[i]);
    if (!vs_parameter_set(j->vm, j->f->parameters[j->f->number[i]].name, text)) return false;
  }
  return true;
}

/* Sets the program's parameters to the fitted values if `found` is true, otherwise to their initial values. Returns
 * false when memory is out. */
static bool set_back(job *j, bool found) {
  char text[40];
  const vs_scan_fit *f = j->f;
  for (size_t i = 0; i < f->number_count; i++) {
    snprintf(text, sizeof text, "%.15g", found ? f->fit.numbers[i].value : f->parameters[f->number[i]].start);
    if (!vs_parameter_set(j->vm, f->parameters[f->number[i]].name, text)) return false;
  }
  return true;
}

/* The function vs_fit_model.make: runs the program with these values of its parameters, and computes the mesh of its
 * drawing. */
static bool make(void *context, const double *numbers, double tolerance, vs_mesh *out, vs_error *e) {
  job *j = context;
  *j->message = 0;
  if (!set_numbers(j, numbers)) return vs_error_memory(e, NULL);
  vs_outcome outcome = run(j);
  if (outcome != VS_OUTCOME_DONE) return failed(j, outcome, e);
  return mesh_drawn(j, tolerance, out, e);
}

/* ---- the program's parameters ---- */

static bool is_held(const vs_fit_options *o, const char *name) {
  for (size_t i = 0; i < o->held_count; i++)
    if (!strcmp(o->held[i], name)) return true;
  return false;
}

/* Reads the program's parameters after its first run. If an option names an unknown parameter, reports this and returns
 * false. Also returns false when memory is out. */
static bool take_parameters(job *j, const vs_fit_options *o, vs_fit_number **numbers, vs_outcome *outcome) {
  vs_session *s = j->session;
  vs_scan_fit *f = j->f;
  size_t n = f->parameter_count = vs_parameter_count(j->vm), rooms[3] = { 0 };
  *outcome = VS_OUTCOME_MACHINE;
  if (!VS_GROW(f->parameters, rooms[0], n + 1) || !VS_GROW(f->number, rooms[1], n + 1) ||
      !VS_GROW(*numbers, rooms[2], n + 1))
    return vs_session_out_of_memory(s), false;
  for (size_t i = 0; i < n; i++) {
    const vs_bind_parameter *p = &s->bind.parameters[i];
    vs_parameter_info info;
    vs_parameter_get(j->vm, i, &info);
    char *end;
    double value = strtod(info.value, &end);
    bool number = info.type == VS_PARAMETER_REAL && !info.choices && !*end && isfinite(value),
         held = is_held(o, info.name);
    f->parameters[i] = (fitted){ .name = info.name,
                                 .start = value,
                                 .value = value,
                                 .low = value,
                                 .high = value,
                                 .at = info.at,
                                 .state = held     ? VS_FIT_HELD
                                          : number ? VS_FIT_FITTED
                                                   : VS_FIT_NO_NUMBER };
    if (!number || held) continue;
    (*numbers)[f->number_count] = (vs_fit_number){ value, p->least ? p->min : -INFINITY, p->most ? p->max : INFINITY };
    f->number[f->number_count++] = i;
  }
  *outcome = VS_OUTCOME_USAGE;
  for (size_t i = 0; i < o->held_count; i++) {
    bool known = false;
    for (size_t k = 0; k < n; k++) known = known || !strcmp(o->held[i], f->parameters[k].name);
    if (known) continue;
    char text[200];
    snprintf(text, sizeof text, "the model has no parameter %.100s that could be held", o->held[i]);
    return vs_session_report_at(s, VS_SEVERITY_ERROR, VS_OUTCOME_USAGE, (vs_span){ .file = j->model }, text), false;
  }
  const char *unused = vs_parameter_unused(j->vm, 0);
  if (unused) {
    char text[200];
    snprintf(text, sizeof text, "the model has no parameter %.100s, which was set", unused);
    return vs_session_report_at(s, VS_SEVERITY_ERROR, VS_OUTCOME_USAGE, (vs_span){ .file = j->model }, text), false;
  }
  if (f->number_count || !o->placed) return true;
  const char *why =
      n ? "nothing is left to fit: the scan is placed, and no free parameter has a real number such as 5.0 as its "
          "default; an exact number such as 5 is never fitted"
        : "nothing is there to fit: the scan is placed, and the model has no parameters; (define-parameter height 5.0) "
          "makes one";
  vs_session_report_at(s, VS_SEVERITY_ERROR, VS_OUTCOME_USAGE, (vs_span){ .file = j->model }, why);
  return false;
}

/* ---- the points of the scan ---- */

static bool keep_reading(void *session) { return !vs_session_interrupted(session); }

static vs_outcome read_scan(job *j, const char *path, const vs_fit_options *o) {
  vs_session *s = j->session;
  char *bytes;
  size_t length;
  const char *why;
  vs_error e = { 0 };
  vs_face_list read = { 0 };
  if (!vs_mesh_file_is(path)) {
    vs_session_report_at(s, VS_SEVERITY_ERROR, VS_OUTCOME_USAGE, (vs_span){ .file = path },
                         "a scan's name ends in .ply, .obj, .off or .stl");
    return VS_OUTCOME_USAGE;
  }
  if (!vs_session_read(s, path, false, &bytes, &length, &why)) return vs_session_unread(s, path, why);
  vs_file_bytes file = { path, (const unsigned char *)bytes, length };
  bool ok = vs_points_file_read(&file, (vs_poller){ keep_reading, s }, true, &read, &e);
  free(bytes);
  size_t points = o->points ? o->points : USUAL_POINTS;
  ok = ok && vs_scan_points_take(&read, points, &j->f->scan, &e);
  vs_face_list_free(&read);
  if (!ok) {
    if (e.kind == VS_ERROR_MODEL) e.kind = VS_ERROR_FILE;
    return vs_session_report_error(s, &e);
  }
  const vs_scan_points *scan = &j->f->scan;
  char text[160];
  if (scan->nowhere && scan->nowhere == scan->file.point_count) {
    vs_session_report_at(s, VS_SEVERITY_ERROR, VS_OUTCOME_USAGE, (vs_span){ .file = path },
                         "no point of the scan has a finite place");
    return VS_OUTCOME_USAGE;
  }
  if (!scan->file.point_count) {
    vs_session_report_at(s, VS_SEVERITY_ERROR, VS_OUTCOME_USAGE, (vs_span){ .file = path }, "the scan has no points");
    return VS_OUTCOME_USAGE;
  }
  if (scan->nowhere) {
    snprintf(text, sizeof text, "%zu of %zu points have no finite place and are omitted", scan->nowhere,
             scan->file.point_count);
    vs_session_report_at(s, VS_SEVERITY_WARNING, VS_OUTCOME_DONE, (vs_span){ .file = path }, text);
  }
  return VS_OUTCOME_DONE;
}

/* ---- warnings about the result ---- */

static void warn(const job *j, const char *text) {
  vs_session_report_at(j->session, VS_SEVERITY_WARNING, VS_OUTCOME_DONE, (vs_span){ .file = j->model }, text);
}

/* Writes the names of all parameters whose fit has the given state, separated by commas. Returns false if there are
 * none. */
static bool names_of(const vs_scan_fit *f, vs_fit_state state, char text[MOST_NAMES]) {
  size_t used = 0;
  *text = 0;
  for (size_t i = 0; i < f->parameter_count; i++) {
    if (f->parameters[i].state != state) continue;
    int n = snprintf(text + used, MOST_NAMES - used, "%s%s", used ? ", " : "", f->parameters[i].name);
    if (n > 0 && used + (size_t)n < MOST_NAMES) used += (size_t)n;
  }
  return used > 0;
}

static void warn_all(const job *j, const vs_fit_result *r) {
  const vs_scan_fit *f = j->f;
  const vs_model_fit *m = &f->fit;
  char names[MOST_NAMES], text[MOST_NAMES + 300];
  bool stopped = m->stopped;
  if (!stopped && !r->converged)
    warn(j, "the fit has not converged: its values may be far off; other values to start from (-D) may help");
  if (!stopped && names_of(f, VS_FIT_UNDETERMINED, names)) {
    snprintf(text, sizeof text,
             "the scan does not determine %s: other values would fit as well; hold the known parameters, or scan more",
             names);
    warn(j, text);
  }
  if (!stopped && names_of(f, VS_FIT_AT_BOUND, names)) {
    snprintf(text, sizeof text, "%s: stopped by #:min or #:max; the scan fits better with a value beyond that limit",
             names);
    warn(j, text);
  }
  for (size_t i = 0; m->rival && m->doubt != VS_FIT_DOUBT_RIVAL && i < f->number_count; i++) {
    double a = m->numbers[i].value, b = m->numbers[i].rival;
    if (!(fabs(a - b) > .05 * fmax(fabs(a), fabs(b))) || m->numbers[i].verdict == VS_FIT_NUMBER_LOOSE) continue;
    snprintf(
        text, sizeof text,
        "another start gave an equally near fit with %s = %.4g instead of %.4g: the scan does not decide between them",
        f->parameters[f->number[i]].name, b, a);
    warn(j, text);
    break;
  }
  if (r->outliers > r->samples / 20 && m->doubt != VS_FIT_DOUBT_STRAYS) {
    snprintf(text, sizeof text,
             "%.0f %% of the points lie further than %.3g from the fitted model and had no influence: damage, other "
             "things in the scan, or a wrong fit; a map (-o map.ply) shows these points",
             100. * (double)r->outliers / (double)r->samples, VS_TUKEY_REACH * r->spread);
    warn(j, text);
  }
  if (r->correlation > .5 && r->spread > 1e-3 * r->size && m->doubt != VS_FIT_DOUBT_SHAPE) {
    snprintf(text, sizeof text,
             "neighbouring points lie on the same side of the model (correlation %.2f): the model differs from the "
             "scan by more than noise, and the intervals are too narrow",
             r->correlation);
    warn(j, text);
  }
  if (names_of(f, VS_FIT_NO_NUMBER, names)) {
    snprintf(text, sizeof text, "not fitted, because the default is no real number (5.0 is one, 5 is not): %s", names);
    vs_session_report_at(j->session, VS_SEVERITY_NOTE, VS_OUTCOME_DONE, (vs_span){ .file = j->model }, text);
  }
}

/* ---- running a fit ---- */

static bool take_result(job *j, vs_fit_result *r) {
  static const vs_fit_state states[] = { [VS_FIT_NUMBER_FITTED] = VS_FIT_FITTED,
                                         [VS_FIT_NUMBER_LOOSE] = VS_FIT_UNDETERMINED,
                                         [VS_FIT_NUMBER_BOUND] = VS_FIT_AT_BOUND };
  static const char *const words[] = { [VS_FIT_DOUBT_NONE] = "none",     [VS_FIT_DOUBT_FAR] = "far",
                                       [VS_FIT_DOUBT_TILTED] = "tilted", [VS_FIT_DOUBT_STRAYS] = "strays",
                                       [VS_FIT_DOUBT_SHAPE] = "shape",   [VS_FIT_DOUBT_RIVAL] = "rival" };
  vs_scan_fit *f = j->f;
  const vs_model_fit *m = &f->fit;
  const vs_face_list *file = &f->scan.file;
  vs_affine place = vs_rigid_inverse(&m->motion);
  size_t room = 0;
  if (!VS_GROW(f->distances, room, file->point_count + 1)) return false;
  for (size_t i = 0; i < file->point_count; i++) {
    vs_vec3 p = file->points[i];
    bool there = isfinite(p.x) && isfinite(p.y) && isfinite(p.z);
    f->distances[i] = there ? vs_mesh_distance_at(m->field, vs_rigid_point(&m->motion, p), NULL) : (double)NAN;
    if (!(i & 1023)) going(j);
  }
  for (size_t i = 0; i < f->number_count; i++) {
    fitted *p = &f->parameters[f->number[i]];
    const vs_fitted_number *n = &m->numbers[i];
    p->value = n->value, p->error = n->error, p->low = n->low, p->high = n->high, p->state = states[n->verdict];
  }
  *r = (vs_fit_result){ .points = file->point_count,
                        .nowhere = f->scan.nowhere,
                        .samples = f->scan.sample_count,
                        .used = m->used,
                        .outliers = m->outliers,
                        .spread = m->spread,
                        .median = m->median,
                        .root_mean_square = m->root_mean_square,
                        .correlation = m->correlation,
                        .size = m->size,
                        .doubt = words[m->doubt],
                        .converged = m->converged && !m->stopped,
                        .iterations = m->iterations,
                        .runs = m->models,
                        .units = j->session->bind.scene.units };
  memcpy(r->place, place.m, sizeof r->place);
  return true;
}

/* Returns the number of the first parameter that differs by more than 5 percent between the best and the second-best
 * result, or 0. */
static size_t rival_number(const vs_model_fit *m, size_t count) {
  for (size_t i = 0; i < count; i++)
    if (fabs(m->numbers[i].value - m->numbers[i].rival) > .05 * fabs(m->numbers[i].value)) return i;
  return 0;
}

/* Writes the reason why the result may be wrong, and possible remedies. Returns false if there is no such reason. */
static bool tell_doubt(const job *j, const vs_fit_result *r, char text[MOST_DOUBT]) {
  const vs_scan_fit *f = j->f;
  const vs_model_fit *m = &f->fit;
  size_t rival;
  switch (m->doubt) {
  case VS_FIT_DOUBT_NONE: return false;
  case VS_FIT_DOUBT_FAR:
    snprintf(
        text, MOST_DOUBT,
        "the model does not fit the scan: half of the points lie further than %.3g from it, %.2g %% of the "
        "scan's size; the result is wrong. Try other values to start from (-D), --near, --any-pose, or another model",
        r->median, 100 * r->median / r->size);
    return true;
  case VS_FIT_DOUBT_TILTED:
    snprintf(text, MOST_DOUBT,
             "the nearest fit turns the scan on its side or upside down; if the scan lies so, give --any-pose; "
             "otherwise the result is wrong: try other values to start from (-D), or --near");
    return true;
  case VS_FIT_DOUBT_STRAYS:
    snprintf(text, MOST_DOUBT,
             "%.0f %% of the scan's points lie further than %.3g from the fitted model: strays, or the fit is wrong. "
             "Crop the scan, or lay the scan near the model and give --near; a map (-o map.ply) shows these points",
             100. * (double)r->outliers / (double)r->samples, VS_TUKEY_REACH * r->spread);
    return true;
  case VS_FIT_DOUBT_SHAPE:
    snprintf(
        text, MOST_DOUBT,
        "neighbouring points lie on the same side of the model (correlation %.2f): the scan has another shape, or the "
        "fit is wrong. Try other values to start from (-D), or --near; a map (-o map.ply) shows the differences",
        r->correlation);
    return true;
  case VS_FIT_DOUBT_RIVAL:
    rival = rival_number(m, f->number_count);
    snprintf(
        text, MOST_DOUBT,
        "another start gave an equally near fit with %.100s = %.4g instead of %.4g: the scan does not decide between "
        "them. Hold the known parameters (--hold), scan more, or lay the scan near the model and give --near",
        f->parameters[f->number[rival]].name, m->numbers[rival].rival, m->numbers[rival].value);
    return true;
  }
  return false;
}

/* Reports the result of the fit, and returns its outcome. */
static vs_outcome conclude(job *j, const vs_fit_result *r) {
  vs_session *s = j->session;
  char text[MOST_DOUBT];
  warn_all(j, r);
  if (j->f->fit.stopped) {
    if (j->late)
      snprintf(text, sizeof text, "the fit took longer than %.6g seconds: the best result so far follows",
               s->options.limit_time);
    else
      snprintf(text, sizeof text, "interrupted: the best result so far follows");
    vs_outcome outcome = j->late ? VS_OUTCOME_MACHINE : VS_OUTCOME_INTERRUPTED;
    vs_session_report_at(s, VS_SEVERITY_ERROR, outcome, (vs_span){ 0 }, text);
    return outcome;
  }
  if (!tell_doubt(j, r, text)) return VS_OUTCOME_DONE;
  vs_session_report_at(s, VS_SEVERITY_ERROR, VS_OUTCOME_MODEL, (vs_span){ .file = j->model }, text);
  return VS_OUTCOME_MODEL;
}

vs_outcome vs_fit(vs_scheme *vm, const char *model, const char *scan, const vs_fit_options *given, vs_fit_result *out) {
  vs_session *s = vs_session_of(vm);
  vs_fit_options own = vs_fit_options_default();
  const vs_fit_options *o = &own;
  vs_session_take_options(&own, sizeof own, VS_FIRST_FIT_OPTIONS, given);
  vs_fit_number *numbers = NULL;
  vs_error e = { 0 };
  *out = (vs_fit_result){ 0 };
  if (vs_session_busy(s, "vs_fit")) return VS_OUTCOME_USAGE;
  vs_session_free_fit(s);
  size_t room = 0;
  if (!vs_room_grow(&s->fit, &room, 1, sizeof *s->fit)) return vs_session_out_of_memory(s);
  *s->fit = (vs_scan_fit){ .parameter_count = 0 };
  job j = {
    .session = s, .vm = vm, .model = model, .f = s->fit, .host = s->options.host, .began = vs_session_clock(s)
  };
  vs_outcome outcome = read_scan(&j, scan, o);
  if (outcome == VS_OUTCOME_DONE) outcome = run(&j);
  if (outcome != VS_OUTCOME_DONE || !take_parameters(&j, o, &numbers, &outcome)) {
    free(numbers);
    return outcome;
  }
  vs_fit_model calls = { &j, make, going, progress };
  vs_fit_problem p = { .model = &calls,
                       .numbers = numbers,
                       .number_count = s->fit->number_count,
                       .points = s->fit->scan.samples,
                       .count = s->fit->scan.sample_count,
                       .placed = o->placed,
                       .near = o->near,
                       .any_pose = o->any_pose,
                       .most = o->points ? o->points : USUAL_POINTS,
                       .confidence = o->confidence > 0 ? o->confidence : .95 };
  hush(&j);
  bool ok = vs_model_fit_solve(&p, &s->fit->fit, &e);
  if (ok && (!take_result(&j, out) || !set_back(&j, true))) ok = vs_error_memory(&e, NULL);
  if (ok) run(&j);
  else set_back(&j, false);
  unhush(&j);
  free(numbers);
  if (!ok) {
    *out = (vs_fit_result){ 0 };
    vs_session_free_fit(s);
    if (j.late) {
      vs_session_report_at(s, VS_SEVERITY_ERROR, VS_OUTCOME_MACHINE, (vs_span){ .file = model },
                           "the limit of time passed before anything was fitted");
      return VS_OUTCOME_MACHINE;
    }
    if (e.kind != VS_ERROR_FILE && e.kind != VS_ERROR_MODEL) return vs_session_report_error(s, &e);
    outcome = e.kind == VS_ERROR_FILE ? VS_OUTCOME_USAGE : VS_OUTCOME_MODEL;
    vs_session_report_at(s, VS_SEVERITY_ERROR, outcome, (vs_span){ .file = e.kind == VS_ERROR_FILE ? scan : model },
                         e.message);
    return outcome;
  }
  return conclude(&j, out);
}

bool vs_fit_parameter_get(const vs_scheme *vm, size_t index, vs_fit_parameter *out) {
  const vs_scan_fit *f = vs_session_of(vm)->fit;
  if (!f || index >= f->parameter_count) return false;
  const fitted *p = &f->parameters[index];
  *out = (vs_fit_parameter){ p->name, p->state, p->start, p->value, p->error, p->low, p->high };
  return true;
}

const double *vs_fit_distances(const vs_scheme *vm, size_t *count) {
  const vs_scan_fit *f = vs_session_of(vm)->fit;
  *count = f && f->distances ? f->scan.file.point_count : 0;
  return f ? f->distances : NULL;
}

/* ---- the picture of distances ---- */

static int compare_sizes(const void *p, const void *q) {
  double a = *(const double *)p, b = *(const double *)q;
  return a < b ? -1 : a > b;
}

/* Returns the distance that 98 percent of the points do not exceed, rounded up to 1, 2 or 5 times a power of ten.
 * Returns 0 when memory is out. */
static double usual_range(const vs_scan_fit *f) {
  double *sizes = NULL, range;
  size_t room = 0, count = 0;
  if (!VS_GROW(sizes, room, f->scan.file.point_count + 1)) return 0;
  for (size_t i = 0; i < f->scan.file.point_count; i++)
    if (isfinite(f->distances[i])) sizes[count++] = fabs(f->distances[i]);
  qsort(sizes, count, sizeof *sizes, compare_sizes);
  range = count ? sizes[(count - 1) * 98 / 100] : 0;
  free(sizes);
  if (!(range > 1e-12)) return 1e-12;
  double power = pow(10, floor(log10(range)));
  return range <= power ? power : range <= 2 * power ? 2 * power : range <= 5 * power ? 5 * power : 10 * power;
}

static bool write_file(void *context, const char *text, size_t length) {
  int file = *(int *)context;
  while (length) {
    ssize_t n = write(file, text, length);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    text += n, length -= (size_t)n;
  }
  return true;
}

static vs_outcome file_failed(vs_session *s, const char *path, const char *why) {
  vs_session_report_at(s, VS_SEVERITY_ERROR, VS_OUTCOME_USAGE, (vs_span){ .file = path }, why);
  return VS_OUTCOME_USAGE;
}

vs_outcome vs_fit_map(vs_scheme *vm, const char *path, double range, double *used) {
  vs_session *s = vs_session_of(vm);
  const vs_scan_fit *f = s->fit;
  const vs_format_info *format = vs_format_find(path);
  vs_publish file;
  bool ply = format && !strcmp(format->suffix, "ply"), x3d = format && !strcmp(format->suffix, "x3d");
  *used = 0;
  if (!f || !f->distances) return file_failed(s, path, "there is no fit whose distances could be mapped");
  if (!ply && !x3d) return file_failed(s, path, "a map of distances must end in .ply or .x3d");
  if (!(range > 0)) range = usual_range(f);
  if (!(range > 0)) return vs_session_out_of_memory(s);
  vs_distance_map map = { &f->scan.file, f->distances, range, s->bind.scene.units };
  if (vs_known_files_read(&s->inputs, path)) return file_failed(s, path, VS_INPUT_KEPT);
  if (!vs_publish_begin(&file, path, false)) return file_failed(s, path, strerror(errno));
  bool ok = ply ? vs_distance_map_ply(&map, write_file, &file.file) : vs_distance_map_x3d(&map, write_file, &file.file);
  int problem = ok ? 0 : errno;
  if (!vs_publish_end(&file, ok) && !problem) problem = errno;
  if (problem) return file_failed(s, path, strerror(problem));
  *used = range;
  return VS_OUTCOME_DONE;
}
