/* Declares shapes that a format writes once and uses at many places: unit forms (such as a sphere of radius 1) with a
 * given number of facets, and the triangles of a node. The triangles are relative to the centre of the node's bounds,
 * because a viewer's 32-bit numbers are finest near zero. */
#ifndef VS_BACKENDS_SHARED_SHAPES_H
#define VS_BACKENDS_SHARED_SHAPES_H

#include "backends/backend.h"
#include "geometry/shapes/unit_forms.h"
#include "model/store/nodemap.h"

typedef struct { uint32_t number; vs_vec3 middle; } vs_shared_node; /* A node's shape: its number, and the centre of the
                                                                     * node's bounds. */

typedef struct {
  struct { uint32_t *at; size_t room; } units[VS_UNIT_COUNT]; /* units[u].at[f]: 1 + number of the shape of unit form
                                                               * u with f facets in a full turn; 0: there is no such
                                                               * shape */
  vs_nodemap nodes;           /* maps a node to 1 + the index of its element in `made` */
  vs_shared_node *made;
  size_t made_count, made_room;
} vs_shared_shapes;           /* an empty vs_shared_shapes is { .nodes.store = s } */

void vs_shared_free(vs_emitter *e, vs_shared_shapes *s);

/* A function of the format that writes a shape, with normals for the given crease angle in radians, and sets *number to
 * the shape's number. Returns false, with e's error set, on failure. */
typedef bool vs_shared_write(vs_emitter *e, const vs_solid *form, double crease, uint32_t *number);
/* Sets *number to the number of the unit form that `copy` places. If the form was not yet written with this number of
 * facets, calls `write`. Returns false, with e's error set, on failure. */
bool vs_shared_unit(vs_emitter *e, vs_shared_shapes *s, const vs_unit_copy *copy, vs_shared_write *write,
                    uint32_t *number);

/* How the shape of a node is placed, including e->placement. */
typedef struct {
  bool shared;                /* whether the shape is valid for all places of the node; otherwise it is computed for
                               * this place only */
  bool written;               /* whether the shape already has a number; otherwise vs_shared_keep sets it */
  uint32_t number;
  vs_vec3 middle;             /* centre of the node's bounds */
  vs_affine home;             /* map from the node's coordinates to the shape's */
  vs_affine there;            /* map from the shape's coordinates to the output's */
} vs_shared_place;

/* Computes how n's shape is placed. shared: whether a single shape may be used for all places of n. Returns false, with
 * e's error set, on failure. */
bool vs_shared_find(vs_emitter *e, const vs_shared_shapes *s, const vs_node *n, bool shared, vs_shared_place *out);
/* Keeps the number of a written shape for the node's other places. Returns false if memory is out. */
bool vs_shared_keep(vs_emitter *e, vs_shared_shapes *s, vs_node *n, vs_shared_place *place, uint32_t number);

/* Returns the centre of a polyline's bounds under e's placement. */
vs_vec3 vs_shared_line_middle(const vs_emitter *e, const struct vs_line *l);

#endif
