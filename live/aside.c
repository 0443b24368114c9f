/* Implements the side of a live view: an interpreter for outputs with other values of the parameters. See aside.h.
 *
 * For each request the interpreter runs the session's text from the start. It does not receive text typed at the
 * prompt, which belongs to the session. The library caches results, so a later request reuses them. */
#include "live/aside.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "model/signals.h"

enum { WAIT_MS = 1000 };

/* ---- callbacks of the interpreter ---- */

static void aside_diagnose(void *context, const vs_diagnostic *d) {
  live_aside *a = context;
  if (a->tells && a->writing) live_said_diagnose(&a->messages, d);
  if (d->severity != VS_SEVERITY_ERROR || a->said.length > 0) return;
  if (d->at.file != NULL && d->at.line > 0) {
    const char *slash = strrchr(d->at.file, '/');
    live_puts(&a->said, slash != NULL ? slash + 1 : d->at.file);
    live_putf(&a->said, ":%u:%u: ", d->at.line, d->at.column);
  }
  live_puts(&a->said, d->message);
}

static void aside_progress(void *context, const vs_progress *p) {
  live_aside *a = context;
  live_text t = { 0 };
  if (a->now == NULL || a->now->id[0] == 0) return;
  live_puts(&t, "{\"id\":");
  live_json(&t, a->now->id);
  live_puts(&t, ",\"phase\":");
  live_json(&t, p->phase);
  live_puts(&t, ",\"fraction\":");
  live_number(&t, p->fraction);
  live_puts(&t, "}");
  if (!t.failed) live_tell(a->publish, "progress", t.at);
  live_text_free(&t);
}

static bool aside_poll(void *context) {
  live_aside *a = context;
  pthread_mutex_lock(&a->publish->lock);
  bool end = a->publish->ended || (a->now != NULL && a->now->cancelled);
  pthread_mutex_unlock(&a->publish->lock);
  return end;
}

static bool aside_read(void *context, const char *path, char **text, size_t *length, const char **why) {
  live_aside *a = context;
  return live_model_read(a->publish, a->options, path, text, length, why);
}

static bool aside_list(void *context, const char *path, bool (*take)(void *to, const char *name, size_t length),
                       void *to, const char **why) {
  return live_options_list(((const live_aside *)context)->options, path, take, to, why);
}

static bool aside_bytes(void *context, const void *bytes, size_t count) {
  live_text *t = context;
  live_add(t, bytes, count);
  return !t->failed;
}

/* ---- handling a window's request ---- */

/* Sets the parameter values that the request contains if `set`, otherwise removes them. Does not change the text
 * w->given. */
static void aside_values(live_aside *a, live_wish *w, bool set) {
  for (char *at = w->given; *at != 0;) {
    char *unit = strchr(at, LIVE_UNIT), *record = strchr(at, LIVE_RECORD);
    if (unit == NULL || record == NULL || unit > record) return;
    *unit = *record = 0;
    if (set) vs_parameter_set(a->scheme, at, unit + 1);
    else vs_parameter_unset(a->scheme, at);
    *unit = LIVE_UNIT;
    *record = LIVE_RECORD;
    at = record + 1;
  }
}

static bool aside_ready(live_aside *a) {
  if (a->scheme != NULL) return true;
  vs_options interpreter = a->options->interpreter;
  interpreter.host = (vs_host){ .context = a,
                                .diagnose = aside_diagnose,
                                .progress = aside_progress,
                                .poll = aside_poll,
                                .read_file = aside_read,
                                .list_folder = aside_list };
  a->scheme = vs_new(&interpreter);
  return a->scheme != NULL;
}

void live_aside_picture(const char *text, vs_output_options *o) {
  static const char *const qualities[] = { "draft", "good", "final" };
  int width = 0, height = 0;
  char quality[8] = "";
  double c[7];
  int count = sscanf(text, "%5dx%5d %7[a-z] %lf %lf %lf %lf %lf %lf %lf", &width, &height, quality, &c[0], &c[1], &c[2],
                     &c[3], &c[4], &c[5], &c[6]);
  if (count >= 2 && width > 0 && height > 0 && width <= 8192 && height <= 8192) o->width = width, o->height = height;
  for (int i = 0; i < 3; i++)
    if (strcmp(quality, qualities[i]) == 0) o->quality = (vs_quality)i;
  bool seen = count == 10 && c[6] > 0 && (c[0] != c[3] || c[1] != c[4] || c[2] != c[5]);
  for (int i = 0; i < 7; i++) seen = seen && isfinite(c[i]);
  if (!seen) return;
  o->has_camera = true;
  memcpy(o->camera, c, sizeof c);
}

/* Sends the messages that arose while an output was made to the windows. */
static void tell_messages(live_aside *a) {
  live_text t = { 0 };
  if (a->messages.shown == 0) return;
  live_puts(&t, "{");
  live_said_write(&a->messages, &t);
  live_puts(&t, "}");
  if (!t.failed) live_tell(a->publish, "messages", t.at);
  live_text_free(&t);
}

static void aside_make(live_aside *a, live_wish *w) {
  live_text bytes = { 0 };
  vs_output_options o = a->options->output;
  vs_outcome outcome = VS_OUTCOME_MACHINE;
  a->now = w;
  a->said.length = 0;
  live_said_begin(&a->messages);
  live_aside_picture(w->value, &o);
  if (aside_ready(a)) {
    aside_values(a, w, true);
    outcome = vs_restart(a->scheme);
    if (outcome == VS_OUTCOME_DONE) outcome = vs_eval_file(a->scheme, a->options->model,
                                                          live_trial_is(a->publish) ? VS_EVAL_TRY : 0);
    a->writing = true;
    if (outcome == VS_OUTCOME_DONE) outcome = vs_write_drawing_to(a->scheme, w->name, &o, aside_bytes, &bytes);
    a->writing = false;
    aside_values(a, w, false);
    vs_interrupt_clear(a->scheme);
  }
  if (outcome != VS_OUTCOME_DONE) {
    live_text_free(&bytes);
    if (w->cancelled) live_puts(&bytes, "cancelled");
    else live_add(&bytes, a->said.length > 0 ? a->said.at : "it could not be made",
                  a->said.length > 0 ? a->said.length : strlen("it could not be made"));
  }
  a->now = NULL;
  tell_messages(a);
  live_wish_finish(a->publish, w, outcome, bytes);
}

bool live_aside_turn(live_aside *a, long wait_ms) {
  live_wish *w = live_wish_take(a->publish, a->queue, wait_ms);
  if (w != NULL) aside_make(a, w);
  return w != NULL;
}

static void *aside_run(void *context) {
  live_aside *a = context;
  for (bool ended = false; !ended;) {
    live_aside_turn(a, WAIT_MS);
    pthread_mutex_lock(&a->publish->lock);
    ended = a->publish->ended;
    pthread_mutex_unlock(&a->publish->lock);
  }
  return NULL;
}

bool live_aside_open(live_aside *a) {
  a->started = vs_thread_start(&a->thread, NULL, aside_run, a) == 0;
  if (!a->started) fprintf(stderr, "vs: no thread for the live view\n");
  return a->started;
}

void live_aside_close(live_aside *a) {
  if (a->started) pthread_join(a->thread, NULL);
  vs_free(a->scheme);
  live_text_free(&a->said);
  live_said_free(&a->messages);
}
