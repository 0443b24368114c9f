/* Implements the session of the live view: the interpreter, the time of its next run, and the publication of its
 * results.
 *
 * Only the calling thread uses the interpreter. It sleeps until a file changes or a window sends a request. A single
 * run handles all requests that have arrived. A run that fails changes the state and its messages, and keeps the last
 * good scene. */
#include "live/live.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "live/aside.h"
#include "live/model_files.h"
#include "live/open_browser.h"
#include "live/said.h"
#include "live/scene_host.h"
#include "live/serve.h"

/* Times in milliseconds. LOOK_MS: time between two checks of the model's files while a window is open. LOOK_ALONE_MS:
 * time between two checks while no window is open. FRAME_MS: duration of a frame of an animated scene. */
enum { LOOK_MS = 8, LOOK_ALONE_MS = 40, FRAME_MS = 40 };
enum { COARSE_SEGMENTS = 12 };

typedef struct live_follower {
  const live_options *options;
  live_options own;    /* the view's own copy of the options, which it changes if it follows a prompt or is confined */
  bool follows;        /* whether the view follows a prompt, so that the interpreter belongs to the caller */
  live_publish publish;
  live_server server;
  vs_scheme *scheme;
  live_files files;
  live_aside aside, exporter; /* aside: makes outputs with other values. exporter: exports the current model */
  live_text released;  /* text with a byte for each parameter that the options set: 1 after a window has set the same
                        * parameter */
  bool coarse;         /* whether a slider is moving; round shapes are then coarse, unless the options set a
                        * tolerance */
  bool frames;         /* whether the scene changes with time, so that the session computes frames */
  double last_frame;   /* time of the last frame in seconds */
  bool good;           /* whether the published scene is the result of the model's last run */
  const char *asked;   /* text typed at the prompt, while the result of that text is published; otherwise NULL */
  bool prompted;       /* whether the prompt has run code since the model's last run, so that the drawing may differ
                        * from the result of the model's text */
  live_said said;      /* messages of the current run */
  bool busy_told;
  bool trial;          /* whether the last run of the model used an unsaved text from a window */
  double began;
  unsigned version, run; /* version: number of the latest published scene; run: number of the latest run */
  bool kept;           /* whether a client waits for the output that is being made. Only a saved file or the window's
                        * Stop button then ends the work. */
  bool moved;          /* whether frames or actions of the user have changed the scene since the model's last run */
  bool overtaken;      /* whether the current run was interrupted because a newer request or a changed file requires
                        * another run */
  bool ended_early;    /* whether a window's request interrupted the last run */
  double looked;       /* looked: clock in seconds at the last check for a newer request. whole: seconds of the last run
                        * that was not interrupted */
  double whole;
} live;

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* ---- callbacks of the interpreter ---- */

static const double FRAME_MOST = 0.25; /* greatest time in seconds by which one frame advances the scene, even if the
                                        * frame is late */

static bool host_output(void *context, const char *text, size_t length) {
  live *l = context;
  live_tail_add(&l->said.printed, text, length);
  return true;
}

static void host_value(void *context, const char *text, size_t length) {
  live *l = context;
  live_said_value(&l->said, text, length);
}

static void host_diagnose(void *context, const vs_diagnostic *d) {
  live *l = context;
  live_said_diagnose(&l->said, d);
}

static void host_progress(void *context, const vs_progress *p) {
  live *l = context;
  if (now() - l->began < 0.15) return;
  live_text t = { 0 };
  live_puts(&t, "{\"phase\":");
  live_json(&t, p->phase);
  live_puts(&t, ",\"fraction\":");
  live_number(&t, p->fraction);
  live_puts(&t, "}");
  if (!t.failed) live_tell(&l->publish, "busy", t.at);
  l->busy_told = true;
  live_text_free(&t);
}

/* Returns the seconds that a run may take before a window's new value or text interrupts it. While a slider moves, a
 * run that will probably end soon may finish, so that the window shows pictures. Of two successive runs at least one
 * finishes. */
static double patience(const live *l) {
  const double least = 0.3, most = l->ended_early ? 3 : 1, likely = 2 * l->whole;
  return likely < least ? least : likely < most ? likely : most;
}

