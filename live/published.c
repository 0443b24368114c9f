/* Implements the state that windows receive. See published.h. */
#include "live/published.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

bool live_publish_open(live_publish *p) {
  memset(p, 0, sizeof *p);
  p->wishes.end = &p->wishes.first;
  p->asides.end = &p->asides.first;
  p->exports.end = &p->exports.first;
  pthread_condattr_t attributes;
  if (pthread_mutex_init(&p->lock, NULL) != 0) return false;
  pthread_condattr_init(&attributes);
  pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC);
  bool ok = pthread_cond_init(&p->changed, &attributes) == 0;
  pthread_condattr_destroy(&attributes);
  return ok;
}

void live_publish_close(live_publish *p) {
  for (size_t i = 0; i < LIVE_EVENTS; i++) free(p->events[i]);
  for (size_t i = 0; i < LIVE_VERSIONS; i++) live_chunks_free(&p->past[i]);
  free(p->state);
  if (p->scene != NULL) live_scene_release(p, p->scene);
  live_queue *queues[] = { &p->wishes, &p->asides, &p->exports };
  for (size_t i = 0; i < sizeof queues / sizeof *queues; i++) {
    for (live_wish *w; (w = queues[i]->first) != NULL; live_wish_free(w)) queues[i]->first = w->next;
  }
  free(p->trial);
  pthread_cond_destroy(&p->changed);
  pthread_mutex_destroy(&p->lock);
}

static void publish_event(live_publish *p, const char *kind, const char *json) { /* Sends an event. The caller must hold
                                                                                  * the lock. */
  live_text t = { 0 };
  live_putf(&t, "id: %lu\nevent: %s\ndata: ", p->event_count + 1, kind);
  live_puts(&t, json);
  live_puts(&t, "\n\n");
  if (t.failed) {
    live_text_free(&t);
    return; /* returns without an event, since the next state contains all its data */
  }
  char **slot = &p->events[p->event_count++ % LIVE_EVENTS];
  free(*slot);
  *slot = t.at;
  pthread_cond_broadcast(&p->changed);
}

/* If the view has no threads, sends the waiting events now, by the callback `alone`. The caller must not hold the
 * lock. */
static void publish_alone(live_publish *p) {
  if (p->alone != NULL) p->alone(p->alone_context, false);
}

void live_tell(live_publish *p, const char *kind, const char *json) {
  pthread_mutex_lock(&p->lock);
  publish_event(p, kind, json);
  pthread_mutex_unlock(&p->lock);
  publish_alone(p);
}

void live_publish_state(live_publish *p, char *json) {
  pthread_mutex_lock(&p->lock);
  free(p->state);
  p->state = json;
  publish_event(p, "state", json);
  pthread_mutex_unlock(&p->lock);
  publish_alone(p);
}

static void scene_drop(live_scene *s) { /* Releases a reference to the scene. The caller must hold the lock. */
  if (--s->uses > 0) return;
  live_chunks_free(&s->chunks);
  free(s->bytes);
  free(s);
}

void live_publish_scene(live_publish *p, live_scene *scene) {
  pthread_mutex_lock(&p->lock);
  live_chunks *past = &p->past[scene->version % LIVE_VERSIONS];
  live_chunks_free(past);
  *past = scene->sorted;
  p->past_version[scene->version % LIVE_VERSIONS] = scene->version;
  scene->sorted = (live_chunks){ NULL, 0 };
  if (p->scene != NULL) scene_drop(p->scene);
  p->scene = scene;
  pthread_mutex_unlock(&p->lock);
}

live_scene *live_scene_take(live_publish *p) {
  pthread_mutex_lock(&p->lock);
  live_scene *s = p->scene;
  if (s != NULL) s->uses++;
  pthread_mutex_unlock(&p->lock);
  return s;
}

void live_scene_release(live_publish *p, live_scene *s) {
  pthread_mutex_lock(&p->lock);
  scene_drop(s);
  pthread_mutex_unlock(&p->lock);
}

live_wish *live_wish_new(live_wish_kind kind, const char *name, const char *value) {
  live_wish *w = calloc(1, sizeof *w);
  if (w == NULL) return NULL;
  w->kind = kind;
  w->name = strdup(name);
  w->value = strdup(value);
  if (w->name != NULL && w->value != NULL) return w;
  live_wish_free(w);
  return NULL;
}

void live_wish_free(live_wish *w) {
  if (w == NULL) return;
  free(w->name);
  free(w->value);
  free(w->given);
  free(w->id);
  live_text_free(&w->result);
  free(w);
}

