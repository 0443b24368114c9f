/* Declares the differences between two drawings of one store: parts that are unchanged, moved, changed, added or
 * removed, and solids that show the differences. */
#ifndef VS_SOLIDS_CHANGED_PARTS_H
#define VS_SOLIDS_CHANGED_PARTS_H

#include "kernel/evaluate.h"
#include "model/node.h"

/* A part of a drawing: a node inside unions, placements, materials and layers that is itself none of these four. A node
 * with several paths to it gives a part for each path. */
typedef struct {
  vs_ref thing;                /* node of the part, retained, with the origin of the reference to it */
  vs_affine place;             /* map from the node's coordinates to those of the drawing */
  const vs_material *material; /* innermost material around the node, or NULL if there is none */
  const char *layer;           /* innermost layer around the node, or "" if there is none */
} vs_drawn_part;
typedef struct { vs_store *store; vs_drawn_part *at; size_t count, room; } vs_drawn_parts;

/* Collects the parts of the references `refs`, in their order. *out begins as { .store = s }. The caller frees *out
 * with vs_drawn_parts_free, also after a failure. Returns false if memory is out or the caller interrupts. */
bool vs_drawn_parts_take(vs_drawn_parts *out, const vs_ref *refs, size_t count, vs_error *e);
void vs_drawn_parts_free(vs_drawn_parts *p);

/* How a part differs from the part with which it is paired in the other drawing. In the first three cases, the shapes
 * of the two are equal. */
typedef enum {
  VS_PART_SAME,
  VS_PART_REPAINTED, /* the paired part has another material or layer */
  VS_PART_MOVED,     /* the paired part is at another place */
  VS_PART_CHANGED,   /* the paired part has the same kind and material, but other numbers */
  VS_PART_ALONE      /* the part is not paired: it was added or removed */
} vs_part_fate;
typedef struct { vs_part_fate fate; uint32_t other; /* other: index of the paired part in the other drawing; undefined
                                                     * if fate is VS_PART_ALONE */ } vs_part_match;

/* Pairs the parts of the lists a and b. Writes the matches of a's parts to before[] and those of b's parts to after[].
 * Each of several equal parts is paired once. Moved and changed parts are paired so that the sum of their distances and
 * differences in size is least, or in order if this would take long. Returns false if memory is out or the caller
 * interrupts. */
bool vs_drawn_parts_match(const vs_drawn_parts *a, const vs_drawn_parts *b, vs_part_match *before, vs_part_match *after,
                          vs_error *e);

/* Three results: material in both lists, only in the second list, and only in the first list. Each is an object whose
 * node the caller owns, or NULL if there is no such material. From a solid, the other list's solids at the same place
 * are subtracted. Curves, regions and surfaces are kept as complete parts. The objects have no materials and layers. */
typedef enum { VS_CHANGE_KEPT, VS_CHANGE_ADDED, VS_CHANGE_REMOVED, VS_CHANGES } vs_change;
bool vs_drawn_parts_change(const vs_drawn_parts *a, const vs_drawn_parts *b, const vs_part_match *before,
                           const vs_part_match *after,
                           vs_node *out[VS_CHANGES], vs_error *e);

/* Makes a copy of node n that is visible over the original. Its solids become a mesh that is slightly outside the
 * original everywhere. A ray therefore reaches the copy before a translucent solid with the same wall. The caller owns
 * *out. */
bool vs_drawn_parts_swell(vs_node *n, double tolerance, const vs_kernel_options *options, vs_node **out, vs_error *e);

/* Sets *volume to the sum of the volumes of all solids among the parts of node n, in cubic model units. The volume of
 * NULL is 0. */
bool vs_drawn_parts_volume(vs_node *n, double tolerance, const vs_kernel_options *options, double *volume,
                           vs_error *e);

#endif
