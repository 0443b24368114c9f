/* Implements the stages of stages.def, through which a drawing becomes one output.
 *
 *   text → data           the reader            vm/front/reader.c
 *   data → core tree      the expander          vm/front/expand.c
 *   core tree → bytecode  the compiler          vm/compiler/compile.c
 *   bytecode → tree       the run loop          vm/machine/run.c, bind/
 *   tree → tree           the stages below      passes/, solids/resolve.c
 *   tree → meshes         where a format needs  solids/solid_meshes.c, kernel/evaluate.c
 *   tree → file           the last stage        backends/export.c, backends/driver.c
 *
 * vs_eval_text and vs_eval_file (visualscheme.c) perform the first four steps for each form. This file performs all
 * others, in this order. */
#include "bind/back_ends.h"
#include "bind/call/precision.h"
#include "bind/custom.h"
#include "bind/objects.h"
#include "bind/scene/node_natives.h"
#include "bind/state.h"
#include "session/advice.h"
#include "session/spine.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "backends/backend.h"
#include "geometry/measure/node_measures.h"
#include "passes/cut_away.h"
#include "passes/flush.h"
#include "passes/ink.h"
#include "passes/lay.h"
#include "passes/looks.h"
#include "passes/optimise.h"
#include "passes/sugar.h"
#include "session/drawing/comparison.h"
#include "session/evaluation.h"
#include "session/host.h"
#include "session/light/pictures.h"
#include "session/report.h"
#include "session/statistics.h"
#include "model/standard_views.h"
#include "solids/drawn_bounds.h"
#include "solids/endless_lines.h"
#include "solids/named_parts.h"
#include "solids/resolve.h"

/* An output that is being made, or a drawing that is being measured. */
typedef struct {
  vs_session *session;
  vs_job job;                    /* limits, progress and messages of the output, passed to all functions below; the
                                  * store refers to this member until the output ends */
  const vs_format *format;       /* format of the output; NULL: the drawing is only measured */
  const vs_output_options *options;
  const char *path;              /* path of the output; NULL: the output goes to the sink `to` */
  vs_byte_sink *to;
  vs_scene scene;                /* the scene that is written: a copy of the drawing's scene with its own array of
                                  * references */
  vs_export_options export;
  vs_output_record *record;      /* times and counts of the output; NULL: there is no output */
  vs_error error;                /* error of a failed stage, which is reported at the end; not used if `outcome` is
                                  * set */
  vs_outcome outcome;            /* outcome of a failure that a stage has already reported */
  char *text;                    /* text that a back-end of the program has written, and its length in bytes; NULL:
                                  * there is none */
  size_t text_bytes;
  bool names;                    /* whether the drawing is divided into parts without an output */
  double told;                   /* clock in seconds when progress was last reported to the host */
  vs_origin warned;              /* place of the last warning; line 0: there was none with a place */
  char warning[200];             /* beginning of its text */
} writing;

/* ---- callbacks for interrupts, progress and warnings ---- */

/* Returns true if the last warning had the same place and text, as for each brick of a list. Remembers the warning. */
static bool warned_before(writing *j, const vs_origin *at, const char *message) {
  const bool same = at && j->warned.line && j->warned.file == at->file && j->warned.line == at->line &&
                    j->warned.column == at->column && strncmp(j->warning, message, sizeof j->warning - 1) == 0;
  j->warned = at ? *at : (vs_origin){ 0 };
  snprintf(j->warning, sizeof j->warning, "%s", message);
  return same;
}

static void job_warn(void *output, const vs_origin *origin, const char *message) {
  if (warned_before(output, origin, message)) return;
  vs_session_warn(((writing *)output)->session, origin, message);
}

static void job_note(void *output, const char *message) {
  const writing *j = output;
  vs_session_report_at(j->session, VS_SEVERITY_NOTE, VS_OUTCOME_DONE, (vs_span){ .file = j->path }, message);
}

/* Reports the progress of the output to the host, at most ten times a second. Returns false if the host interrupts. */
static bool job_going(void *output, const char *stage, double fraction) {
  writing *j = output;
  const vs_host *h = &j->session->options.host;
  double now = stage ? vs_clock() : 0;
  if (h->progress && stage && now - j->told > .1) {
    j->told = now;
    h->progress(h->context, &(vs_progress){ .phase = stage, .subject = j->path, .fraction = fraction });
  }
  return !vs_session_interrupted(j->session);
}

