/* Makes the walls of lofts: rows of points between the sections, and the triangles between these rows.
 *
 * A smooth loft divides each line of the wall into two parts: the path of the sections' centres, and the vector from
 * the centre to the wall. Each is a cubic Hermite curve through the sections. The slopes are those of vs_loft_slope:
 * circular where the sections turn, but zero if a neighbour is equal. Therefore the wall between equal sections is
 * straight, and no wall overshoots a section (the idea of Fritsch and Carlson, for vectors). The slope of the centres
 * is computed separately along the section's normal and perpendicular to it. Thus a column of equal storeys stays
 * upright below the section at which it begins to lean. */
#include "geometry/profiles/loft_mesh.h"

#include <stdlib.h>
#include <string.h>

#include "geometry/frame.h"
#include "geometry/profiles/grid.h"
#include "geometry/profiles/loft.h"
#include "geometry/profiles/loft_guided.h"
#include "model/store/array.h"

vs_vec3 *vs_loft_rows_add(vs_loft_rows *r) {
  if (r->rows == r->room && !vs_room_grow(&r->at, &r->room, r->rows + 1, (r->columns + 1) * sizeof *r->at)) return NULL;
  return r->at + r->rows++ * r->columns;
}

/* ---- slopes ---- */

/* returns the mean of the slopes p and q by Fritsch and Butland's formula, weighted by the lengths h and k of the
 * steps; p, q >= 0 */
static double loft_harmonic(double p, double q, double h, double k) {
  double w = 2 * k + h, v = k + 2 * h;
  VS_ASSERT(p >= 0 && q >= 0);
  return p > 0 && q > 0 ? (w + v) * p * q / (w * q + v * p) : 0;
}

/* Returns the length of the slope where a curve turns. s: length of the sum of the unit directions before and after
 * that point. For small turns it is 4 tan(angle/4), as in a cubic that approximates a circle; it decreases to 0 for
 * opposite directions. */
static double loft_round(double s) { return fmin(1, s * s / 2) * 2 / (1 + s / 2); }

vs_vec3 vs_loft_slope(vs_vec3 a, vs_vec3 b, double h, double k) {
  double p = vs_v3_length(a), q = vs_v3_length(b), mean = loft_harmonic(p, q, h, k);
  if (mean == 0) return vs_v3(0, 0, 0);
  vs_vec3 sum = vs_v3_add(vs_v3_scale(a, 1 / p), vs_v3_scale(b, 1 / q));
  double s = vs_v3_length(sum);
  return s > 1e-9 ? vs_v3_scale(sum, mean * loft_round(s) / s) : vs_v3(0, 0, 0);
}

vs_vec3 vs_loft_end_slope(vs_vec3 a, vs_vec3 m) {
  vs_vec3 out = vs_v3_sub(vs_v3_scale(a, 2), m);
  double along = vs_v3_dot(out, a), aa = vs_v3_dot(a, a);
  return aa > 0 && along < 0 ? vs_v3_sub(out, vs_v3_scale(a, along / aa)) : out;
}

/* Returns the slope of the path of the centres at a section. `a`, `b`: mean slopes before and after the section; `h`,
 * `k`: lengths of the parts before and after it; `n`: normal of the section, or zero. */
static vs_vec3 loft_center_slope(vs_vec3 a, vs_vec3 b, double h, double k, vs_vec3 n) {
  vs_vec3 whole = vs_loft_slope(a, b, h, k);
  double up = vs_v3_dot(a, n), on = vs_v3_dot(b, n);
  if (!(up > 0 && on > 0)) return whole;
  vs_vec3 across = vs_loft_slope(vs_v3_sub(a, vs_v3_scale(n, up)), vs_v3_sub(b, vs_v3_scale(n, on)), h, k);
  double rest = vs_v3_dot(whole, whole) - vs_v3_dot(across, across);
  return vs_v3_add(across, vs_v3_scale(n, sqrt(fmax(rest, 0))));
}

vs_vec3 vs_loft_hermite(vs_vec3 p, vs_vec3 q, vs_vec3 m, vs_vec3 k, double t) {
  double s = 1 - t, a = s * s * (1 + 2 * t), b = t * t * (3 - 2 * t), c = t * s * s, d = -t * t * s;
  VS_ASSERT(t >= 0 && t <= 1);
  return vs_v3_add(vs_v3_add(vs_v3_scale(p, a), vs_v3_scale(q, b)), vs_v3_add(vs_v3_scale(m, c), vs_v3_scale(k, d)));
}

