/* Owns the bounding volume hierarchy: a complete tree over the Morton order of the boxes' centres.
 *
 * Cost: a radix sort and one pass up; a pair query walks from the top for every block of four, so n log n for boxes that meet few others. */
#include "kernel/bvh.h"

#include <string.h>

enum { BLOCK = 4, STACK = 80 };

static uint64_t spread(uint64_t x) { /* 21 bits to every third */
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffffu;
  x = (x | x << 16) & 0x1f0000ff0000ffu;
  x = (x | x << 8) & 0x100f00f00f00f00fu;
  x = (x | x << 4) & 0x10c30c30c30c30c3u;
  return (x | x << 2) & 0x1249249249249249u;
}

enum { AXIS_BITS = 10 }; /* at most: code and item fit 64 bits */

static int length(uint64_t x) { return x ? 64 - __builtin_clzll(x) : 0; }

/* By how much coordinates are coarsened, the same along all axes: the rest tells `count` boxes apart, and has some more bits where they crowd. */
static int code_shift(uint32_t count, const int64_t range[3], int *bits) {
  for (int shift = 0;; shift++) {
    int sum = 0;
    *bits = 0;
    for (int j = 0; j < 3; j++) {
      int n = length((uint64_t)range[j] >> shift);
      sum += n;
      if (n > *bits) *bits = n;
    }
    if (*bits <= AXIS_BITS && sum <= length(count) + 10) return shift;
  }
}

enum { CHUNK = 1 << 14, MANY = 1 << 16 /* boxes that are worth threads */ };

typedef struct {
  vs_bvh *t;
  uint64_t *code;       /* code << 32 | item */
  int64_t low[3];
  int shift;
} coding;

static uint32_t chunk_end(const vs_bvh *t, size_t index) { return (index + 1) * CHUNK < t->count ? (uint32_t)(index + 1) * CHUNK : t->count; }

static bool code_chunk(vs_kernel *k, void *context, size_t index) {
  (void)k;
  coding *c = context;
  for (uint32_t i = (uint32_t)index * CHUNK, end = chunk_end(c->t, index); i < end; i++) {
    const vs_box *b = &c->t->boxes[i];
    uint64_t code = 0;
    for (int j = 0; j < 3; j++) code |= spread((uint64_t)((int64_t)b->min[j] + b->max[j] - c->low[j]) >> c->shift) << j;
    c->code[i] = code << 32 | i;
  }
  return true;
}

static bool gather_chunk(vs_kernel *k, void *context, size_t index) {
  (void)k;
  coding *c = context;
  vs_bvh *t = c->t;
  for (uint32_t i = (uint32_t)index * CHUNK, end = chunk_end(t, index); i < end; i++) t->order[i] = (uint32_t)c->code[i], t->sorted[i] = t->boxes[t->order[i]];
  return true;
}

static bool in_chunks(vs_kernel *k, vs_task_fn *task, coding *c) {
  size_t chunks = ((size_t)c->t->count + CHUNK - 1) / CHUNK;
  if (c->t->count >= MANY) return vs_kernel_run(k, chunks, task, c);
  for (size_t i = 0; i < chunks; i++) task(k, c, i);
  return true;
}

static bool sort_morton(vs_kernel *k, vs_bvh *t) {
  enum { DIGIT = 10, FEW = 64, LARGE = 1 << 16 };
  uint64_t *a = NULL, *b = NULL;
  size_t ar = 0, br = 0;
  uint32_t n = t->count;
  bool ok = VS_ROOM(k, a, ar, (size_t)n + 1) && VS_ROOM(k, b, br, (size_t)n + 1);
  if (ok) {
    int64_t low[3] = { INT64_MAX, INT64_MAX, INT64_MAX }, high[3] = { INT64_MIN, INT64_MIN, INT64_MIN };
    for (uint32_t i = 0; i < n; i++)
      for (int j = 0; j < 3; j++) {
        int64_t c = (int64_t)t->boxes[i].min[j] + t->boxes[i].max[j];
        if (c < low[j]) low[j] = c;
        if (c > high[j]) high[j] = c;
      }
    int64_t range[3] = { n ? high[0] - low[0] : 0, n ? high[1] - low[1] : 0, n ? high[2] - low[2] : 0 };
    int bits;
    coding c = { t, a, { low[0], low[1], low[2] }, code_shift(n, range, &bits) };
    ok = in_chunks(k, code_chunk, &c);
    if (n <= FEW) {
      for (uint32_t i = 1; i < n; i++) {
        uint64_t x = a[i];
        uint32_t to = i;
        for (; to > 0 && a[to - 1] > x; to--) a[to] = a[to - 1];
        a[to] = x;
      }
    } else {
      for (int from = 32; from < 32 + 3 * bits; from += DIGIT) {
        uint32_t counts[1 << DIGIT] = { 0 }, sum = 0;
        for (uint32_t i = 0; i < n; i++) counts[a[i] >> from & ((1 << DIGIT) - 1)]++;
        for (int j = 0; j < 1 << DIGIT; j++) {
          uint32_t count = counts[j];
          counts[j] = sum;
          sum += count;
        }
        for (uint32_t i = 0; i < n; i++) b[counts[a[i] >> from & ((1 << DIGIT) - 1)]++] = a[i];
        uint64_t *swap = a;
        a = b;
        b = swap;
        ok = ok && (n < LARGE || vs_kernel_report(k, k->part));
      }
    }
    c.code = a;
    ok = ok && in_chunks(k, gather_chunk, &c);
  }
  VS_FREE(k, a, ar);
  VS_FREE(k, b, br);
  return ok;
}

