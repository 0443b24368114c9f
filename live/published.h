/* Owns what windows are told: the state after each run as JSON, the scene in pieces, events in order; and what windows
 * ask for. A lock guards it. */
#ifndef VS_LIVE_PUBLISHED_H
#define VS_LIVE_PUBLISHED_H

#include <pthread.h>

#include "live/chunks.h"
#include "live/live_text.h"
#include "visualscheme.h"

enum { LIVE_EVENTS = 64, LIVE_VERSIONS = 8, LIVE_WISHES = 64 };

/* A scene that threads may be sending while the next is made. */
typedef struct {
  unsigned uses;
  unsigned version;
  unsigned char *bytes;
  size_t count;
  live_chunks chunks, sorted;
} live_scene;

typedef enum {
  LIVE_SET,    /* a parameter */
  LIVE_TRY,    /* a text of the model that is not saved; "": the file's again */
  LIVE_INPUT,  /* what a user did to the scene: its kind, and where */
  LIVE_PROMPT, LIVE_EXPORT
} live_wish_kind;
typedef struct live_wish {
  live_wish_kind kind;
  char *name, *value;
  bool coarse;         /* SET: the value is on its way to another one: round things may be coarse */
  char *given;         /* EXPORT aside: values of parameters, each NAME LIVE_UNIT VALUE LIVE_RECORD; NULL elsewhere */
  char *id;            /* EXPORT aside: the window's word for it, in what is told of its progress; NULL elsewhere */
  bool done;           /* EXPORT: the asking thread waits for it */
  live_text result;    /* after a failure the reason, a line */
  vs_outcome outcome;
  bool cancelled;      /* EXPORT aside: it ends as soon as it can */
  bool abandoned;      /* nobody waits any more: whoever finishes it frees it */
  struct live_wish *next;
} live_wish;
enum { LIVE_UNIT = 0x1f, LIVE_RECORD = 0x1e };

typedef struct { live_wish *first, **end; size_t count; } live_queue;

typedef struct {
  pthread_mutex_t lock;
  pthread_cond_t changed;
  bool ended;
  unsigned long event_count;      /* events so far; the last LIVE_EVENTS are kept */
  char *events[LIVE_EVENTS];      /* as lines of server-sent events */
  char *state;                    /* the newest, for a window that opens now; it is the JSON text alone */
  live_scene *scene;              /* the newest good one, or NULL */
  live_chunks past[LIVE_VERSIONS]; /* sorted pieces of the latest versions: version v at v % LIVE_VERSIONS */
  unsigned past_version[LIVE_VERSIONS];
  char *trial;                    /* a text that stands in the model's place until the file changes, or NULL */
  live_queue wishes;              /* of the session */
  bool working;                   /* the session is at something, which Stop ends */
  live_queue asides;              /* of the side (aside.h) */
  live_wish *aside_now;           /* which the side is at, or NULL */
  unsigned windows;
} live_publish;

bool live_publish_open(live_publish *p);
void live_publish_close(live_publish *p);
/* Tells every window. kind is one word, json on one line. */
void live_tell(live_publish *p, const char *kind, const char *json);
void live_publish_state(live_publish *p, char *json); /* takes json, and tells it as "state" */
void live_publish_scene(live_publish *p, live_scene *scene); /* takes scene with one use */
live_scene *live_scene_take(live_publish *p); /* the newest, one more use; NULL: none */
void live_scene_release(live_publish *p, live_scene *s);
live_wish *live_wish_new(live_wish_kind kind, const char *name, const char *value);
void live_wish_free(live_wish *w);
/* Takes w; a setting or a text of the same name replaces one that waits. False: too many wait, w is freed. */
bool live_wish_put(live_publish *p, live_queue *q, live_wish *w);
/* Is there a setting or a text among the session's wishes, so that the model has to run again? */
bool live_wish_renews(live_publish *p);
/* the next, or NULL after so long without one; with a wish the session works */
live_wish *live_wish_take(live_publish *p, live_queue *q, long wait_ms);
/* takes result; lets go of w */
void live_wish_finish(live_publish *p, live_wish *w, vs_outcome outcome, live_text result);
void live_wish_cancel(live_publish *p, const char *id); /* of the side's wishes */
/* As vs_host.read_file: of the model the text that stands in its place, if one does. */
bool live_model_read(live_publish *p, const char *model, const char *path, char **text, size_t *length,
                     const char **why);
void live_trial_put(live_publish *p, char *text); /* takes text; NULL: the file's again */

#endif
