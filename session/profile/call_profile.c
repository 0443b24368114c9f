/* Samples the calls of a running program. A sample adds the time since the previous sample to a node of a tree: the
 * running procedure, whose parent is its caller. Time in the library counts for the program's call that led there.
 *
 * Samples are taken after a number of calls, not of seconds. */
#include "session/profile/call_profile.h"

#include <stdlib.h>
#include <string.h>

#include "bind/origins.h"
#include "session/host.h"
#include "session/report.h"
#include "vm/machine/activation.h"
#include "vm/machine/poll.h"

enum { SLOTS = 8192, DEPTH = 200, MOST_CALLS = 1 << 20, TURNS = 1000 /* TURNS: number of calls and loop iterations
                                                                      * between two samples */ };

/* A node of the tree of calls. name: a symbol, or another value if the procedure has no name. caller: 1 + index of the
 * calling node, or 0 at top level. The member next is 1 + index of the next node with an equal hash, or 0. */
typedef struct { vs_value name; vs_pos place; uint32_t caller, next; double seconds, bytes; } call;

/* Sums over all calls of a procedure. own: seconds in the procedure itself; whole: seconds with the procedures that it
 * calls. */
typedef struct { vs_value name; vs_pos place; double own, whole; uint32_t stamp; } row;

typedef struct vs_call_profile {
  call *calls; size_t count, room;
  row *rows; size_t row_count, row_room;
  size_t summed;            /* number of samples that the rows include */
  size_t looks;
  double looked, allocated; /* at the last sample: clock in seconds, and number of bytes allocated so far */
  double whole;             /* sum of the seconds that all samples cover */
  uint32_t slots[SLOTS];
} profile;

static double allocated(const vs_scheme *vm) {
  return (double)vm->collections * (double)vm->nursery_bytes + (double)(vm->free - vm->nursery);
}

/* Enlarges the array at *at if it has no room for one more element. Returns false when memory is out. */
static bool grow(vs_session *s, void **at, size_t *room, size_t count, size_t size) {
  if (count < *room) return true;
  size_t more = *room ? 2 * *room : 256;
  void *grown = vs_session_memory(s, *at, *room * size, more * size);
  if (!grown) return false;
  *at = grown, *room = more;
  return true;
}

/* ---- taking samples ---- */

/* Returns 1 + the index of the node with this caller, name and place, or 0 when memory is out. Adds the node if it is
 * missing. */
static uint32_t call_below(vs_session *s, uint32_t caller, vs_value name, vs_pos place) {
  profile *p = s->profile;
  uint64_t key = (name ^ (uint64_t)place * UINT64_C(0x9E3779B97F4A7C15)) + caller;
  uint32_t *slot = &p->slots[(key * UINT64_C(0xD6E8FEB86659FD93)) >> 51];
  for (uint32_t i = *slot; i; i = p->calls[i - 1].next) {
    const call *c = &p->calls[i - 1];
    if (c->caller == caller && c->name == name && c->place == place) return i;
  }
  if (p->count == MOST_CALLS || !grow(s, (void **)&p->calls, &p->room, p->count, sizeof *p->calls)) return 0;
  p->calls[p->count++] = (call){ .name = name, .place = place, .caller = caller, .next = *slot };
  return *slot = (uint32_t)p->count;
}

void vs_session_look(vs_session *s) {
  vs_scheme *vm = s->bind.vm;
  profile *p = s->profile;
  vs_value name[DEPTH];
  vs_pos place[DEPTH];
  size_t n = vs_call_links(vm, name, place, DEPTH);
  double now = vs_session_clock(s), bytes = allocated(vm), took = now - p->looked, made = bytes - p->allocated;
  p->looked = now, p->allocated = bytes;
  uint32_t at = 0;
  while (n--)
    if (vs_pos_file(place[n]) >= s->bind.library_files) {
      at = call_below(s, at, vs_is_symbol(name[n]) ? name[n] : VS_FALSE, place[n]);
      if (!at) return;
    }
  if (!at) return;
  p->looks++;
  p->calls[at - 1].seconds += took;
  p->calls[at - 1].bytes += made > 0 ? made : 0;
  p->whole += took;
}

