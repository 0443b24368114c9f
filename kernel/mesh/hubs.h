/* Declares the search for hubs: corners at which very many triangles end. Triangles around one hub need no test against
 * each other. */
#ifndef VS_KERNEL_MESH_HUBS_H
#define VS_KERNEL_MESH_HUBS_H

#include "model/mesh.h"
#include "kernel/memory.h"

/* Input of the search for hubs (vertices of very many triangles): the mesh's triangles, and a function that returns the
 * positions of their corners. */
typedef struct {
  const uint32_t (*triangles)[3];
  size_t triangle_count, vertex_count;
  const uint8_t *gone; /* gone[t]: 1 if the search ignores triangle t; NULL: it ignores none */
  vs_vec3 (*corner)(const void *context, uint32_t vertex);
  const void *context;
} vs_fans;

/* The hubs (vertices of very many triangles) whose triangles were proven to share only their common edges. If a hub
 * lies in the convex cone of another, `of` may name the other hub for its triangles. */
typedef struct {
  VS_LIST(uint32_t) of;      /* of[t]: hub at which triangle t ends, or UINT32_MAX if there is none. Empty: the mesh has
                              * no hubs. */
  VS_LIST(uint32_t) corners; /* vertex numbers of the hubs, the corners of very many triangles */
  size_t edges;              /* number of edges between pairs of triangles that end at one hub, thus have equal values
                              * in `of` */
} vs_hubs;

/* Finds the hubs of a mesh: vertices of very many triangles. Returns false if memory is out or the caller interrupts.
 * In either case, the caller frees `out`. */
bool vs_hubs_find(vs_kernel *k, const vs_fans *mesh, vs_hubs *out);
void vs_hubs_free(vs_kernel *k, vs_hubs *hubs);

#endif
