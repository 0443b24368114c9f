/* Sorts directed edges by their two ends. Each task counts the edges of a chunk of items and distributes them into
 * ranges of points. Then each task sorts the edges of a range. Chunks and ranges do not depend on the number of
 * threads. Therefore the order does not depend on it either. */
#include "kernel/mesh/edge_uses.h"

#include <string.h>

#include "kernel/threads.h"

enum { CHUNK = 1 << 15, BLOCK = 256, LEAST = 10 /* CHUNK: number of items whose edges a task distributes; BLOCK: number
                                                 * of items whose edges are read at once; 1 << LEAST: least number of
                                                 * points of a range, which one task sorts */, RANGES = 256 };

typedef struct { uint32_t low, high, item; } loose;

typedef struct {
  vs_halves *h;
  vs_ends_fn *ends;
  const void *context;
  uint32_t items, points;
  VS_LIST(uint32_t) counts; /* for each chunk of items and each range of points: first the number of edges, later the
                             * index where the chunk writes its next edge */
  VS_LIST(uint32_t) begin;  /* begin[r]: index of the first edge of range r; an extra element marks the end */
  VS_LIST(loose) loose;
} sorting;

static bool count_chunk(vs_kernel *k, void *context, size_t chunk) {
  sorting *s = context;
  uint32_t ends[BLOCK][2], *counts = s->counts.at + chunk * s->h->ranges;
  memset(counts, 0, s->h->ranges * sizeof *counts);
  uint32_t begin = (uint32_t)chunk * CHUNK, end = s->items - begin < CHUNK ? s->items : begin + CHUNK;
  for (uint32_t at = begin; at < end; at += BLOCK) {
    uint32_t n = end - at < BLOCK ? end - at : BLOCK;
    s->ends(s->context, at, n, ends);
    for (uint32_t i = 0; i < n; i++)
      if (ends[i][0] != ends[i][1]) counts[(ends[i][0] < ends[i][1] ? ends[i][0] : ends[i][1]) >> s->h->shift]++;
  }
  return vs_kernel_report(k, k->part);
}

static bool scatter_chunk(vs_kernel *k, void *context, size_t chunk) {
  sorting *s = context;
  uint32_t ends[BLOCK][2], *to = s->counts.at + chunk * s->h->ranges;
  uint32_t begin = (uint32_t)chunk * CHUNK, end = s->items - begin < CHUNK ? s->items : begin + CHUNK;
  for (uint32_t at = begin; at < end; at += BLOCK) {
    uint32_t n = end - at < BLOCK ? end - at : BLOCK;
    s->ends(s->context, at, n, ends);
    for (uint32_t i = 0; i < n; i++) {
      uint32_t a = ends[i][0], b = ends[i][1], low = a < b ? a : b;
      if (a != b) s->loose.at[to[low >> s->h->shift]++] = (loose){ low, a < b ? b : a, at + i };
    }
  }
  return vs_kernel_report(k, k->part);
}

static bool before(const vs_half *a, const vs_half *b) {
  return a->high != b->high ? a->high < b->high : a->item < b->item;
}

static bool sort_range(vs_kernel *k, void *context, size_t range) {
  sorting *s = context;
  vs_halves *h = s->h;
  uint32_t from = vs_halves_begin(h, range), end = vs_halves_begin(h, range + 1), low = s->begin.at[range],
           high = s->begin.at[range + 1];
  uint32_t *first = h->first.at + from, n = end - from;
  memset(first, 0, n * sizeof *first); /* clears n elements only, because element n belongs to the next range */
  for (uint32_t i = low; i < high; i++) first[s->loose.at[i].low - from]++;
  /* The loop sets first[p] to the end of the list of point p's edges. Then the edges are filled in from the end, and
   * first[p] decreases to the beginning of the list. */
  for (uint32_t p = 0, sum = low; p < n; p++) {
    sum += first[p];
    first[p] = sum;
  }
  for (uint32_t i = high; i-- > low;) {
    const loose *l = &s->loose.at[i];
    h->at.at[--first[l->low - from]] = (vs_half){ l->high, l->item };
  }
  for (uint32_t p = 0; p < n; p++) {
    vs_half *at = h->at.at + first[p];
    uint32_t count = (p + 1 < n ? first[p + 1] : high) - first[p];
    /* Shell sort: most points have few edges, but some have very many. */
    for (uint32_t gap = count > 32 ? count / 2 : 1; gap && count; gap = gap == 2 ? 1 : (uint32_t)(gap / 2.2))
      for (uint32_t i = gap; i < count; i++) {
        vs_half x = at[i];
        uint32_t j = i;
        for (; j >= gap && before(&x, &at[j - gap]); j -= gap) at[j] = at[j - gap];
        at[j] = x;
      }
  }
  return vs_kernel_report(k, k->part);
}

bool vs_halves_sort(vs_kernel *k, vs_halves *h, uint32_t points, uint32_t items, vs_ends_fn *ends,
                    const void *context) {
  sorting s = { .h = h, .ends = ends, .context = context, .items = items, .points = points };
  size_t chunks = ((size_t)items + CHUNK - 1) / CHUNK;
  h->shift = LEAST;
  while (points >> h->shift >= RANGES) h->shift++;
  h->ranges = (points >> h->shift) + 1;
  h->first.count = (size_t)points + 1;
  bool ok = VS_ROOM(k, h->first.at, h->first.room, h->first.count) &&
            VS_ROOM(k, s.begin.at, s.begin.room, (size_t)h->ranges + 1) &&
            VS_ROOM(k, s.counts.at, s.counts.room, chunks * h->ranges + 1) && vs_kernel_run(k, chunks, count_chunk, &s);
  if (ok) {
    uint32_t sum = 0;
    for (uint32_t r = 0; r < h->ranges; r++) {
      s.begin.at[r] = sum;
      for (size_t i = 0; i < chunks; i++) {
        uint32_t n = s.counts.at[i * h->ranges + r];
        s.counts.at[i * h->ranges + r] = sum;
        sum += n;
      }
    }
    s.begin.at[h->ranges] = h->first.at[points] = sum;
    h->at.count = sum;
    ok = VS_ROOM(k, h->at.at, h->at.room, (size_t)sum + 1) && VS_ROOM(k, s.loose.at, s.loose.room, (size_t)sum + 1) &&
         vs_kernel_run(k, chunks, scatter_chunk, &s) && vs_kernel_run(k, h->ranges, sort_range, &s);
  }
  VS_DROP(k, s.counts);
  VS_DROP(k, s.begin);
  VS_DROP(k, s.loose);
  return ok;
}

void vs_halves_free(vs_kernel *k, vs_halves *h) {
  VS_DROP(k, h->at);
  VS_DROP(k, h->first);
}
