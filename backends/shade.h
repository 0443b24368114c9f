/* Owns the normals of triangle corners for round shading: smooth inside a curved surface, sharp across its creases. */
#ifndef VS_BACKENDS_SHADE_H
#define VS_BACKENDS_SHADE_H

#include <stddef.h>
#include <stdint.h>

#include "backends/backend.h"

/* As vs_alloc_fn: new_bytes 0 frees, NULL is failure. */
typedef void *vs_shade_memory(void *context, void *old, size_t old_bytes, size_t new_bytes);

typedef struct {
  vs_vec3 *normals;           /* unit */
  uint32_t (*corners)[3];     /* a normal for each corner of each triangle */
  size_t normal_count, normal_room, corner_room;
  vs_shade_memory *memory;    /* that the arrays are of */
  void *context;
} vs_shading;

/* crease: the angle between faces, radians, from which an edge stays sharp. False: out of memory or interrupted, as e's
 * error says. The memory is that of e's store. Free with vs_shading_free. */
bool vs_shading_make(vs_emitter *e, const vs_vec3 *vertices, size_t vertex_count, const uint32_t (*triangles)[3],
                     size_t triangle_count, double crease, vs_shading *out);
/* The same where a triangle's corners are smooth with those of its own group alone; groups NULL: all are one. */
#define VS_SHADE_FLAT UINT32_MAX /* a group: each of its triangles has the normal of its face */
bool vs_shading_make_grouped(vs_emitter *e, const vs_vec3 *vertices, size_t vertex_count,
                             const uint32_t (*triangles)[3], const uint32_t *groups, size_t triangle_count,
                             double crease, vs_shading *out);
/* The same in other memory, for who keeps it longer than e's store lives. */
bool vs_shading_make_in(vs_emitter *e, vs_shade_memory *memory, void *context, const vs_vec3 *vertices,
                        size_t vertex_count, const uint32_t (*triangles)[3], size_t triangle_count, double crease,
                        vs_shading *out);
/* The usual crease, radians: of shapes that are round somewhere, and of those that are flat all over. */
static inline double vs_shade_crease(bool round) { return round ? 0.6 : 0.05; }
void vs_shading_free(vs_shading *s);

#endif