/* Returns true if a request is newer than the current run. The saving of a file counts immediately. */
static bool overtaken(live *l) {
  double time = now();
  if (1e3 * (time - l->looked) < LOOK_MS) return false;
  l->looked = time;
  if (live_files_newer(&l->files)) return true;
  if (l->kept) return false;
  if (time - l->began <= patience(l) || !live_wish_renews(&l->publish)) return false;
  return l->ended_early = true;
}

static bool host_poll(void *context) {
  live *l = context;
  if (*l->options->ended != 0) return true;
  return l->overtaken = l->overtaken || overtaken(l);
}

static bool host_read(void *context, const char *path, char **text, size_t *length, const char **why) {
  live *l = context;
  live_files_note(&l->files, path);
  return live_model_read(&l->publish, l->options, path, text, length, why);
}

static bool host_list(void *context, const char *path, bool (*take)(void *to, const char *name, size_t length),
                      void *to, const char **why) {
  return live_options_list(((const live *)context)->options, path, take, to, why);
}

/* Called for the Stop button: interrupts the current run, or the run that is about to begin. If the session is idle,
 * does nothing, so that the next run is not interrupted. A view that follows a prompt clears the request when the next
 * run begins. */
static void stop(void *context) {
  live *l = context;
  pthread_mutex_lock(&l->publish.lock);
  if (l->follows || l->publish.working || l->publish.wishes.count > 0) vs_interrupt(l->scheme);
  pthread_mutex_unlock(&l->publish.lock);
}

/* Records that the session is idle. Until the session takes a request or calls `work`, the Stop button has no
 * effect. */
static void rest(live *l) {
  pthread_mutex_lock(&l->publish.lock);
  l->publish.working = l->publish.wishes.count > 0;
  if (!l->publish.working) vs_interrupt_clear(l->scheme);
  pthread_mutex_unlock(&l->publish.lock);
}

static void work(live *l) {
  pthread_mutex_lock(&l->publish.lock);
  l->publish.working = true;
  pthread_mutex_unlock(&l->publish.lock);
}

/* ---- publishing ---- */

static void add_parameters(live *l, live_text *t) {
  static const char *const types[] = { "boolean", "integer", "real", "string", "datum" };
  size_t count = vs_parameter_count(l->scheme);
  vs_parameter_info p;
  live_puts(t, "[");
  for (size_t i = 0; i < count && vs_parameter_get(l->scheme, i, &p); i++) {
    live_puts(t, i > 0 ? ",{\"name\":" : "{\"name\":");
    live_json(t, p.name);
    live_puts(t, ",\"label\":");
    live_json(t, p.label);
    live_puts(t, ",\"group\":");
    live_json(t, p.group);
    live_puts(t, ",\"unit\":");
    live_json(t, p.unit);
    live_putf(t, ",\"type\":\"%s\",\"value\":", types[p.type]);
    live_json(t, p.value);
    live_puts(t, ",\"default\":");
    live_json(t, p.default_value);
    if (p.has_range) {
      live_puts(t, ",\"min\":");
      live_number(t, p.min);
      live_puts(t, ",\"max\":");
      live_number(t, p.max);
      live_puts(t, ",\"step\":");
      live_number(t, p.step);
    }
    if (p.choices != NULL) {
      live_puts(t, ",\"choices\":[");
      for (size_t k = 0; k < p.choice_count; k++) {
        if (k > 0) live_puts(t, ",");
        live_json(t, p.choices[k]);
      }
      live_puts(t, "]");
    }
    live_puts(t, ",\"at\":");
    live_json_place(t, &p.at);
    live_puts(t, "}");
  }
  live_puts(t, "]");
}

