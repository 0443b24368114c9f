/* Declares the common part of extrude, sweep and thicken, for use in geometry/ alone: a profile that is moved through
 * sections. */
#ifndef VS_GEOMETRY_PROFILES_SWEPT_H
#define VS_GEOMETRY_PROFILES_SWEPT_H

#include "geometry/plane/outline.h"
#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "geometry/plane/ear_clipping.h"

/* A section maps the point (u, v) of the profile's plane to x * u + y * v + at. Between two sections, the map is
 * interpolated linearly. This interpolation defines the solid; triangles only approximate it. */
typedef struct {
  vs_vec3 x, y, at;
  bool ends; /* true if a piece of the sweep ends at this section, so that no walls connect it to the next section */
} vs_section;
typedef struct {
  vs_vec2 *profile;   /* points of the profile's loops, one loop after another; outer loops are counter-clockwise, each
                       * followed by its holes */
  size_t *sizes;      /* sizes[l]: number of points of loop l */
  bool *hole;
  size_t loop_count, profile_count;
  bool filled;        /* true for a solid; false if the profile is an open curve, which sweeps a surface */
  vs_section *sections;
  size_t section_count, section_room;
  bool joined;        /* true if walls connect the last section to the first */
  size_t *seam;       /* If not NULL: the last section coincides with the first, but with a turned profile: its point i
                       * is point seam[i] of the first section. */
  size_t *stride;     /* If not NULL: point i of the profile is a vertex only in sections 0, stride[i], 2 stride[i] ...;
                       * between them it moves on straight lines. The strides are powers of two, and divide the number
                       * of steps. */
  bool dense;         /* True if part of the profile goes backwards somewhere. Then all points are vertices in all
                       * sections, whose number depends on the whole profile. */
  bool across;        /* true if the sections are perpendicular to a path, or mitred; the sections' x and y are then
                       * right-handed about the path's direction */
  vs_vec2 base;       /* the point of the profile that moves on the path; valid only if `across` is true */
} vs_swept;

void vs_swept_free(vs_swept *s);
/* Computes the sections of node n: an extrude, a sweep, or a thicken of a curve or region. Returns false and sets e on
 * failure. */
bool vs_swept_plan(const vs_node *n, const vs_fineness *f, vs_swept *out, vs_error *e);
/* Returns the section between two neighbouring sections a and b, interpolated at 0 <= t <= 1. */
vs_section vs_section_between(const vs_section *a, const vs_section *b, double t);

#endif
