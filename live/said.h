/* Declares the output of a run that windows show: printed text, values, messages. */
#ifndef VS_LIVE_SAID_H
#define VS_LIVE_SAID_H

#include "live/live_text.h"
#include "visualscheme.h"

/* A text that may lose its beginning: at least the last LIVE_KEPT bytes are kept. {0} is an empty text. */
typedef struct { live_text text; size_t missing; /* missing: number of dropped characters */ } live_tail;
enum { LIVE_KEPT = 1 << 20 };

typedef struct {
  live_tail printed, values;
  live_text messages;          /* messages as JSON objects, separated by commas */
  size_t shown, more, errors;  /* shown: number of kept messages. more: number of discarded messages. errors: number of
                                * errors among all messages */
} live_said;

void live_tail_add(live_tail *t, const char *text, size_t length);

void live_said_begin(live_said *s); /* deletes the output of the previous run */
void live_said_value(live_said *s, const char *text, size_t length);
void live_said_diagnose(live_said *s, const vs_diagnostic *d);
/* Writes the output as members of a JSON object: messages, more, printed, values, missing. */
void live_said_write(const live_said *s, live_text *to);
void live_said_free(live_said *s);

void live_json_place(live_text *to, const vs_span *at); /* writes a place in a source text as a JSON object */

#endif
