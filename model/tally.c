/* Implements the account of a run (tally.h): counts the time and memory of each phase. */
#define _POSIX_C_SOURCE 200809L
#include "model/tally.h"

#include <time.h>

double vs_clock(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

vs_work_phase vs_tally_enter(vs_tally *t, vs_work_phase p) {
  if (!t) return p;
  vs_work_phase was = t->now;
  if (was == p) return was;
  double now = vs_clock();
  vs_phase_use *u = &t->of[was];
  u->seconds += now - t->since;
  u->growth += (double)*t->held - (double)t->from;
  if (t->high > u->peak) u->peak = t->high;
  if (t->high > t->peak) t->peak = t->high;
  t->now = p;
  t->since = now;
  t->from = t->high = *t->held;
  return was;
}

void vs_tally_also(vs_tally *t, size_t bytes) {
  if (t && *t->held + bytes > t->of[t->now].peak) t->of[t->now].peak = *t->held + bytes;
}

size_t vs_tally_peak(const vs_tally *t) { return t->high > t->peak ? t->high : t->peak; }
