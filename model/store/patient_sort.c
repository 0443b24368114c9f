/* Implements an interruptible sort (patient_sort.h): sorts runs with qsort, then merges them, and checks for interrupts
 * between these steps. */
#include <stdlib.h>
#include <string.h>

#include "model/store/patient_sort.h"
#include "model/assert.h"

typedef int sort_compare(const void *, const void *);
typedef struct { const char *at, *end; } sort_run;
typedef struct { size_t size; sort_compare *compare; } sort_order; /* size: number of bytes of an element; compare:
                                                                    * comparison function as for qsort */

/* RUN: number of elements that qsort sorts at once. SORT_WORK: work of merging one element; RUN_WORK: work of sorting
 * one run; both in the unit of vs_store_going (about a nanosecond). */
enum { RUN = 1 << 14, SORT_WORK = 1 << 6, RUN_WORK = 1 << 20 };

/* Merges the sorted runs a and b, in the order `by`, into the memory at `to`. Returns false on an interrupt. */
static bool sort_merge(vs_store *s, sort_run a, sort_run b, char *to, sort_order by, vs_error *e) {
  size_t size = by.size;
  for (; a.at < a.end || b.at < b.end; to += size) {
    if (!vs_store_going(s, SORT_WORK, e)) return false;
    sort_run *from = b.at == b.end || (a.at < a.end && by.compare(a.at, b.at) <= 0) ? &a : &b;
    memcpy(to, from->at, size);
    from->at += size;
  }
  return true;
}

bool vs_store_sort(vs_store *s, void *at, size_t count, size_t size, sort_compare *compare, vs_error *e) {
  if (count <= RUN) {
    if (count > 1) qsort(at, count, size, compare);
    return true;
  }
  char *from = at, *other = vs_store_realloc(s, NULL, 0, count * size), *to = other;
  if (!other) return vs_error_memory(e, NULL);
  bool ok = true;
  for (size_t i = 0; ok && i < count; i += RUN) {
    qsort(from + i * size, count - i < RUN ? count - i : RUN, size, compare);
    ok = vs_store_going(s, RUN_WORK, e);
  }
  for (size_t length = RUN; ok && length < count; length *= 2) {
    for (size_t i = 0; ok && i < count; i += 2 * length) {
      size_t middle = count - i < length ? count : i + length, end = count - middle < length ? count : middle + length;
      sort_run a = { from + i * size, from + middle * size }, b = { from + middle * size, from + end * size };
      ok = sort_merge(s, a, b, to + i * size, (sort_order){ size, compare }, e);
    }
    char *swap = from;
    from = to, to = swap;
  }
  if (ok && from != at) memcpy(at, from, count * size);
  vs_store_realloc(s, other, count * size, 0);
  return ok;
}
