/* Owns the HTTP side of the live view. */
#ifndef VS_LIVE_SERVE_H
#define VS_LIVE_SERVE_H

#include "live/http.h"
#include "live/published.h"
#include "live/waiting.h"

typedef struct live_server {
  live_http http;
  live_publish *publish;
  const char *model;          /* the path of the source that windows read and write; NULL: there is none */
  void (*stop)(void *context); /* interrupts what runs; called from any thread */
  void *stop_context;
  const struct live_options *options; /* its check is asked */
  vs_scheme *names;                  /* an interpreter of its own for completion, used with names_lock held */
  pthread_mutex_t names_lock;
  struct MHD_Daemon *daemon;
  live_waiting waiting;       /* the connections without a whole request */
  unsigned port;
  char token[33];
  char hosts[2][32];          /* "127.0.0.1:PORT", "localhost:PORT" */
} live_server;

bool live_server_open(live_server *s);  /* http, publish, model, stop are set; false: standard error has been told */
void live_server_close(live_server *s); /* publish->ended is set before, so that waiting windows let go */

#endif
