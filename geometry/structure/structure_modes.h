/* Declares the modes of structures: the shapes in which a structure buckles under its axial forces, or vibrates. */
#ifndef VS_GEOMETRY_STRUCTURE_STRUCTURE_MODES_H
#define VS_GEOMETRY_STRUCTURE_STRUCTURE_MODES_H

#include "geometry/structure/structure.h"

typedef struct {
  const vs_structure *s;   /* the structure, whose loads are ignored */
  const double *axial;     /* for buckling: axial forces at the two ends of each member, in N, positive for tension;
                            * NULL: vibration */
  const double *mass;      /* for vibration: mass of each member, in kg */
  const double *node_mass; /* for vibration: additional mass at each node, in kg */
  size_t parts;            /* number of segments into which each member that bends is cut, at least 1 */
  size_t want;             /* greatest number of modes to compute, at least 1 */
} vs_modes_problem;

/* Computes modes of buckling or vibration. `values`: factors by which the axial forces grow until the structure
 * buckles, or frequencies in Hz; ascending. `shapes`: movements at the ends of the segments, (parts + 1) * 3 numbers
 * for each member and mode, at most 1 long. `*found`: number of modes. */
vs_structure_outcome vs_structure_modes(const vs_modes_problem *p, vs_long_work work, double *values, double *shapes,
                                        size_t *found, vs_structure_report *report, vs_error *e);

#endif
