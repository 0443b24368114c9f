/* Declares the shells of a mesh: sets of triangles that are connected by common corners. */
#ifndef VS_KERNEL_MESH_SHELLS_H
#define VS_KERNEL_MESH_SHELLS_H

#include "model/mesh.h"

typedef struct {
  double volume;   /* volume that the shell encloses, in cubic units; negative if the shell is the wall of a cavity */
  double area;
  double reach;    /* largest absolute value of a coordinate of the shell's corners */
  vs_vec3 from;    /* position of the shell's first corner */
} vs_shell;

typedef struct {
  vs_shell *at;
  uint32_t count;
  uint32_t *of;    /* of[v]: number of the shell that contains vertex v */
} vs_shells;

/* Finds the shells (sets of triangles that corners connect) of mesh m. Returns false when memory is out. The caller
 * frees out with vs_shells_free in either case. */
bool vs_shells_find(const vs_mesh *m, vs_shells *out);
void vs_shells_free(vs_shells *s);

#endif
