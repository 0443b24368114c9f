/* Gives warnings, each only once for each place in the program. */
#include "bind/warnings.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "bind/origins.h"
#include "bind/state.h"

/* Returns true if the warning with this key (a hash) was given before. Returns false if memory for the key is out. */
static bool told(vs_bind *b, uint64_t key) {
  if (!key) key = 1;
  if (2 * b->told_count >= b->told_room) {
    size_t room = b->told_room ? b->told_room * 2 : 64;
    uint64_t *t = vs_store_realloc(b->store, NULL, 0, room * sizeof *t);
    if (!t) return false;
    memset(t, 0, room * sizeof *t);
    for (size_t i = 0; i < b->told_room; i++)
      if (b->told[i]) {
        size_t k = b->told[i] & (room - 1);
        while (t[k]) k = (k + 1) & (room - 1);
        t[k] = b->told[i];
      }
    vs_store_realloc(b->store, b->told, b->told_room * sizeof *t, 0);
    b->told = t, b->told_room = room;
  }
  size_t k = key & (b->told_room - 1);
  while (b->told[k] && b->told[k] != key) k = (k + 1) & (b->told_room - 1);
  if (b->told[k] == key) return true;
  b->told[k] = key, b->told_count++;
  return false;
}

bool vs_bind_warned(vs_bind *b, const vs_origin *o, const char *kind) {
  /* The key is a hash of the place and the kind of warning, without the callers: calls from several callers count as
   * one place. */
  uint64_t key = o ? ((uint64_t)o->line << 20 | o->column) ^ (uint64_t)(uintptr_t)o->file : 0;
  for (const char *c = kind; *c; c++) key = (key ^ (unsigned char)*c) * UINT64_C(0x100000001B3);
  key ^= key >> 31;
  return told(b, key);
}

void vs_bind_clear(vs_bind *b, const char *kind) {
  if (b->job.warn) vs_bind_warned(b, vs_bind_origin(b), kind);
}

void vs_bind_warn(vs_bind *b, const char *kind, const char *format, ...) {
  const vs_origin *o = vs_bind_origin(b);
  if (!b->job.warn || vs_bind_warned(b, o, kind)) return;
  char text[512];
  va_list args;
  va_start(args, format);
  vsnprintf(text, sizeof text, format, args);
  va_end(args);
  vs_job_warn(&b->job, o, text);
}
