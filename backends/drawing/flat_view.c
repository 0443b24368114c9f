/* Computes a flat view of the model: cuts the model, projects it, joins its lines and outlines its cut faces.
 *
 * The kernel makes the cut: it subtracts a half-space without a material from the model, so the cut faces have the
 * material of the cut solid (passes/cut_away.h). The cut faces are the triangles of the result that lie in the plane of
 * the cut and face the viewer. They include faces of the model that already lay in the plane. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "backends/lower.h"
#include "backends/drawing/earth.h"
#include "backends/drawing/fault_marks.h"
#include "backends/drawing/flat_view.h"
#include "geometry/plane/slice.h"
#include "model/store/patient_sort.h"
#include "solids/sight_edges.h"

/* The contents of the view while it is computed, in the view's coordinates. */
typedef struct {
  vs_emitter *e;
  vs_flat_view *v;
  vs_sight_host host;
  vs_vec3 *points;
  uint32_t (*triangles)[3];
  uint32_t *paints;    /* paints[i]: number of triangle i's material */
  uint32_t *owners;    /* owners[i]: number of triangle i's layer */
  uint32_t *objects;   /* objects[i]: number of triangle i's object; surfaces have the last numbers */
  uint8_t *caps;
  vs_flat_whole *whole;
  uint32_t run_object;  /* number of the surface that is currently added */
  uint32_t curve_owner; /* number of the layer of the curve that is currently added */
  size_t owner_room;
  size_t point_count, point_room, triangle_count, triangle_room, paint_room, cap_room, object_room;
  size_t closed;       /* number of triangles of solids, which precede all other triangles */
  double slack, nearest; /* slack: lengths up to this count as zero. nearest: in a perspective view, the distance in
                          * front of the eye at which everything is clipped */
  vs_sight_edges edges;
  vs_sight_pieces pieces;
} seen;

static vs_sheet_point flat(const vs_look *l, vs_vec3 p) {
  return l->parallel ? (vs_sheet_point){ p.x, p.y } : (vs_sheet_point){ p.x / p.z, p.y / p.z };
}

vs_sheet_point vs_flat_view_project(const vs_flat_view *v, vs_vec3 p) {
  return flat(&v->look, vs_look_to_view(&v->look, p));
}

/* ---- triangles and curves ---- */

/* Sets *number to the number of the program's layer with this name, or to 0 if name is NULL. */
static bool number_layer(seen *s, const char *name, uint32_t *number) {
  vs_flat_whole *w = s->whole;
  *number = 0;
  if (!name) return true;
  for (size_t i = 0; i < w->layer_count; i++)
    if (w->layers[i] == name || strcmp(w->layers[i], name) == 0) return *number = (uint32_t)i + 1, true;
  if (!vs_emit_grow(s->e, &w->layers, &w->layer_room, w->layer_count + 1, sizeof *w->layers)) return false;
  w->layers[w->layer_count++] = name;
  *number = (uint32_t)w->layer_count;
  return true;
}

