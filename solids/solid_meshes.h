/* Owns the way from a model's nodes to solid meshes: distinct primitives tessellated once, placements and booleans
 * handed to the kernel. */
#ifndef VS_SOLIDS_SOLID_MESHES_H
#define VS_SOLIDS_SOLID_MESHES_H

#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "kernel/evaluate.h"
#include "model/node.h"

/* The source of a face. Faces that differ in their leaf alone are merged where they are coplanar, and then name one of
 * the leaves. */
typedef struct {
  const vs_material *material; /* NULL: none was given */
  const char *layer;           /* NULL: none; interned in the nodes' store */
  vs_ref leaf;                 /* the first such primitive; its origin is that of them all; lives as long as the
                                * nodes */
} vs_solid_part;

typedef struct {
  vs_mesh mesh;         /* triangle i belongs to parts[mesh.tags[i]] */
  vs_solid_part *parts; /* owned */
  size_t part_count;
  size_t straightened;  /* bends that were left out (kernel_options.h) */
} vs_solid;

/* The same with clusters that are copies of each other standing once. */
typedef struct {
  vs_kernel_copies meshes;
  vs_solid_part *parts;
  size_t part_count;
  size_t straightened;
} vs_solid_copies;

/* The union of the solids in refs; curves and surfaces beside them are left out. out need not be initialised; it is
 * empty after a failure. options may be NULL. A face made by a subtraction has the cutter's material, or that of what
 * was cut where the cutter has none; where solids overlap the earlier wins. */
bool vs_solid_evaluate(const vs_ref *refs, size_t count, const vs_fineness *facets, const vs_kernel_options *options,
                       vs_solid *out, vs_error *error);
void vs_solid_free(vs_solid *s);
bool vs_solid_evaluate_copies(const vs_ref *refs, size_t count, const vs_fineness *facets,
                              const vs_kernel_options *options, vs_solid_copies *out, vs_error *error);
void vs_solid_copies_free(vs_solid_copies *s);
/* Adds the seconds of the kernel's steps to the account of whoever owns the store. */
void vs_solid_tally_steps(vs_store *s, const vs_kernel_counts *counts);

#endif
