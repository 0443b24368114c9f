/* Declares the unit forms: every box, wedge, sphere, cylinder and cone is a placed copy of one. Formats with instances
 * keep one mesh for each form and number of facets, for all sizes and directions. */
#ifndef VS_GEOMETRY_SHAPES_UNIT_FORMS_H
#define VS_GEOMETRY_SHAPES_UNIT_FORMS_H

#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"

/* All lie within -1..1 in x, y and z; the axis of cylinder and cone is Z. */
typedef enum { VS_UNIT_BOX, VS_UNIT_WEDGE, VS_UNIT_SPHERE, VS_UNIT_CYLINDER, VS_UNIT_CONE, VS_UNIT_COUNT } vs_unit;

typedef struct {
  vs_unit unit;
  int turn;        /* facets in a turn by the current rule; 0 for the flat forms */
  bool faceted;    /* the node has its own number of facets */
  vs_affine place; /* from the form to the node's own coordinates */
} vs_unit_copy;

/* Returns false if the node is no copy of a unit form. */
bool vs_unit_of(const vs_node *n, const vs_fineness *f, vs_unit_copy *out);
bool vs_unit_mesh(vs_unit unit, int turn, vs_mesh *out); /* appends the form's mesh; false: out of memory */

#endif