static bool add_triangles(seen *s, const vs_mesh *m, const vs_solid *solid, const vs_loose_run *run) {
  vs_emitter *e = s->e;
  size_t base = s->point_count, count = s->triangle_count + m->triangle_count;
  if (base + m->vertex_count > UINT32_MAX) return vs_error_set(e->error, VS_ERROR_MODEL, NULL,
      "more points than a drawing can hold");
  if (!vs_emit_grow(e, &s->points, &s->point_room, base + m->vertex_count, sizeof *s->points) ||
      !vs_emit_grow(e, &s->triangles, &s->triangle_room, count, sizeof *s->triangles) ||
      !vs_emit_grow(e, &s->paints, &s->paint_room, count, sizeof *s->paints) ||
      !vs_emit_grow(e, &s->owners, &s->owner_room, count, sizeof *s->owners) ||
      !vs_emit_grow(e, &s->objects, &s->object_room, count, sizeof *s->objects) ||
      !vs_emit_grow(e, &s->caps, &s->cap_room, count, sizeof *s->caps))
    return false;
  const vs_scene_view *spec = &s->v->spec;
  for (size_t i = 0; i < m->vertex_count; i++) s->points[base + i] = vs_look_to_view(&s->v->look, m->vertices[i]);
  s->point_count += m->vertex_count;
  for (size_t i = 0; i < m->triangle_count; i++) {
    const uint32_t *t = m->triangles[i];
    uint32_t tag = m->tags ? m->tags[i] : 0;
    size_t at = s->triangle_count;
    bool lid = !s->v->look.parallel; /* lid: whether the triangle lies in the clipping plane of a perspective view, just
                                      * in front of the eye */
    for (int k = 0; k < 3; k++) s->triangles[at][k] = (uint32_t)base + t[2 - k];
        /* The view's coordinates are left-handed, so the triangle's corners are reversed. */
    for (int k = 0; k < 3; k++) lid = lid && s->points[base + t[k]].z <= s->nearest + 4 * s->slack;
    if (lid) continue;
    s->triangle_count++;
    s->paints[at] = (uint32_t)vs_emit_material_number(e, solid &&
        tag < solid->part_count ? solid->parts[tag].material : run ? run->material : NULL);
    const char *layer = solid && tag < solid->part_count ? solid->parts[tag].layer : run ? run->layer : NULL;
    if (!number_layer(s, layer, &s->owners[at])) return false;
    s->objects[at] = solid && tag < solid->part_count ? solid->parts[tag].object : s->run_object;
    bool cap = s->v->has_cut && solid;
    for (int k = 0; cap && k < 3; k++) cap = fabs(vs_v3_dot(vs_v3_sub(m->vertices[t[k]], spec->cut_point),
        spec->cut_normal)) <= 4 * s->slack;
    s->caps[at] = 0;
    if (!cap) continue;
    vs_vec3 a = m->vertices[t[0]], n = vs_v3_cross(vs_v3_sub(m->vertices[t[1]], a), vs_v3_sub(m->vertices[t[2]], a));
    s->caps[at] = vs_v3_dot(n, spec->cut_normal) < 0;
  }
  return true;
}

static bool add_curve_edge(seen *s, vs_vec3 p, vs_vec3 q) { /* adds an edge of the current curve, from p to q */
  if (s->edges.count == s->edges.room && !vs_store_grow(s->host.store, &s->edges.at, &s->edges.room,
      s->edges.count + 1, sizeof *s->edges.at))
    return vs_emit_no_memory(s->e);
  double slack = fmax(s->slack, 4 * s->e->facets.tolerance);
      /* A curve on a round surface is drawn by chords that lie slightly inside the surface. Therefore its edges have a
       * slack: a surface that is closer to an edge than this does not hide it. */
  s->edges.at[s->edges.count++] = (vs_sight_edge){ vs_look_to_view(&s->v->look, p), vs_look_to_view(&s->v->look, q),
      VS_SIGHT_CURVE, slack, s->curve_owner };
  return true;
}

static bool put_piece(void *context, const vs_polyline *p) {
  seen *s = context;
  bool ok = true;
  for (size_t i = 0; ok && i + 1 < p->count + (p->closed ? 1 : 0); i++) ok = add_curve_edge(s, p->at[i],
      p->at[(i + 1) % p->count]);
  return ok;
}

static double nearest_of(const vs_emitter *e) { return 1e-3 * vs_bounds_diagonal(&e->bounds); }

/* Computes the clipping plane of a perspective view, just in front of the eye. Nothing in front of this plane is
 * shown. */
static bool near_plane(const vs_flat_view *v, const vs_emitter *e, vs_vec3 *point, vs_vec3 *normal) {
  *normal = v->look.forward;
  *point = vs_v3_add(v->look.eye, vs_v3_scale(*normal, nearest_of(e)));
  return !v->look.parallel;
}

