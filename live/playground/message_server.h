/* Declares the live view's server for a window that sends messages, and the functions of the window's side. */
#ifndef VS_LIVE_PLAYGROUND_MESSAGE_SERVER_H
#define VS_LIVE_PLAYGROUND_MESSAGE_SERVER_H

#include "live/http.h"

typedef struct {
  int id;                   /* number of the request, for its answer */
  const char *method, *path;
  const char *query;        /* the address' query: NAME 0 VALUE 0 ..., and another 0 */
  const char *body;
  size_t size;              /* size: bytes of body */
  const char *host, *token; /* the headers that the server requires */
} message;

void playground_ask(const message *m); /* Handles a request; its answer goes to playground_answer. */
void playground_pump(void);            /* Sends the events that have come to the window. */

/* The window's side, in JavaScript. status, type, bytes: those of the answer; open: whether parts follow. */
void playground_answer(int id, unsigned status, const char *type, const void *bytes, size_t count, bool open);
void playground_part(int id, const void *bytes, size_t count);

#endif
