/* Contains the declarations for the files of the glTF back-end: gltf_collect.c converts the drawing to meshes and
 * nodes, gltf_file.c writes them to the file.
 *
 * A geometry consists of triangles or lines in coordinates of its own, and is written once. A mesh is a geometry with a
 * colour, because glTF's nodes cannot set colours. A node places a mesh. A million copies of a part are therefore a
 * million nodes and a single mesh. */
#ifndef VS_BACKENDS_GLTF_GLTF_H
#define VS_BACKENDS_GLTF_GLTF_H

#include "backends/shared_shapes.h"

typedef struct { unsigned char *at; size_t count, room; } vs_gltf_bytes;

/* A primitive: the part of a geometry that has a single colour. */
typedef struct {
  uint32_t paint;              /* material number from 1; 0: the part has the colour of the place where it is used */
  bool lines;
  bool wide;                   /* true if the indices have 32 bits; otherwise they have 16 bits */
  uint32_t vertex_count, index_count;
  uint32_t pictured;           /* number of the primitive, from 1, among the primitives whose vertices have texture
                                * coordinates; 0: its vertices have none */
  size_t places;               /* offset of the texture coordinates in the array `places` */
  size_t vertices, indices;    /* vertices: offset in bytes in the array of positions and in that of normals. indices:
                                * offset in bytes in the array of 16-bit or 32-bit indices */
  float min[3], max[3];        /* bounds of the primitive's positions */
} vs_gltf_primitive;
typedef struct {
  uint32_t first, count; /* first: index of the geometry's first primitive; count: number of its primitives */
  uint32_t mesh;         /* index of the first mesh of this geometry + 1; 0: there is none */
} vs_gltf_geometry;
typedef struct { uint32_t geometry, paint, next; /* paint: material number. next: index of the geometry's next mesh + 1;
                                                  * 0: none */ } vs_gltf_mesh;
typedef struct { uint32_t mesh, layer; vs_affine place; } vs_gltf_node;
/* A node of the file that contains other nodes and has no mesh: a layer or a part. above: number of the part around it;
 * 0: none */
typedef struct { const char *name; uint32_t above; bool part; } vs_gltf_group;

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
  vs_gltf_group *layers;       /* layers and parts; they are numbered from 1, and 0 means that there is none */
  size_t layer_count, layer_room;
  uint32_t *open_layers;       /* numbers of the layers and parts that contain the current node */
  size_t open_count, open_room;
  vs_shared_shapes shapes;     /* numbers of the geometries that are used at several places */
  vs_rounded settled; /* changes of shapes by rounding to 32 bits, for the warning */
} vs_gltf;

/* ---- gltf_collect.c ---- */
vs_emit_fn vs_gltf_leaf, vs_gltf_line, vs_gltf_through, vs_gltf_boolean;

#endif