double vs_loft_hermite_steps(vs_vec3 p, vs_vec3 q, vs_vec3 m, vs_vec3 k, const vs_fineness *f) {
  vs_vec3 d = vs_v3_sub(q, p);
  vs_vec3 start = vs_v3_sub(vs_v3_scale(d, 6), vs_v3_add(vs_v3_scale(m, 4), vs_v3_scale(k, 2)));
  vs_vec3 end = vs_v3_sub(vs_v3_add(vs_v3_scale(m, 2), vs_v3_scale(k, 4)), vs_v3_scale(d, 6));
  double bend = fmax(vs_v3_length(start), vs_v3_length(end)), turning = 0, length = vs_v3_length(d);
  if (bend <= 1e-12 * length) return 1;
  vs_vec3 middle = vs_v3_sub(vs_v3_scale(d, 1.5), vs_v3_scale(vs_v3_add(m, k), 0.25)), ways[3] = { m, middle, k };
  for (int i = 0; i < 2; i++)
    turning += atan2(vs_v3_length(vs_v3_cross(ways[i], ways[i + 1])), vs_v3_dot(ways[i], ways[i + 1]));
  double n = ceil(turning / 6.28318530717958647693 * (f->segments > 0 ? f->segments : vs_fineness_least(f)) - 1e-9);
  if (f->segments <= 0) n = fmax(n, ceil(sqrt(bend / (8 * f->tolerance)) - 1e-9));
  return n < 1 ? 1 : n > 256 ? 256 : n;
}

/* ---- lines of the wall ---- */

/* Returns the number of pieces, 1 to 64, into which the wall between two rows must be cut for the tolerance. A wall
 * between lines that are not parallel is a saddle. `edges[c]`: receives the number of pieces of each section's edge at
 * column c. */
static double loft_saddle(const vs_loft *l, const vs_fineness *f, uint32_t *edges) {
  enum { MOST = 64 };
  double most = 0;
  size_t pieces = l->joined ? l->rows : l->rows - 1, n = l->columns;
  for (int pass = 0; pass < 2; pass++) { /* the first pass computes k, the second pass the number of pieces of each
                                          * edge */
    double k = fmin(fmax(ceil(sqrt(most / f->tolerance) - 1e-9), 1), MOST);
    if (pass && (f->segments > 0 || k == 1)) return 1;
    for (size_t loop = 0, first = 0; loop < l->loop_count; first += l->sizes[loop++])
      for (size_t c = first; c < first + l->sizes[loop]; c++) {
        size_t d = c + 1 == first + l->sizes[loop] ? first : c + 1;
        double here = 0;
        for (size_t i = 0; i < pieces && (l->round || d > c); i++) {
          size_t next = (i + 1) % l->rows;
          vs_vec3 p = vs_v3_sub(l->at[i * n + d], l->at[i * n + c]),
                  q = vs_v3_sub(l->at[next * n + c], l->at[i * n + c]), across = vs_v3_unit(vs_v3_cross(p, q));
          vs_vec3 twist = vs_v3_sub(vs_v3_sub(l->at[next * n + d], l->at[next * n + c]), p);
          here = fmax(here, fabs(vs_v3_dot(twist, across)) / 4); /* distance of the saddle's middle from the two
                                                                  * triangles, perpendicular to the wall */
        }
        most = fmax(most, here);
        edges[c] = (uint32_t)fmin(fmax(ceil(here / (f->tolerance * k) - 1e-9), 1), MOST);
      }
    if (pass) return k;
  }
  return 1;
}

static bool loft_refine_columns(vs_loft *l, const uint32_t *edges) {
  size_t columns = 0;
  for (size_t loop = 0, first = 0; loop < l->loop_count; first += l->sizes[loop++])
    for (size_t c = 0; c < l->sizes[loop]; c++) columns += !l->round && c + 1 == l->sizes[loop] ? 1 : edges[first + c];
  vs_vec3 *at = vs_fresh(l->rows * columns + 1, sizeof *at);
  if (!at) return false;
  for (size_t i = 0, to = 0; i < l->rows; i++)
    for (size_t loop = 0, first = 0; loop < l->loop_count; first += l->sizes[loop++])
      for (size_t c = 0; c < l->sizes[loop]; c++) {
        bool last = c + 1 == l->sizes[loop];
        const vs_vec3 *row = l->at + i * l->columns;
        vs_vec3 p = row[first + c], q = row[last ? first : first + c + 1];
        uint32_t k = last && !l->round ? 1 : edges[first + c];
        for (uint32_t j = 0; j < k; j++)
          at[to++] = j ? vs_v3_add(p, vs_v3_scale(vs_v3_sub(q, p), (double)j / (double)k)) : p;
      }
  for (size_t loop = 0, first = 0; loop < l->loop_count; loop++) {
    size_t size = 0, was = l->sizes[loop];
    for (size_t c = 0; c < was; c++) size += !l->round && c + 1 == was ? 1 : edges[first + c];
    l->sizes[loop] = size;
    first += was;
  }
  free(l->at);
  l->at = at;
  l->columns = columns;
  return true;
}

