/* Declares lofts, solids and surfaces through sections, for use in geometry/ and bind/. */
#ifndef VS_GEOMETRY_PROFILES_LOFT_H
#define VS_GEOMETRY_PROFILES_LOFT_H

#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"

/* The sections of a loft as a table of points: row r is a section, and column c of all rows is one line along the
 * wall. */
typedef struct {
  size_t rows, columns, loop_count;
  vs_vec3 *at;          /* points of the sections, one row for each: rows * columns points */
  vs_vec3 *center;      /* center[r]: centre of section r, the section of row r */
  vs_vec3 *normal;      /* normal[r]: unit normal of section r, in the loft's direction; zero if the section is a point
                         * or an open curve */
  bool *point;          /* point[r]: true if section r is a point, so that all points of row r coincide */
  size_t *sizes;        /* sizes[l]: number of points of loop l in each row; outer loops are counter-clockwise about the
                         * normal */
  bool *hole;
  bool round;           /* true if the loops of the sections are closed */
  bool joined;          /* true if the loft is closed: a wall also connects the last section to the first */
  double size;          /* size of the entire loft, in model units */
} vs_loft;

void vs_loft_free(vs_loft *l);
/* Matches the points of the loft's sections. The sections are the first `count` children of n; count is at least 1.
 * Returns false and sets e if they are not compatible. */
bool vs_loft_match(const vs_node *n, size_t count, const vs_fineness *f, vs_loft *out, vs_error *e);

/* -- declarations for loft_guided.c and loft_mesh.c alone -- */

typedef struct { vs_vec3 *at; size_t rows, room, columns; } vs_loft_rows;
/* The slopes of a smooth loft at its sections: derivatives at the points of each row. The parameter goes from 0 to 1
 * between two rows. `slope_out`: for the part of the wall that begins at the row; `slope_in`: for the part that ends
 * there. */
typedef struct { const vs_loft *loft; vs_vec3 *slope_in, *slope_out; } vs_loft_smooth;

#endif
