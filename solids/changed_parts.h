/* Owns the differences between two drawings of one store: the parts that are unchanged, moved, changed, added or
 * removed, and the solids that show it. */
#ifndef VS_SOLIDS_CHANGED_PARTS_H
#define VS_SOLIDS_CHANGED_PARTS_H

#include "kernel/evaluate.h"
#include "model/node.h"

/* A part is a node within unions, placements, materials and layers: any other node, once for each path to it. */
typedef struct {
  vs_ref thing;                /* the node, retained, with the origin of the reference to it */
  vs_affine place;             /* map from its coordinates to the drawing's */
  const vs_material *material; /* the innermost; NULL: none */
  const char *layer;           /* the innermost; "": none */
} vs_drawn_part;
typedef struct { vs_store *store; vs_drawn_part *at; size_t count, room; } vs_drawn_parts;

/* Collects the parts of refs, in their order. *out begins as { .store = s }; call vs_drawn_parts_free in both cases.
 * Returns false if memory is out or the caller interrupts. */
bool vs_drawn_parts_take(vs_drawn_parts *out, const vs_ref *refs, size_t count, vs_error *e);
void vs_drawn_parts_free(vs_drawn_parts *p);

/* The fate of a part. The first three have the same shape as their partner. */
typedef enum {
  VS_PART_SAME,
  VS_PART_REPAINTED, /* another material or layer */
  VS_PART_MOVED,     /* another place */
  VS_PART_CHANGED,   /* the same kind and material, with other numbers */
  VS_PART_ALONE      /* added or removed */
} vs_part_fate;
typedef struct { vs_part_fate fate; uint32_t other; /* its partner's index, unless ALONE */ } vs_part_match;

/* Pairs the parts of both lists: writes the matches of a to before[] and those of b to after[], one for each part. Each
 * of several equal parts is paired once: moved or changed parts so that the sum of distances and of differences in size
 * is least, or in order if that would take long. Returns false if memory is out or the caller interrupts. */
bool vs_drawn_parts_match(const vs_drawn_parts *a, const vs_drawn_parts *b, vs_part_match *before, vs_part_match *after,
                          vs_error *e);

/* Material in both lists, in the second alone, and in the first alone: an object each, whose node the caller owns; NULL
 * if there is none. The other list's solids at the same place are subtracted from solids; curves, regions and surfaces
 * are whole parts. The objects have no materials and layers. */
typedef enum { VS_CHANGE_KEPT, VS_CHANGE_ADDED, VS_CHANGE_REMOVED, VS_CHANGES } vs_change;
bool vs_drawn_parts_change(const vs_drawn_parts *a, const vs_drawn_parts *b, const vs_part_match *before,
                          const vs_part_match *after,
                     vs_node *out[VS_CHANGES], vs_error *e);

/* Makes the visible form of the node; its solids become a mesh that extends a little further out everywhere, so that a
 * ray meets it before a translucent solid with the same wall. The caller owns *out. */
bool vs_drawn_parts_swell(vs_node *n, double tolerance, const vs_kernel_options *options, vs_node **out, vs_error *e);

/* Computes the sum of the volumes of all solids among the node's parts; NULL: 0. */
bool vs_drawn_parts_volume(vs_node *n, double tolerance, const vs_kernel_options *options, double *volume,
                          vs_error *e);

#endif