/* Begins the output: passes its job (limits, progress and messages) to the store. */
static void begin(writing *j) {
  vs_session *s = j->session;
  j->job = (vs_job){ .going = job_going, .warn = job_warn, .note = job_note, .context = j, .tally = &s->tally };
  j->told = vs_clock();
  vs_store_set_job(s->bind.store, &j->job);
  vs_tally_enter(&s->tally, VS_WORK_PASSES);
}

/* ---- options of the output ---- */

void vs_session_aim(const vs_output_options *o, vs_scene *scene) {
  vs_scene_style style = o->look ? vs_scene_style_find(o->look) : VS_STYLE_OWN;
  if (style != VS_STYLE_OWN) vs_scene_set_style(scene, style);
  if (o->has_sun) scene->has_sun = true, scene->sun_azimuth = o->sun[0], scene->sun_altitude = o->sun[1];
  if (!o->has_camera) return;
  scene->view = VS_VIEW_CAMERA, scene->upright = false, scene->aperture = 0;
  scene->eye = vs_v3(o->camera[0], o->camera[1], o->camera[2]);
  scene->target = vs_v3(o->camera[3], o->camera[4], o->camera[5]);
  scene->lens = o->camera[6] > 0 ? o->camera[6] : 35;
}

void vs_session_size(const vs_output_options *o, vs_export_options *e) {
  e->width = o->width, e->height = o->height;
  if (e->width && !e->height) e->height = (e->width * 3 + 2) / 4;
  if (e->height && !e->width) e->width = (e->height * 4 + 1) / 3;
  if (!e->width) e->width = 1024, e->height = 768;
}

/* Computes the options of the export from the caller's options, the program and the session's limits. */
static void set_options(writing *j) {
  static const vs_render_quality qualities[] = {
    [VS_QUALITY_DRAFT] = VS_RENDER_DRAFT, [VS_QUALITY_GOOD] = VS_RENDER_GOOD, [VS_QUALITY_FINAL] = VS_RENDER_FINAL
  };
  const vs_options *limits = &j->session->options;
  const vs_output_options *o = j->options;
  vs_export_options *e = &j->export;
  vs_export_options_init(e);
  e->job = &j->job;
  e->inputs = &j->session->inputs;
  e->safe = limits->untrusted || limits->limit_time > 0 || limits->limit_memory || limits->limit_steps ||
            limits->limit_output;
  j->job.limits.mesh_triangles = limits->limit_triangles;
  j->job.limits.worker_seconds = limits->limit_worker;
  e->strict = o->strict;
  e->up_y = o->up_y;
  e->units = o->units;
  e->keeps_parts = o->part != NULL;
  if (limits->limit_memory)
    j->job.limits.mesh_bytes = j->session->bytes < limits->limit_memory ? limits->limit_memory - j->session->bytes : 1;
  vs_session_size(o, e);
  memcpy(e->crop, o->crop, sizeof e->crop);
  e->threads = o->threads;
  e->quality = qualities[o->quality];
  e->tone = vs_session_tone(&o->development);
  e->layers = o->layers;
  e->view = o->view;
  vs_scene *scene = &j->scene;
  if (o->tolerance > 0) scene->tolerance = o->tolerance;
  if (o->segments > 0) scene->segments = o->segments;
  else if (o->least_segments > 0 && !scene->segments) scene->segments = -o->least_segments;
  vs_session_aim(o, scene);
}

/* ---- stages: a stage that fails returns false, and sets the error, or the outcome if it has already reported the
 * failure ---- */

/* Computes the objects that the tree of scene nodes shows, as a separate evaluation. If the drawing belongs to a node
 * that is not the root, sets *beside to false; `objects` then include the root's objects. */
static bool show_nodes(writing *j, bool *beside, vs_value *objects) {
  vs_session *s = j->session;
  if (!vs_nodes_are_there(&s->bind)) return true;
  vs_session_begin(s, 0);
  bool ok = vs_nodes_shown(&s->bind, beside, objects);
  s->phase = NULL;
  vs_tally_enter(&s->tally, VS_WORK_PASSES);
  if (!ok) j->outcome = vs_session_report_condition(s, s->bind.vm->condition, false);
  return ok;
}

