/* Declares checks of a mesh that is to become a solid: it must be closed, and every place must have the winding number
 * 0 or 1. */
#ifndef VS_KERNEL_MESH_INSPECT_H
#define VS_KERNEL_MESH_INSPECT_H

#include "model/mesh.h"
#include "kernel/distinct_meshes.h"

enum { VS_FLAWS_LISTED = 16 };

typedef struct {
  uint32_t triangle;
  vs_vec3 at;      /* Position of the flaw. For a flaw in `open`, it is the middle of the open edge. For a flaw in
                    * `wound`, it is a place inside the triangle that borders on space with a wrong winding number. */
  int32_t winding; /* in the list `wound`: winding number of the space beside the triangle; 2 or more if the mesh
                    * overlaps itself, below 0 if it is inside out */
} vs_mesh_flaw;

typedef struct {
  size_t open_count;                /* number of edges that triangles contain more often in one direction than in the
                                     * other; if there are any, the winding numbers are not computed */
  size_t wound_count;               /* number of triangles next to space with a winding number other than 0 and 1,
                                     * unless rounding errors explain the space. If several coplanar triangles form one
                                     * face next to such space, at least one of them is counted. */
  bool touches;                     /* true if the mesh may overlap or touch itself at more than common corners and
                                     * edges of neighbouring triangles; all winding numbers may be right nevertheless */
  int32_t least, most;              /* least and greatest winding number of any cell of space, including 0 for the
                                     * outside; a correct solid has 0 and 1 */
  double volume;                    /* signed volume of the mesh; negative if the mesh is inside out */
  vs_mesh_flaw open[VS_FLAWS_LISTED], wound[VS_FLAWS_LISTED]; /* the first flaws of each kind, sorted by triangle. open:
                                                               * edges without an opposite edge; wound: triangles beside
                                                               * space with a wrong winding number */
} vs_mesh_flaws;

static inline bool vs_mesh_flawless(const vs_mesh_flaws *f) { return f->open_count == 0 && f->wound_count == 0; }

/* Sets *good to true if the mesh is closed and does not intersect itself, no shell lies within another, and the
 * triangles at each vertex form one fan. *good may be false for a correct mesh, because the test uses doubles. Returns
 * false only on an error. */
bool vs_part_plainly_good(vs_kernel *k, const vs_part *p, bool *good);

/* Inspects a mesh. Vertices with equal coordinates count as one corner; tags are ignored. A shell within another is a
 * cavity if it faces inwards. options may be NULL. Returns false and sets the error only if a coordinate is not finite,
 * memory is out, a limit is exceeded or the caller interrupts. A flaw is not an error. */
bool vs_kernel_inspect(const vs_mesh *mesh, const vs_kernel_options *options, vs_mesh_flaws *out,
                       vs_kernel_error *error);

/* Appends to out the solid that contains every place where the winding number of the mesh is above 0. It does not
 * overlap itself, even if the mesh does. Parts that are inside out vanish. Every triangle gets the tag. Returns false
 * with the same errors as vs_kernel_evaluate. */
bool vs_kernel_resolve(const vs_mesh *mesh, uint32_t tag, const vs_kernel_options *options, vs_mesh *out,
                       vs_kernel_error *error);

#endif
