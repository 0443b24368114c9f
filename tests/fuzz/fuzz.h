/* Owns what the fuzzers share: an interpreter of an untrusted model under limits, which is made anew now and then. */
#ifndef VS_FUZZ_H
#define VS_FUZZ_H

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "visualscheme.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

typedef struct { const uint8_t *at; size_t size; } fuzz_file; /* what every path names */

static inline bool fuzz_drop(void *context, const char *text, size_t length) { return (void)context, (void)text, (void)length, true; }
static inline bool fuzz_drop_bytes(void *context, const void *bytes, size_t count) { return (void)context, (void)bytes, (void)count, true; }
static inline void fuzz_value(void *context, const char *text, size_t length) { (void)context, (void)text, (void)length; }
static inline void fuzz_told(void *context, const vs_diagnostic *d) {
  (void)context;
  if (!d->message || strlen(d->message) > 100000) abort();
}
static inline bool fuzz_read(void *context, const char *path, char **text, size_t *length, const char **why) {
  const fuzz_file *f = context;
  (void)path;
  *why = "none";
  if (!f->at || !(*text = malloc(f->size + 1))) return false;
  memcpy(*text, f->at, f->size);
  *length = f->size;
  return true;
}

/* The same one for TURNS inputs, each of which begins anew. */
static inline vs_scheme *fuzz_interpreter(fuzz_file *file) {
  enum { TURNS = 2000 };
  static vs_scheme *s;
  static int turn;
  if (s && ++turn % TURNS == 0) vs_free(s), s = NULL;
  if (s) {
    vs_restart(s);
    return s;
  }
  vs_options o = vs_options_default();
  o.untrusted = true;
  o.limit_steps = 20000, o.limit_memory = 64 << 20, o.limit_output = 1 << 20, o.limit_time = 5, o.limit_triangles = 20000, o.cache = 1 << 20;
  o.host = (vs_host){ .context = file, .output = fuzz_drop, .diagnose = fuzz_told, .value = fuzz_value, .read_file = fuzz_read };
  if (!(s = vs_new(&o))) abort();
  return s;
}

#endif
