/* Declares, for use in geometry/ alone, the steps of a twisted sweep, and the pieces into which they divide the edges
 * of its profile. */
#ifndef VS_GEOMETRY_PROFILES_SWEPT_STEPS_H
#define VS_GEOMETRY_PROFILES_SWEPT_STEPS_H

#include "geometry/profiles/swept.h"

/* VS_STEPS_MOST: greatest number of steps of a path. VS_SWEPT_POINTS_MOST: greatest number of points in all rows. */
enum { VS_STEPS_MOST = 200000, VS_SWEPT_POINTS_MOST = 10000000 };

/* The motion of a profile about a point of its plane. */
typedef struct {
  double scale; /* scale at the end of the path */
  vs_vec2 base; /* the point about which the profile turns */
  double reach; /* greatest distance of the profile's points from the base */
  double turn;  /* rotation along the whole path in radians, >= 0, without that of an upright profile */
  double step;  /* greatest rotation in radians in a coarse step of the path (a step before any halving) */
  double lean;  /* greatest change of the sections' inclination along the path, in 1 / unit; 0 without corners. It moves
                 * points along the path, and thus away from a twisted wall. */
  size_t rows;  /* number of steps of the whole path by which all edges are divided; 0: each edge is divided by the
                 * steps of its own points */
} vs_twist;

/* Returns n rounded up, at least 1 and at most `most`. */
size_t vs_steps_count(double n, size_t most);
/* Returns the number of coarse steps (steps before any halving), at least 1, for a rotation by `angle`. */
size_t vs_twist_coarse(const vs_fineness *f, double angle);
/* Returns how often coarse steps must be halved, so that a point at the distance r from the base stays within the
 * tolerance. */
int vs_twist_halvings(const vs_fineness *f, double step, double r);
/* Returns the reach by which the inclination at corners decreases along a path of this length: the least of
 * length * 4^n, n an integer, that is not below the profile's own reach. Profiles of similar reach are thus inclined
 * equally. The tolerance does not change the solid. */
double vs_twist_lean_reach(double length, double reach);
/* Returns the distance from the base that determines the steps of a point at the distance r: greater than r near
 * corners, where twisted walls bend more. */
double vs_twist_reach(const vs_twist *twist, double r);
/* Sets twist->rows, the number of steps by which all edges are divided, to about the number of pieces of the longest
 * edge. */
void vs_twist_rows(const vs_swept *s, vs_twist *twist, const vs_fineness *f);
/* Returns the number of parts into which each of `count` coarse steps is divided for twist->rows rows. */
size_t vs_twist_parts(const vs_twist *twist, size_t count, const vs_fineness *f);
/* Divides the edges of the profile into pieces, as the tolerance requires for the twisted walls. Returns false when
 * memory is out. */
bool vs_twist_divide(vs_swept *s, const vs_twist *twist, const vs_fineness *f);
/* Sets s->stride, for each point the distance between rows in which it has a vertex. A row belongs to each part of a
 * coarse step after the given number of halvings. Returns false when memory is out. */
bool vs_twist_strides(vs_swept *s, const vs_twist *twist, int halvings, const vs_fineness *f);

/* ---- walls that are not planar: of an upright profile where its path climbs out of a bend, of a profile that grows or
 * shrinks ---- */

/* Divides the edges of the profile into pieces, so that triangles deviate from walls that are not planar by at most the
 * tolerance. Returns false when memory is out. */
bool vs_swept_flatten_edges(vs_swept *s, const vs_fineness *f);
/* Divides the steps of the path, and the edges of a profile without a seam, so that triangles deviate from walls that
 * are not planar by at most the tolerance. Returns false when memory is out. */
bool vs_swept_flatten_steps(vs_swept *s, const vs_fineness *f);

#endif
