/* Declares, for use in geometry/ and bind/, lofts: solids and surfaces through sections. */
#ifndef VS_GEOMETRY_PROFILES_LOFT_H
#define VS_GEOMETRY_PROFILES_LOFT_H

#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"

/* Sections of a loft with matched points: column c of all rows forms one line of the wall. */
typedef struct {
  size_t rows, columns, loop_count;
  vs_vec3 *at;          /* points of the sections, one row for each: rows * columns points */
  vs_vec3 *center;      /* center[r]: centre of the section of row r */
  vs_vec3 *normal;      /* normal[r]: unit normal of the section of row r in the loft's direction; zero for a point or
                         * an open curve */
  bool *point;          /* point[r]: true if all points of row r coincide */
  size_t *sizes;        /* sizes[l]: number of points of loop l in each row; outer loops are counter-clockwise about the
                         * normal */
  bool *hole;
  bool round;           /* true if the loops of the sections are closed */
  bool joined;          /* true if the last section is joined to the first */
  double size;          /* size of the entire loft, in model units */
} vs_loft;

void vs_loft_free(vs_loft *l);
/* Matches the first `count` children of n as sections of a loft; count is at least 1. Returns false and sets e if they
 * are not compatible. */
bool vs_loft_match(const vs_node *n, size_t count, const vs_fineness *f, vs_loft *out, vs_error *e);

/* -- declarations for loft_guided.c and loft_mesh.c alone -- */

typedef struct { vs_vec3 *at; size_t rows, room, columns; } vs_loft_rows;
/* Appends the rows of a loft without guides between section i and the next section. */
/* The slopes of a smooth loft at its sections. A piece is the part of the wall between two rows, over which the
 * parameter goes from 0 to 1. The derivatives at each point of a row are slope_out for the piece that begins there, and
 * slope_in for the piece that ends there. */
typedef struct { const vs_loft *loft; vs_vec3 *slope_in, *slope_out; } vs_loft_smooth;

#endif
