/* Declares the data that windows receive: the state after each run as JSON, the scene in pieces, and events in order.
 * Also declares the requests that windows send. A lock protects the data. */
#ifndef VS_LIVE_PUBLISHED_H
#define VS_LIVE_PUBLISHED_H

#include <pthread.h>

#include "live/chunks.h"
#include "live/live_options.h"
#include "live/live_text.h"
#include "visualscheme.h"

enum { LIVE_EVENTS = 64, LIVE_VERSIONS = 8, LIVE_WISHES = 64 };

/* A scene as bytes, with a count of references: a thread may still send the scene to a window when the next scene is
 * published. */
typedef struct {
  unsigned uses;
  unsigned version;
  unsigned char *bytes;
  size_t count;
  live_chunks chunks, sorted;
} live_scene;

typedef enum {
  LIVE_SET,    /* sets a parameter */
  LIVE_TRY,    /* tries an unsaved text of the model; an empty text returns to the file */
  LIVE_INPUT,  /* passes an action of the user to the scene: the kind of the action, and the ray under the mouse */
  LIVE_PROMPT, LIVE_EXPORT,
  LIVE_FACE    /* describes the face at a point of the model */
} live_wish_kind;
typedef struct live_wish {
  live_wish_kind kind;
  char *name, *value;
  bool coarse;         /* if kind is SET: whether the window's slider is still moving, so that round shapes may be
                        * coarse */
  char *given;         /* if kind is EXPORT: values of parameters for the side (aside.h), each as NAME LIVE_UNIT VALUE
                        * LIVE_RECORD; otherwise NULL */
  char *id;            /* if kind is EXPORT: name that the window has given the request, for events about its progress,
                        * or ""; otherwise NULL */
  bool done;           /* if kind is EXPORT or FACE: whether the result is ready for the thread that waits for it */
  live_text result;    /* result of the request; if it failed: the reason, in one line */
  vs_outcome outcome;
  bool cancelled;      /* for an EXPORT that a side (aside.h) makes: whether the window has cancelled the request, so
                        * that the work must end soon */
  bool abandoned;      /* whether no thread waits for the result any more, so that the thread that finishes the request
                        * frees it */
  struct live_wish *next;
} live_wish;
enum { LIVE_UNIT = 0x1f, LIVE_RECORD = 0x1e };

/* now: the request that was taken last, if it has an id and is not finished; otherwise NULL. */
typedef struct { live_wish *first, **end, *now; size_t count; } live_queue;

typedef struct {
  pthread_mutex_t lock;
  pthread_cond_t changed;
  bool ended;
  unsigned long event_count;      /* number of events since the start; only the last LIVE_EVENTS events are kept */
  char *events[LIVE_EVENTS];      /* events as lines of server-sent events */
  char *state;                    /* newest state as JSON, which a window receives when it opens */
  live_scene *scene;              /* newest scene that was made without an error, or NULL */
  live_chunks past[LIVE_VERSIONS]; /* past[v % LIVE_VERSIONS]: sorted pieces of version v of the scene; kept for the
                                    * latest LIVE_VERSIONS versions */
  unsigned past_version[LIVE_VERSIONS];
  char *trial;                    /* unsaved text from a window that replaces the model's text until the file changes,
                                   * or NULL */
  live_queue wishes;              /* requests that wait for the session */
  bool working;                   /* whether the session is busy, so that the Stop button ends its work */
  live_queue asides;              /* requests that wait for the side that makes pictures (aside.h) */
  live_queue exports;             /* requests that wait for the side that makes exports of the current model */
  unsigned windows;
  /* Callback for a view without threads, or NULL. A single thread then serves as session, server and window, so it
   * cannot wait for another. `alone` sends the events, and handles the waiting requests if `work` is true. */
  void (*alone)(void *context, bool work);
  void *alone_context;
} live_publish;

bool live_publish_open(live_publish *p);
void live_publish_close(live_publish *p);
/* Sends an event to every window. kind is a single word, json is a single line. */
void live_tell(live_publish *p, const char *kind, const char *json);
void live_publish_state(live_publish *p, char *json); /* Sends json as the event "state", and takes ownership of the
                                                       * memory of json. */
void live_publish_scene(live_publish *p, live_scene *scene); /* Publishes the scene, and takes ownership of the caller's
                                                              * reference to it. */
live_scene *live_scene_take(live_publish *p); /* Returns a new reference to the newest scene, or NULL if there is
                                               * none. */
void live_scene_release(live_publish *p, live_scene *s);
live_wish *live_wish_new(live_wish_kind kind, const char *name, const char *value);
void live_wish_free(live_wish *w);
/* Appends the request w to the queue, which takes ownership of w. A waiting request of equal kind (a setting or a text)
 * and name is replaced. Returns false, and frees w, if too many requests wait. */
bool live_wish_put(live_publish *p, live_queue *q, live_wish *w);
/* Returns true if a new parameter value or text waits for the session, so that the model must run again. */
bool live_wish_renews(live_publish *p);
/* Takes the next request out of the queue and returns it. Returns NULL if none arrives within wait_ms milliseconds.
 * After a request the session counts as busy. */
live_wish *live_wish_take(live_publish *p, live_queue *q, long wait_ms);
/* Appends the request w, which was taken from another queue, to the queue q, which takes ownership of w. Returns false
 * if too many requests wait in q; the caller then still owns w. */
bool live_wish_pass(live_publish *p, live_queue *q, live_wish *w);
/* Finishes the request w: sets its outcome and its result, takes ownership of the result's memory, and releases w. */
void live_wish_finish(live_publish *p, live_wish *w, vs_outcome outcome, live_text result);
void live_wish_cancel(live_publish *p, const char *id); /* cancels the request of the side (aside.h) that has this id */
/* Reads a file as live_options_read does. If path is the model and there is an unsaved text, returns the unsaved
 * text. */
bool live_model_read(live_publish *p, const live_options *o, const char *path, char **text, size_t *length,
                     const char **why);
bool live_trial_is(live_publish *p); /* returns true if there is an unsaved text */
void live_trial_put(live_publish *p, char *text); /* Sets the unsaved text, and takes ownership of its memory. If the
                                                   * argument is NULL, the model's file is used again. */

#endif
