/* Owns the data that windows receive (the state after each run as JSON, the scene in pieces, events in order) and the
 * requests that they send. A lock guards it. */
#ifndef VS_LIVE_PUBLISHED_H
#define VS_LIVE_PUBLISHED_H

#include <pthread.h>

#include "live/chunks.h"
#include "live/live_text.h"
#include "visualscheme.h"

enum { LIVE_EVENTS = 64, LIVE_VERSIONS = 8, LIVE_WISHES = 64 };

/* A scene that threads may send while the next is made. */
typedef struct {
  unsigned uses;
  unsigned version;
  unsigned char *bytes;
  size_t count;
  live_chunks chunks, sorted;
} live_scene;

typedef enum {
  LIVE_SET,    /* sets a parameter */
  LIVE_TRY,    /* tries an unsaved text of the model; "": returns to the file */
  LIVE_INPUT,  /* an action of the user on the scene: its kind, and the ray */
  LIVE_PROMPT, LIVE_EXPORT
} live_wish_kind;
typedef struct live_wish {
  live_wish_kind kind;
  char *name, *value;
  bool coarse;         /* SET: the slider is moving; round shapes may be coarse */
  char *given;         /* EXPORT aside: values of parameters, each NAME LIVE_UNIT VALUE LIVE_RECORD; else NULL */
  char *id;            /* EXPORT aside: the window's name for the request, in its progress events; else NULL */
  bool done;           /* EXPORT: the thread that asked waits for it */
  live_text result;    /* after a failure: the reason, a line */
  vs_outcome outcome;
  bool cancelled;      /* EXPORT aside: it must end soon */
  bool abandoned;      /* no thread waits any more; the one that finishes it frees it */
  struct live_wish *next;
} live_wish;
enum { LIVE_UNIT = 0x1f, LIVE_RECORD = 0x1e };

typedef struct { live_wish *first, **end; size_t count; } live_queue;

typedef struct {
  pthread_mutex_t lock;
  pthread_cond_t changed;
  bool ended;
  unsigned long event_count;      /* number of events so far; the last LIVE_EVENTS are kept */
  char *events[LIVE_EVENTS];      /* as lines of server-sent events */
  char *state;                    /* the newest state, for a new window: the JSON text only */
  live_scene *scene;              /* the newest good scene, or NULL */
  live_chunks past[LIVE_VERSIONS]; /* sorted pieces of the latest versions: version v at v % LIVE_VERSIONS */
  unsigned past_version[LIVE_VERSIONS];
  char *trial;                    /* the unsaved text that replaces the model's until the file changes, or NULL */
  live_queue wishes;              /* of the session */
  bool working;                   /* the session is busy; Stop ends its work */
  live_queue asides;              /* of the side (aside.h) */
  live_wish *aside_now;           /* the side's current request, or NULL */
  unsigned windows;
} live_publish;

bool live_publish_open(live_publish *p);
void live_publish_close(live_publish *p);
/* Sends an event to every window. kind is one word, json is one line. */
void live_tell(live_publish *p, const char *kind, const char *json);
void live_publish_state(live_publish *p, char *json); /* Takes json, and sends it as "state". */
void live_publish_scene(live_publish *p, live_scene *scene); /* Takes over one reference to scene. */
live_scene *live_scene_take(live_publish *p); /* Returns the newest scene with a new reference; NULL: none. */
void live_scene_release(live_publish *p, live_scene *s);
live_wish *live_wish_new(live_wish_kind kind, const char *name, const char *value);
void live_wish_free(live_wish *w);
/* Takes w. It replaces a waiting setting or text of the same name. Returns false, and frees w, if too many wait. */
bool live_wish_put(live_publish *p, live_queue *q, live_wish *w);
/* Returns true if a setting or a text waits for the session, so that the model must run again. */
bool live_wish_renews(live_publish *p);
/* Returns the next request, or NULL after that many milliseconds without one; with a request the session is busy. */
live_wish *live_wish_take(live_publish *p, live_queue *q, long wait_ms);
/* Takes result; drops w. */
void live_wish_finish(live_publish *p, live_wish *w, vs_outcome outcome, live_text result);
void live_wish_cancel(live_publish *p, const char *id); /* of the side's requests */
/* Works as vs_host.read_file; for the model it returns the unsaved text, if there is one. */
bool live_model_read(live_publish *p, const char *model, const char *path, char **text, size_t *length,
                     const char **why);
void live_trial_put(live_publish *p, char *text); /* Takes text; NULL: returns to the file. */

#endif