enum { COLLECT_WORK = 128 }; /* work for an object that is collected, in the units of vs_store_going: a cache miss */

/* Copies the drawing's references to the scene. First collects garbage: otherwise a node to which an unused value
 * refers would seem to be shared. Later stages replace the copied references. */
static bool stage_collect(writing *j) {
  vs_session *s = j->session;
  bool beside = true, change = j->options && j->options->change;
  VS_ROOTS(s->bind.vm, shown, 1);
  shown[0] = VS_NIL;
  vs_scene *scene = &j->scene;
  *scene = s->bind.scene;
  scene->drawn = NULL, scene->drawn_count = scene->drawn_room = 0;
  if (change) scene->fault_count = 0;
  if (!change && !show_nodes(j, &beside, &shown[0])) return false;
  bool returned = !change && vs_bind_finish(&s->bind);
  scene->tolerance = vs_bind_tolerance(s->bind.vm);
  const vs_ref *drawn = change ? s->change : s->bind.scene.drawn;
  size_t n = change ? s->change_count : returned ? s->bind.returned_count : beside ? s->bind.scene.drawn_count : 0;
  scene->drawn = vs_store_realloc(s->bind.store, NULL, 0, (n + 1) * sizeof *scene->drawn);
  if (!scene->drawn) return vs_error_memory(&j->error, NULL);
  scene->drawn_room = n + 1;
  for (size_t i = 0; i < n; i++) {
    if (!vs_store_going(s->bind.store, COLLECT_WORK, &j->error)) return false;
    scene->drawn[i] = returned ? (vs_ref){ s->bind.returned[i].node, s->bind.returned[i].origin } : drawn[i];
    vs_node_retain(scene->drawn[i].node);
    scene->drawn_count = i + 1;
  }
  for (; vs_is_pair(shown[0]); shown[0] = vs_cdr(shown[0]))
    if (!vs_scene_draw(scene, vs_bind_take_ref(vs_car(shown[0])))) return vs_error_memory(&j->error, NULL);
  for (size_t i = 0; change && vs_backend_has(j->format->backend, VS_PARTS_FLUSH) && i < n; i++)
    if (!vs_session_swell(s, i, &scene->drawn[i], &j->error)) return false;
  if (!j->record) return true;
  if (!vs_store_going(s->bind.store, UINT32_MAX, &j->error)) return false;
  vs_tally_enter(&s->tally, VS_WORK_RUN);
  vs_gc_major(s->bind.vm);
  vs_tally_enter(&s->tally, VS_WORK_PASSES);
  set_options(j);
  return true;
}

/* Calls the program's drawing functions as a separate evaluation with its own limits. The time limit of the output
 * begins after these calls. */
static bool stage_hand_over(writing *j) {
  vs_session *s = j->session;
  const vs_format *f = j->format;
  const char *names[4] = { NULL };
  size_t n = 0;
  if (!f) names[n++] = "*"; /* without a format, calls the functions that are registered for all formats ("*"); if there
                             * are none, calls the functions for single formats */
  if (f) names[n++] = f->name, names[n++] = f->suffix;
  if (f && vs_export_family(f)) names[n++] = vs_export_family(f);
  bool handed = j->options && j->options->change; /* handed: whether the output shows a comparison, for whose two
                                                   * drawings the drawing functions were already called */
  if (!handed && vs_bind_hands_on(&s->bind)) {
    vs_session_begin(s, 0);
    bool ok = vs_bind_hand_on(&s->bind, j->scene.drawn, j->scene.drawn_count, names);
    s->phase = NULL;
    vs_tally_enter(&s->tally, VS_WORK_PASSES);
    if (!ok) {
      j->outcome = s->bind.handed.kind != VS_ERROR_NONE ? vs_session_report_error(s, &s->bind.handed)
                                                        : vs_session_report_condition(s, s->bind.vm->condition, false);
      return false;
    }
  }
  if (j->record) vs_cache_turn(vs_store_cache(s->bind.store), !j->options->last);
  j->job.limits.seconds = s->options.limit_time;
  vs_job_start(&j->job);
  s->writing = &j->job;
  return true;
}