/* Adds the curves and open faces of the drawing, and clips them. */
static bool add_loose(seen *s, const vs_loose *l) {
  vs_vec3 point, normal;
  const vs_scene_view *spec = &s->v->spec;
  bool near = near_plane(s->v, s->e, &point, &normal), ok = true;
  for (size_t i = 0; ok && l && i < l->run_count; i++) {
    const vs_loose_run *run = &l->runs[i];
    if (run->line && !number_layer(s, run->layer, &s->curve_owner)) return false;
    if (run->line) {
      vs_polyline p = { 0 }, *line = &p;
      p.at = vs_store_realloc(s->host.store, NULL, 0, run->count * sizeof *p.at);
      if (!p.at) return vs_emit_no_memory(s->e);
      for (size_t k = 0; k < run->count; k++) p.at[p.count++] = l->points[l->corners[run->first + k]];
      if (s->v->has_cut) ok = vs_slice_polyline(line, spec->cut_point, spec->cut_normal, put_piece, s);
      else if (near) ok = vs_slice_polyline(line, point, normal, put_piece, s);
      else ok = put_piece(s, line);
      vs_store_realloc(s->host.store, p.at, run->count * sizeof *p.at, 0);
      continue;
    }
    vs_mesh whole = { 0 }, part = { 0 };
    s->run_object = UINT32_MAX - (uint32_t)i;
    for (size_t k = 0; ok && k + 2 < run->count; k += 3) {
      for (size_t n = 0; ok && n < 3; n++) ok = vs_mesh_add_vertex(&whole, l->points[l->corners[run->first + k + n]],
          NULL);
      ok = ok && vs_mesh_add_triangle(&whole, (uint32_t)k, (uint32_t)k + 1, (uint32_t)k + 2);
    }
    if (ok && s->v->has_cut) ok = vs_slice_mesh(&whole, spec->cut_point, spec->cut_normal, &part);
    else if (ok && near) ok = vs_slice_mesh(&whole, point, normal, &part);
    ok = ok && add_triangles(s, s->v->has_cut || near ? &part : &whole, NULL, run);
    vs_mesh_free(&whole);
    vs_mesh_free(&part);
  }
  return ok || s->e->error->kind != VS_ERROR_NONE || vs_emit_no_memory(s->e);
}

enum { CUT_DEPTH = 2 }; /* depth at which the drawn objects occur in the node that cut_node returns */

/* Returns a node for all solids of the drawing minus the half-spaces beyond the planes. */
static vs_node *cut_node(vs_emitter *e, const vs_vec3 (*planes)[2], size_t count) {
  const vs_scene *scene = e->scene;
  vs_ref operands[3];
  size_t n = 0;
  vs_node *all = vs_node_new(scene->store, VS_UNION, &(struct vs_union){ 0 }, scene->drawn, scene->drawn_count),
      *made = NULL;
  if (all) operands[n++] = (vs_ref){ all, NULL };
  for (size_t i = 0; n > 0 && i < count; i++) {
    struct vs_half_space away = { .point = planes[i][0], .normal = vs_v3_scale(planes[i][1], -1) };
    vs_node *space = vs_node_new(scene->store, VS_HALF_SPACE, &away, NULL, 0);
    if (space) operands[n++] = (vs_ref){ space, NULL };
  }
  if (n == count + 1) made = vs_node_new(scene->store, VS_DIFFERENCE, &(struct vs_difference){ 0 }, operands, n);
  for (size_t i = 0; i < n; i++) vs_node_release(operands[i].node);
  return made;
}

/* Returns true if the drawing contains solids. */
static bool has_solids(const vs_scene *scene) {
  bool any = false;
  for (size_t i = 0; !any && i < scene->drawn_count; i++) any = scene->drawn[i].node->class_ == VS_SOLID;
  return any;
}

/* Adds the solids. For a view with a cut, only the cut solids are computed: the uncut solids of a city would take
 * longer than its plan. */
static bool add_solids(seen *s, vs_flat_whole *whole) {
  vs_vec3 planes[2][2];
  size_t count = 0;
  const vs_scene_view *spec = &s->v->spec;
  if (s->v->has_cut) planes[count][0] = spec->cut_point, planes[count++][1] = spec->cut_normal;
  if (near_plane(s->v, s->e, &planes[count][0], &planes[count][1])) count++;
  if (count == 0 || !has_solids(s->e->scene)) {
    if (!whole->made && !vs_lower_drawing(s->e, &whole->solid)) return false;
    whole->made = true;
    if (count == 0 || whole->solid.mesh.triangle_count == 0)
      return add_triangles(s, &whole->solid.mesh, &whole->solid, NULL);
  }
  vs_ref ref = { cut_node(s->e, (const vs_vec3 (*)[2])planes, count), NULL };
  vs_solid cut = { .part_count = 0 };
  if (!ref.node) return vs_emit_no_memory(s->e);
  const vs_refs refs = { &ref, 1 };
  bool ok = vs_lower_objects(s->e, &refs, CUT_DEPTH, VS_BENT, &cut) && add_triangles(s, &cut.mesh, &cut, NULL);
  vs_solid_free(&cut);
  vs_node_release(ref.node);
  return ok;
}

/* ---- lines: pieces with a common end are joined, and collinear pieces are merged ---- */

