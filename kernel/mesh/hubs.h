/* Declares the hubs, corners of very many triangles: triangles around a hub that need no test against each other. */
#ifndef VS_KERNEL_MESH_HUBS_H
#define VS_KERNEL_MESH_HUBS_H

#include "model/mesh.h"
#include "kernel/memory.h"

/* Triangles, and the positions of their corners. */
typedef struct {
  const uint32_t (*triangles)[3];
  size_t triangle_count, vertex_count;
  const uint8_t *gone; /* gone[t]: 1: triangle t does not exist; NULL: all exist */
  vs_vec3 (*corner)(const void *context, uint32_t vertex);
  const void *context;
} vs_fans;

/* Hubs whose triangles meet in their edges only. If a hub lies inside another's convex cone, its triangles are apart
 * from the other's and may have that hub in `of`. */
typedef struct {
  VS_LIST(uint32_t) of;      /* for each triangle: its hub, or UINT32_MAX. Empty: there are no hubs */
  VS_LIST(uint32_t) corners; /* the hubs */
  size_t edges;              /* number of edges between two triangles with the same hub in `of` */
} vs_hubs;

/* Returns false if memory is out or the caller interrupts; the caller frees `out` in any case. */
bool vs_hubs_find(vs_kernel *k, const vs_fans *mesh, vs_hubs *out);
void vs_hubs_free(vs_kernel *k, vs_hubs *hubs);

#endif
