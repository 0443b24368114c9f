/* Declares the index of boxes: all pairs that meet, and all boxes that meet a given one. It finds candidates only;
 * other files test and cut them. */
#ifndef VS_KERNEL_MESH_BVH_H
#define VS_KERNEL_MESH_BVH_H

#include "kernel/memory.h"

#include <string.h>

typedef struct { int32_t min[3], max[3]; } vs_bvh_box;

/* without branches: the comparison that fails is as good as random */
static inline bool vs_box_meet(const vs_bvh_box *a, const vs_bvh_box *b) {
  return (a->min[0] <= b->max[0]) & (b->min[0] <= a->max[0]) & (a->min[1] <= b->max[1]) & (b->min[1] <= a->max[1]) &
         (a->min[2] <= b->max[2]) & (b->min[2] <= a->max[2]);
}

/* Four boxes side by side, tested at once; in an empty lane the minimum exceeds the maximum. */
typedef int32_t vs_lanes __attribute__((vector_size(16)));
typedef struct { vs_lanes min[3], max[3]; } vs_pack;

static const vs_bvh_box vs_box_nowhere = { { INT32_MAX, INT32_MAX, INT32_MAX }, { INT32_MIN, INT32_MIN, INT32_MIN } };
/* Sets one of the four boxes. */
static inline void vs_pack_put(vs_pack *p, uint32_t lane, const vs_bvh_box *b) {
  VS_ASSERT(lane < 4);
  for (int j = 0; j < 3; j++) p->min[j][lane] = b->min[j], p->max[j][lane] = b->max[j];
}
/* Return the lanes whose box meets the given one, or contains it: all bits of a lane are set, or none. */
/* in the form that machines compare: greater, or not */
static inline vs_lanes vs_pack_meeting(const vs_pack *p, const vs_bvh_box *b) {
  return ~((p->min[0] > b->max[0]) | (p->max[0] < b->min[0]) | (p->min[1] > b->max[1]) | (p->max[1] < b->min[1]) |
           (p->min[2] > b->max[2]) | (p->max[2] < b->min[2]));
}
/* with a margin on all sides */
static inline vs_lanes vs_pack_holding(const vs_pack *p, const vs_bvh_box *b) {
  return (p->min[0] < b->min[0]) & (p->max[0] > b->max[0]) & (p->min[1] < b->min[1]) & (p->max[1] > b->max[1]) &
         (p->min[2] < b->min[2]) & (p->max[2] > b->max[2]);
}
static inline uint32_t vs_pack_bits(vs_lanes all) { /* returns bit i for lane i */
  uint64_t half[2];
  all &= (vs_lanes){ 1, 2, 4, 8 };
  memcpy(half, &all, sizeof half);
  half[0] |= half[1];
  return (uint32_t)(half[0] | half[0] >> 32);
}

/* The items in Morton order, four to a pack of level 0; a pack of level l+1 has the boxes around four packs of level
 * l. */
typedef struct {
  const vs_bvh_box *boxes;      /* the caller's, in the caller's order; used during the build only */
  const uint32_t *families; /* the caller's: two items of one family are no pair; UINT32_MAX: the item has no family. Or
                             * NULL. Set before the build and used during it */
  uint32_t *order;          /* the caller's item numbers, sorted */
  vs_pack *packs;
  vs_lanes *family;         /* the families of items, and the common family below each lane of a pack; -1: none or
                             * several. Empty without families */
  size_t order_room, pack_room, family_room;
  uint32_t count, level_count, first[18]; /* first[l]: first pack of level l */
  uint32_t size[18];
  bool has_families;
} vs_bvh;

typedef bool vs_bvh_pair_fn(void *context, uint32_t a, uint32_t b); /* returns false to stop the query */
typedef bool vs_bvh_hit_fn(void *context, uint32_t a);

/* tree: zeroed, or built before (the build reuses its memory) */
bool vs_bvh_build(vs_kernel *k, vs_bvh *tree, const vs_bvh_box *boxes, uint32_t count);
uint32_t vs_bvh_blocks(const vs_bvh *tree);
/* Calls fn once for each unordered pair, if the ranges of blocks [first, end) cover all; a larger end is the last
 * block. */
bool vs_bvh_pairs(const vs_bvh *tree, uint32_t first, uint32_t end, vs_bvh_pair_fn *fn, void *context);
bool vs_bvh_query(const vs_bvh *tree, const vs_bvh_box *box, vs_bvh_hit_fn *fn, void *context);
void vs_bvh_free(vs_kernel *k, vs_bvh *tree);

#endif
