/* Defines the state of the repair of a mesh for rounding (rounding.c). The search for triangles that intersect after
 * rounding (self_contacts.c) and their repair (contraction.c) share it. */
#ifndef VS_KERNEL_ROUND_ROUNDING_STATE_H
#define VS_KERNEL_ROUND_ROUNDING_STATE_H

#include "model/mesh.h"
#include "kernel/memory.h"
#include "kernel/mesh/shells.h"
#include "kernel/round/rounded.h"

typedef struct { uint32_t first, count; } vs_fan;

typedef struct { double value; int axis; } vs_storey; /* A storey is a plane perpendicular to an axis that contains
                                                       * triangles. value: the coordinate of the plane along this
                                                       * axis. */

typedef struct {
  vs_kernel *k;
  vs_mesh *m;
  vs_numbers numbers;      /* kind of the format's numbers; VS_NUMBERS_LOOSE is replaced by VS_NUMBERS_SINGLE */
  /* True if the format stores positions without vertex numbers. Triangles with two equal corners are then omitted. */
  bool places;
  vs_bounds bounds;
  double coarsest;         /* Two units in the last place of the mesh's greatest coordinate: two corners farther apart
                            * than this are never rounded to one position. */
  VS_LIST(vs_storey) storeys; /* the planes perpendicular to an axis that contain triangles, sorted by axis and value;
                               * empty if two of them are less than two units apart */
  bool level;              /* true if every triangle is perpendicular to an axis, in one of `storeys` */
  VS_LIST(vs_fan) fans;    /* fans[v]: range in `around` of the triangles at vertex v that are not removed */
  VS_LIST(uint32_t) around;
  VS_LIST(uint32_t) look;  /* sorted list of triangles that may be low or have a short edge: at first all such
                            * triangles, later those that have changed */
  VS_LIST(uint8_t) busy;   /* busy[v]: 1 if the current round has changed a triangle at vertex v */
  VS_LIST(uint8_t) gone;   /* gone[t]: 1 if triangle t is removed; triangles keep their numbers until the end */
  VS_LIST(uint8_t) listed; /* listed[t]: 1 if triangle t is in `look`; 2 if it is counted among the intersecting
                            * triangles */
  VS_LIST(uint8_t)
  changed; /* changed[t]: marks of triangle t. VS_CHANGED: the repair has given it other corners. VS_SUSPECT: it is
            * beside a triangle that may have turned over, or where the surface touches itself. VS_SEEN: a search for
            * intersections has tested it since then. */
  bool searched;           /* true if self_contacts.c has tested all pairs of triangles once */
  vs_shells shells;        /* shells (connected parts) of the mesh, computed when needed; they stay valid, because the
                            * collapse of an edge does not connect two shells */
  VS_LIST(uint8_t) alone;  /* alone[v]: 1 if the shell of vertex v cannot intersect anything after rounding (stars.h);
                            * filled only for the first search, empty later */
  VS_LIST(uint8_t) folded; /* folded[v]: 1 if vertex v belongs to two triangles that lie on each other, within some
                            * units of the last place */
  VS_LIST(uint8_t) near_met; /* near_met[v]: 1 if vertex v belongs to a triangle that intersects another; 2 or 3 if it
                              * is one or two triangles away from such a vertex */
} vs_rounding;

enum { VS_CHANGED = 1, VS_SUSPECT = 2, VS_SEEN = 4 /* VS_SEEN: since the triangle got its mark VS_CHANGED or VS_SUSPECT,
                                                    * a search for intersections has tested it */ };

bool vs_rounding_find_shells(vs_rounding *s); /* computes s->shells if it is not computed yet; returns false if memory
                                               * is out or the caller interrupts */
vs_vec3 vs_rounding_corner(const vs_rounding *s, uint32_t v); /* returns the position of vertex v after rounding to the
                                                               * format's numbers */
/* Returns the unit in the last place of a number of the size of x. For doubles, it includes the digits that are lost
 * when coordinates are mapped from the cluster's frame. */
double vs_rounding_unit(double x, vs_numbers numbers);
double vs_rounding_reach(vs_vec3 p); /* returns the largest absolute value of the coordinates of p */
/* v must be a vertex of the mesh. */
double vs_rounding_unit_at(const vs_rounding *s, uint32_t v); /* returns the unit in the last place of the largest
                                                               * coordinate of vertex v */
/* t must be a triangle of the mesh. */
int vs_rounding_longest(const vs_rounding *s, uint32_t t); /* returns the corner (0 to 2) of triangle t at which its
                                                            * longest edge begins */
/* vs_rounding_normal returns the normal of the triangle a, b, c, with twice the area as length. vs_rounding_height
 * returns the least of the triangle's three heights. */
static inline vs_vec3 vs_rounding_normal(vs_vec3 a, vs_vec3 b, vs_vec3 c) {
  return vs_v3_cross(vs_v3_sub(b, a), vs_v3_sub(c, a));
}
double vs_rounding_height(vs_vec3 a, vs_vec3 b, vs_vec3 c);
/* Returns true if rounding changes the direction of triangle t by more than two or three degrees, or makes the triangle
 * vanish. */
bool vs_rounding_bends(const vs_rounding *s, uint32_t t);

/* Returns the index in s->storeys of the first plane perpendicular to the axis at a coordinate of at least `value`. If
 * there is none, returns the index at which it would be inserted. */
size_t vs_rounding_storey(const vs_rounding *s, int axis, double value);

/* Returns true if rounding may turn triangle t over: t is lower than the distance by which its corners may move, and
 * its direction changes by more than two or three degrees. Also returns true if t is lower than doubles can represent,
 * because it may have turned over before. */
bool vs_rounding_is_noise(const vs_rounding *s, uint32_t t);

#endif
