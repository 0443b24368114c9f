/* Declares the conversion of a model's nodes to solid meshes. It meshes distinct primitives once, and passes placements
 * and booleans to the kernel. */
#ifndef VS_SOLIDS_SOLID_MESHES_H
#define VS_SOLIDS_SOLID_MESHES_H

#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "kernel/evaluate.h"
#include "model/node.h"

/* The source of a face of a solid: primitive, material and layer. Coplanar faces that differ only in their primitive
 * are merged, and the merged face has one of these primitives. */
typedef struct {
  const vs_material *material; /* material of the face; NULL if the model gives it none */
  const char *layer;           /* name of the face's layer, interned in the nodes' store; NULL if there is none */
  const char *part;            /* name of the part of the drawing to which the face belongs; NULL if there is none */
  vs_ref leaf;                 /* first primitive with this material and layer; its origin is used for all faces of the
                                * part; valid as long as the nodes exist */
  uint32_t object;             /* number of the object to which the part belongs (vs_solid_of_objects); 0: objects are
                                * not distinguished */
} vs_solid_part;

typedef struct {
  vs_mesh mesh;         /* mesh of the solid; triangle i belongs to the part parts[mesh.tags[i]] */
  vs_solid_part *parts; /* sources of the solid's faces; the solid owns this array */
  size_t part_count;
  size_t straightened;  /* number of corners that were removed where the kernel's grid had bent a straight cut (option
                         * `straight` in kernel_options.h) */
} vs_solid;

/* A solid as copies of meshes: groups of touching solids that are copies of each other are stored once. */
typedef struct {
  vs_kernel_copies meshes;
  vs_solid_part *parts;
  size_t part_count;
  size_t straightened;
} vs_solid_copies;

typedef struct { const vs_ref *at; size_t count; } vs_refs;

/* Computes the union of the solids in refs, and ignores curves and surfaces. Where solids overlap, the earlier solid
 * has priority. A face made by a subtraction has the cutter's material, if it has one. options may be NULL. Returns
 * false and sets an error on failure; out is then empty. */
bool vs_solid_evaluate(const vs_ref *refs, size_t count, const vs_fineness *facets, const vs_kernel_options *options,
                       vs_solid *out, vs_error *error);
/* Computes the union of the solids as vs_solid_evaluate does, but keeps faces of different objects apart: coplanar
 * faces that touch stay two faces. An object is a node that is `depth` levels below a reference; if depth is 0, it is
 * the reference's own node. */
bool vs_solid_of_objects(const vs_refs *refs, int depth, const vs_fineness *facets, const vs_kernel_options *options,
                         vs_solid *out, vs_error *error);
/* Evaluates a single object as vs_solid_evaluate does, but each face belongs to the primitive that made it: the wall of
 * a hole belongs to the cutter. Primitives with different meshes have different parts. Returns false and sets e on
 * failure. */
bool vs_solid_of_leaves(vs_ref ref, const vs_fineness *facets, const vs_kernel_options *options, vs_solid *out,
                        vs_error *error);
void vs_solid_free(vs_solid *s);
bool vs_solid_evaluate_copies(const vs_ref *refs, size_t count, const vs_fineness *facets,
                              const vs_kernel_options *options, vs_solid_copies *out, vs_error *error);
void vs_solid_copies_free(vs_solid_copies *s);
/* Adds the seconds of the kernel's steps in `counts` to the account of the store's job. */
void vs_solid_tally_steps(vs_store *s, const vs_kernel_counts *counts);

#endif
