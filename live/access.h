/* Declares the access control of the live view's server. */
#ifndef VS_LIVE_ACCESS_H
#define VS_LIVE_ACCESS_H

#include "live/http.h"

typedef struct {
  char token[33];             /* secret token: a request must contain this text in its header X-VS-Token */
  char hosts[2][32];          /* accepted values of the header Host: "127.0.0.1:PORT", "localhost:PORT" */
} live_access;

/* The refusal of a request: its HTTP status, and the reason in a line of text. why is NULL if it is accepted. */
typedef struct { unsigned status; const char *why; } live_refusal;

/* Decides from the path and the headers of a request whether the server accepts it. most: the greatest length of a body
 * in bytes. */
live_refusal live_access_refuse(const live_http *http, struct MHD_Connection *c, const live_access *a, const char *url,
                                size_t most);
void live_access_hosts(live_access *a, unsigned port); /* sets the accepted values of the header Host for this port */
bool live_access_word(char out[33]); /* Writes a random word of 32 hexadecimal digits and a NUL. Returns false if the
                                      * system provides no random numbers. */

#endif
