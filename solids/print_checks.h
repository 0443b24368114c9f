/* Declares the checks of a solid that is to be printed in layers along Z. */
#ifndef VS_SOLIDS_PRINT_CHECKS_H
#define VS_SOLIDS_PRINT_CHECKS_H

#include "kernel/kernel_options.h"
#include "model/mesh.h"

typedef enum { VS_PRINT_WALL, VS_PRINT_OVERHANG, VS_PRINT_VOID, VS_PRINT_PIECE, VS_PRINT_GAP } vs_print_kind;

typedef struct {
  vs_print_kind kind;
  vs_vec3 place; /* wall and gap: middle of the thinnest place; overhang: a point of the steepest facet; void and piece:
                  * centroid */
  double value;  /* wall: thickness; gap: width; overhang: angle from the vertical in radians; void and piece: volume */
  double area;   /* wall and gap: area of one side; overhang: area of the faces; void and piece: area of the surface */
} vs_print_fault;

typedef struct { vs_print_fault *at; size_t count, room; } vs_print_faults;

typedef struct {
  double wall;     /* thickness below which a wall is a fault; 0: walls are not measured */
  double overhang; /* angle from the vertical, in radians, above which a face that looks down is a fault, except on the
                    * plane of the lowest point */
  double gap;      /* width below which a gap is a fault; 0: gaps are not measured */
} vs_print_rule;

/* Appends the faults of a closed mesh to out. Faces that are opposite each other within 30 degrees bound a wall or a
 * gap; neighbouring facets make one fault. options may be NULL. Returns false and sets e on failure. The caller frees
 * out->at in either case. */
bool vs_print_check(const vs_mesh *m, vs_store *store, const vs_print_rule *rule, const vs_kernel_options *options,
                    vs_print_faults *out, vs_error *e);

#endif