static void publish_state(live *l, bool good, vs_outcome outcome) {
  live_text t = { 0 };
  const char *const yes[] = { "false", "true" };
  live_putf(&t, "{\"version\":%u,\"run\":%u,\"good\":%s,\"stopped\":%s,", l->version, l->run, yes[good],
            yes[outcome == VS_OUTCOME_INTERRUPTED]);
  live_putf(&t, "\"prompted\":%s,\"follows\":%s,\"trial\":%s,\"reads\":%s,\"seconds\":", yes[l->prompted],
            yes[l->follows], yes[l->trial], yes[l->options->read_only]);
  live_number(&t, now() - l->began);
  if (l->files.count > 0) { /* the state contains a hash of the model's file as it was read; when the hash changes, a
                             * window reads the source again */
    const live_file *f = &l->files.at[0];
    live_putf(&t, ",\"file\":\"%lld.%ld.%lld.%llu\"", (long long)f->seconds, (long)f->nanoseconds, (long long)f->size,
              (unsigned long long)f->inode);
  }
  live_puts(&t, ",\"files\":[");
  for (size_t i = 0; i < l->files.count; i++) {
    if (i > 0) live_puts(&t, ",");
    live_json(&t, l->files.at[i].path);
  }
  live_puts(&t, "],\"model\":");
  live_json(&t, l->follows ? "prompt" : l->options->model);
  live_puts(&t, ",");
  live_said_write(&l->said, &t);
  live_puts(&t, ",\"asked\":");
  live_json(&t, l->asked != NULL ? l->asked : "");
  live_puts(&t, ",\"parameters\":");
  add_parameters(l, &t);
  live_puts(&t, ",\"scene\":");
  l->frames = live_scene_needs(l->scheme, &t) && good;
  live_puts(&t, "}");
  if (t.failed) live_text_free(&t);
  else live_publish_state(&l->publish, t.at);
}

static bool scene_bytes(void *context, const void *bytes, size_t count) {
  live_text *t = context;
  live_add(t, bytes, count);
  return !t->failed;
}

/* Publishes the current drawing as the next version of the scene. If `another` is true, does so only if the drawing
 * differs from the last version. */
static vs_outcome publish_drawing(live *l, bool another) {
  live_text bytes = { 0 };
  vs_summary summary;
  vs_output_options o = l->options->output;
  if (l->coarse && o.tolerance == 0 && o.segments == 0) o.segments = COARSE_SEGMENTS;
  vs_outcome outcome = vs_drawing_summary(l->scheme, &summary);
  if (outcome == VS_OUTCOME_DONE && summary.objects > 0)
    outcome = vs_write_drawing_to(l->scheme, "x3d-packed", &o, scene_bytes, &bytes);
  live_scene *last = (another || l->follows) && outcome == VS_OUTCOME_DONE ? live_scene_take(&l->publish) : NULL;
  bool same = last != NULL && last->count == bytes.length &&
              (bytes.length == 0 || memcmp(last->bytes, bytes.at, bytes.length) == 0);
  if (last != NULL) live_scene_release(&l->publish, last);
  if (same) {
    live_text_free(&bytes);
    return VS_OUTCOME_DONE;
  }
  live_scene *scene = outcome == VS_OUTCOME_DONE ? calloc(1, sizeof *scene) : NULL;
  if (scene == NULL || !live_chunks_cut((const unsigned char *)bytes.at, bytes.length, &scene->chunks) ||
      !live_chunks_sorted(&scene->chunks, &scene->sorted)) {
    if (scene != NULL) {
      live_chunks_free(&scene->chunks);
      outcome = VS_OUTCOME_MACHINE;
    }
    free(scene);
    live_text_free(&bytes);
    return outcome;
  }
  scene->uses = 1;
  scene->version = ++l->version;
  scene->bytes = (unsigned char *)bytes.at;
  scene->count = bytes.length;
  live_publish_scene(&l->publish, scene);
  return VS_OUTCOME_DONE;
}

/* ---- running ---- */

static void begin(live *l) {
  if (l->follows) vs_interrupt_clear(l->scheme);
  live_said_begin(&l->said);
  l->busy_told = l->overtaken = false;
  l->run++;
  l->began = now();
}

/* Reports the result of a run. Does not report a run that was interrupted because another run follows immediately. */
static void finish(live *l, vs_outcome outcome) {
  if (outcome == VS_OUTCOME_DONE) outcome = publish_drawing(l, false);
  if (l->overtaken && outcome == VS_OUTCOME_INTERRUPTED) {
    vs_interrupt_clear(l->scheme);
    return;
  }
  l->good = outcome == VS_OUTCOME_DONE;
  publish_state(l, l->good, outcome);
  vs_interrupt_clear(l->scheme);
}

