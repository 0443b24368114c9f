/* Declares, for use in geometry/ and bind/, lofts: solids and surfaces through sections. */
#ifndef VS_GEOMETRY_PROFILES_LOFT_H
#define VS_GEOMETRY_PROFILES_LOFT_H

#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"

/* Sections with matched points: column c of all rows forms one line of the wall. */
typedef struct {
  size_t rows, columns, loop_count;
  vs_vec3 *at;          /* points of the rows, one row after another: rows * columns points */
  vs_vec3 *center;      /* centre of each row */
  vs_vec3 *normal;      /* for each row: unit normal in the loft's direction; zero for a point or an open curve */
  bool *point;          /* for each row: true if all points of the row coincide */
  size_t *sizes;        /* number of points in each loop of a row; outer loops are counter-clockwise about the normal */
  bool *hole;
  bool round;           /* true if the loops are closed */
  bool joined;          /* true if the last row is joined to the first */
  double size;          /* size of the entire loft, in model units */
} vs_loft;

void vs_loft_free(vs_loft *l);
/* Matches the first `count` children of n as sections of a loft; count is at least 1. Returns false and sets e if they
 * are not compatible. */
bool vs_loft_match(const vs_node *n, size_t count, const vs_fineness *f, vs_loft *out, vs_error *e);

/* -- declarations for loft_guided.c and loft_mesh.c alone -- */

typedef struct { vs_vec3 *at; size_t rows, room, columns; } vs_loft_rows;
/* Appends the rows of a loft without guides between section i and the next. */
/* A piece is the part of the wall between two rows. slope_out: derivative of each point of a row where a piece begins;
 * slope_in: derivative where a piece ends at the row. The parameter goes from 0 to 1 over the piece. */
typedef struct { const vs_loft *loft; vs_vec3 *slope_in, *slope_out; } vs_loft_smooth;

#endif
