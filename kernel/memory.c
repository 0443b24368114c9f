/* Implements the context of the kernel (memory.h): counts its memory, records its error and polls for interrupts. */
#include "kernel/memory.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool vs_kernel_fail(vs_kernel *k, vs_kernel_status status, uint32_t leaf, const char *format, ...) {
  if (k->error->status != VS_KERNEL_FINE) return false; /* keeps an earlier error, because later errors may be its
                                                         * consequences */
  k->error->status = status;
  k->error->leaf = leaf;
  va_list rest;
  va_start(rest, format);
  vsnprintf(k->error->message, sizeof k->error->message, format, rest);
  va_end(rest);
  return false;
}

bool vs_kernel_no_memory(vs_kernel *k) {
  return vs_kernel_fail(k, VS_KERNEL_OUT_OF_MEMORY, 0, "out of memory while combining solids");
}

bool vs_kernel_on_the_way(vs_kernel *k, size_t pieces) {
  size_t limit = k->options ? k->options->max_triangles : 0;
  return !limit || pieces / VS_ON_THE_WAY <= limit ||
         vs_kernel_fail(
             k, VS_KERNEL_LIMIT, 0,
             "the shapes are cut into more than %zu pieces, %d times the limit of %zu triangles for the result",
             limit * VS_ON_THE_WAY, VS_ON_THE_WAY, limit);
}

bool vs_kernel_grow(vs_kernel *k, void *slot, size_t *room, size_t need, size_t size) {
  VS_ASSERT(size > 0);
  if (need <= *room) return true;
  size_t more = *room < 16 ? 16 : *room + *room / 2;
  if (more < need) more = need;
  size_t added = (more - *room) * size;
  if (more > SIZE_MAX / size)
    return vs_kernel_no_memory(k);
  _Atomic size_t *bytes = k->owner ? &k->owner->bytes : &k->bytes;
  if (k->options && k->options->max_bytes && *bytes + added > k->options->max_bytes)
    return vs_kernel_no_memory(k);
  void *old, *grown;
  memcpy(&old, slot, sizeof old); /* slot is the address of a pointer whose type is unknown here, so memcpy reads the
                                   * pointer */
  grown = realloc(old, more * size);
  if (!grown) return vs_kernel_no_memory(k);
  memcpy(slot, &grown, sizeof grown);
  size_t now = atomic_fetch_add(bytes, added) + added; /* number of allocated bytes after this call; other threads may
                                                        * have added more in the meantime */
  _Atomic size_t *peak = k->owner ? &k->owner->peak : &k->peak;
  if (now > *peak) *peak = now;
  *room = more;
  return true;
}

void vs_kernel_free(vs_kernel *k, void *slot, size_t *room, size_t size) {
  void *old, *none = NULL;
  VS_ASSERT(*(k->owner ? &k->owner->bytes : &k->bytes) >= *room * size);
  memcpy(&old, slot, sizeof old);
  free(old);
  memcpy(slot, &none, sizeof none);
  *(k->owner ? &k->owner->bytes : &k->bytes) -= *room * size;
  *room = 0;
}

bool vs_kernel_report(vs_kernel *k, double part) {
  VS_ASSERT(part >= 0 && part <= 1);
  if (k->owner) return !atomic_load(&k->owner->stop);
  k->part = part;
  if (!k->options || vs_job_done(k->options->job, k->done + k->share * part)) return true;
  return vs_kernel_fail(k, VS_KERNEL_INTERRUPTED, 0, "interrupted while combining solids");
}

void vs_kernel_sort(uint32_t *at, uint32_t *scratch, size_t count, vs_less_fn *less, const void *context) {
  enum { RUN = 8 };
  for (size_t lo = 0; lo < count; lo += RUN) {
    size_t hi = lo + RUN < count ? lo + RUN : count;
    for (size_t i = lo + 1; i < hi; i++) {
      uint32_t x = at[i];
      size_t j = i;
      for (; j > lo && less(context, x, at[j - 1]); j--) at[j] = at[j - 1];
      at[j] = x;
    }
  }
  for (size_t width = RUN; width < count; width *= 2) {
    for (size_t lo = 0; lo + width < count; lo += 2 * width) {
      size_t mid = lo + width, hi = mid + width < count ? mid + width : count;
      if (!less(context, at[mid], at[mid - 1])) continue;
      memcpy(scratch, at + lo, (mid - lo) * sizeof *at);
      size_t i = 0, n = mid - lo, j = mid, o = lo;
      while (i < n && j < hi) at[o++] = less(context, at[j], scratch[i]) ? at[j++] : scratch[i++];
      while (i < n) at[o++] = scratch[i++];
    }
  }
}
