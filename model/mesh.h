/* Declares the indexed triangle mesh that tessellation, the kernel and the mesh formats exchange. */
#ifndef VS_MODEL_MESH_H
#define VS_MODEL_MESH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "model/vec.h"

typedef struct {
  vs_vec3 *vertices;
  uint32_t (*triangles)[3]; /* vertex numbers of each triangle's corners, counterclockwise as seen from outside */
  uint32_t *tags;           /* tags[i]: number of the part (leaf) from which triangle i came; NULL if unknown */
  size_t vertex_count, vertex_room, triangle_count, triangle_room;
  size_t most;              /* greatest number of triangles that may be added; 0: no limit. There may be three times as
                             * many vertices. */
  bool over;                /* true if a triangle was refused because of the limit `most` */
  bool settled;             /* True if no two triangles intersect after rounding to the numbers of any format. All code
                             * that changes the mesh sets it to false. */
} vs_mesh;

void vs_mesh_free(vs_mesh *m); /* Frees the mesh's arrays, not m itself. m is then an empty mesh. */
bool vs_mesh_add_vertex(vs_mesh *m, vs_vec3 v, uint32_t *index); /* Adds a vertex at v and sets *index to its number
                                                                  * (index may be NULL). Returns false when memory is
                                                                  * out. */
/* Adds a triangle whose corners are the vertices with the numbers a, b and c; these may be added later. Returns false
 * when memory is out, or the mesh would have more than m->most triangles. */
bool vs_mesh_add_triangle(vs_mesh *m, uint32_t a, uint32_t b, uint32_t c);
bool vs_mesh_reserve(vs_mesh *m, size_t vertices, size_t triangles); /* Makes room for `vertices` vertices and
                                                                      * `triangles` triangles in total. Returns false
                                                                      * when memory is out; or when m->most is exceeded,
                                                                      * and then sets m->over. */
bool vs_mesh_want_tags(vs_mesh *m); /* Allocates m->tags if it is NULL, with the tag 0 for each triangle. Returns false
                                     * when memory is out. */
bool vs_mesh_copy(const vs_mesh *from, vs_mesh *to); /* Copies a mesh to `to`, which must be empty. When memory is out,
                                                      * returns false, and `to` stays empty. */
double vs_mesh_volume(const vs_mesh *m); /* Returns the signed volume of a closed mesh, by the divergence theorem. */
double vs_mesh_area(const vs_mesh *m);
vs_bounds vs_mesh_bounds(const vs_mesh *m);
vs_bounds vs_mesh_placed_bounds(const vs_mesh *m, const vs_affine *a); /* Returns the bounds of all vertices mapped by
                                                                        * a, including vertices that no triangle has. */
/* Returns true if every directed edge of m, by vertex numbers, occurs as often as its reverse. If memory is out,
 * returns false and sets *ok to false. */
bool vs_mesh_closed(const vs_mesh *m, bool *ok);
void vs_mesh_transform(vs_mesh *m, const vs_affine *a); /* Maps the vertices of m by a. If a mirrors, also reverses the
                                                         * triangles. */
/* Maps the vertices with numbers of at least first_vertex by a. If a mirrors, also reverses the triangles with numbers
 * of at least first_triangle. Neither number exceeds the mesh's counts. */
void vs_mesh_transform_from(vs_mesh *m, const vs_affine *a, size_t first_vertex, size_t first_triangle);
void vs_mesh_squeeze(vs_mesh *m, const uint8_t *gone); /* Removes each triangle i for which gone[i] is not 0. Keeps all
                                                        * vertices. */
/* Reverses the orientation of the triangles from first_triangle on. first_triangle is at most m->triangle_count. */
void vs_mesh_turn(vs_mesh *m, size_t first_triangle);
/* Reverses the triangles from first_triangle on, a closed mesh, if their volume is negative. Returns true if it is. */
bool vs_mesh_turn_outwards(vs_mesh *m, size_t first_triangle);

#endif
