/* Owns the way from a model's nodes to solid meshes: distinct primitives tessellated once, placements and booleans handed to the kernel. */
#ifndef VS_KERNEL_SOLID_H
#define VS_KERNEL_SOLID_H

#include "geometry/tessellate.h"
#include "kernel/kernel.h"
#include "model/node.h"

typedef struct {
  vs_mesh mesh;              /* triangle i is painted with parts[mesh.tags[i]] */
  const vs_material **parts; /* owned; NULL entries: no material was given */
  size_t part_count;
} vs_solid;

/* The union of the solids in refs; curves and surfaces beside them are left out. out need not be initialised; it is empty after a
 * failure. options may be NULL. A face made by a subtraction has the cutter's material, or that of what was cut where the cutter
 * has none; where solids overlap the earlier wins. */
bool vs_solid_evaluate(const vs_ref *refs, size_t count, const vs_facets *facets, const vs_kernel_options *options, vs_solid *out, vs_error *error);
void vs_solid_free(vs_solid *s);

#endif