static const vs_drawn_layer layer_of[VS_SIGHT_KINDS] = {
  [VS_SIGHT_CUT] = VS_DRAWN_CUT,     [VS_SIGHT_PARTING] = VS_DRAWN_PARTING, [VS_SIGHT_OUTLINE] = VS_DRAWN_OUTLINE,
  [VS_SIGHT_CREASE] = VS_DRAWN_EDGE, [VS_SIGHT_CURVE] = VS_DRAWN_CURVE,
};

typedef struct { vs_sheet_point a, b; vs_drawn_layer layer; uint32_t own; } stretch;
typedef struct { vs_sheet_point at; uint32_t stretch, own; uint8_t layer, end; } tip;

static int tip_compare(const void *p, const void *q) {
  const tip *a = p, *b = q;
  if (a->layer != b->layer) return a->layer < b->layer ? -1 : 1;
  if (a->own != b->own) return a->own < b->own ? -1 : 1;
  if (a->at.x != b->at.x) return a->at.x < b->at.x ? -1 : 1;
  if (a->at.y != b->at.y) return a->at.y < b->at.y ? -1 : 1;
  if (a->stretch != b->stretch) return a->stretch < b->stretch ? -1 : 1;
  return (int)a->end - (int)b->end;
}

static bool same_place(const tip *tips, size_t count, size_t a, size_t b) {
  return a < count && b < count && tips[a].layer == tips[b].layer && tips[a].own == tips[b].own &&
      tips[a].at.x == tips[b].at.x &&
      tips[a].at.y == tips[b].at.y;
}

/* All visible segments, and their ends sorted by layer and position. */
typedef struct {
  const stretch *all;
  size_t count;             /* number of segments; the list of ends has twice as many elements */
  tip *tips;
  uint32_t *slot;           /* slot[2 * i + k]: index of end k of segment i in the sorted list of ends */
  bool *used;               /* used[i]: whether segment i is part of a line */
  double slack;             /* greatest distance of a point from the straight line through its neighbours at which the
                             * point is omitted, in the view's units */
} stretches;

/* An end of a segment: end 0 is point a, end 1 is point b. */
typedef struct { uint32_t stretch; int end; } stretch_end;

static vs_sheet_point place_of(const stretches *s, stretch_end x) {
  return x.end ? s->all[x.stretch].b : s->all[x.stretch].a;
}

/* Sets *next to the end of a segment that continues the line at end x: the only other end of the same layer at this
 * position. Returns false if there is no such end, or if there are several. */
static bool next_of(const stretches *s, stretch_end x, stretch_end *next) {
  size_t i = s->slot[2 * x.stretch + (uint32_t)x.end], count = 2 * s->count;
  bool before = same_place(s->tips, count, i - 1, i), after = same_place(s->tips, count, i + 1, i);
  if (before == after || same_place(s->tips, count, before ? i - 2 : i + 2, i)) return false;
  const tip *other = &s->tips[before ? i - 1 : i + 1];
  if (other->stretch == x.stretch) return false;
  *next = (stretch_end){ other->stretch, other->end };
  return true;
}

static bool add_point(vs_emitter *e, vs_flat_view *v, vs_sheet_point p) {
  if (!vs_emit_grow(e, &v->points, &v->point_room, v->point_count + 1, sizeof *v->points)) return false;
  v->points[v->point_count++] = p;
  return true;
}

/* Adds a point to the line that begins at point `first`. If the line's last point lies on the straight line from the
 * point before it to the new point, the new point replaces it. */
static bool extend(vs_emitter *e, vs_flat_view *v, size_t first, vs_sheet_point p, double slack) {
  size_t n = v->point_count - first;
  if (n >= 2) {
    vs_sheet_point a = v->points[v->point_count - 2], b = v->points[v->point_count - 1];
    double ux = p.x - a.x, uy = p.y - a.y, length = hypot(ux, uy), off = fabs((b.x - a.x) * uy - (b.y - a.y) * ux);
    if (length > 0 && off <= slack * length && (b.x - a.x) * (p.x - b.x) + (b.y - a.y) * (p.y - b.y) > 0) {
      v->points[v->point_count - 1] = p;
      return true;
    }
  }
  return add_point(e, v, p);
}

/* Adds the line that contains segment `start`. Goes back to the line's beginning, or once around a closed line, and
 * then follows the line forwards. */