/* Returns the index, counted from 1, of the option that sets the parameter `name`, or 0 if no option sets it. */
static size_t option_of(const live *l, const char *name) {
  size_t length = strlen(name);
  for (size_t i = l->options->parameter_count; i > 0; i--)
    if (strncmp(l->options->parameters[i - 1], name, length) == 0 && l->options->parameters[i - 1][length] == '=')
      return i;
  return 0;
}

/* Returns true if a and b are the same text, or the same number (6 and 6.0). */
static bool same_value(const char *a, const char *b) {
  char *a_end, *b_end;
  double x = strtod(a, &a_end), y = strtod(b, &b_end);
  return strcmp(a, b) == 0 || (a_end != a && *a_end == 0 && b_end != b && *b_end == 0 && x - y == 0);
}

/* Removes set values that equal the values in the source, so that these parameters follow changes of the source. Values
 * from the command line remain until a window sets the parameter. */
static void forget_defaults(live *l) {
  vs_parameter_info p;
  for (size_t i = 0; i < vs_parameter_count(l->scheme) && vs_parameter_get(l->scheme, i, &p); i++) {
    size_t option = option_of(l, p.name);
    if (same_value(p.value, p.default_value) && (option == 0 || l->released.at[option - 1] != 0))
      vs_parameter_unset(l->scheme, p.name);
  }
}

static bool set_parameter(live *l, const char *name, const char *value) {
  size_t option = option_of(l, name);
  if (option > 0) l->released.at[option - 1] = 1;
  return vs_parameter_set(l->scheme, name, value);
}

static vs_outcome run_files(live *l) {
  begin(l);
  if (live_files_newer(&l->files)) live_trial_put(&l->publish, NULL); /* the file was saved since the last check: its
                                                                       * text replaces the unsaved text from a window */
  live_files_clear(&l->files);
  live_files_note(&l->files, l->options->model);
  l->prompted = l->moved = false;
  vs_outcome outcome = vs_restart(l->scheme);
  l->trial = live_trial_is(&l->publish);
  return outcome == VS_OUTCOME_DONE ? vs_eval_file(l->scheme, l->options->model, l->trial ? VS_EVAL_TRY : 0) : outcome;
}

/* Runs the model. Many editors empty a file before they write it, so a file that changed while it was read may be
 * incomplete. The session then reads it again before it shows a result, unless the first read took long: then the file
 * was probably saved twice. */
static void run_model(live *l) {
  enum { TIMES = 3 };
  const double quick = 0.5; /* duration of a read in seconds; if a longer read finds a change, the file was probably
                             * saved twice, not read incompletely */
  vs_outcome outcome = run_files(l);
  for (int i = 1; i < TIMES && outcome != VS_OUTCOME_INTERRUPTED && now() - l->began < quick; i++) {
    if (!live_files_changed(&l->files)) break;
    live_files_settle(&l->files);
    outcome = run_files(l);
  }
  if (outcome == VS_OUTCOME_DONE) forget_defaults(l);
  finish(l, outcome);
  if (l->overtaken) return;
  l->ended_early = false;
  if (l->good) l->whole = now() - l->began;
}

/* Publishes the changes that a frame or an action of the user has made. After an error, no more frames are computed
 * until the model runs again. */
static void tell_frame(live *l, vs_outcome outcome) {
  live_text t = { 0 };
  unsigned version = l->version;
  if (outcome == VS_OUTCOME_DONE) outcome = publish_drawing(l, true);
  if (outcome == VS_OUTCOME_INTERRUPTED && l->overtaken) return;
  if (outcome != VS_OUTCOME_DONE) {
    publish_state(l, false, outcome);
    l->frames = false;
    return;
  }
  live_putf(&t, "{\"version\":%u,\"scene\":", l->version);
  l->frames = live_scene_needs(l->scheme, &t);
  live_puts(&t, "}");
  l->moved = l->moved || version != l->version;
  if (!t.failed && version != l->version) live_tell(&l->publish, "frame", t.at);
  live_text_free(&t);
}