/* ---- the smooth loft ---- */

void vs_loft_smooth_free(vs_loft_smooth *s) {
  free(s->slope_in);
  free(s->slope_out);
}

static vs_vec3 loft_way(const vs_loft *l, size_t row, size_t column) { /* returns the vector from the centre of a row to
                                                                        * the point of the wall at this column */
  return vs_v3_sub(l->at[row * l->columns + column], l->center[row]);
}

static double loft_chord(const vs_loft *l, size_t i) { /* returns the mean distance between row i and the next row, over
                                                        * the points of the wall */
  size_t next = (i + 1) % l->rows;
  double sum = 0;
  for (size_t c = 0; c < l->columns; c++)
    sum += vs_v3_length(vs_v3_sub(l->at[next * l->columns + c], l->at[i * l->columns + c]));
  return fmax(sum / (double)l->columns, 1e-12 * l->size);
}

/* Returns the slope at row i of the line of the wall in this column, or of the path of the centres if column ==
 * l->columns. i is below l->rows. */
static vs_vec3 loft_slope_at(const vs_loft *l, const double *chord, size_t i, size_t column) {
  size_t before = i ? i - 1 : l->rows - 1, after = (i + 1) % l->rows;
  bool path = column == l->columns;
  vs_vec3 p = path ? l->center[before] : loft_way(l, before, column), q = path ? l->center[i] : loft_way(l, i, column),
          r = path ? l->center[after] : loft_way(l, after, column);
  vs_vec3 a = vs_v3_scale(vs_v3_sub(q, p), 1 / chord[before]), b = vs_v3_scale(vs_v3_sub(r, q), 1 / chord[i]);
  VS_ASSERT(i < l->rows && column <= l->columns);
  return path ? loft_center_slope(a, b, chord[before], chord[i], l->normal[i])
              : vs_loft_slope(a, b, chord[before], chord[i]);
}

/* returns the mean slope between row i and the next row of the line in this column, or of the path of the centres if
 * column == l->columns */
static vs_vec3 loft_secant(const vs_loft *l, const double *chord, size_t i, size_t column) {
  size_t after = (i + 1) % l->rows;
  vs_vec3 d = column == l->columns ? vs_v3_sub(l->center[after], l->center[i])
                                   : vs_v3_sub(loft_way(l, after, column), loft_way(l, i, column));
  VS_ASSERT(column <= l->columns && i < l->rows);
  return vs_v3_scale(d, 1 / chord[i]);
}

static vs_vec3 loft_line_slope(const vs_loft *l, const double *chord, size_t i, size_t column) {
  if (l->joined || (i && i + 1 < l->rows)) return loft_slope_at(l, chord, i, column);
  size_t piece = i ? i - 1 : 0, other = i ? i - 1 : 1;
  vs_vec3 a = loft_secant(l, chord, piece, column);
  return l->rows < 3 ? a : vs_loft_end_slope(a, loft_slope_at(l, chord, other, column));
}

bool vs_loft_smooth_make(const vs_loft *l, vs_loft_smooth *out) {
  size_t n = l->columns;
  *out =
      (vs_loft_smooth){ l, vs_fresh(l->rows * n + 1, sizeof(vs_vec3)), vs_fresh(l->rows * n + 1, sizeof(vs_vec3)) };
  double *chord = vs_fresh(l->rows + 1, sizeof *chord);
  bool ok = out->slope_in && out->slope_out && chord;
  for (size_t i = 0; ok && i < l->rows; i++) chord[i] = loft_chord(l, i);
  for (size_t i = 0; ok && i < l->rows; i++) {
    vs_vec3 path = loft_line_slope(l, chord, i, n);
    for (size_t c = 0; c < n; c++) {
      vs_vec3 slope = vs_v3_add(path, loft_line_slope(l, chord, i, c));
      /* slope at the start of the piece of wall that begins at row i */
      out->slope_out[i * n + c] = vs_v3_scale(slope, chord[i]);
      out->slope_in[i * n + c] = vs_v3_scale(slope, chord[i ? i - 1 : l->rows - 1]); /* slope at the end of the piece of
                                                                                      * wall that ends at row i */
    }
  }
  free(chord);
  return ok;
}