static bool chain(vs_emitter *e, vs_flat_view *v, const stretches *s, uint32_t start) {
  stretch_end at = { start, 0 }, next;
  while (next_of(s, at, &next) && next.stretch != start) at = (stretch_end){ next.stretch, !next.end };
  uint32_t begun = at.stretch;
  bool closed = false;
  size_t first = v->point_count;
  if (!vs_emit_grow(e, &v->lines, &v->line_room, v->line_count + 1, sizeof *v->lines)) return false;
  if (!add_point(e, v, place_of(s, at))) return false;
  for (at.end = !at.end;;) {
    s->used[at.stretch] = true;
    if (!extend(e, v, first, place_of(s, at), s->slack)) return false;
    if (!next_of(s, at, &next)) break;
    if ((closed = next.stretch == begun)) break;
    at = (stretch_end){ next.stretch, !next.end };
  }
  size_t n = v->point_count - first;
  closed = closed && n > 3;
  if (closed) v->point_count--, n--; /* removes the last point, which repeats the first */
  const stretch *one = &s->all[start];
  v->lines[v->line_count++] = (vs_flat_line){ (uint32_t)first, (uint32_t)n, closed, one->layer, one->own };
  return true;
}

static bool join(seen *s, const stretch *all, size_t count, double slack) {
  vs_store *store = s->host.store;
  stretches t = { .all = all, .count = count, .slack = slack };
  t.tips = vs_store_realloc(store, NULL, 0, (2 * count + 1) * sizeof *t.tips);
  t.slot = vs_store_realloc(store, NULL, 0, (2 * count + 1) * sizeof *t.slot);
  t.used = vs_store_realloc(store, NULL, 0, count + 1);
  bool ok = t.tips && t.slot && t.used;
  for (size_t i = 0; ok && i < 2 * count; i++) {
    const stretch *one = &all[i / 2];
    t.tips[i] = (tip){ i % 2 ? one->b : one->a, (uint32_t)(i / 2), one->own, (uint8_t)one->layer, i % 2 };
  }
  bool grew = ok && vs_store_sort(store, t.tips, 2 * count, sizeof *t.tips, tip_compare, s->e->error);
  if (ok) memset(t.used, 0, count + 1);
  for (size_t i = 0; grew && i < 2 * count; i++) t.slot[2 * t.tips[i].stretch + t.tips[i].end] = (uint32_t)i;
  for (uint32_t i = 0; grew && i < count; i++)
    if (!t.used[i]) grew = chain(s->e, s->v, &t, i);
  vs_store_realloc(store, t.tips, (2 * count + 1) * sizeof *t.tips, 0);
  vs_store_realloc(store, t.slot, (2 * count + 1) * sizeof *t.slot, 0);
  vs_store_realloc(store, t.used, count + 1, 0);
  return ok ? grew : vs_emit_no_memory(s->e);
}

/* Rounds coordinates to a grid finer than the slack, so that two computations of the same point give equal numbers. */
static vs_sheet_point on_grid(vs_sheet_point p, double step) {
  return (vs_sheet_point){ round(p.x / step) * step + 0., round(p.y / step) * step + 0. }; /* adding 0 turns -0 into
                                                                                            * 0 */
}

static bool add_lines(seen *s) {
  vs_store *store = s->host.store;
  size_t room = s->pieces.count + 1, count = 0;
  stretch *all = vs_store_realloc(store, NULL, 0, room * sizeof *all);
  if (!all) return vs_emit_no_memory(s->e);
  double far = 1;
  if (!s->v->look.parallel) far = vs_v3_length(vs_v3_sub(s->v->look.target, s->v->look.eye));
  double step = ldexp(1, ilogb(s->slack / far) - 6);
  for (size_t i = 0; i < s->pieces.count; i++) {
    const vs_sight_piece *p = &s->pieces.at[i];
    const vs_sight_edge *edge = &s->edges.at[p->edge];
    vs_vec3 d = vs_v3_sub(edge->q, edge->p);
    vs_sheet_point a = on_grid(flat(&s->v->look, p->from > 0 ? vs_v3_add(edge->p, vs_v3_scale(d, p->from)) :
        edge->p), step);
    vs_sheet_point b = on_grid(flat(&s->v->look, p->to < 1 ? vs_v3_add(edge->p, vs_v3_scale(d, p->to)) : edge->q),
        step);
    if (a.x == b.x && a.y == b.y) continue;
    bool turned = a.x > b.x || (a.x == b.x && a.y > b.y);
    vs_drawn_layer layer = p->hidden ? VS_DRAWN_HIDDEN : layer_of[edge->kind];
    all[count++] = (stretch){ turned ? b : a, turned ? a : b, layer, edge->owner };
  }
  bool ok = join(s, all, count, 2 * s->slack / far);
  vs_store_realloc(store, all, room * sizeof *all, 0);
  return ok;
}