/* Returns true if a window is open. */
static bool seen(live *l) {
  pthread_mutex_lock(&l->publish.lock);
  bool any = l->publish.windows > 0;
  pthread_mutex_unlock(&l->publish.lock);
  return any;
}

static void run_frame(live *l) {
  double seconds = now() - l->last_frame;
  l->last_frame = now();
  if (!seen(l)) return; /* while no window is open, the scene's time does not advance */
  l->began = l->last_frame;
  l->overtaken = false;
  tell_frame(l, vs_scene_frame(l->scheme, seconds < FRAME_MOST ? seconds : FRAME_MOST));
  vs_interrupt_clear(l->scheme);
}

static void run_input(live *l, const live_wish *w) {
  l->began = now();
  l->overtaken = false;
  vs_outcome outcome = live_scene_input(l->scheme, w->name, w->value);
  if (outcome != VS_OUTCOME_USAGE || l->said.errors > 0) tell_frame(l, outcome);
  vs_interrupt_clear(l->scheme);
}

static void run_prompt(live *l, const char *text) {
  begin(l);
  l->prompted = true;
  l->asked = text;
  vs_outcome outcome = vs_eval_text(l->scheme, "prompt", 1, text, strlen(text), VS_EVAL_PRINT);
  if (outcome == VS_OUTCOME_DONE || !l->good || l->overtaken) {
    finish(l, outcome);
  } else { /* An error in text typed at the prompt is not an error of the model. The model remains, with the objects
            * that the text drew before the error. */
    vs_interrupt_clear(l->scheme);
    l->good = publish_drawing(l, true) == VS_OUTCOME_DONE;
    publish_state(l, l->good, outcome);
  }
  l->asked = NULL;
}

static unsigned pass_mask(const char *name) {
  size_t count;
  const char *const *names = vs_pass_list(&count);
  for (size_t i = 0; i < count; i++)
    if (strcmp(names[i], name) == 0) return 1u << i;
  return 0;
}

/* The format that shows step by step how the model is constructed. It follows the program's text, so the optimisation
 * passes are not used. */
static const char STEPS[] = "x3d-steps";

/* Passes an export to the side `exporter`, so that a save of the file does not wait for the export. The side runs
 * the model anew. Returns false if the current drawing may differ from the result of the model's text, if a value
 * contains a separator of live_wish.given, or if memory is out. */
static bool export_aside(live *l, live_wish *w) {
  if (l->publish.alone != NULL || l->follows || l->prompted || l->moved || !l->good) return false;
  live_text values = { 0 };
  vs_parameter_info p;
  for (size_t i = 0; i < vs_parameter_count(l->scheme) && vs_parameter_get(l->scheme, i, &p); i++) {
    if (same_value(p.value, p.default_value)) continue;
    live_putf(&values, "%s%c%s%c", p.name, LIVE_UNIT, p.value, LIVE_RECORD);
    values.failed = values.failed || strpbrk(p.value, (const char[]){ LIVE_UNIT, LIVE_RECORD, 0 }) != NULL;
  }
  free(w->given);
  w->given = values.failed ? NULL : values.at != NULL ? values.at : strdup("");
  if (values.failed) live_text_free(&values);
  return w->given != NULL && live_wish_pass(&l->publish, &l->publish.exports, w);
}

static void run_export(live *l, live_wish *w) {
  vs_output_options o = l->options->output;
  live_text bytes = { 0 };
  live_aside_picture(w->value, &o);
  bool steps = strcmp(w->name, STEPS) == 0; /* steps: whether the output shows the model's construction; a window
                                             * displays it itself, so no event reports it */
  if (!steps && export_aside(l, w)) return;
  if (steps) o.passes = pass_mask("share");
  begin(l);
  l->overtaken = false;
  l->kept = !steps;
  vs_outcome outcome = vs_write_drawing_to(l->scheme, w->name, &o, scene_bytes, &bytes);
  l->kept = false;
  vs_interrupt_clear(l->scheme);
  if (l->said.shown > 0 && !steps && !l->overtaken) publish_state(l, true, outcome);
  if (l->busy_told || !steps) live_tell(&l->publish, "idle", "{}");
  live_wish_finish(&l->publish, w, outcome, bytes);
}

