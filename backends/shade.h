/* Owns the normals of triangle corners for round shading: smooth inside a curved surface, sharp across its creases. */
#ifndef VS_BACKENDS_SHADE_H
#define VS_BACKENDS_SHADE_H

#include <stddef.h>
#include <stdint.h>

#include "backends/backend.h"

/* As vs_alloc_fn: new_bytes 0 frees; returns NULL on failure. */
typedef void *vs_shade_memory(void *context, void *old, size_t old_bytes, size_t new_bytes);

typedef struct {
  vs_vec3 *normals;           /* unit */
  uint32_t (*corners)[3];     /* the index of a normal for each corner of each triangle */
  size_t normal_count, normal_room, corner_room;
  vs_shade_memory *memory;    /* owns the arrays */
  void *context;
} vs_shading;

/* Triangles that get normals, borrowed from the caller. */
typedef struct {
  const vs_vec3 *vertices;
  const uint32_t (*triangles)[3];
  const uint32_t *groups;     /* the group of each triangle: its corners are smooth only with those of its group; NULL:
                               * all are one group */
  size_t vertex_count, triangle_count;
  double crease;              /* radians: the least angle between two faces that makes their edge sharp */
} vs_shade_faces;
#define VS_SHADE_FLAT UINT32_MAX /* a group: each of its triangles has the normal of its face */

/* Returns the faces of a mesh as one group. */
static inline vs_shade_faces vs_shade_mesh(const vs_mesh *m, double crease) {
  return (vs_shade_faces){ m->vertices, (const uint32_t (*)[3])m->triangles, NULL, m->vertex_count, m->triangle_count,
                           crease };
}

/* Makes the normals of the faces in the memory of e's store. Fails when memory is out or the user interrupts; sets e's
 * error, and *out is empty. Free with vs_shading_free. */
bool vs_shading_make(vs_emitter *e, const vs_shade_faces *faces, vs_shading *out);
/* The same in other memory, for a caller that keeps it longer than e's store lives. */
bool vs_shading_make_in(vs_emitter *e, vs_shade_memory *memory, void *context, const vs_shade_faces *faces,
                        vs_shading *out);
/* Returns the usual crease, radians, of shapes that are round somewhere, and of those with flat faces only. */
static inline double vs_shade_crease(bool round) { return round ? 0.6 : 0.05; }
void vs_shading_free(vs_shading *s);

/* A solid whose triangles are being written with normals. A vertex of the file is a corner with its normal; corners
 * with the same normal share a vertex. */
typedef struct {
  const vs_solid *solid;
  const vs_affine *place;     /* from the solid to the file */
  bool mirrored;              /* the place mirrors: the order of each triangle's corners is reversed */
  vs_shading shading;
  uint32_t *vertex;           /* vertex[i]: the number of normal i's vertex in the current part; VS_SHADED_NEW: none */
} vs_shaded_solid;
#define VS_SHADED_NEW UINT32_MAX

/* Makes the normals and the room for the vertices' numbers; borrows solid and place. Fails as vs_shading_make does.
 * Free with vs_shaded_free, also after a failure. */
bool vs_shaded_make(vs_emitter *e, const vs_solid *solid, const vs_affine *place, double crease, vs_shaded_solid *out);
void vs_shaded_free(vs_emitter *e, vs_shaded_solid *s);
void vs_shaded_begin_part(vs_shaded_solid *s); /* the next part has new vertices */
static inline vs_vec3 vs_shaded_point(const vs_shaded_solid *s, size_t triangle, int corner) {
  const vs_mesh *m = &s->solid->mesh;
  return vs_affine_point(s->place, m->vertices[m->triangles[triangle][corner]]);
}
static inline vs_vec3 vs_shaded_normal(const vs_shaded_solid *s, size_t triangle, int corner) {
  return vs_affine_normal(s->place, s->shading.normals[s->shading.corners[triangle][corner]]);
}
static inline uint32_t *vs_shaded_vertex(const vs_shaded_solid *s, size_t triangle, int corner) {
  return &s->vertex[s->shading.corners[triangle][corner]];
}

#endif