/* ---- fills: the borders of the cut faces of each material, joined to loops ---- */

typedef struct { vs_sheet_point a, b; uint32_t paint; bool used; } border;
static int border_compare(const void *p, const void *q) {
  const border *a = p, *b = q;
  if (a->paint != b->paint) return a->paint < b->paint ? -1 : 1;
  if (a->a.x != b->a.x) return a->a.x < b->a.x ? -1 : 1;
  if (a->a.y != b->a.y) return a->a.y < b->a.y ? -1 : 1;
  if (a->b.x != b->b.x) return a->b.x < b->b.x ? -1 : 1;
  return a->b.y < b->b.y ? -1 : a->b.y > b->b.y;
}

/* Returns the index of the first unused border of this paint (material's number) that begins at p, or count if there is
 * none. */
static size_t border_from(const border *all, size_t count, uint32_t paint, vs_sheet_point p) {
  size_t low = 0, high = count;
  border key = { p, { -INFINITY, -INFINITY }, paint, false };
  while (low < high) {
    size_t middle = low + (high - low) / 2;
    if (border_compare(&all[middle], &key) < 0) low = middle + 1;
    else high = middle;
  }
  for (; low < count && all[low].paint == paint && all[low].a.x == p.x && all[low].a.y == p.y; low++)
    if (!all[low].used) return low;
  return count;
}

/* Follows the loop that begins with border i, and adds the loop to the view. */
static bool take_loop(seen *s, border *all, size_t count, size_t i, double slack) {
  vs_flat_view *v = s->v;
  size_t first = v->point_count;
  uint32_t paint = all[i].paint;
  vs_sheet_point start = all[i].a;
  if (!add_point(s->e, v, start)) return false;
  for (;;) {
    all[i].used = true;
    vs_sheet_point end = all[i].b;
    if (end.x == start.x && end.y == start.y) break;
    if (!extend(s->e, v, first, end, slack)) return false;
    if ((i = border_from(all, count, paint, end)) == count) break;
  }
  if (v->point_count - first < 3) return v->point_count = first, true;
  if (!vs_emit_grow(s->e, &v->loops, &v->loop_room, v->loop_count + 1, sizeof *v->loops)) return false;
  v->loops[v->loop_count].first = (uint32_t)first, v->loops[v->loop_count++].count = (uint32_t)(v->point_count - first);
  vs_flat_fill *fill = v->fill_count > 0 ? &v->fills[v->fill_count - 1] : NULL;
  const vs_material *m = paint > 0 ? vs_emit_material_at(s->e, paint) : NULL;
  if (!fill || fill->material != m) {
    if (!vs_emit_grow(s->e, &v->fills, &v->fill_room, v->fill_count + 1, sizeof *v->fills)) return false;
    fill = &v->fills[v->fill_count++];
    *fill = (vs_flat_fill){ (uint32_t)v->loop_count - 1, 0, m, VS_FILL_CUT };
  }
  fill->loop_count++;
  return true;
}

enum { SEARCH_WORK = 200 }; /* estimated time of a search for a border in nanoseconds, by which vs_store_going decides
                             * when to test for an interrupt */

