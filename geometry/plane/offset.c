/* Computes offsets in a plane: enlarged or reduced areas, and open lines moved to one side.
 *
 * An area grows by the union with strips along its outside, and shrinks by the difference with strips along its inside.
 * The union resolves overlaps and holes that close, and exact coordinates stay exact. A strip follows edges a -> b on
 * one side; hand +1 is the left of travel. Its far side is at the distance d. n1 and n2 are the normals of two
 * neighbouring edges towards that side. The far side goes through
 *   b + d n1, b + d n2           at a corner that opens on that side, with the corner's join between them;
 *   b + d (n1 + n2)/(1 + n1.n2)  at a corner that closes, if the edges are long enough for the far sides to intersect.
 * A strip ends at edges that are too short, and before it has turned by more than a right angle. Therefore no strip
 * crosses itself. The offset of an open line is the border of the union of its strips, without the line itself and the
 * ends. */
#include "geometry/plane/offset.h"

#include <stdlib.h>

#include "geometry/frame.h"
#include "geometry/plane/areas.h"
#include "geometry/plane/plane.h"
#include "model/store/array.h"

enum { MITRE_MOST = 100 }; /* greatest length of a mitre, as a multiple of the offset's distance; a sharper corner is
                            * cut off square */

typedef struct {
  vs_area *strips;
  vs_vec2 *near, *far;  /* points of the current strip: `near` on the original line, `far` at the offset's distance from
                         * it */
  size_t near_count, far_count, near_room, far_room;
  double turned, d, hand;
  vs_offset_corners corners;
  int turn;             /* number of facets in a full turn of a round corner */
  const vs_vec2 *ways;  /* exact unit directions of an open line at its two ends, or NULL */
} vs_offsetter;

static const double pi = 3.14159265358979323846;

static bool offset_push(vs_vec2 **at, size_t *count, size_t *room, double x, double y) {
  if (!VS_GROW(*at, *room, *count + 1)) return false;
  (*at)[(*count)++] = (vs_vec2){ x, y };
  return true;
}

static bool offset_near(vs_offsetter *o, vs_vec2 p) {
  return offset_push(&o->near, &o->near_count, &o->near_room, p.x, p.y);
}
static bool offset_far(vs_offsetter *o, vs_vec2 p, double nx, double ny) {
  return offset_push(&o->far, &o->far_count, &o->far_room, p.x + o->d * nx, p.y + o->d * ny);
}

/* Appends the current strip to the list of strips, as a counter-clockwise loop. If the far side is on the left, the
 * loop goes along the original line and back on the far side; otherwise the other way round. */
static bool offset_strip(vs_offsetter *o) {
  bool ok = true;
  size_t n = o->near_count, m = o->far_count;
  for (size_t i = 0; ok && i < n + m; i++) {
    size_t k = o->hand > 0 ? i : n + m - 1 - i;
    vs_vec2 p = k < n ? o->near[k] : o->far[m - 1 - (k - n)];
    ok = vs_area_point(o->strips, p.x, p.y);
  }
  o->near_count = o->far_count = 0;
  o->turned = 0;
  return ok && vs_area_loop(o->strips, false);
}

typedef struct { vs_vec2 p; double tx, ty, nx, ny, length; } vs_offset_edge; /* an edge that begins at p: unit direction
                                                                              * (tx, ty), unit normal (nx, ny) towards
                                                                              * the strip, and length */

/* Appends the far side of the strip around the corner p, at which the strip widens, from the end of edge a to the start
 * of edge b. */
