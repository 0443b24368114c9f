/* Declares the HTTP server of the live view. */
#ifndef VS_LIVE_SERVE_H
#define VS_LIVE_SERVE_H

#include "live/access.h"
#include "live/http.h"
#include "live/published.h"
#include "live/waiting.h"

typedef struct live_server {
  live_http http;
  live_publish *publish;
  const char *model;          /* path of the source that windows read and write; NULL: there is no source */
  void (*stop)(void *context); /* interrupts the current run of the model; any thread may call it */
  void *stop_context;
  const struct live_options *options; /* options of the view, of which the server uses the function `check` */
  vs_scheme *names;                  /* interpreter that provides the names for completion; a thread must hold
                                      * names_lock while it uses this interpreter */
  pthread_mutex_t names_lock;
  int socket;                 /* the socket that listens, which the daemon closes; used if port is not 0 */
  struct MHD_Daemon *daemon;
  live_waiting waiting;       /* table of the connections whose request is incomplete */
  unsigned port;
  live_access access;
} live_server;

enum { LIVE_ADDRESS = 96 };

/* Opens the server's socket on a free port, and sets the members socket, port and access. Browsers may then connect,
 * but receive answers only after live_server_open. Returns false after a message on standard error. */
bool live_server_listen(live_server *s);
/* Starts the server; the members http, publish, model and stop must be set. Returns false after a message on standard
 * error. */
bool live_server_open(live_server *s);
void live_server_address(const live_server *s, char out[LIVE_ADDRESS]); /* writes the page's address with the token */
void live_server_close(live_server *s); /* Closes the server. The caller must first set publish->ended, so that the
                                         * threads of waiting windows end. */

#endif
