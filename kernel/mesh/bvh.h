/* Owns the index of boxes: all pairs that meet, and all that a box meets. It only finds candidates; nothing is ever cut
 * by it. */
#ifndef VS_KERNEL_MESH_BVH_H
#define VS_KERNEL_MESH_BVH_H

#include "kernel/memory.h"

#include <string.h>

typedef struct { int32_t min[3], max[3]; } vs_bvh_box;

/* without a jump: which of them fails is as good as random */
static inline bool vs_box_meet(const vs_bvh_box *a, const vs_bvh_box *b) {
  return (a->min[0] <= b->max[0]) & (b->min[0] <= a->max[0]) & (a->min[1] <= b->max[1]) & (b->min[1] <= a->max[1]) &
         (a->min[2] <= b->max[2]) & (b->min[2] <= a->max[2]);
}

/* Four boxes side by side, tested at once; one that is missing has its sides the wrong way round. */
typedef int32_t vs_lanes __attribute__((vector_size(16)));
typedef struct { vs_lanes min[3], max[3]; } vs_pack;

static const vs_bvh_box vs_box_nowhere = { { INT32_MAX, INT32_MAX, INT32_MAX }, { INT32_MIN, INT32_MIN, INT32_MIN } };
/* Makes the box one of the four. */
static inline void vs_pack_put(vs_pack *p, uint32_t lane, const vs_bvh_box *b) {
  VS_ASSERT(lane < 4);
  for (int j = 0; j < 3; j++) p->min[j][lane] = b->min[j], p->max[j][lane] = b->max[j];
}
/* Which of the four meet the box, and which hold it; all bits of a lane are set, or none. */
/* as machines compare: greater, or not */
static inline vs_lanes vs_pack_meeting(const vs_pack *p, const vs_bvh_box *b) {
  return ~((p->min[0] > b->max[0]) | (p->max[0] < b->min[0]) | (p->min[1] > b->max[1]) | (p->max[1] < b->min[1]) |
           (p->min[2] > b->max[2]) | (p->max[2] < b->min[2]));
}
/* with something to spare on all sides */
static inline vs_lanes vs_pack_holding(const vs_pack *p, const vs_bvh_box *b) {
  return (p->min[0] < b->min[0]) & (p->max[0] > b->max[0]) & (p->min[1] < b->min[1]) & (p->max[1] > b->max[1]) &
         (p->min[2] < b->min[2]) & (p->max[2] > b->max[2]);
}
static inline uint32_t vs_pack_bits(vs_lanes all) { /* lane i: bit i */
  uint64_t half[2];
  all &= (vs_lanes){ 1, 2, 4, 8 };
  memcpy(half, &all, sizeof half);
  half[0] |= half[1];
  return (uint32_t)(half[0] | half[0] >> 32);
}

/* Items in Morton order, four to a pack of level 0; a pack of level l+1 has the boxes around four packs of level l. */
typedef struct {
  const vs_bvh_box *boxes;      /* the caller's, in his order; only while it is built */
  const uint32_t *families; /* his: two of one family are no pair; UINT32_MAX has none. Or NULL. Only while it is built,
                             * set before */
  uint32_t *order;          /* his numbers, sorted */
  vs_pack *packs;
  vs_lanes *family;         /* of the items, and of all below a pack's lane, where they are one; else -1. Only with
                             * families */
  size_t order_room, pack_room, family_room;
  uint32_t count, level_count, first[18]; /* where each level's packs begin */
  uint32_t size[18];
  bool has_families;
} vs_bvh;

typedef bool vs_bvh_pair_fn(void *context, uint32_t a, uint32_t b); /* false stops */
typedef bool vs_bvh_hit_fn(void *context, uint32_t a);

/* tree zeroed, or built before (its room is used again) */
bool vs_bvh_build(vs_kernel *k, vs_bvh *tree, const vs_bvh_box *boxes, uint32_t count);
uint32_t vs_bvh_blocks(const vs_bvh *tree);
/* Each unordered pair once, over all ranges of blocks [first, end); an end past the last is the last. */
bool vs_bvh_pairs(const vs_bvh *tree, uint32_t first, uint32_t end, vs_bvh_pair_fn *fn, void *context);
bool vs_bvh_query(const vs_bvh *tree, const vs_bvh_box *box, vs_bvh_hit_fn *fn, void *context);
void vs_bvh_free(vs_kernel *k, vs_bvh *tree);

#endif
