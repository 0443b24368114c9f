/* Declares the places of flat parts on sheets: kinds of parts, their forms in the allowed rotations, the sheets with
 * their pieces, and the search for the place of one part. */
#ifndef VS_GEOMETRY_NETS_NESTING_PLACES_H
#define VS_GEOMETRY_NETS_NESTING_PLACES_H

#include "geometry/nets/nesting.h"
#include "geometry/plane/areas.h"
#include "model/vec.h"

typedef struct { double x0, y0, x1, y1; } vs_nest_box;

/* A convex piece of a turned part. first, count: range of its mirrored points in `mirrored`; grown_first, grown_count:
 * range of the points of the piece, grown by the gap, in `grown`. */
typedef struct {
  size_t first, count, grown_first, grown_count;
  vs_nest_box box;
} vs_nest_piece;

/* A form: a part of one kind, turned by one of the allowed angles. */
typedef struct {
  size_t first, count; /* range of the turned part's convex pieces */
  vs_nest_box box;
  double angle;
} vs_nest_form;

/* A kind: the parts that have one shape. */
typedef struct {
  size_t first, count; /* range of the forms of the kind: its part turned by each allowed angle */
  double area, extent; /* area: area of the part; extent: longer side of its bounding box */
  uint32_t part;       /* number of the first part of this kind */
} vs_nest_kind;

typedef struct {
  size_t piece;
  vs_vec2 move;
} vs_nest_laid_piece;

typedef struct {
  vs_nest_laid_piece *at;
  size_t count, room;
  vs_nest_box *parts; /* bounding boxes of the parts that lie on the sheet */
  size_t part_count, part_room;
  double width, free, reach; /* free: area of the sheet without parts; reach: greatest x of a part on the sheet */
  bool *full;                /* full[k]: true if a part of kind k no longer fits on this sheet */
} vs_nest_sheet;

/* Where a part lies: number of the sheet, form (the turned part), and move of the form. */
typedef struct {
  uint32_t sheet;
  size_t form;
  vs_vec2 move;
} vs_nest_laid;

/* Working memory for the search of a place for one part (nesting_places.c). */
typedef struct vs_nest_lines vs_nest_lines;

/* All parts and sheets, with the places of the parts. The caller sets the rule, the number of parts, slack, kind_of and
 * laid before it places parts. */
typedef struct {
  const vs_nest_rule *rule;
  double slack; /* lengths below this count as 0 */
  vs_vec2 *grown, *mirrored;
  size_t grown_points, grown_room, points, mirrored_room;
  vs_nest_piece *pieces;
  size_t piece_count, piece_room;
  vs_nest_form *forms;
  size_t form_count, form_room;
  vs_nest_kind *kinds;
  size_t kind_count, kind_room;
  uint32_t *kind_of; /* kind_of[i]: number of part i's kind; parts of one kind have equal shape */
  size_t parts;
  vs_nest_sheet *sheets;
  size_t sheet_count, sheet_room;
  vs_nest_laid *laid; /* laid[i]: sheet and place of part i */
  int wish;           /* number of the formula that measures how good a place on a sheet is */
  size_t endless;     /* index of the sheet that is treated as endless, or SIZE_MAX if there is none */
  uint64_t steps;     /* amount of work done so far, in an arbitrary unit */
  vs_nest_lines *lines;
} vs_nest_places;

/* Groups the parts into kinds of equal shape, and turns each kind by the allowed angles. *unfit: first part that is too
 * large for the sheet, or the number of parts. Returns false when memory is out. */
bool vs_nest_find_kinds(vs_nest_places *w, const vs_area *parts, size_t *unfit);

/* Places a part on the first sheet where it fits. *used: number of sheets so far, which increases if a new sheet is
 * needed. Returns false when memory is out. */
bool vs_nest_lay_part(vs_nest_places *w, uint32_t part, size_t *used);

/* Lays a part at the place stored in `laid`. *used: number of sheets in use, which may increase. Returns false when
 * memory is out. */
bool vs_nest_lay_again(vs_nest_places *w, uint32_t part, size_t *used);

/* Returns the length to which a sheet is filled: the mean of the greatest x of its parts and the length that their area
 * requires. */
double vs_nest_filled(const vs_nest_places *w, const vs_nest_sheet *s);

/* Returns the vector p, turned by the angle with the sine s and the cosine c. */
vs_vec2 vs_nest_turned(vs_vec2 p, double s, double c);

void vs_nest_places_free(vs_nest_places *w);

#endif
