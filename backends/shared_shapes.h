/* Owns the shapes that a format writes once for many places: unit forms by their facets in a full turn, and the
 * triangles of a node. The triangles are relative to their own centre, since a viewer's 32-bit numbers are finest near
 * zero. */
#ifndef VS_BACKENDS_SHARED_SHAPES_H
#define VS_BACKENDS_SHARED_SHAPES_H

#include "backends/backend.h"
#include "geometry/shapes/unit_forms.h"
#include "model/store/nodemap.h"

typedef struct { uint32_t number; vs_vec3 middle; } vs_shared_node; /* a node's shape, and the centre of its bounds */

typedef struct {
  struct { uint32_t *at; size_t room; } units[VS_UNIT_COUNT]; /* at[facets in a full turn]: the number of the shape + 1,
                                                               * or 0 */
  vs_nodemap nodes;           /* node -> its index in `made` + 1 */
  vs_shared_node *made;
  size_t made_count, made_room;
} vs_shared_shapes;           /* { .nodes.store = s } is empty */

void vs_shared_free(vs_emitter *e, vs_shared_shapes *s);

/* Writes a shape with normals for that crease, in radians, and sets its number. Fails with e's error set. */
typedef bool vs_shared_write(vs_emitter *e, const vs_solid *form, double crease, uint32_t *number);
/* Sets the number of the unit form that `copy` places. Calls `write` if it is the first with its facets. Fails with e's
 * error set. */
bool vs_shared_unit(vs_emitter *e, vs_shared_shapes *s, const vs_unit_copy *copy, vs_shared_write *write,
                    uint32_t *number);

/* The place of a node's shape, at e's placement. */
typedef struct {
  bool shared;                /* it serves every place; else it is made for this one */
  bool written;               /* the shape has its number; else vs_shared_keep gives it one */
  uint32_t number;
  vs_vec3 middle;             /* the centre of the node's bounds */
  vs_affine home;             /* from the node to the shape */
  vs_affine there;            /* from the shape to the coordinates of the output */
} vs_shared_place;

/* Finds the place of n's shape. shared: one shape may serve all places of n. Fails with e's error set. */
bool vs_shared_find(vs_emitter *e, const vs_shared_shapes *s, const vs_node *n, bool shared, vs_shared_place *out);
/* Keeps the number of a written shape for the node's other places. Fails when memory is out. */
bool vs_shared_keep(vs_emitter *e, vs_shared_shapes *s, vs_node *n, vs_shared_place *place, uint32_t number);

/* Returns the centre of a polyline's bounds at e's placement. */
vs_vec3 vs_shared_line_middle(const vs_emitter *e, const struct vs_line *l);

#endif