/* Describes the face at the point that the request names, as JSON; "{}" if no face is there. */
static void run_face(live *l, live_wish *w) {
  vs_face_info face;
  live_text t = { 0 };
  double at[3];
  int end = 0;
  vs_outcome outcome = VS_OUTCOME_USAGE;
  if (sscanf(w->value, "%lf,%lf,%lf%n", &at[0], &at[1], &at[2], &end) == 3 && !w->value[end]) {
    l->began = now();
    l->overtaken = false;
    outcome = vs_drawing_face(l->scheme, at, &face);
    vs_interrupt_clear(l->scheme);
  }
  if (outcome == VS_OUTCOME_DONE && face.form != NULL) {
    const struct { const char *name; double at; } numbers[] = {
      { "area", face.area }, { "radius", face.radius }, { "tube", face.tube }, { "angle", face.angle },
    };
    live_putf(&t, "{\"form\":\"%s\",\"at\":[%.17g,%.17g,%.17g],\"axis\":[%.17g,%.17g,%.17g]", face.form, face.at[0],
              face.at[1], face.at[2], face.axis[0], face.axis[1], face.axis[2]);
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
      live_putf(&t, ",\"%s\":%.17g", numbers[i].name, numbers[i].at);
    live_puts(&t, "}");
  } else if (outcome == VS_OUTCOME_DONE) live_puts(&t, "{}");
  live_wish_finish(&l->publish, w, outcome, t);
}

/* Handles a request for whose result a thread waits, and passes it to that thread. Returns false for other requests. */
static bool run_answered(live *l, live_wish *w) {
  if (w->kind == LIVE_EXPORT) run_export(l, w);
  else if (w->kind == LIVE_FACE) run_face(l, w);
  else return false;
  return true;
}

/* Handles the request w of a window. Returns true if the model must run again. `again`: whether an earlier request
 * already requires this. */
static bool run_wish(live *l, live_wish *w, bool again) {
  if (w->kind == LIVE_SET) {
    again |= set_parameter(l, w->name, w->value);
    l->coarse = w->coarse;
  } else if (w->kind == LIVE_TRY) {
    char *text = w->value[0] != 0 ? w->value : NULL;
    if (text != NULL) w->value = NULL;
    live_trial_put(&l->publish, text);
    l->coarse = w->coarse;
    again = true;
  } else {
    if (again) run_model(l);
    again = false;
    if (run_answered(l, w)) return false;
    if (w->kind == LIVE_INPUT) run_input(l, w);
    else run_prompt(l, w->value);
  }
  live_wish_free(w);
  return again;
}

/* Waits for a change of a file, a request, or the time of the next frame, and handles it. */
static void turn(live *l) {
  bool again = live_files_changed(&l->files);
  l->coarse = false;
  if (again) {
    work(l);
    live_files_settle(&l->files);
    live_trial_put(&l->publish, NULL);
  } else {
    rest(l);
  }
  const long pause = l->frames ? FRAME_MS : seen(l) ? LOOK_MS : LOOK_ALONE_MS;
  live_wish *w = again ? NULL : live_wish_take(&l->publish, &l->publish.wishes, pause);
  for (; w != NULL; w = live_wish_take(&l->publish, &l->publish.wishes, 0)) /* handles all waiting requests before the
                                                                             * model runs */
    again = run_wish(l, w, again);
  if (again && !*l->options->ended) run_model(l);
  if (l->frames && !*l->options->ended) {
    work(l);
    run_frame(l);
  }
}

static void serve(live *l) {
  work(l);
  run_model(l);
  while (!*l->options->ended) turn(l);
}

/* Prints the view's address. If `opens` is true and the options permit it, also opens the browser. */
static void tell_address(const live *l, bool opens) {
  char address[LIVE_ADDRESS];
  live_server_address(&l->server, address);
  fprintf(l->options->told, "%s\n", address);
  fflush(l->options->told);
  if (opens && l->options->open_browser) live_open_browser(address);
}

