/* Declares the faces of the kinds that consist of polygons: polyface meshes, grid meshes and boxes. */
#ifndef VS_GEOMETRY_SHAPES_POLYGONS_H
#define VS_GEOMETRY_SHAPES_POLYGONS_H

#include "model/node.h"

/* A function that receives a face with `count` corners, counter-clockwise as seen from outside. The array is valid only
 * during the call. Returns false to stop. */
typedef bool vs_polygon_taker(void *context, const vs_vec3 *corner, uint32_t count);

typedef enum {
  VS_POLYGONS_NONE,    /* the node's kind does not consist of polygons, so no face was passed to the function */
  VS_POLYGONS_GIVEN,   /* all faces were passed to the function */
  VS_POLYGONS_STOPPED, /* the function has returned false, so no further face was passed to it */
  VS_POLYGONS_MEMORY   /* memory is out */
} vs_polygons_result;

/* Passes each face of the node to the function `take`, with its corners mapped by `map`. If the map is a reflection,
 * the order of the corners is reversed. */
vs_polygons_result vs_polygons_each(const vs_node *n, const vs_affine *map, vs_polygon_taker *take, void *context);

#endif