static bool stage_sugar(writing *j) {
  vs_sugar_options solids_only = { .highlights = VS_MARKS_DROP, .keeps_text = true, .keeps_parts = j->names };
  return j->format ? vs_export_sugar(&j->scene, j->format, &j->export, &j->error)
                   : vs_scene_sugar(&j->scene, &solids_only, &j->error);
}

/* Appends the names of the model's views to the message. */
static void list_views(const vs_scene *scene, char *message, size_t room) {
  size_t used = strlen(message);
  for (size_t i = 0; i < scene->view_count && used + 2 < room; i++) {
    int n = snprintf(message + used, room - used, "%s \"%s\"", i > 0 ? "," : "; its views are", scene->views[i].name);
    used += n > 0 ? (size_t)n : 0;
  }
  const vs_standard_view *row;
  for (size_t i = 0; (row = vs_standard_view_at(i)) != NULL && used + 2 < room; i++) {
    int n = snprintf(message + used, room - used, "%s %s", i > 0 ? "," : "; every model has", row->name);
    used += n > 0 ? (size_t)n : 0;
  }
}

/* Sets *out to the view of this name that every model has. Returns false if there is none, or on failure. */
static bool find_standard(writing *j, const char *name, vs_scene_view *out) {
  vs_scene *scene = &j->scene;
  const vs_standard_view *row;
  size_t i = 0, budget = VS_DRAWN_BOUNDS_MOST;
  vs_fineness facets = { 0 };
  vs_kernel_options options = { .job = &j->job };
  vs_drawn_search search = { .facets = &facets, .options = &options, .budget = &budget };
  vs_bounds b;
  while ((row = vs_standard_view_at(i)) != NULL && strcmp(row->name, name) != 0) i++;
  if (!row || !scene->drawn_count) return false;
  if (!vs_drawn_bounds_all(scene->drawn, scene->drawn_count, &search, &b, &j->error)) return false;
  if (vs_bounds_is_empty(&b) || !isfinite(vs_bounds_diagonal(&b))) return false;
  *out = vs_standard_view_for(row, &b);
  if (out->cut == VS_CUT_OWN) vs_standard_cut_plan(scene, &b, out);
  return true;
}

static bool stage_view(writing *j) {
  vs_scene *scene = &j->scene;
  const char *name = j->record ? j->options->view : NULL;
  /* a format for drawings on sheets chooses the views itself */
  if (!j->format || vs_backend_has(j->format->backend, VS_DRAWS) || (name && !strcmp(name, "*"))) return true;
  const vs_scene_view *view = name ? vs_scene_find_view(scene, name) : j->options->has_camera ? NULL
      : vs_scene_own_view(scene);
  /* in a mesh or a page, the model is cut only by a view that the user requests by name */
  if (!name && (!view || (view->cut == VS_CUT_PLANE && !vs_backend_has(j->format->backend, VS_FRAMES)))) return true;
  vs_scene_view standard;
  if (!view && find_standard(j, name, &standard)) view = &standard;
  if (!view && j->error.kind != VS_ERROR_NONE) return false;
  if (!view) {
    char message[400];
    snprintf(message, sizeof message, "the model has no view \"%.100s\"", name);
    list_views(scene, message, sizeof message);
    return vs_error_set(&j->error, VS_ERROR_FILE, NULL, "%s", message);
  }
  if (!j->options->has_camera) vs_scene_look(scene, view);
  return view->cut != VS_CUT_PLANE || vs_scene_cut(scene, view->cut_point, view->cut_normal, &j->error);
}

static bool stage_resolve(writing *j) {
  return vs_scene_resolve(&j->scene, &(vs_kernel_options){ .job = &j->job, .warns = true }, &j->error);
}

/* Runs the passes. A back-end that the program defines receives the drawing before the passes, unless it requests the
 * optimised drawing. */
static bool stage_optimise(writing *j) {
  const vs_bind_back_end *own =
      j->format->backend == &vs_backend_given ? vs_bind_back_end_find(&j->session->bind, j->format->name) : NULL;
  unsigned passes = own && !own->optimised ? 0 : j->options->passes;
  return (!j->options->count || vs_session_output_nodes(j->session, &j->scene, passes, &j->error)) &&
         vs_scene_optimise(&j->scene, passes, &j->record->passes, &(vs_pass_notes){ job_warn, j }, &j->error);
}