static bool add_fills(seen *s) {
  vs_store *store = s->host.store;
  vs_flat_view *v = s->v;
  size_t caps = 0, count = 0, kept = 0;
  for (size_t i = 0; i < s->closed; i++) caps += s->caps[i];
  if (caps == 0) return true;
  size_t room = 3 * caps;
  border *all = vs_store_realloc(store, NULL, 0, room * sizeof *all);
  if (!all) return vs_emit_no_memory(s->e);
  double step = ldexp(1, ilogb(s->slack) - 6);
  for (size_t i = 0; i < s->closed; i++) {
    if (!s->caps[i]) continue;
    vs_sheet_point c[3];
    for (int k = 0; k < 3; k++) c[k] = on_grid(flat(&v->look, s->points[s->triangles[i][k]]), step);
    v->cut_area -= 0.5 * ((c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[1].y - c[0].y) * (c[2].x - c[0].x));
    for (int k = 0; k < 3; k++)
      if (c[k].x != c[(k + 1) % 3].x || c[k].y != c[(k + 1) % 3].y) all[count++] = (border){ c[(k + 1) % 3], c[k],
          s->paints[i], false };
  }
  bool ok = vs_store_sort(store, all, count, sizeof *all, border_compare, s->e->error);
  for (size_t i = 0; ok && i < count; i++) { /* removes the sides that two triangles of the same material have in
                                              * common */
    border back = { all[i].b, all[i].a, all[i].paint, false };
    const border *found = bsearch(&back, all, count, sizeof *all, border_compare);
    all[i].used = found != NULL;
    ok = vs_store_going(store, SEARCH_WORK, s->e->error);
  }
  for (size_t i = 0; ok && i < count; i++)
    if (!all[i].used) all[kept++] = all[i];
  for (size_t i = 0; ok && i < kept; i++)
    if (!all[i].used) ok = take_loop(s, all, kept, i, 2 * s->slack);
  vs_store_realloc(store, all, room * sizeof *all, 0);
  return ok;
}

/* ---- labels ---- */

/* Returns true if a triangle lies between the viewer and the point p of the view. */
static bool is_covered(const seen *s, vs_vec3 p) {
  for (size_t i = 0; i < s->triangle_count; i++) {
    vs_vec3 c[3];
    for (int k = 0; k < 3; k++) c[k] = vs_v3_sub(s->points[s->triangles[i][k]], p);
    double part[3], all = 0;
    for (int k = 0; k < 3; k++) {
      const vs_vec3 *a = &c[(k + 1) % 3], *b = &c[(k + 2) % 3];
      all += part[k] = a->x * b->y - a->y * b->x;
    }
    if (all == 0 || part[0] / all < 0 || part[1] / all < 0 || part[2] / all < 0) continue;
    if ((part[0] * c[0].z + part[1] * c[1].z + part[2] * c[2].z) / all < -16 * s->slack) return true;
  }
  return false;
}

/* Finds the labels of the view. A cut removes the labels in the removed part. Elevations and sections show only labels
 * whose position is visible. A label with #:view always appears in the view that it names. */
static bool find_labels(seen *s) {
  const vs_scene *scene = s->e->scene;
  vs_flat_view *v = s->v;
  const vs_scene_view *spec = &v->spec;
  if (!scene->note_count) return true;
  v->labelled = vs_store_realloc(scene->store, NULL, 0, scene->note_count);
  if (!v->labelled) return vs_emit_no_memory(s->e);
  for (size_t i = 0; i < scene->note_count; i++) {
    const vs_scene_note *n = &scene->notes[i];
    bool upright = fabs(v->look.forward.z) < 1e-6;
    double kept = v->has_cut ? vs_v3_dot(vs_v3_sub(n->p, spec->cut_point), spec->cut_normal) : 0;
    v->labelled[i] = n->kind == VS_NOTE_LABEL && kept >= -s->slack &&
                     (n->view || !upright || !is_covered(s, vs_look_to_view(&v->look, n->p)));
  }
  return true;
}

/* ---- the earth ---- */

/* Appends the triangles behind which the earth hides the model. These triangles have no visible edges. */
static bool add_veil(seen *s) {
  vs_emitter *e = s->e;
  vs_mesh veil = { 0 };
  vs_earth_model model = { s->points, (const uint32_t (*)[3])s->triangles, s->point_count, s->triangle_count,
                           s->closed, s->slack, s->nearest };
  size_t base = s->point_count;
  bool ok = vs_flat_earth(e, s->v, &model, &veil, &s->edges);
  size_t count = s->triangle_count + veil.triangle_count;
  if (ok && base + veil.vertex_count > UINT32_MAX)
    ok = vs_error_set(e->error, VS_ERROR_MODEL, NULL, "more points than a drawing can hold");
  ok = ok && vs_emit_grow(e, &s->points, &s->point_room, base + veil.vertex_count, sizeof *s->points) &&
       vs_emit_grow(e, &s->triangles, &s->triangle_room, count, sizeof *s->triangles) &&
       vs_emit_grow(e, &s->paints, &s->paint_room, count, sizeof *s->paints) &&
       vs_emit_grow(e, &s->owners, &s->owner_room, count, sizeof *s->owners) &&
       vs_emit_grow(e, &s->objects, &s->object_room, count, sizeof *s->objects) &&
       vs_emit_grow(e, &s->caps, &s->cap_room, count, sizeof *s->caps);
  for (size_t i = 0; ok && i < veil.vertex_count; i++) s->points[s->point_count++] = veil.vertices[i];
  for (size_t i = 0; ok && i < veil.triangle_count; i++) {
    size_t at = s->triangle_count++;
    for (int k = 0; k < 3; k++) s->triangles[at][k] = (uint32_t)base + veil.triangles[i][k];
    s->paints[at] = s->owners[at] = s->objects[at] = 0, s->caps[at] = 0;
  }
  vs_mesh_free(&veil);
  return ok;
}