/* Appends w to the queue. Returns false if too many requests wait. The caller must hold the lock. */
static bool append(live_publish *p, live_queue *q, live_wish *w) {
  if (q->count >= LIVE_WISHES || p->ended) return false;
  w->next = NULL;
  *q->end = w;
  q->end = &w->next;
  q->count++;
  pthread_cond_broadcast(&p->changed);
  return true;
}

bool live_wish_put(live_publish *p, live_queue *q, live_wish *w) {
  pthread_mutex_lock(&p->lock);
  for (live_wish *old = q->first; w->kind <= LIVE_TRY && old != NULL; old = old->next) {
    if (old->kind != w->kind || strcmp(old->name, w->name) != 0) continue;
    char *value = old->value;
    old->value = w->value;
    old->coarse = w->coarse;
    w->value = value;
    pthread_mutex_unlock(&p->lock);
    live_wish_free(w);
    return true;
  }
  bool ok = append(p, q, w);
  pthread_mutex_unlock(&p->lock);
  if (!ok) live_wish_free(w);
  return ok;
}

bool live_wish_pass(live_publish *p, live_queue *q, live_wish *w) {
  pthread_mutex_lock(&p->lock);
  if (p->wishes.now == w) p->wishes.now = NULL;
  bool ok = append(p, q, w);
  pthread_mutex_unlock(&p->lock);
  return ok;
}

bool live_wish_renews(live_publish *p) {
  bool renews = false;
  pthread_mutex_lock(&p->lock);
  for (const live_wish *w = p->wishes.first; w != NULL && !renews; w = w->next)
    renews = w->kind == LIVE_SET || w->kind == LIVE_TRY;
  pthread_mutex_unlock(&p->lock);
  return renews;
}

live_wish *live_wish_take(live_publish *p, live_queue *q, long wait_ms) {
  pthread_mutex_lock(&p->lock);
  if (q->first == NULL && wait_ms > 0 && !p->ended && p->alone == NULL) {
    struct timespec until;
    clock_gettime(CLOCK_MONOTONIC, &until);
    until.tv_sec += wait_ms / 1000;
    until.tv_nsec += wait_ms % 1000 * 1000000L;
    if (until.tv_nsec >= 1000000000L) until.tv_sec++, until.tv_nsec -= 1000000000L;
    pthread_cond_timedwait(&p->changed, &p->lock, &until);
  }
  live_wish *w = q->first;
  if (w != NULL) {
    q->first = w->next;
    q->count--;
    if (q->first == NULL) q->end = &q->first;
    q->now = w->id != NULL ? w : NULL;
    if (q == &p->wishes) p->working = true;
  }
  pthread_mutex_unlock(&p->lock);
  return w;
}

void live_wish_finish(live_publish *p, live_wish *w, vs_outcome outcome, live_text result) {
  pthread_mutex_lock(&p->lock);
  live_queue *queues[] = { &p->wishes, &p->asides, &p->exports };
  for (size_t i = 0; i < sizeof queues / sizeof *queues; i++)
    if (queues[i]->now == w) queues[i]->now = NULL;
  w->outcome = outcome;
  w->result = result;
  w->done = true;
  bool abandoned = w->abandoned;
  pthread_cond_broadcast(&p->changed);
  pthread_mutex_unlock(&p->lock);
  if (abandoned) live_wish_free(w);
}

void live_wish_cancel(live_publish *p, const char *id) {
  pthread_mutex_lock(&p->lock);
  live_queue *queues[] = { &p->asides, &p->exports };
  for (size_t i = 0; i < sizeof queues / sizeof *queues; i++) {
    if (queues[i]->now != NULL && strcmp(queues[i]->now->id, id) == 0) queues[i]->now->cancelled = true;
    for (live_wish *w = queues[i]->first; w != NULL; w = w->next)
      if (strcmp(w->id, id) == 0) w->cancelled = true;
  }
  pthread_mutex_unlock(&p->lock);
}

bool live_model_read(live_publish *p, const live_options *o, const char *path, char **text, size_t *length,
                     const char **why) {
  if (strcmp(path, o->model) != 0) return live_options_read(o, path, text, length, why);
  pthread_mutex_lock(&p->lock);
  bool trial = p->trial != NULL;
  *text = trial ? strdup(p->trial) : NULL;
  pthread_mutex_unlock(&p->lock);
  if (!trial) return live_options_read(o, path, text, length, why);
  *why = "out of memory";
  if (*text != NULL) *length = strlen(*text);
  return *text != NULL;
}

bool live_trial_is(live_publish *p) {
  pthread_mutex_lock(&p->lock);
  bool trial = p->trial != NULL;
  pthread_mutex_unlock(&p->lock);
  return trial;
}

void live_trial_put(live_publish *p, char *text) {
  pthread_mutex_lock(&p->lock);
  char *old = p->trial;
  p->trial = text;
  pthread_mutex_unlock(&p->lock);
  free(old);
}