static bool offset_join(vs_offsetter *o, vs_vec2 p, const vs_offset_edge *a, const vs_offset_edge *b) {
  double cosine = a->nx * b->nx + a->ny * b->ny, sine = a->nx * b->ny - a->ny * b->nx,
         half = atan2(fabs(sine), cosine) / 2;
  bool ok = offset_far(o, p, a->nx, a->ny);
  double least = 1 / cos(half);
  if (o->corners == VS_OFFSET_FACETS) {
    double step = (sine < 0 ? -2 : 2) * pi / o->turn;
    int steps = (int)floor(half / pi * o->turn + 0.5);
    for (int i = 1; ok && i < steps; i++) {
      double s, c;
      vs_sincos(step * i, &s, &c);
      ok = offset_far(o, p, a->nx * c - a->ny * s, a->nx * s + a->ny * c);
    }
  } else if (o->corners == VS_OFFSET_ROUND) {
    int steps = (int)ceil(half / pi * o->turn - 1e-9);
    for (int i = 1; ok && i < steps; i++) {
      double s, c, w = (sine < 0 ? -2 : 2) * half * i / steps;
      vs_sincos(w, &s, &c);
      ok = offset_far(o, p, a->nx * c - a->ny * s, a->nx * s + a->ny * c);
    }
  } else if (o->corners == VS_OFFSET_MITRE && least > 0 && least <= MITRE_MOST) {
    double k = 1 / (1 + cosine);
    ok = ok && offset_far(o, p, (a->nx + b->nx) * k, (a->ny + b->ny) * k);
  } else { /* cuts the corner off with a straight edge, perpendicular to the bisector, at the offset's distance from
            * p */
    double k = tan(half / 2);
    ok = ok && offset_far(o, p, a->nx + k * a->tx, a->ny + k * a->ty) &&
         offset_far(o, p, b->nx - k * b->tx, b->ny - k * b->ty);
  }
  return ok && offset_far(o, p, b->nx, b->ny);
}

typedef enum { CORNER_OPENS, CORNER_MEETS, CORNER_CROSSES } vs_offset_corner;

static vs_offset_corner offset_look(const vs_offsetter *o, const vs_offset_edge *a, const vs_offset_edge *b,
                                    double *turning, double *k) {
  double cosine = a->tx * b->tx + a->ty * b->ty, sine = a->tx * b->ty - a->ty * b->tx;
  *turning = fabs(atan2(sine, cosine));
  *k = 1 / (1 + cosine);
  if (sine * o->hand <= 0) return CORNER_OPENS;
  return cosine > -0.5 && o->d * tan(*turning / 2) < 0.5 * fmin(a->length, b->length) ? CORNER_MEETS : CORNER_CROSSES;
}

/* Makes the strips along a closed loop or an open line of n points. Returns false when memory is out. */
static bool offset_strips(vs_offsetter *o, const vs_vec2 *at, size_t n, bool closed) {
  vs_offset_edge *edges = vs_fresh(n, sizeof *edges);
  size_t count = 0;
  bool ok = edges != NULL;
  for (size_t i = 0; ok && i + (closed ? 0 : 1) < n; i++) {
    vs_vec2 p = at[i], q = at[(i + 1) % n];
    double length = hypot(q.x - p.x, q.y - p.y);
    if (!(length > 0)) continue;
    double tx = (q.x - p.x) / length, ty = (q.y - p.y) / length;
    edges[count++] = (vs_offset_edge){ p, tx, ty, -o->hand * ty, o->hand * tx, length };
  }
  for (size_t i = 0; ok && i < count; i++) {
    const vs_offset_edge *e = &edges[i],
                         *next = i + 1 < count ? e + 1
                                 : closed      ? edges
                                               : NULL,
                         *last = i        ? e - 1
                                 : closed ? &edges[count - 1]
                                          : NULL;
    double turning = 0, k = 0;
    if (!o->near_count) { /* begins a strip; if the line bends towards this side at the corner before it, the strip
                           * begins on the bisector of that corner */
      bool meets = last && offset_look(o, last, e, &turning, &k) == CORNER_MEETS;
      double nx = !i && o->ways ? -o->hand * o->ways[0].y : e->nx, ny = !i && o->ways ? o->hand * o->ways[0].x : e->ny;
      ok = offset_near(o, e->p) &&
           (meets ? offset_far(o, e->p, (last->nx + e->nx) * k, (last->ny + e->ny) * k) : offset_far(o, e->p, nx, ny));
    }
    vs_vec2 end = next ? next->p : at[n - 1];
    ok = ok && offset_near(o, end);
    if (!ok) break;
    if (!next) {
      ok = (o->ways ? offset_far(o, end, -o->hand * o->ways[1].y, o->hand * o->ways[1].x)
                    : offset_far(o, end, e->nx, e->ny)) &&
           offset_strip(o);
      break;
    }
    vs_offset_corner corner = offset_look(o, e, next, &turning, &k);
    if (corner == CORNER_OPENS) ok = offset_join(o, end, e, next);
    else if (corner == CORNER_MEETS) ok = offset_far(o, end, (e->nx + next->nx) * k, (e->ny + next->ny) * k);
    else ok = offset_far(o, end, e->nx, e->ny);
    o->turned += turning;
    if (ok && (corner == CORNER_CROSSES || o->turned > 1.5 || i + 1 == count)) ok = offset_strip(o);
  }
  free(edges);
  return ok;
}

