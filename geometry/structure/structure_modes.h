/* Declares the modes of structures: the shapes in which a structure buckles under its axial forces, or vibrates. */
#ifndef VS_GEOMETRY_STRUCTURE_STRUCTURE_MODES_H
#define VS_GEOMETRY_STRUCTURE_STRUCTURE_MODES_H

#include "geometry/structure/structure.h"

typedef struct {
  const vs_structure *s;   /* its loads count for nothing */
  const double *axial;     /* buckling: two numbers a member, the axial forces at its ends; NULL: vibration */
  const double *mass;      /* vibration: of each member, in kg */
  const double *node_mass; /* vibration: of each node, in kg */
  size_t parts;            /* segments into which a member that bends is cut, 1 or more */
  size_t want;             /* greatest number of modes, 1 or more */
} vs_modes_problem;

/* Sets values[0..], in rising order, to the factors by which the axial forces grow until the structure buckles, or to
 * frequencies in Hz. Sets shapes, (parts + 1) * 3 numbers a member for each mode, to movements at the ends of the
 * segments; the greatest has the length 1. Sets *found to the number of modes; 0: nothing buckles. */
vs_structure_outcome vs_structure_modes(const vs_modes_problem *p, vs_long_work work, double *values, double *shapes,
                                        size_t *found, vs_structure_report *report, vs_error *e);

#endif