static vs_box join(const vs_box *a, const vs_box *b) {
  vs_box r = *a;
  for (int j = 0; j < 3; j++) {
    if (b->min[j] < r.min[j]) r.min[j] = b->min[j];
    if (b->max[j] > r.max[j]) r.max[j] = b->max[j];
  }
  return r;
}

bool vs_bvh_build(vs_kernel *k, vs_bvh *t, const vs_box *boxes, uint32_t count) {
  t->boxes = boxes;
  t->count = count;
  t->level_count = 0;
  if (!VS_ROOM(k, t->order, t->order_room, (size_t)count + 1) || !VS_ROOM(k, t->sorted, t->sorted_room, (size_t)count + 1) ||
      !VS_ROOM(k, t->nodes, t->node_room, (size_t)count + 40) || !sort_morton(k, t))
    return false;
  uint32_t n = (count + BLOCK - 1) / BLOCK, at = 0;
  for (uint32_t level = 0; n; level++) {
    t->first[level] = at;
    t->size[level] = n;
    t->level_count = level + 1;
    for (uint32_t i = 0; i < n; i++) {
      if (level == 0) {
        vs_box b = t->sorted[i * BLOCK];
        for (uint32_t j = i * BLOCK + 1; j < count && j < (i + 1) * BLOCK; j++) b = join(&b, &t->sorted[j]);
        t->nodes[at++] = b;
      } else {
        const vs_box *below = t->nodes + t->first[level - 1];
        bool two = 2 * i + 1 < t->size[level - 1];
        t->nodes[at++] = two ? join(&below[2 * i], &below[2 * i + 1]) : below[2 * i];
      }
    }
    if (n == 1) break;
    n = (n + 1) / 2;
  }
  t->boxes = NULL;
  return true;
}

/* Calls visit for every block from `from` on whose box meets `box`. */
#define WALK(t, box, from, visit)                                                                                         \
  do {                                                                                                                   \
    struct { uint32_t level, i; } stack[STACK];                                                                          \
    int top = 0;                                                                                                         \
    if ((t)->level_count) stack[top].level = (t)->level_count - 1, stack[top++].i = 0;                                   \
    while (top) {                                                                                                        \
      uint32_t level_ = stack[--top].level, i_ = stack[top].i;                                                           \
      if ((((uint64_t)i_ + 1) << level_) <= (from) || !vs_box_meet(&(t)->nodes[(t)->first[level_] + i_], (box))) continue; \
      if (level_ == 0) {                                                                                                 \
        uint32_t block = i_;                                                                                             \
        visit                                                                                                            \
      } else {                                                                                                           \
        if (2 * i_ + 1 < (t)->size[level_ - 1]) stack[top].level = level_ - 1, stack[top++].i = 2 * i_ + 1;              \
        stack[top].level = level_ - 1, stack[top++].i = 2 * i_;                                                          \
      }                                                                                                                  \
    }                                                                                                                    \
  } while (0)

static uint32_t block_end(const vs_bvh *t, uint32_t block) { return (block + 1) * BLOCK < t->count ? (block + 1) * BLOCK : t->count; }

uint32_t vs_bvh_blocks(const vs_bvh *t) { return t->level_count ? t->size[0] : 0; }

bool vs_bvh_pairs(const vs_bvh *t, uint32_t first, uint32_t end, vs_bvh_pair_fn *fn, void *context) {
  enum { GROUP = 4 }; /* blocks that go down together */
  uint32_t blocks = vs_bvh_blocks(t);
  if (end > blocks) end = blocks;
  for (uint32_t from = first; from < end; from += GROUP) {
    uint32_t stop = from + GROUP < end ? from + GROUP : end;
    vs_box all = t->nodes[from];
    for (uint32_t a = from + 1; a < stop; a++) all = join(&all, &t->nodes[a]);
    WALK(t, &all, from, {
      for (uint32_t a = from; a < stop && a <= block; a++) {
        if (a != block && !vs_box_meet(&t->nodes[a], &t->nodes[block])) continue;
        for (uint32_t j = block * BLOCK; j < block_end(t, block); j++) {
          if (!vs_box_meet(&t->nodes[a], &t->sorted[j])) continue;
          for (uint32_t i = a * BLOCK, last = block == a ? j : block_end(t, a); i < last; i++)
            if (vs_box_meet(&t->sorted[i], &t->sorted[j]) && !fn(context, t->order[i], t->order[j])) return false;
        }
      }
    });
  }
  return true;
}

bool vs_bvh_query(const vs_bvh *t, const vs_box *box, vs_bvh_hit_fn *fn, void *context) {
  WALK(t, box, 0, {
    for (uint32_t j = block * BLOCK; j < block_end(t, block); j++)
      if (vs_box_meet(&t->sorted[j], box) && !fn(context, t->order[j])) return false;
  });
  return true;
}

void vs_bvh_free(vs_kernel *k, vs_bvh *t) {
  VS_FREE(k, t->order, t->order_room);
  VS_FREE(k, t->sorted, t->sorted_room);
  VS_FREE(k, t->nodes, t->node_room);
  t->count = t->level_count = 0;
}
