/* Implements text that grows, and the JSON form of strings. See live_text.h. */
#include "live/live_text.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "model/characters.h"

void live_add(live_text *t, const void *bytes, size_t length) {
  if (t->failed) return;
  if (t->room - t->length <= length) {
    size_t room = (t->length + length + 64) * 2;
    char *grown = room > length ? realloc(t->at, room) : NULL;
    if (grown == NULL) {
      t->failed = true;
      return;
    }
    t->at = grown;
    t->room = room;
  }
  memcpy(t->at + t->length, bytes, length);
  t->length += length;
  t->at[t->length] = 0;
}

void live_puts(live_text *t, const char *text) { live_add(t, text, strlen(text)); }

void live_putf(live_text *t, const char *format, ...) {
  char short_text[512];
  va_list arguments;
  va_start(arguments, format);
  int length = vsnprintf(short_text, sizeof short_text, format, arguments);
  va_end(arguments);
  if (length < 0 || (size_t)length >= sizeof short_text) t->failed = true;
  else live_add(t, short_text, (size_t)length);
}

void live_json_bytes(live_text *t, const char *text, size_t length) {
  live_puts(t, "\"");
  char spelled[VS_SPELLED_ROOM];
  for (const char *at = text, *end = text + length; at < end;) live_add(t, spelled, vs_spell_json(&at, end, spelled));
  live_puts(t, "\"");
}

void live_json(live_text *t, const char *text) {
  if (text == NULL) live_puts(t, "null");
  else live_json_bytes(t, text, strlen(text));
}

void live_number(live_text *t, double x) {
  if (isfinite(x)) live_putf(t, "%.15g", x);
  else live_puts(t, "null");
}

void live_text_free(live_text *t) {
  free(t->at);
  *t = (live_text){ 0 };
}
