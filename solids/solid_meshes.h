/* Owns the step from a model's nodes to solid meshes: it tessellates distinct primitives once, and passes placements
 * and booleans to the kernel. */
#ifndef VS_SOLIDS_SOLID_MESHES_H
#define VS_SOLIDS_SOLID_MESHES_H

#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "kernel/evaluate.h"
#include "model/node.h"

/* The source of a face. Coplanar faces that differ in their leaf alone are merged, and then name one of the leaves. */
typedef struct {
  const vs_material *material; /* NULL: the model gives none */
  const char *layer;           /* NULL: none; interned in the nodes' store */
  vs_ref leaf;                 /* the first such primitive, whose origin all of them have; lives as long as the nodes */
} vs_solid_part;

typedef struct {
  vs_mesh mesh;         /* triangle i belongs to parts[mesh.tags[i]] */
  vs_solid_part *parts; /* owned */
  size_t part_count;
  size_t straightened;  /* number of bends removed (kernel_options.h) */
} vs_solid;

/* A solid in which clusters that are copies of each other are stored once. */
typedef struct {
  vs_kernel_copies meshes;
  vs_solid_part *parts;
  size_t part_count;
  size_t straightened;
} vs_solid_copies;

/* Computes the union of the solids in refs; ignores curves and surfaces beside them. out need not be initialised; it is
 * empty after a failure. options may be NULL. A face made by a subtraction has the cutter's material, or that of the
 * solid it cuts if the cutter has none; where solids overlap the earlier has priority. */
bool vs_solid_evaluate(const vs_ref *refs, size_t count, const vs_fineness *facets, const vs_kernel_options *options,
                       vs_solid *out, vs_error *error);
void vs_solid_free(vs_solid *s);
bool vs_solid_evaluate_copies(const vs_ref *refs, size_t count, const vs_fineness *facets,
                              const vs_kernel_options *options, vs_solid_copies *out, vs_error *error);
void vs_solid_copies_free(vs_solid_copies *s);
/* Adds the seconds of the kernel's steps to the account of the store's owner. */
void vs_solid_tally_steps(vs_store *s, const vs_kernel_counts *counts);

#endif
