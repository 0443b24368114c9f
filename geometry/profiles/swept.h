/* Declares, for use in geometry/ alone, what extrude, sweep and thicken have in common: a profile carried through sections. */
#ifndef VS_GEOMETRY_PROFILES_SWEPT_H
#define VS_GEOMETRY_PROFILES_SWEPT_H

#include "geometry/plane/outline.h"
#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "geometry/plane/ear_clipping.h"

/* Section i maps the profile's plane into space: (u, v) -> x * u + y * v + at. Between neighbours the map goes
 * linearly: that, and not the triangles, is what the solid is. */
typedef struct {
  vs_vec3 x, y, at;
  bool ends; /* a piece: nothing lies between this section and the next */
} vs_section;
typedef struct {
  vs_vec2 *profile;   /* loops one behind the other; outer ones counter-clockwise, each followed by its holes */
  size_t *sizes;      /* of the loops */
  bool *hole;
  size_t loop_count, profile_count;
  bool filled;        /* false: an open profile; it makes a surface */
  vs_section *sections;
  size_t section_count, section_room;
  bool joined;        /* the last section goes on to the first */
  size_t *seam;       /* not NULL: the last section is the first again, turned, and its point i lies on point seam[i] of
                       * that */
  bool across;        /* the sections stand across a path, x and y right-handed about the way */
  vs_vec2 base;       /* across: the point of the profile that rides on the path */
} vs_swept;

void vs_swept_free(vs_swept *s);
/* n: an extrude, sweep or thicken (of a curve or region). */
bool vs_swept_plan(const vs_node *n, const vs_fineness *f, vs_swept *out, vs_error *e);
/* The map between two neighbouring sections, 0 <= t <= 1 */
vs_section vs_section_between(const vs_section *a, const vs_section *b, double t);

#endif