/* Frees everything except l itself. */
static void close_view(live *l) {
  pthread_mutex_lock(&l->publish.lock);
  l->publish.ended = true;
  pthread_cond_broadcast(&l->publish.changed);
  pthread_mutex_unlock(&l->publish.lock);
  if (l->server.publish != NULL) live_server_close(&l->server);
  live_aside_close(&l->aside);
  live_aside_close(&l->exporter);
  if (!l->follows) vs_free(l->scheme);
  live_files_clear(&l->files);
  live_text_free(&l->released);
  live_said_free(&l->said);
  live_publish_close(&l->publish);
}

/* Returns a new view, or NULL after a message on standard error. */
static live *new_view(void) {
  live *l = calloc(1, sizeof *l);
  if (l != NULL && live_publish_open(&l->publish)) return l;
  fprintf(stderr, "vs: out of memory\n");
  free(l);
  return NULL;
}

/* Sets the parameters to the values in the options. Returns false if memory is out. */
static bool set_given(live *l) {
  const live_options *o = l->options;
  for (size_t i = 0; i < o->parameter_count; i++) {
    const char *equals = strchr(o->parameters[i], '=');
    live_add(&l->released, "", 1);
    char *name = equals != NULL ? strdup(o->parameters[i]) : NULL;
    if (name == NULL) continue;
    name[equals - o->parameters[i]] = 0;
    vs_parameter_set(l->scheme, name, equals + 1);
    free(name);
  }
  return !l->released.failed;
}

/* Creates the session's interpreter, and sets the parameters to the values in the options. Returns false after a
 * message on standard error. */
static bool open_interpreter(live *l) {
  const live_options *o = l->options;
  vs_options interpreter = o->interpreter;
  interpreter.host = (vs_host){ .context = l,
                                .output = host_output,
                                .diagnose = host_diagnose,
                                .progress = host_progress,
                                .poll = host_poll,
                                .value = host_value,
                                .read_file = host_read,
                                .list_folder = host_list };
  l->scheme = vs_new(&interpreter);
  bool ok = l->scheme != NULL && set_given(l);
  if (!ok) fprintf(stderr, "vs: out of memory\n");
  return ok;
}

/* Restricts the process's rights, if the options contain the callback `confine`. The caller has neither run the model
 * nor started a thread. Returns false after a message. */
static bool confine(live *l) {
  const live_confinement *c = &l->own.confined;
  return c->confine == NULL || c->confine(c->context, &l->own.interpreter);
}

/* Returns true if the model's file can be read, otherwise false after a message on standard error. */
static bool readable(const live *l) {
  char *text = NULL;
  size_t length;
  const char *why;
  bool ok = live_options_read(l->options, l->options->model, &text, &length, &why);
  if (!ok) fprintf(stderr, "vs: %s: %s\n", l->options->model, why);
  free(text);
  return ok;
}

/* Opens the server, the interpreter and the sides of a view. alone: the callback of live_publish, or NULL if the
 * view uses threads. Returns VS_OUTCOME_DONE. On failure, prints a message and returns the outcome described for
 * live_view. */
static vs_outcome open_view(live *l, const live_options *o, void (*alone)(void *context, bool work)) {
  l->own = *o;
  l->options = o = &l->own;
  l->publish.alone = alone;
  l->publish.alone_context = l;
  bool confined = o->confined.confine != NULL;
  if (!confined && !readable(l)) return VS_OUTCOME_USAGE;
  l->server = (live_server){ .publish = &l->publish, .model = o->model, .stop = stop, .stop_context = l, .options = o };
  if (!live_http_load(&l->server.http)) return VS_OUTCOME_WORKER;
  if (!live_server_listen(&l->server)) return VS_OUTCOME_MACHINE;
  if (confined && o->open_browser) { /* starts the browser now, because a confined process could not start it */
    char address[LIVE_ADDRESS];
    live_server_address(&l->server, address);
    live_open_browser(address);
  }
  if (!confine(l) || (confined && !readable(l))) return VS_OUTCOME_USAGE;
  if (!open_interpreter(l)) return VS_OUTCOME_MACHINE;
  l->aside = (live_aside){ .options = o, .publish = &l->publish, .queue = &l->publish.asides };
  l->exporter = (live_aside){ .options = o, .publish = &l->publish, .queue = &l->publish.exports, .tells = true };
  if (alone == NULL && !(live_aside_open(&l->aside) && live_aside_open(&l->exporter))) return VS_OUTCOME_MACHINE;
  return live_server_open(&l->server) ? VS_OUTCOME_DONE : VS_OUTCOME_MACHINE;
}

