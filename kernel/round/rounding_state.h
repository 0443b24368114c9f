/* Owns the state of rounding a mesh (rounding.c), shared with the search for self-contacts after rounding
 * (self_contacts.c) and with what mends them (contraction.c). */
#ifndef VS_KERNEL_ROUND_ROUNDING_STATE_H
#define VS_KERNEL_ROUND_ROUNDING_STATE_H

#include "model/mesh.h"
#include "kernel/memory.h"
#include "kernel/mesh/shells.h"
#include "kernel/round/rounded.h"

typedef struct { uint32_t first, count; } vs_fan;

typedef struct { double value; int axis; } vs_storey; /* a plane across an axis in which a triangle lies */

typedef struct {
  vs_kernel *k;
  vs_mesh *m;
  vs_numbers numbers;      /* LOOSE is SINGLE here */
  /* triangles are given by places, without indices: those of which two corners are one place are left out */
  bool places;
  vs_bounds bounds;
  double coarsest;         /* two units where the mesh reaches furthest */
  VS_LIST(vs_storey) storeys; /* those of the mesh, by axis and value, each once; none where two of them are less than
                               * two units apart */
  bool level;              /* every triangle lies in one of them */
  VS_LIST(vs_fan) fans;    /* of a vertex: its triangles that are not gone, into around */
  VS_LIST(uint32_t) around;
  VS_LIST(uint32_t) look;  /* in order: triangles that may be thin, or have an edge that is too short: all that are, and
                            * what has changed since */
  VS_LIST(uint8_t) busy;   /* of a vertex: something near it has changed in this round */
  VS_LIST(uint8_t) gone;   /* of a triangle: 1; numbers stay until the end */
  VS_LIST(uint8_t) listed; /* of a triangle: 1: in look; 2: counted among those met */
  VS_LIST(uint8_t)
  changed; /* of a triangle: VS_CHANGED where it has been given other corners, so that it is none of the exact result's
            * any more; VS_SUSPECT beside one that may have turned over, or at a place
            * where the surface touches itself */
  bool searched;           /* all pairs of triangles have been looked at once (self_contacts.c) */
  vs_shells shells;        /* once they have been asked for; what collapses stays within its shell */
  VS_LIST(uint8_t) alone;  /* of a vertex, in the first search: see stars.h; else empty */
  VS_LIST(uint8_t) folded; /* of a vertex: 1: of two triangles that lie on each other but for some units */
  VS_LIST(uint8_t) near_met; /* of a vertex: 1: of a triangle that meets another; 2, 3: one and two triangles further */
} vs_rounding;

enum { VS_CHANGED = 1, VS_SUSPECT = 2, VS_SEEN = 4 /* with one of these: a search has seen it so */ };

bool vs_rounding_find_shells(vs_rounding *s); /* false: out of memory, or interrupted */
vs_vec3 vs_rounding_corner(const vs_rounding *s, uint32_t v); /* rounded */
/* The unit of the last place of a number; what doubles lost on the way out of a frame counts as lost. */
double vs_rounding_unit(double x, vs_numbers numbers);
double vs_rounding_reach(vs_vec3 p); /* its largest coordinate, without the sign */
/* v is a vertex of the mesh. */
double vs_rounding_unit_at(const vs_rounding *s, uint32_t v); /* the unit of that coordinate of a corner */
/* t is a triangle of the mesh. */
int vs_rounding_longest(const vs_rounding *s, uint32_t t); /* the first corner of the triangle's longest edge: 0 to 2 */
/* Of three corners: across their triangle, twice as long as its area; and the least of its three heights. */
static inline vs_vec3 vs_rounding_normal(vs_vec3 a, vs_vec3 b, vs_vec3 c) {
  return vs_v3_cross(vs_v3_sub(b, a), vs_v3_sub(c, a));
}
double vs_rounding_height(vs_vec3 a, vs_vec3 b, vs_vec3 c);
/* Does rounding turn the triangle by more than two or three degrees, or make it nothing? */
bool vs_rounding_bends(const vs_rounding *s, uint32_t t);

/* Where the first storey of the axis stands that is not below the value, or would. */
size_t vs_rounding_storey(const vs_rounding *s, int axis, double value);

/* Is it lower than rounding may move its corners by, and turned by that more than two or three degrees; or lower than
 * its doubles tell? Doubles have been rounded already: such a triangle may have turned over then, and no format's
 * numbers turn it any more. */
bool vs_rounding_is_noise(const vs_rounding *s, uint32_t t);

#endif
