/* Owns the corners in which very many triangles end: which of these need not be tried against each other. */
#ifndef VS_KERNEL_MESH_HUBS_H
#define VS_KERNEL_MESH_HUBS_H

#include "model/mesh.h"
#include "kernel/memory.h"

/* Triangles, and where their corners stand. */
typedef struct {
  const uint32_t (*triangles)[3];
  size_t triangle_count, vertex_count;
  const uint8_t *gone; /* of a triangle: 1: there is none; NULL: there are all */
  vs_vec3 (*corner)(const void *context, uint32_t vertex);
  const void *context;
} vs_fans;

/* Hubs around which all triangles meet in their edges alone; those of a hub that lies within another's convex cone are
 * apart from that one's and may have its name. */
typedef struct {
  VS_LIST(uint32_t) of;      /* of each triangle: such a corner of it, or UINT32_MAX. Empty: there are none */
  VS_LIST(uint32_t) corners; /* the hubs */
  size_t edges;              /* between two triangles that have the same in `of` */
} vs_hubs;

/* False: out of memory, or interrupted; the caller frees it in any case. */
bool vs_hubs_find(vs_kernel *k, const vs_fans *mesh, vs_hubs *out);
void vs_hubs_free(vs_kernel *k, vs_hubs *hubs);

#endif
