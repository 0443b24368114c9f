/* Declares the live view's server for a window that sends messages, and the functions of the window's side. */
#ifndef VS_LIVE_PLAYGROUND_MESSAGE_SERVER_H
#define VS_LIVE_PLAYGROUND_MESSAGE_SERVER_H

#include "live/http.h"

typedef struct {
  int id;                   /* number of the request, which playground_answer receives with the response */
  const char *method, *path;
  const char *query;        /* query of the address: names and values, each terminated by NUL, and an empty name at the
                             * end */
  const char *body;
  size_t size;              /* size: length of the body in bytes */
  const char *host, *token; /* values of the headers Host and X-VS-Token, which the server checks */
} message;

void playground_ask(const message *m); /* Handles a window's request. The response is passed to playground_answer. */
void playground_pump(void);            /* Sends new events to the window. */

/* Passes a response to the window; implemented in JavaScript. id: number of the request. status, type, bytes: status,
 * content type and body of the response. open: whether more bytes of the body follow. */
void playground_answer(int id, unsigned status, const char *type, const void *bytes, size_t count, bool open);
void playground_part(int id, const void *bytes, size_t count);

#endif
