/* Owns what differs between two drawings of one store: which parts stayed, moved, were made otherwise, came or went,
 * and the solids that show it. */
#ifndef VS_SOLIDS_CHANGED_PARTS_H
#define VS_SOLIDS_CHANGED_PARTS_H

#include "kernel/evaluate.h"
#include "model/node.h"

/* A part is what stands in unions, placements, materials and layers: any other node, once for each way that leads to
 * it. */
typedef struct {
  vs_ref thing;                /* the node itself, retained, with the origin of the reference to it */
  vs_affine place;             /* from its coordinates to the drawing's */
  const vs_material *material; /* the innermost; NULL: none */
  const char *layer;           /* the innermost; "": none */
} vs_drawn_part;
typedef struct { vs_store *store; vs_drawn_part *at; size_t count, room; } vs_drawn_parts;

/* The parts of refs, in their order. *out begins as { .store = s }; vs_drawn_parts_free in either case. False: out of
 * memory, or interrupted. */
bool vs_drawn_parts_take(vs_drawn_parts *out, const vs_ref *refs, size_t count, vs_error *e);
void vs_drawn_parts_free(vs_drawn_parts *p);

/* The fate of a part. The first three are the same shape. */
typedef enum {
  VS_PART_SAME,
  VS_PART_REPAINTED, /* another material or layer */
  VS_PART_MOVED,     /* another place */
  VS_PART_CHANGED,   /* made and painted as the other, with other numbers */
  VS_PART_ALONE      /* came, or went */
} vs_part_fate;
typedef struct { vs_part_fate fate; uint32_t other; /* its index in the other list, unless ALONE */ } vs_part_match;

/* Pairs the parts of both lists: matches of before go to before[], those of after to after[], as many as there are
 * parts. Of equal parts each is paired once: those that moved or changed so that the ways and the differences of size
 * are least in all, or in order where that would take long. False: out of memory, or interrupted. */
bool vs_drawn_parts_match(const vs_drawn_parts *a, const vs_drawn_parts *b, vs_part_match *before, vs_part_match *after,
                          vs_error *e);

/* Material in both, in the second list alone, and in the first alone: an object each, whose node the caller owns;
 * NULL where there is nothing. Solids are less by what the other list has in their place; curves, regions and surfaces
 * are whole parts. Bare: without materials and layers. */
typedef enum { VS_CHANGE_KEPT, VS_CHANGE_ADDED, VS_CHANGE_REMOVED, VS_CHANGES } vs_change;
bool vs_drawn_parts_change(const vs_drawn_parts *a, const vs_drawn_parts *b, const vs_part_match *before,
                          const vs_part_match *after,
                     vs_node *out[VS_CHANGES], vs_error *e);

/* The visible form of the node, its solids as a mesh that reaches a little further out everywhere: where a translucent
 * solid has the same wall, a ray meets this one first. The caller owns *out. */
bool vs_drawn_parts_swell(vs_node *n, double tolerance, const vs_kernel_options *options, vs_node **out, vs_error *e);

/* The volume of all solids among the parts of the node, together; NULL: 0. */
bool vs_drawn_parts_volume(vs_node *n, double tolerance, const vs_kernel_options *options, double *volume,
                          vs_error *e);

#endif
