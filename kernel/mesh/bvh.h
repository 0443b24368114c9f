/* Declares an index of boxes (bounding volume hierarchy). It finds all pairs of boxes that intersect, and all boxes
 * that intersect a given box. The boxes enclose triangles or patches; other files test and cut these. */
#ifndef VS_KERNEL_MESH_BVH_H
#define VS_KERNEL_MESH_BVH_H

#include "kernel/memory.h"

#include <string.h>

typedef struct { int32_t min[3], max[3]; } vs_bvh_box;

/* combines the comparisons with & instead of &&, because the processor could not predict the branches of && */
static inline bool vs_box_meet(const vs_bvh_box *a, const vs_bvh_box *b) {
  return (a->min[0] <= b->max[0]) & (b->min[0] <= a->max[0]) & (a->min[1] <= b->max[1]) & (b->min[1] <= a->max[1]) &
         (a->min[2] <= b->max[2]) & (b->min[2] <= a->max[2]);
}

/* Four 32-bit integers, for the minima or maxima of four boxes, which are tested at once. A box that is missing has a
 * minimum above its maximum. */
typedef int32_t vs_lanes __attribute__((vector_size(16)));
typedef struct { vs_lanes min[3], max[3]; } vs_pack;

static const vs_bvh_box vs_box_nowhere = { { INT32_MAX, INT32_MAX, INT32_MAX }, { INT32_MIN, INT32_MIN, INT32_MIN } };
/* Sets box number `lane` (0 to 3) of the pack to b. */
static inline void vs_pack_put(vs_pack *p, uint32_t lane, const vs_bvh_box *b) {
  VS_ASSERT(lane < 4);
  for (int j = 0; j < 3; j++) p->min[j][lane] = b->min[j], p->max[j][lane] = b->max[j];
}
/* The functions vs_pack_meeting and vs_pack_holding test the four boxes of a pack p against one box b. Lane i of the
 * result has all bits set if the test is true for box i, and no bit otherwise. */
/* Tests which boxes of p intersect or touch b. The test is negated, because processors have these comparisons. */
static inline vs_lanes vs_pack_meeting(const vs_pack *p, const vs_bvh_box *b) {
  return ~((p->min[0] > b->max[0]) | (p->max[0] < b->min[0]) | (p->min[1] > b->max[1]) | (p->max[1] < b->min[1]) |
           (p->min[2] > b->max[2]) | (p->max[2] < b->min[2]));
}
/* Tests which boxes of p contain b strictly inside. */
static inline vs_lanes vs_pack_holding(const vs_pack *p, const vs_bvh_box *b) {
  return (p->min[0] < b->min[0]) & (p->max[0] > b->max[0]) & (p->min[1] < b->min[1]) & (p->max[1] > b->max[1]) &
         (p->min[2] < b->min[2]) & (p->max[2] > b->max[2]);
}
static inline uint32_t vs_pack_bits(vs_lanes all) { /* converts the lanes of a test to bits: bit i is set if lane i
                                                     * is */
  uint64_t half[2];
  all &= (vs_lanes){ 1, 2, 4, 8 };
  memcpy(half, &all, sizeof half);
  half[0] |= half[1];
  return (uint32_t)(half[0] | half[0] >> 32);
}

/* An index of boxes. The items are in Morton order. Each pack of level 0 contains the boxes of four items. Each pack of
 * level l + 1 contains the bounding boxes of four packs of level l. */
typedef struct {
  const vs_bvh_box *boxes;      /* the caller's boxes, in the caller's order; used only during the build */
  const uint32_t *families; /* families[i]: family of item i, or UINT32_MAX for none; the index never reports two items
                             * of one family as a pair. NULL: there are no families. The caller sets this member before
                             * each build, which resets it to NULL. */
  uint32_t *order;          /* order[i]: number of the item at position i of the Morton order */
  vs_pack *packs;
  vs_lanes *family;         /* family of each item; in higher levels, the family of all items below a lane of a pack;
                             * -1: no family, or several. The list is empty if there are no families. */
  size_t order_room, pack_room, family_room;
  uint32_t count, level_count, first[18]; /* count: number of items; level_count: number of levels; first[l]: index of
                                           * the first pack of level l */
  uint32_t size[18];
  bool has_families;
} vs_bvh;

typedef bool vs_bvh_pair_fn(void *context, uint32_t a, uint32_t b); /* a function that receives a pair of items whose
                                                                     * boxes intersect; returns false to stop the
                                                                     * search */
typedef bool vs_bvh_hit_fn(void *context, uint32_t a);

/* Builds the tree over the boxes. *tree has all bytes 0, or is an earlier tree, whose memory is reused. Returns false
 * when memory is out or the caller interrupts. */
bool vs_bvh_build(vs_kernel *k, vs_bvh *tree, const vs_bvh_box *boxes, uint32_t count);
uint32_t vs_bvh_blocks(const vs_bvh *tree);
/* Calls fn once for each unordered pair of intersecting boxes whose first box lies in a block from `first` to end - 1.
 * Ranges that cover all blocks find every pair. end may exceed the number of blocks. Returns false if fn does, or if
 * the caller of k interrupts: crowded boxes have a quadratic number of pairs. */
bool vs_bvh_pairs(vs_kernel *k, const vs_bvh *tree, uint32_t first, uint32_t end, vs_bvh_pair_fn *fn, void *context);
bool vs_bvh_query(const vs_bvh *tree, const vs_bvh_box *box, vs_bvh_hit_fn *fn, void *context);
void vs_bvh_free(vs_kernel *k, vs_bvh *tree);

#endif
