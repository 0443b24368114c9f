/* Owns the output of a run for the windows: printed text, values, messages. */
#ifndef VS_LIVE_SAID_H
#define VS_LIVE_SAID_H

#include "live/live_text.h"
#include "visualscheme.h"

/* A text of which the last LIVE_KEPT bytes at least are kept. {0} is empty. */
typedef struct { live_text text; size_t missing; /* characters before it that were dropped */ } live_tail;
enum { LIVE_KEPT = 1 << 20 };

typedef struct {
  live_tail printed, values;
  live_text messages;          /* JSON objects with commas between them */
  size_t shown, more, errors;  /* messages among them; messages that there was no room for; errors among both */
} live_said;

void live_tail_add(live_tail *t, const char *text, size_t length);

void live_said_begin(live_said *s); /* forgets what was said */
void live_said_value(live_said *s, const char *text, size_t length);
void live_said_diagnose(live_said *s, const vs_diagnostic *d);
/* Writes members of a JSON object: messages, more, printed, values, missing. */
void live_said_write(const live_said *s, live_text *to);
void live_said_free(live_said *s);

void live_json_place(live_text *to, const vs_span *at); /* a JSON object */

#endif
