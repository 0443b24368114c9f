/* Declares the faces of the kinds that consist of polygons: polyface meshes, grid meshes and boxes. */
#ifndef VS_GEOMETRY_SHAPES_POLYGONS_H
#define VS_GEOMETRY_SHAPES_POLYGONS_H

#include "model/node.h"

/* Receives one face: its corners, counter-clockwise seen from outside, which are valid during the call only. Returns
 * false to stop. */
typedef bool vs_polygon_taker(void *context, const vs_vec3 *corner, uint32_t count);

typedef enum {
  VS_POLYGONS_NONE,    /* the node is of another kind: no face was passed */
  VS_POLYGONS_GIVEN,   /* all faces were passed */
  VS_POLYGONS_STOPPED, /* the taker stopped */
  VS_POLYGONS_MEMORY   /* out of memory */
} vs_polygons_result;

/* Passes each face of the node to the taker, its corners mapped; a reflection reverses their order. */
vs_polygons_result vs_polygons_each(const vs_node *n, const vs_affine *map, vs_polygon_taker *take, void *context);

#endif
