/* Implements the bounding volume hierarchy: a complete tree over the boxes in the Morton order of their centres. Each
 * node has four children.
 *
 * The build costs a radix sort and one pass from the leaves to the root. A query for pairs descends from the root once
 * for every four blocks of four boxes. It takes n log n steps if each box intersects few others. Items of one family
 * need no test against each other. If all boxes below a node have one family, queries from blocks of that family skip
 * the node. Therefore n triangles around one corner, whose boxes all intersect there, also take n log n. */
#include "kernel/mesh/bvh.h"

#include <string.h>

#include "kernel/threads.h"

enum { BLOCK = 4, STACK = 64 };

static uint64_t spread(uint64_t x) { /* moves the 21 bits of x to every third position, for a Morton code */
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffffu;
  x = (x | x << 16) & 0x1f0000ff0000ffu;
  x = (x | x << 8) & 0x100f00f00f00f00fu;
  x = (x | x << 4) & 0x10c30c30c30c30c3u;
  return (x | x << 2) & 0x1249249249249249u;
}

enum { AXIS_BITS = 10 }; /* greatest number of bits per axis, so that the Morton code and the item's number fit into 64
                          * bits */

static int length(uint64_t x) { return x ? 64 - __builtin_clzll(x) : 0; }

/* Returns the number of low bits to omit from all coordinates of the Morton codes. The remaining bits suffice to
 * distinguish `count` boxes, with a few more bits for regions with many boxes. */
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

enum { CHUNK = 1 << 14, MANY = 1 << 16 /* CHUNK: number of boxes that one task handles; MANY: number of boxes from which
                                        * several threads work */ };

typedef struct {
  vs_bvh *t;
  uint64_t *code;       /* code[i]: Morton code of a box in the high 32 bits, the item's number in the low 32 bits */
  int64_t low[3];
  int shift;
} coding;

static uint32_t chunk_end(const vs_bvh *t, size_t index) {
  return (index + 1) * CHUNK < t->count ? (uint32_t)(index + 1) * CHUNK : t->count;
}

