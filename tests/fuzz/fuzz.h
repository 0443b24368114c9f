/* Contains the common part of the fuzzers: an interpreter that runs an untrusted model under limits. A new interpreter
 * replaces it after a number of inputs. */
#ifndef VS_FUZZ_H
#define VS_FUZZ_H

#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "visualscheme.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

typedef struct {
  const uint8_t *at;
  size_t size;
} fuzz_file; /* contents of the only file of the simulated file system: every path denotes this file */

static inline bool fuzz_drop(void *context, const char *text, size_t length) {
  return (void)context, (void)text, (void)length, true;
}
static inline bool fuzz_drop_bytes(void *context, const void *bytes, size_t count) {
  return (void)context, (void)bytes, (void)count, true;
}
static inline void fuzz_value(void *context, const char *text, size_t length) {
  (void)context, (void)text, (void)length;
}
static inline void fuzz_told(void *context, const vs_diagnostic *d) {
  (void)context;
  if (!d->message || strlen(d->message) > 100000) abort();
  if (getenv("FUZZ_TELL")) fprintf(stderr, "%s\n", d->message);
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

/* The journal: a file with all inputs of an interpreter, since an earlier input may have caused a crash.
 * FUZZ_JOURNAL=FILE names the file, which remains after the crash. `replay -j` reads it. */
typedef struct {
  uint8_t *at;
  size_t used;
} fuzz_journal;
enum { FUZZ_JOURNAL_ROOM = 8 << 20 };

static inline fuzz_journal *fuzz_journal_open(void) {
  static fuzz_journal j;
  static bool asked;
  if (asked) return j.at ? &j : NULL;
  asked = true;
  const char *path = getenv("FUZZ_JOURNAL");
  int f = path ? open(path, O_RDWR | O_CREAT | O_TRUNC, 0666) : -1;
  if (f < 0 || ftruncate(f, FUZZ_JOURNAL_ROOM)) return NULL;
  void *at = mmap(NULL, FUZZ_JOURNAL_ROOM, PROT_READ | PROT_WRITE, MAP_SHARED, f, 0);
  close(f);
  if (at == MAP_FAILED) return NULL;
  j.at = at;
  return &j;
}

/* Appends an input to the journal: its size in four bytes, then its bytes. A size of 0xFFFFFFFF ends the journal. */
static inline void fuzz_note(const uint8_t *data, size_t size, bool anew) {
  fuzz_journal *j = fuzz_journal_open();
  const uint32_t n = (uint32_t)size, none = UINT32_MAX;
  if (!j) return;
  if (anew) j->used = 0;
  if (j->used + size + 2 * sizeof n > FUZZ_JOURNAL_ROOM) return;
  memcpy(j->at + j->used + sizeof n, data, size);
  memcpy(j->at + j->used + sizeof n + size, &none, sizeof n);
  memcpy(j->at + j->used, &n, sizeof n);
  j->used += sizeof n + size;
}

/* Returns a new interpreter for an untrusted model. */
static inline vs_scheme *fuzz_open(fuzz_file *file) {
  vs_options o = vs_options_default();
  o.untrusted = true;
  o.limit_steps = 3000, o.limit_memory = 64 << 20, o.limit_output = 1 << 16, o.limit_time = 5,
  o.limit_triangles = 20000, o.cache = 1 << 20;
  o.host = (vs_host){
    .context = file, .output = fuzz_drop, .diagnose = fuzz_told, .value = fuzz_value, .read_file = fuzz_read
  };
  vs_scheme *s = vs_new(&o);
  if (!s) abort();
  return s;
}

/* Returns the interpreter for the next input. A new interpreter costs more than a small program, so each is used for
 * `turns` inputs. `begin`, if not NULL, is called for each new interpreter. */
static inline vs_scheme *fuzz_interpreter(fuzz_file *file, const uint8_t *data, size_t size, unsigned turns,
                                          const char *begin) {
  enum { LIVES = 100 };
  static vs_scheme *s;
  static unsigned turn, life;
  const bool anew = !s || ++turn >= turns;
  if (s && anew && ++life % LIVES == 0) vs_free(s), s = NULL;
  if (s && anew) vs_restart(s);
  if (!s) s = fuzz_open(file);
  if (anew) turn = 0;
  if (anew && begin && vs_eval_text(s, "begin", 1, begin, strlen(begin), 0) != VS_OUTCOME_DONE) abort();
  fuzz_note(data, size, anew);
  return s;
}

#endif
