/* Declares the normals of triangle corners for smooth shading: smooth within a curved surface, sharp across its
 * creases. Also converts colours to linear light. */
#ifndef VS_BACKENDS_SHADE_H
#define VS_BACKENDS_SHADE_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include "backends/backend.h"

/* Returns a colour of sRGB in linear light (IEC 61966-2-1). */
static inline double vs_linear_light(double x) { return x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4); }
static inline vs_vec3 vs_linear_color(vs_vec3 c) {
  return vs_v3(vs_linear_light(c.x), vs_linear_light(c.y), vs_linear_light(c.z));
}

/* Allocates, resizes or frees a block, as vs_alloc_fn does: new_bytes 0 frees it. Returns NULL on failure. */
typedef void *vs_shade_memory(void *context, void *old, size_t old_bytes, size_t new_bytes);

typedef struct {
  vs_vec3 *normals;           /* list of unit normals, each used by one or several corners */
  uint32_t (*corners)[3];     /* corners[t][k]: index of the normal at corner k of triangle t */
  size_t normal_count, normal_room, corner_room;
  vs_shade_memory *memory;    /* function that allocated the arrays, and frees them */
  void *context;
} vs_shading;

/* Triangles for which normals are computed. The arrays belong to the caller. */
typedef struct {
  const vs_vec3 *vertices;
  const uint32_t (*triangles)[3];
  const uint32_t *groups;     /* groups[t]: group of triangle t, whose edges are smooth only between triangles of one
                               * group; NULL: all triangles are one group */
  size_t vertex_count, triangle_count;
  double crease;              /* least angle between two faces, in radians, at which their common edge is sharp */
} vs_shade_faces;
#define VS_SHADE_FLAT UINT32_MAX /* number of the group of flat triangles, each of which has the normal of its own
                                  * plane */

/* Returns the faces of a mesh as a single group. */
static inline vs_shade_faces vs_shade_mesh(const vs_mesh *m, double crease) {
  return (vs_shade_faces){ m->vertices, (const uint32_t (*)[3])m->triangles, NULL, m->vertex_count, m->triangle_count,
                           crease };
}

/* Computes the normals of the faces, in the memory of e's store. Fails if memory is out or the user interrupts; it then
 * sets e's error, and *out is empty. Free the result with vs_shading_free. */
bool vs_shading_make(vs_emitter *e, const vs_shade_faces *faces, vs_shading *out);
/* Computes normals as vs_shading_make does, but in the caller's memory. This is for a caller that keeps the normals
 * after e's store is freed. */
bool vs_shading_make_in(vs_emitter *e, vs_shade_memory *memory, void *context, const vs_shade_faces *faces,
                        vs_shading *out);
/* Returns the usual crease angle in radians: 0.6 for shapes with curved faces (round), 0.05 for shapes with flat faces
 * only. */
static inline double vs_shade_crease(bool round) { return round ? 0.6 : 0.05; }
void vs_shading_free(vs_shading *s);

/* A solid whose triangles are being written with normals. A vertex of the output file is a point together with a
 * normal. Corners at one point with the same normal are one vertex of the file. */
typedef struct {
  const vs_solid *solid;
  const vs_affine *place;     /* placement from the solid's coordinates to the file's */
  bool mirrored;              /* whether `place` mirrors, so that the order of each triangle's corners is reversed */
  vs_shading shading;
  uint32_t *vertex;           /* vertex[i]: number of the vertex with normal i in the current part; VS_SHADED_NEW: the
                               * part has no such vertex yet */
} vs_shaded_solid;
#define VS_SHADED_NEW UINT32_MAX

/* Computes the normals of the solid's corners, and allocates the numbers of vertices. The pointers solid and place must
 * remain valid. Fails as vs_shading_make does. Free *out with vs_shaded_free, even after a failure. */
bool vs_shaded_make(vs_emitter *e, const vs_solid *solid, const vs_affine *place, double crease, vs_shaded_solid *out);
void vs_shaded_free(vs_emitter *e, vs_shaded_solid *s);
void vs_shaded_begin_part(vs_shaded_solid *s); /* begins the next part of the solid, which has no vertices in common
                                                * with earlier parts */
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
