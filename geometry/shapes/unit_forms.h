/* Owns the unit forms: shapes of which every box, wedge, sphere, cylinder and cone is a placed copy. Formats of
 * instances keep one mesh a form and number of facets, whatever the sizes and directions of what is drawn. */
#ifndef VS_GEOMETRY_SHAPES_UNIT_FORMS_H
#define VS_GEOMETRY_SHAPES_UNIT_FORMS_H

#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"

/* All lie within -1..1 in x, y and z; cylinder and cone stand on the Z axis. */
typedef enum { VS_UNIT_BOX, VS_UNIT_WEDGE, VS_UNIT_SPHERE, VS_UNIT_CYLINDER, VS_UNIT_CONE, VS_UNIT_COUNT } vs_unit;

typedef struct {
  vs_unit unit;
  int turn;        /* facets a turn by the rule in force; 0 for the flat forms */
  bool faceted;    /* the node says its number of facets itself */
  vs_affine place; /* from the form to the node's own coordinates */
} vs_unit_copy;

/* false: the node is no copy of a unit form */
bool vs_unit_of(const vs_node *n, const vs_fineness *f, vs_unit_copy *out);
bool vs_unit_mesh(vs_unit unit, int turn, vs_mesh *out); /* appended; false: out of memory */

#endif
