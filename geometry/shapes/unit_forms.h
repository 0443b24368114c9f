/* Declares the unit forms. Every box, wedge, sphere, cylinder or cone is a placed copy of a unit form. A file format
 * with instances stores one mesh for each form and number of facets, for all sizes and directions. */
#ifndef VS_GEOMETRY_SHAPES_UNIT_FORMS_H
#define VS_GEOMETRY_SHAPES_UNIT_FORMS_H

#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"

/* The unit forms. Each lies within -1 to 1 in x, y and z. The axis of the cylinder and the cone is Z. */
typedef enum { VS_UNIT_BOX, VS_UNIT_WEDGE, VS_UNIT_SPHERE, VS_UNIT_CYLINDER, VS_UNIT_CONE, VS_UNIT_COUNT } vs_unit;

typedef struct {
  vs_unit unit;
  int turn;        /* number of facets of a full turn, which follows from the fineness that was passed to vs_unit_of; 0
                    * for the box and the wedge */
  bool faceted;    /* true if the node's field `segments` defines the number of facets */
  vs_affine place; /* map from the unit form to the node's own coordinates */
} vs_unit_copy;

/* Finds the unit form and the placement of which node n is a copy. Returns false if there are none. */
bool vs_unit_of(const vs_node *n, const vs_fineness *f, vs_unit_copy *out);
bool vs_unit_mesh(vs_unit unit, int turn, vs_mesh *out); /* appends the mesh of the unit form with `turn` facets in a
                                                          * full turn to out; returns false when memory is out */

#endif
