/* Defines the state of rounding a mesh (rounding.c). The search for self-contacts after rounding (self_contacts.c) and
 * their repair (contraction.c) share it. */
#ifndef VS_KERNEL_ROUND_ROUNDING_STATE_H
#define VS_KERNEL_ROUND_ROUNDING_STATE_H

#include "model/mesh.h"
#include "kernel/memory.h"
#include "kernel/mesh/shells.h"
#include "kernel/round/rounded.h"

typedef struct { uint32_t first, count; } vs_fan;

typedef struct { double value; int axis; } vs_storey; /* A storey: a plane perpendicular to an axis that contains a
                                                       * triangle. */

typedef struct {
  vs_kernel *k;
  vs_mesh *m;
  vs_numbers numbers;      /* kind of numbers; LOOSE is replaced by SINGLE */
  /* True if the format stores positions without vertex numbers. Triangles with two equal corners are then omitted. */
  bool places;
  vs_bounds bounds;
  double coarsest;         /* two units in the last place of the greatest coordinate of the mesh */
  VS_LIST(vs_storey) storeys; /* different storeys of the mesh, sorted by axis and value; empty if two of them are less
                               * than two units apart */
  bool level;              /* true if every triangle lies in a storey */
  VS_LIST(vs_fan) fans;    /* for each vertex: range in `around` of the triangles at the vertex that are not gone */
  VS_LIST(uint32_t) around;
  VS_LIST(uint32_t) look;  /* sorted list of triangles that may be low or have an edge that is too short: at first all
                            * of them, later those that have changed */
  VS_LIST(uint8_t) busy;   /* for each vertex: 1 if the current round has changed a triangle near it */
  VS_LIST(uint8_t) gone;   /* for each triangle: 1 if it is removed; triangles keep their numbers until the end */
  VS_LIST(uint8_t) listed; /* for each triangle: 1 if it is in `look`; 2 if it is counted among the intersecting
                            * triangles */
  VS_LIST(uint8_t)
  changed; /* for each triangle, a set of marks. VS_CHANGED: it has other corners than in the exact result. VS_SUSPECT:
            * it is beside a triangle that may have turned over, or at a place where the surface touches itself */
  bool searched;           /* true if all pairs of triangles have been tested once (self_contacts.c) */
  vs_shells shells;        /* shells of the mesh, computed when needed; collapsing an edge does not connect shells */
  VS_LIST(uint8_t) alone;  /* for each vertex, in the first search: 1 if its shell needs no test (stars.h); else
                            * empty */
  VS_LIST(uint8_t) folded; /* for each vertex: 1 if it belongs to two triangles that lie on each other, to within some
                            * units in the last place */
  VS_LIST(uint8_t) near_met; /* for each vertex: 1 if it belongs to a triangle that intersects another; 2 or 3 if it is
                              * one or two triangles away from such a vertex */
} vs_rounding;

enum { VS_CHANGED = 1, VS_SUSPECT = 2, VS_SEEN = 4 /* mark that is set together with another mark: a search has already
                                                    * seen the triangle with this mark */ };

bool vs_rounding_find_shells(vs_rounding *s); /* returns false if memory is out or the caller interrupts */
vs_vec3 vs_rounding_corner(const vs_rounding *s, uint32_t v); /* returns the position of vertex v after rounding */
/* Returns the unit in the last place of the number x. For doubles, digits that were lost on the way out of a frame are
 * not counted. */
double vs_rounding_unit(double x, vs_numbers numbers);
double vs_rounding_reach(vs_vec3 p); /* returns the largest absolute value of p's coordinates */
/* v is a vertex of the mesh. */
double vs_rounding_unit_at(const vs_rounding *s, uint32_t v); /* returns the unit of the largest coordinate of vertex
                                                               * v */
/* t is a triangle of the mesh. */
int vs_rounding_longest(const vs_rounding *s, uint32_t t); /* returns the first corner of the triangle's longest edge, 0
                                                            * to 2 */
/* vs_rounding_normal returns the normal of the triangle a, b, c, whose length is twice the area. vs_rounding_height
 * returns the least of the triangle's three heights. */
static inline vs_vec3 vs_rounding_normal(vs_vec3 a, vs_vec3 b, vs_vec3 c) {
  return vs_v3_cross(vs_v3_sub(b, a), vs_v3_sub(c, a));
}
double vs_rounding_height(vs_vec3 a, vs_vec3 b, vs_vec3 c);
/* Returns true if rounding changes the direction of triangle t by more than two or three degrees, or makes it
 * vanish. */
bool vs_rounding_bends(const vs_rounding *s, uint32_t t);

/* Returns the index of the first storey of the axis whose value is not below `value`. Returns the index at which it
 * would be inserted if there is none. */
size_t vs_rounding_storey(const vs_rounding *s, int axis, double value);

/* Returns true if triangle t is lower than the distance by which rounding may move its corners, and this changes its
 * direction by more than two or three degrees. Also returns true if the triangle is lower than doubles can represent.
 * Because doubles are rounded, such a triangle may have turned over before, and no format turns it further. */
bool vs_rounding_is_noise(const vs_rounding *s, uint32_t t);

#endif