/* ---- the view ---- */

/* Returns the triangles of the view as a vs_sight, from which the visible lines are computed. */
static vs_sight sight_of(const seen *s) {
  return (vs_sight){ .points = s->points, .triangles = (const uint32_t (*)[3])s->triangles,
                     .point_count = s->point_count, .triangle_count = s->triangle_count, .closed = s->closed,
                     .paints = s->paints, .owners = s->owners, .objects = s->objects,
                     .caps = s->v->has_cut ? s->caps : NULL,
                     .perspective = !s->v->look.parallel, .slack = s->slack };
}

static void measure(vs_flat_view *v) {
  v->low = (vs_sheet_point){ INFINITY, INFINITY }, v->high = (vs_sheet_point){ -INFINITY, -INFINITY };
  for (size_t i = 0; i < v->point_count; i++) {
    v->low.x = fmin(v->low.x, v->points[i].x), v->low.y = fmin(v->low.y, v->points[i].y);
    v->high.x = fmax(v->high.x, v->points[i].x), v->high.y = fmax(v->high.y, v->points[i].y);
  }
  if (v->point_count == 0) v->low = v->high = (vs_sheet_point){ 0, 0 };
}

bool vs_flat_view_make(vs_emitter *e, vs_flat_view *v, const vs_loose *loose, vs_flat_whole *whole) {
  seen s = { .e = e, .v = v, .whole = whole, .host = { e->scene->store, e->job } };
  vs_scene scene = *e->scene;
  vs_scene_look(&scene, &v->spec);
  v->look = vs_look_find(&scene, &e->bounds, &e->bounds, 1, 1);
  if (v->spec.upright && !v->look.parallel) { /* in an upright perspective view, the picture plane is vertical, so the
                                               * line of sight is not perpendicular to it */
    v->look.forward = vs_v3_unit(vs_v3(v->look.forward.x, v->look.forward.y, 0));
    v->look.up = vs_v3(0, 0, 1);
  }
  s.nearest = nearest_of(e);
  s.slack = 2e-7 * vs_bounds_diagonal(&e->bounds);
  bool ok = add_solids(&s, whole);
  s.closed = s.triangle_count;
  ok = ok && add_loose(&s, loose);
  vs_sight sight = sight_of(&s);
  ok = ok && vs_sight_find_edges(&s.host, &sight, &s.edges, e->error) && add_fills(&s) && add_veil(&s) &&
       vs_flat_faults(e, v);
  sight = sight_of(&s);
  ok = ok && vs_sight_find_visible(&s.host, &sight, &s.edges, v->spec.hidden, &s.pieces, e->error) && add_lines(&s) &&
       find_labels(&s);
  measure(v);
  vs_sight_edges_free(&s.host, &s.edges);
  vs_sight_pieces_free(&s.host, &s.pieces);
  vs_emit_release(e, s.points, s.point_room, sizeof *s.points);
  vs_emit_release(e, s.triangles, s.triangle_room, sizeof *s.triangles);
  vs_emit_release(e, s.paints, s.paint_room, sizeof *s.paints);
  vs_emit_release(e, s.owners, s.owner_room, sizeof *s.owners);
  vs_emit_release(e, s.objects, s.object_room, sizeof *s.objects);
  vs_emit_release(e, s.caps, s.cap_room, sizeof *s.caps);
  return ok;
}

void vs_flat_view_free(vs_emitter *e, vs_flat_view *v) {
  vs_emit_release(e, v->points, v->point_room, sizeof *v->points);
  vs_emit_release(e, v->lines, v->line_room, sizeof *v->lines);
  vs_emit_release(e, v->fills, v->fill_room, sizeof *v->fills);
  vs_emit_release(e, v->loops, v->loop_room, sizeof *v->loops);
  if (v->labelled) vs_store_realloc(e->scene->store, v->labelled, e->scene->note_count, 0);
}