/* Returns the direction, in the plane of a section with the normal n, that points outwards from the wall at this row
 * and column. */
static vs_vec3 loft_outwards(const vs_loft *l, size_t row, size_t column, vs_vec3 n) {
  size_t first = 0, loop = 0, other = row ? row - 1 : 1;
  VS_ASSERT(row < l->rows && column < l->columns);
  if (l->point[row]) { /* for a section that is a point, uses the outward direction of the neighbouring section */
    vs_vec3 d = vs_v3_sub(l->at[other * l->columns + column], l->center[other]);
    return vs_v3_unit(vs_v3_sub(d, vs_v3_scale(n, vs_v3_dot(d, n))));
  }
  while (column >= first + l->sizes[loop]) first += l->sizes[loop++];
  size_t size = l->sizes[loop], i = column - first;
  const vs_vec3 *at = l->at + row * l->columns + first;
  vs_vec3 before = at[l->round ? (i + size - 1) % size
                      : i      ? i - 1
                               : 0],
          after = at[l->round       ? (i + 1) % size
                     : i + 1 < size ? i + 1
                                    : i];
  vs_vec3 a = vs_v3_unit(vs_v3_sub(at[i], before)), b = vs_v3_unit(vs_v3_sub(after, at[i]));
  return vs_v3_unit(vs_v3_cross(vs_v3_add(a, b), n));
}

/* Sets the direction of the wall at the first section, or if `end` is true, at the last. The direction leans outwards
 * from the normal by `angle` radians. hold: length of the handle of a Bezier curve; a cubic's slope is 3 times as long.
 * The loft has at least two rows. */
static void loft_hold(vs_loft_smooth *s, bool end, double angle, double hold) {
  const vs_loft *l = s->loft;
  size_t row = end ? l->rows - 1 : 0, other = end ? l->rows - 2 : 1;
  vs_vec3 n = l->normal[row];
  VS_ASSERT(l->rows >= 2);
  if (vs_v3_length(n) == 0)
    n = vs_v3_unit(end ? vs_v3_sub(l->center[row], l->center[other]) : vs_v3_sub(l->center[other], l->center[row]));
  double sine, cosine;
  vs_sincos(angle, &sine, &cosine);
  for (size_t c = 0; c < l->columns; c++) {
    vs_vec3 out = loft_outwards(l, row, c, n),
            slope = vs_v3_add(vs_v3_scale(n, 3 * hold * cosine), vs_v3_scale(out, 3 * hold * (end ? -sine : sine)));
    if (end) s->slope_in[row * l->columns + c] = slope;
    else s->slope_out[row * l->columns + c] = slope;
  }
}

void vs_loft_smooth_row(const vs_loft_smooth *s, size_t i, double t, vs_vec3 *row) {
  const vs_loft *l = s->loft;
  size_t n = l->columns, next = (i + 1) % l->rows;
  VS_ASSERT(i < s->loft->rows && t >= 0 && t <= 1);
  if (t == 0 || t == 1) memcpy(row, l->at + (t == 0 ? i : next) * n, n * sizeof *row);
  else
    for (size_t c = 0; c < n; c++)
      row[c] =
          vs_loft_hermite(l->at[i * n + c], l->at[next * n + c], s->slope_out[i * n + c], s->slope_in[next * n + c], t);
}

double vs_loft_smooth_steps(const vs_loft_smooth *s, size_t i, const vs_fineness *f) {
  const vs_loft *l = s->loft;
  size_t n = l->columns, next = (i + 1) % l->rows;
  double steps = 1;
  for (size_t c = 0; c < n; c++)
    steps = fmax(steps, vs_loft_hermite_steps(l->at[i * n + c], l->at[next * n + c], s->slope_out[i * n + c],
                                              s->slope_in[next * n + c], f));
  return steps;
}

static uint32_t loft_row_work(const vs_loft *l) { /* returns the estimated time in nanoseconds to make one row, for
                                                   * vs_store_going */
  return (uint32_t)fmin(64.0 * (double)l->columns, 1e9);
}

