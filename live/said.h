/* Owns the output of a run for the windows: printed text, values, messages. */
#ifndef VS_LIVE_SAID_H
#define VS_LIVE_SAID_H

#include "live/live_text.h"
#include "visualscheme.h"

/* A text that keeps at least its last LIVE_KEPT bytes. {0} is empty. */
typedef struct { live_text text; size_t missing; /* dropped characters before it */ } live_tail;
enum { LIVE_KEPT = 1 << 20 };

typedef struct {
  live_tail printed, values;
  live_text messages;          /* JSON objects, separated by commas */
  size_t shown, more, errors;  /* messages that are kept; messages without room; errors among both */
} live_said;

void live_tail_add(live_tail *t, const char *text, size_t length);

void live_said_begin(live_said *s); /* forgets the output */
void live_said_value(live_said *s, const char *text, size_t length);
void live_said_diagnose(live_said *s, const vs_diagnostic *d);
/* Writes members of a JSON object: messages, more, printed, values, missing. */
void live_said_write(const live_said *s, live_text *to);
void live_said_free(live_said *s);

void live_json_place(live_text *to, const vs_span *at); /* a JSON object */

#endif
