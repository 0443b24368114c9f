/* Defines the state of rounding a mesh (rounding.c), shared with the search for self-contacts after rounding
 * (self_contacts.c) and with contraction.c, which mends them. */
#ifndef VS_KERNEL_ROUND_ROUNDING_STATE_H
#define VS_KERNEL_ROUND_ROUNDING_STATE_H

#include "model/mesh.h"
#include "kernel/memory.h"
#include "kernel/mesh/shells.h"
#include "kernel/round/rounded.h"

typedef struct { uint32_t first, count; } vs_fan;

typedef struct { double value; int axis; } vs_storey; /* a plane across an axis that contains a triangle */

typedef struct {
  vs_kernel *k;
  vs_mesh *m;
  vs_numbers numbers;      /* LOOSE is SINGLE here */
  /* triangles are given by positions, without indices: those with two equal corners are omitted */
  bool places;
  vs_bounds bounds;
  double coarsest;         /* two units where the mesh is furthest from the origin */
  VS_LIST(vs_storey) storeys; /* storeys of the mesh, by axis and value, each once; empty if two of them are less than
                               * two units apart */
  bool level;              /* every triangle lies in a storey */
  VS_LIST(vs_fan) fans;    /* for each vertex: its triangles that are not gone, a range of `around` */
  VS_LIST(uint32_t) around;
  VS_LIST(uint32_t) look;  /* in order: triangles that may be low or have an edge that is too short: at first all of
                            * them, then those that have changed */
  VS_LIST(uint8_t) busy;   /* for each vertex: this round has changed something near it */
  VS_LIST(uint8_t) gone;   /* for each triangle: 1: gone; numbers are kept until the end */
  VS_LIST(uint8_t) listed; /* for each triangle: 1: in look; 2: counted among those that meet */
  VS_LIST(uint8_t)
  changed; /* for each triangle: VS_CHANGED if it has been given other corners, so that it no longer belongs to the
            * exact result; VS_SUSPECT beside one that may have turned over, or at a place where the surface touches
            * itself */
  bool searched;           /* all pairs of triangles have been tested once (self_contacts.c) */
  vs_shells shells;        /* filled on request; a collapse stays within its shell */
  VS_LIST(uint8_t) alone;  /* for each vertex, in the first search: see stars.h; else empty */
  VS_LIST(uint8_t) folded; /* for each vertex: 1: of two triangles that lie on each other, up to some units */
  VS_LIST(uint8_t) near_met; /* for each vertex: 1: of a triangle that meets another; 2, 3: one and two triangles
                              * further */
} vs_rounding;

enum { VS_CHANGED = 1, VS_SUSPECT = 2, VS_SEEN = 4 /* with one of the others: a search has seen the triangle in that
                                                    * state */ };

bool vs_rounding_find_shells(vs_rounding *s); /* returns false if memory is out or the caller interrupts */
vs_vec3 vs_rounding_corner(const vs_rounding *s, uint32_t v); /* returns the rounded corner */
/* Returns the unit of the last place of a number; digits that doubles lost on the way out of a frame do not count. */
double vs_rounding_unit(double x, vs_numbers numbers);
double vs_rounding_reach(vs_vec3 p); /* returns the largest absolute coordinate */
/* v is a vertex of the mesh. */
double vs_rounding_unit_at(const vs_rounding *s, uint32_t v); /* returns the unit of the corner's largest coordinate */
/* t is a triangle of the mesh. */
int vs_rounding_longest(const vs_rounding *s, uint32_t t); /* returns the first corner of the triangle's longest edge: 0
                                                            * to 2 */
/* From three corners: the normal of their triangle, twice as long as its area; and the least of its three heights. */
static inline vs_vec3 vs_rounding_normal(vs_vec3 a, vs_vec3 b, vs_vec3 c) {
  return vs_v3_cross(vs_v3_sub(b, a), vs_v3_sub(c, a));
}
double vs_rounding_height(vs_vec3 a, vs_vec3 b, vs_vec3 c);
/* Returns true if rounding turns the triangle by more than two or three degrees, or makes it vanish. */
bool vs_rounding_bends(const vs_rounding *s, uint32_t t);

/* Returns the index of the axis's first storey that is not below the value, or the index at which it would be. */
size_t vs_rounding_storey(const vs_rounding *s, int axis, double value);

/* Returns true if the triangle is lower than the distance by which rounding may move its corners, and that turns it by
 * more than two or three degrees. Returns true also if it is lower than its doubles can represent. Doubles are already
 * rounded: such a triangle may have turned over then, and no format's numbers turn it any further. */
bool vs_rounding_is_noise(const vs_rounding *s, uint32_t t);

#endif