/* Removes all objects but the part with this name from the drawing, for a format that may have no name for it. */
static bool select_part(writing *j, const char *name) {
  vs_scene *scene = &j->scene;
  vs_ref kept = { NULL, NULL };
  for (size_t i = 0; i < scene->drawn_count && !kept.node; i++) {
    const vs_node *n = scene->drawn[i].node;
    if (n->kind != VS_PART || strcmp(VS_AS(part, n)->name, name)) continue;
    kept = vs_backend_has(j->format->backend, VS_NAMES) ? scene->drawn[i] : n->children[0];
    vs_node_retain(kept.node);
  }
  if (!kept.node) return vs_error_set(&j->error, VS_ERROR_FILE, NULL, "the model has no part \"%.100s\"", name);
  for (size_t i = 0; i < scene->drawn_count; i++) vs_node_release(scene->drawn[i].node);
  scene->drawn[0] = kept, scene->drawn_count = 1;
  return true;
}

static bool stage_parts(writing *j) {
  const char *part = j->options ? j->options->part : NULL;
  bool parted = part || (j->format && !vs_backend_has(j->format->backend, VS_DRAWS));
  return vs_scene_parts(&j->scene, parted, &j->error) && (!part || select_part(j, part));
}

static bool stage_looks(writing *j) { return vs_scene_looks(&j->scene, &j->error); }

static bool stage_ink(writing *j) { return vs_scene_ink(&j->scene, &j->error); }

static bool stage_lay(writing *j) { return vs_scene_lay(&j->scene, &j->error); }

static bool stage_flush(writing *j) { return vs_scene_part_flush(&j->scene, &j->error); }

static bool stage_group(writing *j) { return vs_scene_group(&j->scene, &j->error); }

/* Calls the back-end that the program defines, as a separate evaluation. */
static bool stage_defined(writing *j) {
  vs_session *s = j->session;
  vs_session_begin(s, 0);
  bool ok =
      vs_bind_back_end_write(&s->bind, j->format->name, j->scene.drawn, j->scene.drawn_count, &j->text, &j->text_bytes);
  s->phase = NULL;
  vs_tally_enter(&s->tally, VS_WORK_PASSES);
  j->export.given = j->text, j->export.given_size = j->text_bytes;
  if (!ok) j->outcome = vs_session_report_condition(s, s->bind.vm->condition, false);
  return ok;
}

static bool write_bytes(void *sink, const void *bytes, size_t count) {
  const vs_byte_sink *to = sink;
  return to->write(to->context, bytes, count);
}

static bool stage_write(writing *j) {
  vs_tally_enter(&j->session->tally, VS_WORK_EMIT);
  vs_scene scene = j->scene;
  /* if the program's back-end has written the whole text, no objects remain to be written */
  if (j->format->backend == &vs_backend_given) scene.drawn = NULL, scene.drawn_count = scene.drawn_room = 0;
  return j->to ? vs_export_to(&scene, j->format, write_bytes, j->to, &j->export, &j->error)
               : vs_export(&scene, j->format, j->path, &j->export, &j->error);
}

/* ---- the table of the stages, and their order ---- */

/* Returns true if the format shows the drawing's tree without any changes by passes. */
static bool shows_tree(const vs_backend *b) { return vs_backend_has(b, VS_VERBATIM) && b != &vs_backend_given; }

static bool runs_for(vs_stage stage, const vs_backend *b) {
  switch (stage) {
#define VS_STAGE(upper, lower, when, formats, doc) case VS_STAGE_##upper: return when;
#include "session/stages.def"
  case VS_STAGE_COUNT: break;
  }
  return false;
}

/* Returns the seconds of work in all phases since the session began. */
static double worked(vs_session *s) {
  double sum = 0;
  vs_work_phase was = vs_tally_enter(&s->tally, VS_WORK_NONE);
  for (int i = 0; i < VS_WORK_NONE; i++) sum += s->tally.of[i].seconds;
  vs_tally_enter(&s->tally, was);
  return sum;
}