static vs_offsetter offset_begin(vs_area *strips, const vs_offset_rule *rule, double hand) {
  double d = fabs(rule->distance);
  int turn = vs_fineness_turn(rule->fineness, d, rule->segments);
  return (vs_offsetter){ .strips = strips, .d = d, .hand = hand, .corners = rule->corners, .turn = turn };
}

bool vs_area_offset(const vs_area *in, const vs_offset_rule *rule, vs_area *out, vs_error *e) {
  double d = rule->distance;
  vs_area parts[2] = { *in, { 0 } };
  vs_offsetter o = offset_begin(&parts[1], rule, d > 0 ? -1 : 1);
  bool ok = true;
  for (size_t l = 0, first = 0; ok && l < in->loop_count; first += in->size[l++])
    ok = offset_strips(&o, in->at + first, in->size[l], true);
  if (!ok) vs_error_memory(e, NULL);
  else ok = vs_area_combine(d > 0 ? VS_AREA_UNION : VS_AREA_DIFFERENCE, parts, 2, "do-offset", out, e);
  vs_area_free(&parts[1]);
  free(o.near);
  free(o.far);
  return ok;
}

/* ---- open lines ---- */

static double offset_distance(vs_vec2 p, vs_vec2 a, vs_vec2 b) { /* returns the distance of p from the segment from a to
                                                                  * b */
  double dx = b.x - a.x, dy = b.y - a.y, d = dx * dx + dy * dy,
         t = d > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / d : 0;
  t = fmin(1, fmax(0, t));
  return hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

/* Appends to out the longest sequence of the border's edges that are at the offset's distance from the line, except
 * edges at the line's two ends. The line has at least two points, and the distance is above 0. */
static bool offset_border(const vs_offsetter *o, const vs_area *border, const vs_open_line *line, vs_polyline *out) {
  const vs_vec2 *at = line->at;
  size_t n = line->count;
  double d = o->d, slack = 1e-7 * d, longest = 0, least = d * (cos(pi / o->turn) - 1e-6);
  vs_vec2 from[2] = { at[0], at[n - 1] }, to[2];
  size_t best_first = 0, best_size = 0, best_start = 0, best_count = 0;
  VS_ASSERT(n >= 2 && d > 0);
  for (int k = 0; k < 2; k++) {
    vs_vec2 way = line->ways[k];
    to[k] = (vs_vec2){ from[k].x + d * (-o->hand * way.y), from[k].y + d * (o->hand * way.x) };
  }
  for (size_t l = 0, first = 0; l < border->loop_count; first += border->size[l++]) {
    const vs_vec2 *p = border->at + first;
    size_t size = border->size[l], run = 0;
    double length = 0;
    for (size_t i = 0; i < 2 * size; i++) { /* goes twice around the loop, so that a sequence across the loop's start is
                                             * found as a whole */
      vs_vec2 a = p[i % size], b = p[(i + 1) % size], middle = { (a.x + b.x) / 2, (a.y + b.y) / 2 };
      bool other = offset_distance(middle, from[0], to[0]) > slack && offset_distance(middle, from[1], to[1]) > slack;
      for (size_t k = 0; other && k + 1 < n; k++) other = offset_distance(middle, at[k], at[k + 1]) >= least;
      run = other ? run + 1 : 0;
      length = other ? length + hypot(b.x - a.x, b.y - a.y) : 0;
      if (run > size) break; /* the sequence contains all edges of the loop */
      if (length > longest * (1 + 1e-12)) {
        longest = length;
        best_first = first, best_size = size, best_count = run, best_start = (i + 1 - run) % size;
      }
    }
  }
  if (!best_count) return true;
  out->at = vs_fresh(best_count + 1, sizeof *out->at);
  if (!out->at) return false;
  out->room = out->count = best_count + 1;
  for (size_t i = 0; i <= best_count; i++) {
    vs_vec2 p = border->at[best_first + (best_start + i) % best_size];
    out->at[i] = vs_v3(p.x, p.y, 0);
  }
  return true;
}

bool vs_line_offset(const vs_open_line *line, const vs_offset_rule *rule, vs_polyline *out, vs_error *e) {
  vs_area strips = { 0 }, border = { 0 };
  double hand = rule->distance > 0 ? 1 : -1;
  vs_offsetter o = offset_begin(&strips, rule, hand);
  VS_ASSERT(line->count >= 2 && rule->distance != 0);
  o.ways = line->ways;
  bool ok = offset_strips(&o, line->at, line->count, false) || vs_error_memory(e, NULL);
  ok = ok && vs_area_combine(VS_AREA_UNION, &strips, 1, "do-offset", &border, e);
  if (ok) {
    ok = offset_border(&o, &border, line, out) || vs_error_memory(e, NULL);
    /* The border is counter-clockwise. On the left side of the line it runs against the line, so its points are
     * reversed. */
    for (size_t i = 0, j = out->count; ok && hand > 0 && i < j; i++) {
      vs_vec3 swap = out->at[i];
      out->at[i] = out->at[--j];
      out->at[j] = swap;
    }
  }
  vs_area_free(&strips);
  vs_area_free(&border);
  free(o.near);
  free(o.far);
  return ok;
}

/* ---- offsets without sampling ---- */

bool vs_offset_round(const vs_node *n, vs_affine *place, vs_offset_exact *out) {
  double scale = 1, grown = 0;
  bool level = true; /* true if all placements map +Z upwards, so that the left side of an arc stays the left side */
  *place = vs_affine_identity();
  for (;;) {
    if (n->kind == VS_OFFSET) grown += scale * VS_AS(offset, n)->distance;
    else if (n->kind == VS_TRANSFORM) {
      const vs_affine *m = &VS_AS(transform, n)->matrix;
      double k;
      if (!vs_affine_even(m, &k)) return false;
      level = level && m->m[0][2] == 0 && m->m[1][2] == 0 && m->m[2][2] > 0 && vs_affine_determinant(m) > 0;
      scale *= k;
      *place = vs_affine_multiply(place, m);
    } else if (n->kind == VS_CIRCLE || n->kind == VS_ARC) break;
    else if (!vs_node_is_wrapper(n) && !(n->kind == VS_REGION && n->child_count == 1)) return false;
    n = n->children[0].node;
  }
  if (n->kind == VS_CIRCLE) {
    const struct vs_circle *c = VS_AS(circle, n);
    out->arc = (struct vs_arc){
      .center = c->center, .radius = c->radius + grown / scale, .end = 2 * pi, .segments = c->segments
    };
  } else {
    out->arc = *VS_AS(arc, n);
    out->arc.radius += (out->arc.end > out->arc.start ? -grown : grown) / scale;
    if (!level) return false;
  }
  out->circle = n->kind == VS_CIRCLE;
  return out->arc.radius > 0;
}

bool vs_line_frame(const vs_polyline *line, vs_affine *frame, vs_error *e) {
  vs_vec3 along = { 0, 0, 0 }, normal = { 0, 0, 0 }, o = line->at[0];
  double off = 0;
  for (size_t i = 1; i < line->count; i++) {
    vs_vec3 d = vs_v3_sub(line->at[i], o);
    if (vs_v3_dot(d, d) > vs_v3_dot(along, along)) along = d;
  }
  for (size_t i = 1; i < line->count; i++) {
    vs_vec3 c = vs_v3_cross(along, vs_v3_sub(line->at[i], o));
    if (vs_v3_dot(c, c) > vs_v3_dot(normal, normal)) normal = c;
  }
  double size = vs_v3_length(along);
  if (vs_v3_length(normal) > 1e-9 * size * size) normal = vs_plane_up(normal);
  else {
    vs_vec3 t = vs_v3_unit(along), z = { 0, 0, 1 };
    normal = vs_v3_sub(z, vs_v3_scale(t, t.z));
    normal = vs_v3_length(normal) > 1e-9 ? vs_v3_unit(normal) : vs_v3(0, 1, 0);
  }
  for (size_t i = 0; i < line->count; i++) off = fmax(off, fabs(vs_v3_dot(normal, vs_v3_sub(line->at[i], o))));
  if (off > 1e-6 * size)
    return vs_error_set(e, VS_ERROR_MODEL, NULL,
                        "do-offset: the curve must lie in one plane, and deviates from a plane by %.6g", off);
  *frame = vs_frame_on_axis(vs_v3_scale(normal, vs_v3_dot(normal, o)), normal);
  return true;
}
