/* Declares the functions for the checks of one mesh that may become a solid: it must be closed and wind around every
 * place at most once. */
#ifndef VS_KERNEL_MESH_INSPECT_H
#define VS_KERNEL_MESH_INSPECT_H

#include "model/mesh.h"
#include "kernel/distinct_meshes.h"

enum { VS_FLAWS_LISTED = 16 };

typedef struct {
  uint32_t triangle;
  vs_vec3 at;      /* open: the middle of the edge; wound: a place inside the triangle, at the space with the wrong
                    * winding number */
  int32_t winding; /* wound: the winding number of the space beside it: 2 or more if the mesh overlaps itself, below 0
                    * if it is inside out */
} vs_mesh_flaw;

typedef struct {
  size_t open_count;                /* number of edges whose uses in the two directions differ; if there are any, the
                                     * inspection ends */
  size_t wound_count;               /* number of triangles beside space with a winding number other than 0 and 1, by
                                     * more than rounding explains; of the coplanar triangles of one face, at least one
                                     * counts */
  bool touches;                     /* it may overlap or touch itself other than in corners and edges of neighbours,
                                     * with or without wrong winding numbers */
  int32_t least, most;              /* the range of winding numbers, 0 included; a good solid has 0 and 1 */
  double volume;                    /* signed: negative if the mesh is inside out */
  vs_mesh_flaw open[VS_FLAWS_LISTED], wound[VS_FLAWS_LISTED]; /* the first of each kind, by triangle */
} vs_mesh_flaws;

static inline bool vs_mesh_flawless(const vs_mesh_flaws *f) { return f->open_count == 0 && f->wound_count == 0; }

/* *good: closed, without intersections, no shell inside another, and one fan around each corner. The test uses doubles,
 * which decide it for most meshes. Returns false only on an error. */
bool vs_part_plainly_good(vs_kernel *k, const vs_part *p, bool *good);

/* Inspects a mesh. Corners at one place are one corner, with any indices; tags do not matter. Shells in shells are
 * cavities if they face inwards. Returns false only on an error (not finite, memory, limit, interrupt); a flaw is a
 * result. options may be NULL. */
bool vs_kernel_inspect(const vs_mesh *mesh, const vs_kernel_options *options, vs_mesh_flaws *out,
                       vs_kernel_error *error);

/* Appends to out the solid of all space that mesh winds around more than 0 times: a closed mesh that intersects or
 * overlaps itself becomes one that does not; parts that are inside out vanish. Triangles get the tag. Fails like
 * vs_kernel_evaluate: OPEN, INSIDE_OUT as a whole, and so on. */
bool vs_kernel_resolve(const vs_mesh *mesh, uint32_t tag, const vs_kernel_options *options, vs_mesh *out,
                       vs_kernel_error *error);

#endif