static bool code_chunk(vs_kernel *k, void *context, size_t index) {
  (void)k;
  coding *c = context;
  for (uint32_t i = (uint32_t)index * CHUNK, end = chunk_end(c->t, index); i < end; i++) {
    const vs_bvh_box *b = &c->t->boxes[i];
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
  for (uint32_t i = (uint32_t)index * CHUNK, end = chunk_end(t, index); i < end; i += BLOCK) {
    vs_pack p;
    for (uint32_t lane = 0; lane < BLOCK; lane++) {
      uint32_t item = i + lane < end ? (uint32_t)c->code[i + lane] : UINT32_MAX;
      if (item != UINT32_MAX) t->order[i + lane] = item;
      vs_pack_put(&p, lane, item == UINT32_MAX ? &vs_box_nowhere : &t->boxes[item]);
      if (t->families) t->family[i / BLOCK][lane] = item == UINT32_MAX ? -1 : (int32_t)t->families[item];
    }
    t->packs[i / BLOCK] = p;
  }
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

static vs_bvh_box around(const vs_pack *p) {
  vs_bvh_box b;
  for (int j = 0; j < 3; j++) {
    b.min[j] = p->min[j][0];
    b.max[j] = p->max[j][0];
    for (int lane = 1; lane < BLOCK; lane++) {
      if (p->min[j][lane] < b.min[j]) b.min[j] = p->min[j][lane];
      if (p->max[j][lane] > b.max[j]) b.max[j] = p->max[j][lane];
    }
  }
  return b;
}

/* Returns the family of all items below the given block of the tree. Returns -1 if they have several families, or an
 * item has no family. The tree must have this level. */
static int32_t family_below(const vs_bvh *t, uint32_t level, uint32_t block) {
  uint32_t all = level ? t->size[level - 1] : t->count,
           held = all - block * BLOCK < BLOCK ? all - block * BLOCK : BLOCK;
  const vs_lanes *of = &t->family[t->first[level] + block];
  int32_t family = (*of)[0];
  VS_ASSERT(level < t->level_count);
  for (uint32_t lane = 1; lane < held; lane++)
    if ((*of)[lane] != family) return -1;
  return family;
}

bool vs_bvh_build(vs_kernel *k, vs_bvh *t, const vs_bvh_box *boxes, uint32_t count) {
  uint32_t n = (count + BLOCK - 1) / BLOCK, all = 0;
  t->boxes = boxes;
  t->count = count;
  t->level_count = 0;
  t->has_families = t->families != NULL;
  for (uint32_t size = n; size; size = size > 1 ? (size + BLOCK - 1) / BLOCK : 0) {
    t->first[t->level_count] = all;
    t->size[t->level_count++] = size;
    all += size;
  }
  bool ok = VS_ROOM(k, t->order, t->order_room, (size_t)count + 1) &&
            VS_ROOM(k, t->packs, t->pack_room, (size_t)all + 1) &&
            (!t->families || VS_ROOM(k, t->family, t->family_room, (size_t)all + 1)) && sort_morton(k, t);
  for (uint32_t level = 1; ok && level < t->level_count; level++) {
    const vs_pack *below = t->packs + t->first[level - 1];
    vs_pack *to = t->packs + t->first[level];
    memset(to[t->size[level] - 1].min, 0x7f, sizeof to->min); /* fills the last pack with empty boxes, because it may
                                                               * have fewer than four boxes */
    memset(to[t->size[level] - 1].max, 0x80, sizeof to->max);
    for (uint32_t i = 0; i < t->size[level - 1]; i++) {
      vs_bvh_box b = around(&below[i]);
      vs_pack_put(&to[i / BLOCK], i % BLOCK, &b);
      if (t->families) t->family[t->first[level] + i / BLOCK][i % BLOCK] = family_below(t, level - 1, i);
    }
  }
  t->boxes = NULL;
  t->families = NULL;
  return ok;
}

/* Returns box number `lane` (0 to 3) of the pack. */
static vs_bvh_box box_of(const vs_pack *p, uint32_t lane) {
  VS_ASSERT(lane < BLOCK);
  return (vs_bvh_box){ { p->min[0][lane], p->min[1][lane], p->min[2][lane] },
                   { p->max[0][lane], p->max[1][lane], p->max[2][lane] } };
}

/* Removes the lowest bit from *set, which is not 0, and returns the number of that bit. */
static uint32_t next_bit(uint32_t *set) {
  uint32_t lane = (uint32_t)__builtin_ctz(*set);
  VS_ASSERT(*set != 0);
  *set &= *set - 1;
  return lane;
}

/* A traversal of the tree's blocks from number `from` on, in order. It visits the blocks that have a box that
 * intersects `box`. */
typedef struct {
  const vs_bvh *t;
  vs_bvh_box box;
  uint32_t from;
  int32_t family; /* family whose items are skipped: the traversal omits blocks that contain only items of this family;
                   * -1: nothing is skipped */
  struct { uint32_t level, i; } stack[STACK];
  int top;
} descent;

static void begin(descent *d, const vs_bvh *t, const vs_bvh_box *box, uint32_t from, int32_t family) {
  d->t = t;
  d->box = *box;
  d->from = from;
  d->family = family;
  d->top = 0;
  if (t->level_count) d->stack[d->top].level = t->level_count - 1, d->stack[d->top++].i = 0;
}

/* Finds the next block of the traversal, and sets *block to its number. Bit i of *met is set if box i of the block
 * intersects d->box. Returns false at the end. */
static bool next(descent *d, uint32_t *block, uint32_t *met) {
  const vs_bvh *t = d->t;
  while (d->top) {
    uint32_t level = d->stack[--d->top].level, i = d->stack[d->top].i;
    vs_lanes meeting = vs_pack_meeting(&t->packs[t->first[level] + i], &d->box);
    if (d->family != -1) meeting &= t->family[t->first[level] + i] != d->family;
    uint32_t set = vs_pack_bits(meeting);
    if (level == 0) {
      *block = i;
      *met = set;
      if (set) return true;
      continue;
    }
    for (uint32_t lane = BLOCK; lane-- > 0;) { /* avoids a branch: writes every child to the stack, and advances the top
                                                * only if the child is to be visited */
      uint32_t below = i * BLOCK + lane;
      d->stack[d->top].level = level - 1;
      d->stack[d->top].i = below;
      d->top += (int)(set >> lane & (((uint64_t)below + 1) << (2 * (level - 1)) > d->from));
    }
  }
  return false;
}

uint32_t vs_bvh_blocks(const vs_bvh *t) { return t->level_count ? t->size[0] : 0; }

bool vs_bvh_pairs(vs_kernel *k, const vs_bvh *t, uint32_t first, uint32_t end, vs_bvh_pair_fn *fn, void *context) {
  enum { GROUP = 4 }; /* number of neighbouring blocks for which one traversal of the tree finds the pairs */
  uint32_t blocks = vs_bvh_blocks(t), block, met;
  if (end > blocks) end = blocks;
  for (uint32_t from = first; from < end; from += GROUP) {
    uint32_t stop = from + GROUP < end ? from + GROUP : end;
    vs_bvh_box all = around(&t->packs[from]);
    for (uint32_t a = from + 1; a < stop; a++) {
      vs_bvh_box b = around(&t->packs[a]);
      for (int j = 0; j < 3; j++) {
        if (b.min[j] < all.min[j]) all.min[j] = b.min[j];
        if (b.max[j] > all.max[j]) all.max[j] = b.max[j];
      }
    }
    int32_t family = t->has_families ? family_below(t, 0, from) : -1;
    for (uint32_t a = from + 1; family != -1 && a < stop; a++)
      if (family_below(t, 0, a) != family) family = -1;
    descent d;
    begin(&d, t, &all, from, family);
    while (next(&d, &block, &met)) {
      if (!vs_kernel_poll(k, k->part)) return false;
      for (uint32_t left = met; left;) {
        uint32_t j = next_bit(&left);
        vs_bvh_box box = box_of(&t->packs[block], j);
        for (uint32_t a = from; a < stop && a <= block; a++) {
          vs_lanes meets = vs_pack_meeting(&t->packs[a], &box);
          if (t->has_families) {
            int32_t own = t->family[block][j];
            if (own != -1) meets &= t->family[a] != own;
          }
          for (uint32_t set = vs_pack_bits(meets) & (a == block ? (1u << j) - 1 : 15); set;)
            if (!fn(context, t->order[a * BLOCK + next_bit(&set)], t->order[block * BLOCK + j])) return false;
        }
      }
    }
  }
  return true;
}

bool vs_bvh_query(const vs_bvh *t, const vs_bvh_box *box, vs_bvh_hit_fn *fn, void *context) {
  descent d;
  uint32_t block, met;
  begin(&d, t, box, 0, -1);
  while (next(&d, &block, &met))
    while (met)
      if (!fn(context, t->order[block * BLOCK + next_bit(&met)])) return false;
  return true;
}

void vs_bvh_free(vs_kernel *k, vs_bvh *t) {
  VS_FREE(k, t->order, t->order_room);
  VS_FREE(k, t->packs, t->pack_room);
  VS_FREE(k, t->family, t->family_room);
  t->count = t->level_count = 0;
}