/* Makes the rows of a smooth loft. Returns false and sets e on failure. */
static bool loft_smooth_rows(const vs_node *n, const vs_loft *l, const vs_fineness *f, double least, vs_loft_rows *out,
                             vs_error *e) {
  vs_loft_smooth s;
  bool ok = vs_loft_smooth_make(l, &s) || vs_error_memory(e, NULL);
  if (ok && n->kind == VS_LOFT && !l->joined) {
    const struct vs_loft *d = VS_AS(loft, n);
    if (d->start_hold > 0) loft_hold(&s, false, d->start_angle, d->start_hold);
    if (d->end_hold > 0) loft_hold(&s, true, d->end_angle, d->end_hold);
  }
  size_t pieces = l->joined ? l->rows : l->rows - 1;
  for (size_t i = 0; ok && i < pieces; i++) {
    double steps = fmax(least, vs_loft_smooth_steps(&s, i, f));
    for (double k = 0; ok && k < steps; k++) {
      vs_vec3 *row = vs_loft_rows_add(out);
      ok = (row || vs_error_memory(e, NULL)) && vs_store_going(n->store, loft_row_work(l), e);
      if (ok) vs_loft_smooth_row(&s, i, k / steps, row);
    }
  }
  vs_vec3 *last = ok && !l->joined ? vs_loft_rows_add(out) : NULL;
  if (last) vs_loft_smooth_row(&s, l->rows - 2, 1, last);
  vs_loft_smooth_free(&s);
  return ok && (last || l->joined || vs_error_memory(e, NULL));
}

/* ---- straight walls ---- */

/* Makes the rows of a loft with straight walls: k pieces of wall between two sections. Returns false and sets e on
 * failure. */
static bool loft_straight_rows(const vs_node *n, const vs_loft *l, double k, vs_loft_rows *out, vs_error *e) {
  size_t pieces = l->joined ? l->rows : l->rows - 1, columns = l->columns;
  for (size_t i = 0; i <= pieces; i++) {
    if (i == pieces && l->joined) break;
    for (double j = 0; j < (i == pieces ? 1 : k); j++) {
      vs_vec3 *row = vs_loft_rows_add(out);
      if (!row) return vs_error_memory(e, NULL);
      if (!vs_store_going(n->store, loft_row_work(l), e)) return false;
      const vs_vec3 *p = l->at + i * columns, *q = l->at + (i + 1) % l->rows * columns;
      for (size_t c = 0; c < columns; c++)
        row[c] = j > 0 ? vs_v3_add(p[c], vs_v3_scale(vs_v3_sub(q[c], p[c]), j / k)) : p[c];
    }
  }
  return true;
}

/* ---- triangles ---- */

bool vs_loft_mesh(const vs_node *n, const vs_fineness *f, vs_mesh *out, vs_error *e) {
  vs_loft l;
  vs_loft_rows rows = { 0 };
  size_t first = out->triangle_count,
         count = n->kind == VS_GUIDED_LOFT ? (size_t)VS_AS(guided_loft, n)->section_count : n->child_count;
  if (!vs_loft_match(n, count, f, &l, e)) return false;
  uint32_t *edges = vs_fresh(l.columns + 1, sizeof *edges);
  double k = edges ? loft_saddle(&l, f, edges) : 1;
  bool ok = (edges && (k <= 1 || loft_refine_columns(&l, edges))) || vs_error_memory(e, NULL);
  free(edges);
  rows.columns = l.columns;
  if (ok && n->kind == VS_GUIDED_LOFT)
    ok =
        VS_AS(guided_loft, n)->path ? vs_loft_along_path(n, &l, f, &rows, e) : vs_loft_along_guides(n, &l, f, &rows, e);
  else if (ok) {
    bool held = n->kind == VS_LOFT && (VS_AS(loft, n)->start_hold > 0 || VS_AS(loft, n)->end_hold > 0);
    bool straight = n->kind == VS_RULED_LOFT || (l.rows < 3 && !held);
    ok = straight ? loft_straight_rows(n, &l, k, &rows, e) : loft_smooth_rows(n, &l, f, k, &rows, e);
  }
  vs_quad_grid g = { .at = rows.at, .rows = rows.rows, .columns = rows.columns, .sizes = l.sizes, .hole = l.hole,
                     .loop_count = l.loop_count, .round = l.round, .joined = l.joined, .capped = l.round };
  ok = ok && (vs_grid_mesh(&g, out) || vs_error_memory(e, NULL));
  if (ok && l.round) vs_mesh_turn_outwards(out, first);
  free(rows.at);
  vs_loft_free(&l);
  return ok;
}
