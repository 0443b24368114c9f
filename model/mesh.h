/* Owns the indexed triangle mesh that tessellation, the kernel and the mesh writers exchange. */
#ifndef VS_MODEL_MESH_H
#define VS_MODEL_MESH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "model/vec.h"

typedef struct {
  vs_vec3 *vertices;
  uint32_t (*triangles)[3]; /* counter-clockwise seen from outside */
  uint32_t *tags;           /* tags[i]: the part (leaf) from which triangle i came; NULL: not known */
  size_t vertex_count, vertex_room, triangle_count, triangle_room;
  size_t most;              /* the most triangles; corners may be three times as many; 0: no limit */
  bool over;                /* more room was requested than `most`, and refused */
} vs_mesh;

void vs_mesh_free(vs_mesh *m); /* frees the contents, not m, which is then empty and usable */
bool vs_mesh_add_vertex(vs_mesh *m, vs_vec3 v, uint32_t *index); /* false: out of memory; index may be NULL */
/* Adds a triangle. a, b and c are vertices of m, which may be added later. */
bool vs_mesh_add_triangle(vs_mesh *m, uint32_t a, uint32_t b, uint32_t c);
bool vs_mesh_reserve(vs_mesh *m, size_t vertices, size_t triangles); /* makes room in all; false: out of memory, or
                                                                      * m->over */
bool vs_mesh_want_tags(vs_mesh *m); /* makes room for tags, each 0, if there are none; false: out of memory */
bool vs_mesh_copy(const vs_mesh *from, vs_mesh *to); /* `to` is empty before; false: out of memory, and it is empty
                                                      * again */
double vs_mesh_volume(const vs_mesh *m); /* signed, by the divergence theorem; closed meshes only */
double vs_mesh_area(const vs_mesh *m);
vs_bounds vs_mesh_bounds(const vs_mesh *m);
vs_bounds vs_mesh_placed_bounds(const vs_mesh *m, const vs_affine *a); /* of all its corners at that place, used or
                                                                        * not */
/* Returns true if every directed edge has its opposite, by index; *ok false: out of memory. */
bool vs_mesh_closed(const vs_mesh *m, bool *ok);
void vs_mesh_transform(vs_mesh *m, const vs_affine *a); /* in place; reverses the triangles if the map mirrors */
/* Transforms the vertices from first_vertex and the triangles from first_triangle. Both are at most m's counts. */
void vs_mesh_transform_from(vs_mesh *m, const vs_affine *a, size_t first_vertex, size_t first_triangle);
void vs_mesh_squeeze(vs_mesh *m, const uint8_t *gone); /* removes the triangles with gone[i] not 0; corners remain */
/* Reverses the triangles from first_triangle on, which is at most m's count. */
void vs_mesh_turn(vs_mesh *m, size_t first_triangle);

#endif