vs_outcome live_view(const live_options *o) {
  live *l = new_view();
  vs_outcome outcome = l != NULL ? open_view(l, o, NULL) : VS_OUTCOME_MACHINE;
  if (outcome == VS_OUTCOME_DONE) {
    o = l->options;
    tell_address(l, o->confined.confine == NULL);
    if (o->running != NULL) o->running(l->scheme);
    serve(l);
    if (o->running != NULL) o->running(NULL);
  }
  if (l != NULL) close_view(l);
  free(l);
  return outcome;
}

/* ---- views without threads ---- */

/* The callback live_publish.alone. The view's own thread calls it while it works (`work` is false), or while a request
 * waits for its result (`work` is true). */
static void alone(void *context, bool work) {
  live *l = context;
  if (work) {
    live_wish *w;
    bool again = false;
    while ((w = live_wish_take(&l->publish, &l->publish.wishes, 0)) != NULL) again = run_wish(l, w, again);
    if (again) run_model(l);
    while (live_aside_turn(&l->aside, 0)) {}
  }
  if (l->options->send != NULL) l->options->send();
}

live *live_alone_open(const live_options *o) {
  live *l = new_view();
  if (l != NULL && open_view(l, o, alone) == VS_OUTCOME_DONE) return l;
  live_alone_close(l);
  return NULL;
}

void live_alone_run(live *l) {
  work(l);
  run_model(l);
}

bool live_alone_turn(live *l) {
  turn(l);
  return l->frames;
}

const struct live_server *live_alone_server(const live *l) { return &l->server; }

void live_alone_close(live *l) {
  if (l == NULL) return;
  close_view(l);
  free(l);
}

/* ---- views that follow a prompt ---- */

live_follower *live_follow(const live_options *o, vs_scheme *scheme) {
  live *l = new_view();
  if (l == NULL) return NULL;
  l->own = *o;
  l->own.model = NULL;
  l->own.parameter_count = 0;
  l->options = &l->own;
  l->follows = l->prompted = true;
  l->scheme = scheme;
  l->server = (live_server){ .publish = &l->publish, .stop = stop, .stop_context = l, .options = l->options };
  if (!live_http_load(&l->server.http) || !live_server_listen(&l->server) || !live_server_open(&l->server)) {
    live_follow_close(l);
    return NULL;
  }
  begin(l);
  live_follow_show(l);
  tell_address(l, true);
  return l;
}

void live_follow_close(live_follower *l) {
  if (l == NULL) return;
  close_view(l);
  free(l);
}

void live_follow_tell(const live_follower *l) { tell_address(l, true); }
void live_follow_begin(live_follower *l) { begin(l); }
void live_follow_output(live_follower *l, const char *text, size_t length) { host_output(l, text, length); }
void live_follow_value(live_follower *l, const char *text, size_t length) { host_value(l, text, length); }
void live_follow_diagnose(live_follower *l, const vs_diagnostic *d) { host_diagnose(l, d); }
void live_follow_show(live_follower *l) { finish(l, VS_OUTCOME_DONE); }

live_asked live_follow_asked(live_follower *l) {
  live_asked asked = { LIVE_NOTHING, NULL, NULL };
  for (live_wish *w; asked.kind == LIVE_NOTHING && (w = live_wish_take(&l->publish, &l->publish.wishes, 0)) != NULL;) {
    if (run_answered(l, w)) continue;
    if (w->kind != LIVE_TRY) {
      asked = (live_asked){ w->kind == LIVE_SET ? LIVE_ASKED_SET : LIVE_ASKED_PROMPT, w->name, w->value };
      w->name = w->value = NULL;
    }
    live_wish_free(w);
  }
  return asked;
}

void live_asked_free(live_asked *a) {
  free(a->name);
  free(a->value);
  *a = (live_asked){ LIVE_NOTHING, NULL, NULL };
}
