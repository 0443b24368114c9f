/* Owns the questions about one mesh that are asked before it may be a solid: is it closed, and does it wind around
 * every place at most once? */
#ifndef VS_KERNEL_MESH_INSPECT_H
#define VS_KERNEL_MESH_INSPECT_H

#include "model/mesh.h"
#include "kernel/distinct_meshes.h"

enum { VS_FLAWS_LISTED = 16 };

typedef struct {
  uint32_t triangle;
  vs_vec3 at;      /* open: the middle of the edge; wound: inside the triangle, beside the place that is wound
                    * wrongly */
  int32_t winding; /* wound: how often what lies beside it is wound around: 2 and more where the mesh overlaps itself,
                    * below 0 inside out */
} vs_mesh_flaw;

typedef struct {
  size_t open_count;                /* edges that are not walked as often one way as the other; where there are any,
                                     * nothing else is looked at */
  size_t wound_count;               /* triangles beside space that is wound other than 0 or 1 times, by more than
                                     * rounding explains; of the coplanar triangles that make one face, at least one */
  bool touches;                     /* it may lie on itself or touch itself, other than in corners and edges of
                                     * neighbours; wound or not */
  int32_t least, most;              /* windings found, 0 among them; a good solid has 0 and 1 */
  double volume;                    /* signed */
  vs_mesh_flaw open[VS_FLAWS_LISTED], wound[VS_FLAWS_LISTED]; /* the first of each, by triangle */
} vs_mesh_flaws;

static inline bool vs_mesh_flawless(const vs_mesh_flaws *f) { return f->open_count == 0 && f->wound_count == 0; }

/* *good: closed, nothing meets anything, no shell lies in another, and around each corner is one fan: told in doubles,
 * as most meshes can be. False on error only. */
bool vs_part_plainly_good(vs_kernel *k, const vs_part *p, bool *good);

/* Corners in one place are one corner, whatever their indices; tags are not looked at. Shells within shells are
 * cavities where they look inwards. False on error only (not finite, memory, limit, interrupt): a flaw is an answer.
 * options may be NULL. */
bool vs_kernel_inspect(const vs_mesh *mesh, const vs_kernel_options *options, vs_mesh_flaws *out,
                       vs_kernel_error *error);

/* Appends to out the solid of all that mesh winds around more than 0 times: a closed mesh that crosses or overlaps
 * itself becomes one that does not; parts that are inside out vanish. Triangles get the tag. Fails as
 * vs_kernel_evaluate does: OPEN, INSIDE_OUT as a whole, and so on. */
bool vs_kernel_resolve(const vs_mesh *mesh, uint32_t tag, const vs_kernel_options *options, vs_mesh *out,
                       vs_kernel_error *error);

#endif
