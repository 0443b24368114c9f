/* Declares the search for clashes: pairs of solids that overlap, touch, or are nearer to each other than a
 * clearance. */
#ifndef VS_SOLIDS_CLASHES_H
#define VS_SOLIDS_CLASHES_H

#include "solids/solid_meshes.h"

typedef enum { VS_CLASH_OVERLAP, VS_CLASH_TOUCH, VS_CLASH_NEAR } vs_clash_kind;

typedef struct {
  vs_clash_kind kind;
  uint32_t a, b;   /* numbers of the two parts, a < b */
  double volume;   /* volume of the parts' intersection; 0 unless they overlap */
  double area;     /* area in which the parts touch; 0 unless `kind` is VS_CLASH_TOUCH */
  double gap;      /* distance between the parts; 0 unless `kind` is VS_CLASH_NEAR */
  vs_vec3 place;   /* Overlap: centroid of the largest piece of the intersection. Touch: centroid of the area, or a
                    * point where the parts touch. Near: the middle between the nearest points. */
} vs_clash;

typedef struct { vs_clash *at; size_t count, room; } vs_clash_list;

typedef struct {
  double clearance;  /* distance below which parts clash, 0 or more */
  double tolerance;  /* tolerance of curved parts; 0: it follows from the size of each pair */
  int segments;      /* number of facets in a full turn of curved parts, as in vs_fineness */
} vs_clash_rule;

/* Appends to out all clashes of the parts, which are resolved (solids/resolve.h): first overlaps, then touches, then
 * gaps. Parts that overlap by less than 1e-7 of their size count as touching. Returns false and sets e on failure. The
 * caller frees out->at in either case. */
bool vs_clashes_find(const vs_refs *parts, const vs_clash_rule *rule, const vs_kernel_options *options,
                     vs_clash_list *out, vs_error *e);

#endif
