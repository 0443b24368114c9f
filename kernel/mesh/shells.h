/* Declares the shells of a mesh: sets of triangles connected by corners. */
#ifndef VS_KERNEL_MESH_SHELLS_H
#define VS_KERNEL_MESH_SHELLS_H

#include "model/mesh.h"

typedef struct {
  double volume;   /* signed: negative if it is the wall of a cavity */
  double area;
  double reach;    /* the largest absolute coordinate */
  vs_vec3 from;    /* its first corner */
} vs_shell;

typedef struct {
  vs_shell *at;
  uint32_t count;
  uint32_t *of;    /* of[v]: shell of vertex v */
} vs_shells;

/* Fills out. Returns false when memory is out; the caller frees out in any case. */
bool vs_shells_find(const vs_mesh *m, vs_shells *out);
void vs_shells_free(vs_shells *s);

#endif
