/* Declares the differences between two drawings of one store: parts that are unchanged, moved, changed, added or
 * removed, and solids that show the differences. */
#ifndef VS_SOLIDS_CHANGED_PARTS_H
#define VS_SOLIDS_CHANGED_PARTS_H

#include "kernel/evaluate.h"
#include "model/node.h"

/* A part of a drawing: a node below unions, placements, materials and layers that itself is none of these. A node to
 * which several paths lead gives a part for each path. */
typedef struct {
  vs_ref thing;                /* node of the part, with the origin of the reference to it; the part holds a reference
                                * to the node */
  vs_affine place;             /* map from the node's coordinates to the drawing's coordinates */
  const vs_material *material; /* innermost material around the node; NULL if there is none */
  const char *layer;           /* innermost layer around the node; "" if there is none */
} vs_drawn_part;
typedef struct { vs_store *store; vs_drawn_part *at; size_t count, room; } vs_drawn_parts;

/* Collects the parts below the references `refs`, in their order. *out must be { .store = s } at the call. The
 * caller frees *out with vs_drawn_parts_free, also after a failure. Returns false if memory is out or the caller
 * interrupts. */
bool vs_drawn_parts_take(vs_drawn_parts *out, const vs_ref *refs, size_t count, vs_error *e);
void vs_drawn_parts_free(vs_drawn_parts *p);

/* How a part differs from its pair in the other drawing. VS_PART_SAME, _REPAINTED and _MOVED: the shapes of the two are
 * equal. */
typedef enum {
  VS_PART_SAME,
  VS_PART_REPAINTED, /* the paired part has another material or layer */
  VS_PART_MOVED,     /* the paired part is at another place */
  VS_PART_CHANGED,   /* the paired part has the same kind and material, but other numbers */
  VS_PART_ALONE      /* the part is not paired: it was added or removed */
} vs_part_fate;
typedef struct { vs_part_fate fate; uint32_t other; /* other: index of the pair in the other drawing's parts; undefined
                                                     * if fate is VS_PART_ALONE */ } vs_part_match;

/* Pairs the parts of the lists a and b. before[]: receives the pair of each part of a; after[]: that of each part of
 * b. Among equal parts, the nearest and most similar are paired. Returns false if memory is out or the caller
 * interrupts. */
bool vs_drawn_parts_match(const vs_drawn_parts *a, const vs_drawn_parts *b, vs_part_match *before, vs_part_match *after,
                          vs_error *e);

/* The results of a comparison of two drawings: the space in both, only in the second, and only in the first. Each is an
 * object without materials and layers, whose node the caller owns; NULL if it is empty. */
typedef enum { VS_CHANGE_KEPT, VS_CHANGE_ADDED, VS_CHANGE_REMOVED, VS_CHANGES } vs_change;
bool vs_drawn_parts_change(const vs_drawn_parts *a, const vs_drawn_parts *b, const vs_part_match *before,
                           const vs_part_match *after,
                           vs_node *out[VS_CHANGES], vs_error *e);

/* Makes a copy of node n that hides the original in pictures: its solids become a mesh slightly outside the original.
 * The caller owns *out. Returns false and sets e on failure. */
bool vs_drawn_parts_swell(vs_node *n, double tolerance, const vs_kernel_options *options, vs_node **out, vs_error *e);

/* Sets *volume to the sum of the volumes of all solids below node n, in cubic model units; 0 if n is NULL. Returns
 * false and sets e on failure. */
bool vs_drawn_parts_volume(vs_node *n, double tolerance, const vs_kernel_options *options, double *volume,
                           vs_error *e);

#endif