static bool go_through(writing *j, vs_stage last) {
  static bool (*const stages[])(writing *) = {
#define VS_STAGE(upper, lower, when, formats, doc) stage_##lower,
#include "session/stages.def"
  };
  static const vs_backend none = { .native = NULL };
  vs_session *s = j->session;
  bool ok = true;
  for (int k = 0; ok && k <= (int)last; k++) {
    if (!runs_for((vs_stage)k, j->format ? j->format->backend : &none)) continue;
    double before = worked(s);
    ok = vs_store_going(s->bind.store, UINT32_MAX, &j->error) && stages[k](j);
    if (j->record) j->record->stages[k] = worked(s) - before;
  }
  return ok;
}

/* Reports the error that the program draws nothing. Lists the procedures that the program defines and never calls.
 * Returns false when memory is out. */
static bool report_nothing(vs_session *s, const char *message) {
  vs_text why;
  vs_text_open(s->bind.vm, &why, 0);
  bool told = vs_text_puts(&why, message) && vs_session_advise_empty(s, &why) && vs_text_end(&why);
  if (told) vs_session_report(s, VS_SEVERITY_ERROR, VS_OUTCOME_MODEL, NULL, why.at);
  vs_text_close(&why);
  return told;
}

/* Returns the place of the call that made the deepest drawn object, or NULL if no object has a place. It becomes the
 * place of an error of a limit that has none. */
static const vs_origin *deepest_drawn(const vs_scene *scene) {
  const vs_ref *deepest = NULL;
  for (size_t i = 0; i < scene->drawn_count; i++) {
    const vs_ref *r = &scene->drawn[i];
    if (r->origin && (!deepest || r->node->depth > deepest->node->depth)) deepest = r;
  }
  return deepest ? deepest->origin : NULL;
}

/* Ends the output: releases the references, reports the error of a failed stage, and returns the outcome. */
static vs_outcome end_writing(writing *j, bool ok) {
  vs_session *s = j->session;
  bool stopped = s->writing && s->writing->late && j->error.kind == VS_ERROR_INTERRUPT;
  s->writing = NULL;
  vs_store_set_job(s->bind.store, &s->job);
  bool nothing = !ok && j->scene.drawn_count == 0 && j->error.kind == VS_ERROR_MODEL && !strcmp(j->error.message,
      "nothing is drawn");
  if (!j->error.origin && (j->error.kind == VS_ERROR_MEMORY || j->error.kind == VS_ERROR_LIMIT))
    j->error.origin = deepest_drawn(&j->scene);
  for (size_t i = 0; i < j->scene.drawn_count; i++) vs_node_release(j->scene.drawn[i].node);
  vs_store_realloc(s->bind.store, j->scene.drawn, j->scene.drawn_room * sizeof *j->scene.drawn, 0);
  if (j->text) vs_mem(s->bind.vm, j->text, j->text_bytes + 1, 0);
  if (ok) return VS_OUTCOME_DONE;
  if (j->outcome != VS_OUTCOME_DONE) return j->outcome;
  if (nothing && report_nothing(s, j->error.message)) return VS_OUTCOME_MODEL;
  if (stopped)
    vs_error_set(&j->error, VS_ERROR_LIMIT, NULL, "the output: stopped after %g seconds, the limit",
                 s->options.limit_time);
  return vs_session_report_error(s, &j->error);
}

vs_outcome vs_session_write(vs_session *s, const char *path, const vs_format *format, const vs_output_options *options,
                            vs_byte_sink *to) {
  if (!vs_session_output_begin(s, path, format->name)) return vs_session_out_of_memory(s);
  writing j = { .session = s,
               .format = format,
               .options = options,
               .path = path,
               .to = to,
               .record = &s->outputs[s->output_count - 1] };
  begin(&j);
  vs_outcome outcome = end_writing(&j, go_through(&j, VS_STAGE_WRITE));
  vs_session_output_end(s, outcome == VS_OUTCOME_DONE);
  return outcome;
}

/* ---- measuring the drawing without an output ---- */

