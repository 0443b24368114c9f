/* Declares the differences between two drawings of the same store: the parts that are unchanged, moved, changed, added
 * or removed, and the solids that show the differences. */
#ifndef VS_SOLIDS_CHANGED_PARTS_H
#define VS_SOLIDS_CHANGED_PARTS_H

#include "kernel/evaluate.h"
#include "model/node.h"

/* A part of a drawing: a node inside unions, placements, materials and layers that is itself none of these four. A node
 * with several paths to it gives a part for each path. */
typedef struct {
  vs_ref thing;                /* node, retained, with the origin of the reference to it */
  vs_affine place;             /* map from the node's coordinates to the drawing's */
  const vs_material *material; /* innermost material around the node, or NULL if there is none */
  const char *layer;           /* innermost layer around the node, or "" if there is none */
} vs_drawn_part;
typedef struct { vs_store *store; vs_drawn_part *at; size_t count, room; } vs_drawn_parts;

/* Collects the parts of refs, in their order. *out begins as { .store = s }. Call vs_drawn_parts_free also after a
 * failure. Returns false if memory is out or the caller interrupts. */
bool vs_drawn_parts_take(vs_drawn_parts *out, const vs_ref *refs, size_t count, vs_error *e);
void vs_drawn_parts_free(vs_drawn_parts *p);

/* How a part differs from its partner in the other drawing. In the first three cases, the part and its partner have the
 * same shape. */
typedef enum {
  VS_PART_SAME,
  VS_PART_REPAINTED, /* the partner has another material or layer */
  VS_PART_MOVED,     /* the partner is at another place */
  VS_PART_CHANGED,   /* the partner has the same kind and material, but other numbers */
  VS_PART_ALONE      /* the part has no partner: it was added or removed */
} vs_part_fate;
typedef struct { vs_part_fate fate; uint32_t other; /* index of the partner in the other drawing, unless fate is
                                                     * ALONE */ } vs_part_match;

/* Pairs the parts of the lists a and b. Writes the matches of a to before[] and those of b to after[], one for each
 * part. Each of several equal parts is paired once. Moved and changed parts are paired so that the sum of distances and
 * of differences in size is least, or in order if this would take long. Returns false if memory is out or the caller
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

/* Makes a copy of the node that is visible over the original. Its solids become a mesh that is slightly outside the
 * original everywhere. A ray therefore reaches the copy before a translucent solid with the same wall. The caller owns
 * *out. */
bool vs_drawn_parts_swell(vs_node *n, double tolerance, const vs_kernel_options *options, vs_node **out, vs_error *e);

/* Computes the sum of the volumes of all solids among the node's parts. The volume of NULL is 0. */
bool vs_drawn_parts_volume(vs_node *n, double tolerance, const vs_kernel_options *options, double *volume,
                           vs_error *e);

#endif
