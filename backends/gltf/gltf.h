/* Owns the declarations that the files of the glTF back-end share: gltf_collect.c makes meshes and nodes from the
 * drawing, gltf_file.c writes them to the file.
 *
 * A geometry is triangles or lines in their own coordinates, once in the file. A mesh is a geometry in the colour of
 * one place (glTF's nodes cannot paint). A node places a mesh: a million copies are a million nodes and one mesh. */
#ifndef VS_BACKENDS_GLTF_GLTF_H
#define VS_BACKENDS_GLTF_GLTF_H

#include "backends/shared_shapes.h"

typedef struct { unsigned char *at; size_t count, room; } vs_gltf_bytes;

/* The part of a geometry that has one colour. */
typedef struct {
  uint32_t paint;              /* material number from 1; 0: the colour of the place */
  bool lines;
  bool wide;                   /* indices of 32 bits, else of 16 */
  uint32_t vertex_count, index_count;
  uint32_t pictured;           /* its number, from 1, among the primitives whose vertices have texture coordinates; 0:
                                * it has none */
  size_t places;               /* offset into places */
  size_t vertices, indices;    /* offsets into positions (and normals), into the indices of that width, in bytes */
  float min[3], max[3];        /* the bounds of its positions */
} vs_gltf_primitive;
typedef struct {
  uint32_t first, count; /* primitives */
  uint32_t mesh;         /* the first of its meshes + 1, or 0 */
} vs_gltf_geometry;
typedef struct { uint32_t geometry, paint, next; /* another mesh of this geometry + 1, or 0 */ } vs_gltf_mesh;
typedef struct { uint32_t mesh, layer; vs_affine place; } vs_gltf_node;

typedef struct {
  vs_gltf_bytes positions, normals, places, narrow, wide;
  vs_gltf_primitive *primitives;
  size_t primitive_count, primitive_room;
  uint32_t pictured_count;
  vs_gltf_geometry *geometries;
  size_t geometry_count, geometry_room;
  vs_gltf_mesh *meshes;
  size_t mesh_count, mesh_room;
  vs_gltf_node *nodes;
  size_t node_count, node_room;
  const char **layers;         /* names; index 0 is the absence of a layer */
  size_t layer_count, layer_room;
  uint32_t *open_layers;       /* the layers around the current node */
  size_t open_count, open_room;
  vs_shared_shapes shapes;     /* geometries by number */
  vs_rounded settled; /* the changes that rounding to 32 bits made to shapes, for the warning */
} vs_gltf;

/* ---- gltf_collect.c ---- */
vs_emit_fn vs_gltf_leaf, vs_gltf_line, vs_gltf_through, vs_gltf_boolean;

#endif
