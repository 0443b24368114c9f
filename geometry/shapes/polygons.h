/* Owns the faces of the kinds that are made of polygons: polyface meshes, grid meshes and boxes. */
#ifndef VS_GEOMETRY_SHAPES_POLYGONS_H
#define VS_GEOMETRY_SHAPES_POLYGONS_H

#include "model/node.h"

/* Takes one face: its corners, counter-clockwise where it is seen from outside, which are read during the call only.
 * Returns false to stop. */
typedef bool vs_polygon_taker(void *context, const vs_vec3 *corner, uint32_t count);

typedef enum {
  VS_POLYGONS_NONE,    /* the node is of another kind: no face was given */
  VS_POLYGONS_GIVEN,   /* all faces were given */
  VS_POLYGONS_STOPPED, /* the taker stopped */
  VS_POLYGONS_MEMORY   /* memory is exhausted */
} vs_polygons_result;

/* Gives each face of the node to the taker, its corners mapped; a map that mirrors has the corners in reverse order. */
vs_polygons_result vs_polygons_each(const vs_node *n, const vs_affine *map, vs_polygon_taker *take, void *context);

#endif
