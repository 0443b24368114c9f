/* Owns the HTTP side of the live view. */
#ifndef VS_LIVE_SERVE_H
#define VS_LIVE_SERVE_H

#include "live/http.h"
#include "live/published.h"
#include "live/waiting.h"

typedef struct live_server {
  live_http http;
  live_publish *publish;
  const char *model;          /* the path of the source that windows read and write; NULL: none */
  void (*stop)(void *context); /* interrupts the current run; any thread may call it */
  void *stop_context;
  const struct live_options *options; /* for its check */
  vs_scheme *names;                  /* an interpreter for completion, used with names_lock held */
  pthread_mutex_t names_lock;
  struct MHD_Daemon *daemon;
  live_waiting waiting;       /* the connections without a whole request */
  unsigned port;
  char token[33];
  char hosts[2][32];          /* "127.0.0.1:PORT", "localhost:PORT" */
} live_server;

bool live_server_open(live_server *s);  /* Needs http, publish, model and stop set. Returns false after a message on
                                         * standard error. */
void live_server_close(live_server *s); /* The caller sets publish->ended first, so that waiting windows end. */

#endif
