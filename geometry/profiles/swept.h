/* Declares, for use in geometry/ alone, the common part of extrude, sweep and thicken: a profile that is moved through
 * sections. */
#ifndef VS_GEOMETRY_PROFILES_SWEPT_H
#define VS_GEOMETRY_PROFILES_SWEPT_H

#include "geometry/plane/outline.h"
#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "geometry/plane/ear_clipping.h"

/* A section maps the point (u, v) of the profile's plane to x * u + y * v + at. Between two sections the map is
 * interpolated linearly. The solid is defined by this interpolation, not by the triangles. */
typedef struct {
  vs_vec3 x, y, at;
  bool ends; /* true if a piece ends at this section, so that nothing connects it to the next section */
} vs_section;
typedef struct {
  vs_vec2 *profile;   /* points of the profile's loops, one loop after another; outer loops are counter-clockwise, each
                       * followed by its holes */
  size_t *sizes;      /* sizes[l]: number of points of loop l */
  bool *hole;
  size_t loop_count, profile_count;
  bool filled;        /* true for a solid; false if the profile is open and sweeps a surface */
  vs_section *sections;
  size_t section_count, section_room;
  bool joined;        /* true if the last section is connected to the first */
  size_t *seam;       /* If not NULL: the last section lies at the first, but its profile is turned. Its point i
                       * coincides with point seam[i] of the first section. */
  bool across;        /* true if the sections are perpendicular to a path, or mitred, with x and y right-handed about
                       * the path's direction */
  vs_vec2 base;       /* the point of the profile that moves along the path; only valid if `across` is true */
} vs_swept;

void vs_swept_free(vs_swept *s);
/* Computes the sections of node n, an extrude, sweep or thicken (of a curve or region). Returns false and sets e on
 * failure. */
bool vs_swept_plan(const vs_node *n, const vs_fineness *f, vs_swept *out, vs_error *e);
/* Returns the section between two neighbouring sections a and b, interpolated at 0 <= t <= 1. */
vs_section vs_section_between(const vs_section *a, const vs_section *b, double t);

#endif
