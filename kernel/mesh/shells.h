/* Owns the shells of a mesh: what hangs together by corners. */
#ifndef VS_KERNEL_MESH_SHELLS_H
#define VS_KERNEL_MESH_SHELLS_H

#include "model/mesh.h"

typedef struct {
  double volume;   /* signed: negative where it is the wall of a hole */
  double area;
  double reach;    /* the largest coordinate, without its sign */
  vs_vec3 from;    /* its first corner */
} vs_shell;

typedef struct {
  vs_shell *at;
  uint32_t count;
  uint32_t *of;    /* a vertex's shell */
} vs_shells;

/* Filled; false: out of memory. The caller frees it either way. */
bool vs_shells_find(const vs_mesh *m, vs_shells *out);
void vs_shells_free(vs_shells *s);

#endif