void vs_session_resume_profile(vs_session *s) {
  if (!s->profiling) return;
  s->profile->looked = vs_session_clock(s), s->profile->allocated = allocated(s->bind.vm);
}

void vs_session_forget_profile(vs_session *s) {
  profile *p = s->profile;
  s->profiling = false;
  s->profile = NULL;
  if (!p) return;
  vs_session_memory(s, p->calls, p->room * sizeof *p->calls, 0);
  vs_session_memory(s, p->rows, p->row_room * sizeof *p->rows, 0);
  vs_session_memory(s, p, sizeof *p, 0);
}

void vs_profile(vs_scheme *vm, bool on) {
  vs_session *s = vs_session_of(vm);
  if (on) {
    vs_session_forget_profile(s);
    s->profile = vs_session_memory(s, NULL, 0, sizeof *s->profile);
    if (s->profile) memset(s->profile, 0, sizeof *s->profile);
  }
  s->profiling = on && s->profile;
  vm->poll_turns = s->profiling ? TURNS : 0;
  vs_session_resume_profile(s);
}

/* ---- reporting ---- */

static row *row_of(vs_session *s, const call *c) {
  profile *p = s->profile;
  for (size_t i = 0; i < p->row_count; i++)
    if (p->rows[i].name == c->name) return &p->rows[i];
  if (!grow(s, (void **)&p->rows, &p->row_room, p->row_count, sizeof *p->rows)) return NULL;
  p->rows[p->row_count] = (row){ .name = c->name, .place = c->place };
  return &p->rows[p->row_count++];
}

static int most_own(const void *a, const void *b) {
  const row *x = a, *y = b;
  if (x->own != y->own) return x->own < y->own ? 1 : -1;
  return x->whole < y->whole ? 1 : x->whole > y->whole ? -1 : x->place < y->place ? -1 : x->place > y->place;
}

/* Sums the calls of each procedure that has a name. In each sample, a procedure that calls itself counts only once. */
static void sum_rows(vs_session *s) {
  profile *p = s->profile;
  p->row_count = 0, p->summed = p->looks;
  for (size_t i = 0; i < p->count; i++) {
    bool first = true;
    for (size_t k = i + 1; k && p->calls[i].seconds > 0; k = p->calls[k - 1].caller) {
      row *r = vs_is_symbol(p->calls[k - 1].name) ? row_of(s, &p->calls[k - 1]) : NULL;
      if (!r || r->stamp == i + 1) continue;
      r->stamp = (uint32_t)i + 1;
      r->whole += p->calls[i].seconds;
      if (first) r->own += p->calls[i].seconds;
      first = false;
    }
  }
  qsort(p->rows, p->row_count, sizeof *p->rows, most_own);
}

bool vs_profile_get(vs_scheme *vm, size_t index, vs_profile_info *out, size_t *looks) {
  vs_session *s = vs_session_of(vm);
  profile *p = s->profile;
  *looks = p ? p->looks : 0;
  if (p && p->summed != p->looks) sum_rows(s);
  if (!p || index >= p->row_count) return false;
  const row *r = &p->rows[index];
  *out = (vs_profile_info){ .procedure = vs_as_symbol(r->name)->name, .own = r->own / p->whole,
                            .whole = r->whole / p->whole };
  vs_session_span(s, r->place, &out->at);
  return true;
}

bool vs_profile_call(vs_scheme *vm, size_t index, vs_profile_call_info *out) {
  vs_session *s = vs_session_of(vm);
  if (!s->profile || index >= s->profile->count) return false;
  const call *c = &s->profile->calls[index];
  *out = (vs_profile_call_info){ .procedure = vs_is_symbol(c->name) ? vs_as_symbol(c->name)->name : "",
                                 .caller = c->caller, .seconds = c->seconds, .bytes = c->bytes };
  vs_session_span(s, c->place, &out->at);
  return true;
}