static bool summarise(vs_job *job, const vs_scene *scene, vs_summary *out, vs_error *e) {
  vs_bounds all;
  vs_bind_counts sum = { 0 }, c;
  vs_fineness facets = { .tolerance = scene->tolerance, .segments = scene->segments };
  vs_kernel_options options = { .job = job };
  for (size_t i = 0; i < scene->drawn_count; i++) {
    if (!vs_bind_count(scene->drawn[i], &c, e)) return false;
    sum.all += c.all;
    for (int k = 0; k < VS_INHERIT; k++) sum.of[k] += c.of[k];
  }
  size_t budget = VS_DRAWN_BOUNDS_MOST;
  vs_drawn_search search = { .facets = &facets, .options = &options, .budget = &budget };
  if (!vs_drawn_bounds_all(scene->drawn, scene->drawn_count, &search, &all, e)) return false;
  out->bounds_at_most = out->bounds_at_most || search.at_most;
  out->objects = (size_t)sum.all;
  out->solids = (size_t)sum.of[VS_SOLID], out->surfaces = (size_t)sum.of[VS_SURFACE];
  out->regions = (size_t)sum.of[VS_REGION_CLASS], out->curves = (size_t)sum.of[VS_CURVE];
  out->has_bounds = !vs_bounds_is_empty(&all);
  const double least[] = { all.min.x, all.min.y, all.min.z }, most[] = { all.max.x, all.max.y, all.max.z };
  for (int i = 0; out->has_bounds && i < 3; i++) out->min[i] = least[i], out->max[i] = most[i];
  return true;
}

vs_outcome vs_session_summary(vs_session *s, vs_summary *out) {
  writing j = { .session = s };
  *out = (vs_summary){ .units = s->bind.scene.units };
  begin(&j);
  vs_outcome outcome = end_writing(&j, go_through(&j, VS_STAGE_RESOLVE) && summarise(&j.job, &j.scene, out, &j.error));
  vs_tally_enter(&s->tally, VS_WORK_NONE);
  if (outcome == VS_OUTCOME_DONE && out->objects == 0) {
    vs_text why;
    vs_text_open(s->bind.vm, &why, 0);
    if (vs_session_advise_empty(s, &why) && vs_text_end(&why) && why.count > 2 && *why.at == ':') out->advice =
        vs_store_text(s->bind.store, why.at + 2, why.count - 2);
    vs_text_close(&why);
  }
  return outcome;
}

vs_outcome vs_session_parts(vs_session *s, const char **names, size_t room, size_t *count) {
  writing j = { .session = s, .names = true };
  size_t found = 0;
  begin(&j);
  bool ok = go_through(&j, VS_STAGE_PARTS);
  for (size_t i = 0; ok && i < j.scene.drawn_count; i++) {
    const vs_node *n = j.scene.drawn[i].node;
    if (n->kind != VS_PART) continue;
    if (found < room) names[found] = VS_AS(part, n)->name;
    found++;
  }
  vs_outcome outcome = end_writing(&j, ok);
  vs_tally_enter(&s->tally, VS_WORK_NONE);
  *count = found;
  return outcome;
}

vs_outcome vs_session_take(vs_session *s, vs_ref **out, size_t *count) {
  writing j = { .session = s };
  *out = NULL, *count = 0;
  begin(&j);
  bool ok = go_through(&j, VS_STAGE_RESOLVE);
  size_t n = j.scene.drawn_count;
  vs_ref *refs = ok ? vs_store_realloc(s->bind.store, NULL, 0, (n + 1) * sizeof *refs) : NULL;
  if (ok && !refs) ok = vs_error_memory(&j.error, NULL);
  for (size_t i = 0; ok && i < n; i++) refs[i] = j.scene.drawn[i], vs_node_retain(refs[i].node);
  vs_outcome outcome = end_writing(&j, ok);
  vs_tally_enter(&s->tally, VS_WORK_NONE);
  if (ok) *out = refs, *count = n;
  return outcome;
}

void vs_session_give_back(vs_session *s, vs_ref *refs, size_t count) {
  for (size_t i = 0; i < count; i++) vs_node_release(refs[i].node);
  if (refs) vs_store_realloc(s->bind.store, refs, (count + 1) * sizeof *refs, 0);
}

void vs_output_options_init(vs_output_options *o, size_t size) {
  const vs_output_options usual = { .size = sizeof usual, .quality = VS_QUALITY_GOOD, .passes = VS_PASSES_ALL };
  vs_session_give_options(o, size, &usual, sizeof usual);
}
