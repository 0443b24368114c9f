/* Declares the HTTP side of the live view. */
#ifndef VS_LIVE_SERVE_H
#define VS_LIVE_SERVE_H

#include "live/http.h"
#include "live/published.h"
#include "live/waiting.h"

typedef struct live_server {
  live_http http;
  live_publish *publish;
  const char *model;          /* path of the source that windows read and write; NULL: there is no source */
  void (*stop)(void *context); /* interrupts the current run; any thread may call it */
  void *stop_context;
  const struct live_options *options; /* options of the view, of which the server uses the function `check` */
  vs_scheme *names;                  /* interpreter for completion; use it only with names_lock held */
  pthread_mutex_t names_lock;
  struct MHD_Daemon *daemon;
  live_waiting waiting;       /* connections whose request is incomplete */
  unsigned port;
  char token[33];
  char hosts[2][32];          /* accepted values of Host: "127.0.0.1:PORT", "localhost:PORT" */
} live_server;

bool live_server_open(live_server *s);  /* Opens the server; http, publish, model and stop must be set. Returns false
                                         * after a message on standard error. */
void live_server_close(live_server *s); /* Closes the server. The caller first sets publish->ended, so that waiting
                                         * windows end. */

#endif
