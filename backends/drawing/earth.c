/* Computes where the earth hides a view, and the earth that a section cuts. See earth.h.
 *
 * Heights are compared exactly: a corner at the height of the ground counts as above it. A house on the ground
 * therefore displaces no earth. */
#include "backends/drawing/earth.h"

#include <math.h>

#include "geometry/plane/areas.h"
#include "geometry/plane/earth_areas.h"
#include "geometry/plane/slice.h"

typedef vs_vec2 directed[2]; /* an edge from the first point to the second */
typedef struct { directed *at; size_t count, room; } edge_list;

/* Adds the triangles of a plane area to the mesh `out`. axes: directions of the area's x and y; at: position of its
 * origin. */
static bool add_area(vs_emitter *e, const vs_area *a, const vs_vec3 axes[2], vs_vec3 at, vs_mesh *out) {
  bool ok = true;
  for (size_t l = 0, first = 0, end; ok && l < a->loop_count; l = end) {
    size_t count = 0, base = out->vertex_count;
    for (end = l; end == l || (end < a->loop_count && a->hole[end]); end++) count += a->size[end];
    uint32_t *index = vs_store_realloc(e->scene->store, NULL, 0, (count + 1) * sizeof *index);
    ok = index != NULL;
    for (size_t i = 0; ok && i < count; i++) {
      vs_vec2 p = a->at[first + i];
      index[i] = (uint32_t)(base + i);
      ok = vs_mesh_add_vertex(out, vs_v3_add(at, vs_v3_add(vs_v3_scale(axes[0], p.x), vs_v3_scale(axes[1], p.y))),
                              NULL);
    }
    ok = ok && vs_triangulate(a->at + first, a->size + l, end - l, out, index, false);
    if (index) vs_store_realloc(e->scene->store, index, (count + 1) * sizeof *index, 0);
    first += count;
  }
  return ok || vs_emit_no_memory(e);
}

static bool add_edge(vs_emitter *e, edge_list *list, vs_vec2 p, vs_vec2 q) {
  if (p.x == q.x && p.y == q.y) return true;
  if (!vs_emit_grow(e, &list->at, &list->room, list->count + 1, sizeof *list->at)) return false;
  list->at[list->count][0] = p, list->at[list->count++][1] = q;
  return true;
}

/* ---- sections ---- */

static bool add_loop(vs_emitter *e, vs_flat_view *v, const vs_vec2 *at, size_t count) {
  if (!vs_emit_grow(e, &v->points, &v->point_room, v->point_count + count, sizeof *v->points) ||
      !vs_emit_grow(e, &v->loops, &v->loop_room, v->loop_count + 1, sizeof *v->loops))
    return false;
  v->loops[v->loop_count].first = (uint32_t)v->point_count, v->loops[v->loop_count++].count = (uint32_t)count;
  for (size_t i = 0; i < count; i++) v->points[v->point_count++] = (vs_sheet_point){ at[i].x, at[i].y };
  return true;
}

static bool add_earth_fill(vs_emitter *e, vs_flat_view *v, const vs_area *a) {
  if (a->loop_count == 0) return true;
  if (!vs_emit_grow(e, &v->fills, &v->fill_room, v->fill_count + 1, sizeof *v->fills)) return false;
  v->fills[v->fill_count++] = (vs_flat_fill){ (uint32_t)v->loop_count, (uint32_t)a->loop_count, NULL,
                                              VS_FILL_EARTH };
  bool ok = true;
  for (size_t l = 0, first = 0; ok && l < a->loop_count; first += a->size[l++])
    ok = add_loop(e, v, a->at + first, a->size[l]);
  return ok;
}

/* Computes the area of earth in the plane of a section, or of a plan that is cut below the ground. The earth extends
 * beyond the model by a fraction of the model's size. */
static bool earth_in_section(vs_emitter *e, vs_flat_view *v, const vs_earth_model *m, double ground, vs_area *out) {
  static const double border = 0.06;
  vs_vec2 box[2] = { { INFINITY, INFINITY }, { -INFINITY, -INFINITY } };
  for (size_t i = 0; i < m->triangle_count; i++)
    for (int k = 0; k < 3; k++) {
      vs_vec3 p = m->points[m->triangles[i][k]];
      box[0] = (vs_vec2){ fmin(box[0].x, p.x), fmin(box[0].y, p.y) };
      box[1] = (vs_vec2){ fmax(box[1].x, p.x), fmax(box[1].y, p.y) };
    }
  bool upright = fabs(v->look.forward.z) < 0.5;
  if (!(box[1].x > box[0].x)) return true;
  double more = border * fmax(box[1].x - box[0].x, box[1].y - box[0].y);
  if (upright) box[0].y = fmin(box[0].y, ground), box[1].y = ground;
  else box[1].y += more;
  box[0].x -= more, box[0].y -= more, box[1].x += more;
  edge_list edges = { 0 };
  bool ok = true;
  for (size_t l = 0; ok && l < v->loop_count; l++)
    for (uint32_t i = 0, n = v->loops[l].count; ok && i < n; i++) {
      vs_sheet_point p = v->points[v->loops[l].first + i], q = v->points[v->loops[l].first + (i + 1) % n];
      ok = add_edge(e, &edges, (vs_vec2){ p.x, p.y }, (vs_vec2){ q.x, q.y });
    }
  ok = ok && vs_earth_around((const directed *)edges.at, edges.count, box, !upright, out, e->error);
  vs_emit_release(e, edges.at, edges.room, sizeof *edges.at);
  return ok;
}

static bool section(vs_emitter *e, vs_flat_view *v, const vs_earth_model *m, vs_mesh *veil) {
  vs_area earth = { 0 };
  double ground = vs_look_to_view(&v->look, vs_v3(0, 0, e->scene->ground_z)).y;
  const vs_vec3 axes[2] = { vs_v3(1, 0, 0), vs_v3(0, 1, 0) };
  bool ok = earth_in_section(e, v, m, ground, &earth) && add_earth_fill(e, v, &earth) &&
            add_area(e, &earth, axes, vs_v3(0, 0, vs_look_to_view(&v->look, v->spec.cut_point).z), veil);
  vs_area_free(&earth);
  return ok;
}

/* ---- views from above ---- */

/* Returns the point at the height of the ground on the edge from a to b, of which one is above and one below the
 * ground. The result does not depend on the order of a and b. */
static vs_vec2 on_ground(vs_vec3 a, vs_vec3 b, double ground) {
  vs_vec3 low = a.z < b.z ? a : b, high = a.z < b.z ? b : a;
  double t = (ground - low.z) / (high.z - low.z);
  return (vs_vec2){ low.x + t * (high.x - low.x), low.y + t * (high.y - low.y) };
}

/* Collects the edges in which the solids intersect the plane of the ground. */
static bool footprint(vs_emitter *e, const vs_flat_view *v, const vs_earth_model *m, edge_list *out) {
  double ground = e->scene->ground_z;
  bool ok = true;
  for (size_t i = 0; ok && i < m->closed; i++) {
    vs_vec3 c[3];
    vs_vec2 up = { 0, 0 }, down = { 0, 0 };
    int crossings = 0;
    for (int k = 0; k < 3; k++) {
      c[k] = vs_look_from_view(&v->look, m->points[m->triangles[i][k]]);
      if (fabs(c[k].z - ground) <= m->slack) c[k].z = ground;
    }
    for (int k = 0; k < 3; k++) {
      vs_vec3 p = c[k], q = c[(k + 1) % 3];
      if ((p.z >= ground) == (q.z >= ground)) continue;
      if (p.z < ground) up = on_ground(p, q, ground);
      else down = on_ground(p, q, ground);
      crossings++;
    }
    if (crossings == 2) ok = add_edge(e, out, up, down);
    ok = ok && vs_emit_going(e, i + 1);
  }
  return ok;
}

/* Removes the part of the mesh on the side of a plane from which the normal points away. */
static bool keep_side(vs_emitter *e, vs_mesh *mesh, vs_vec3 point, vs_vec3 normal) {
  vs_mesh kept = { 0 };
  bool ok = vs_slice_mesh(mesh, point, normal, &kept);
  vs_mesh_free(mesh);
  *mesh = kept;
  return ok || vs_emit_no_memory(e);
}

/* Sets `box` to opposite corners of a rectangle on the ground that every line of sight from the viewer to the model
 * below the ground intersects. */
static void ground_box(const vs_emitter *e, const vs_flat_view *v, vs_vec2 box[2]) {
  const vs_look *l = &v->look;
  vs_bounds b = e->bounds;
  double far = vs_bounds_diagonal(&b), depth = e->scene->ground_z - b.min.z, more = 0.1 * far;
  if (l->parallel) more += depth * hypot(l->forward.x, l->forward.y) / fabs(l->forward.z);
  else vs_bounds_add(&b, l->eye);
  box[0] = (vs_vec2){ b.min.x - more, b.min.y - more }, box[1] = (vs_vec2){ b.max.x + more, b.max.y + more };
}

/* Shortens the edge from p to q to its part on the side of a plane to which the normal points. Returns false if nothing
 * remains. */
static bool clip(vs_vec3 *p, vs_vec3 *q, vs_vec3 point, vs_vec3 normal) {
  double a = vs_v3_dot(vs_v3_sub(*p, point), normal), b = vs_v3_dot(vs_v3_sub(*q, point), normal);
  if (a < 0 && b < 0) return false;
  vs_vec3 at = vs_v3_add(*p, vs_v3_scale(vs_v3_sub(*q, *p), a == b ? 0 : a / (a - b)));
  if (a < 0) *p = at;
  if (b < 0) *q = at;
  return true;
}

/* Adds the edges in which walls rise from the ground: the borders of the area `a` of earth, except the sides of the
 * rectangle on the ground. */
static bool add_feet(vs_emitter *e, const vs_flat_view *v, const vs_earth_model *m, const vs_area *a,
                     vs_sight_edges *out) {
  const vs_look *l = &v->look;
  double z = e->scene->ground_z;
  for (size_t i = 0, first = 0; i < a->loop_count; first += a->size[i++])
    for (size_t k = 0, n = a->size[i]; a->hole[i] && k < n; k++) {
      vs_vec2 from = a->at[first + k], to = a->at[first + (k + 1) % n];
      vs_vec3 p = vs_v3(from.x, from.y, z), q = vs_v3(to.x, to.y, z);
      if (v->has_cut && !clip(&p, &q, v->spec.cut_point, v->spec.cut_normal)) continue;
      p = vs_look_to_view(l, p), q = vs_look_to_view(l, q);
      if (!l->parallel && !clip(&p, &q, vs_v3(0, 0, m->nearest), vs_v3(0, 0, 1))) continue;
      if (out->count == out->room &&
          !vs_store_grow(e->scene->store, &out->at, &out->room, out->count + 1, sizeof *out->at))
        return vs_emit_no_memory(e);
      out->at[out->count++] = (vs_sight_edge){ p, q, VS_SIGHT_CREASE, m->slack, 0 };
    }
  return true;
}

static bool from_above(vs_emitter *e, vs_flat_view *v, const vs_earth_model *m, vs_mesh *veil, vs_sight_edges *feet) {
  const vs_look *l = &v->look;
  const vs_vec3 axes[2] = { vs_v3(1, 0, 0), vs_v3(0, 1, 0) };
  edge_list edges = { 0 };
  vs_area earth = { 0 };
  vs_mesh flat = { 0 };
  vs_vec2 box[2];
  ground_box(e, v, box);
  bool ok = footprint(e, v, m, &edges) &&
            vs_earth_around((const directed *)edges.at, edges.count, box, true, &earth, e->error) &&
            add_area(e, &earth, axes, vs_v3(0, 0, e->scene->ground_z), &flat);
  if (fabs(l->forward.z) < 1 - 1e-9) ok = ok && add_feet(e, v, m, &earth, feet);
  ok = ok && (!v->has_cut || keep_side(e, &flat, v->spec.cut_point, v->spec.cut_normal));
  for (size_t i = 0; i < flat.vertex_count; i++) flat.vertices[i] = vs_look_to_view(l, flat.vertices[i]);
  ok = ok && (l->parallel || keep_side(e, &flat, vs_v3(0, 0, m->nearest), vs_v3(0, 0, 1)));
  vs_emit_release(e, edges.at, edges.room, sizeof *edges.at);
  vs_area_free(&earth);
  vs_mesh_free(veil);
  *veil = flat;
  return ok;
}

/* ---- elevations ---- */

/* Adds to `veil` a rectangle in front of the part of the model below the ground. It hides everything behind it. */
static bool elevation(vs_emitter *e, const vs_flat_view *v, const vs_earth_model *m, vs_mesh *veil) {
  double far = vs_bounds_diagonal(&e->bounds), front = INFINITY;
  double ground = vs_look_to_view(&v->look, vs_v3(0, 0, e->scene->ground_z)).y;
  vs_vec2 low = { INFINITY, INFINITY }, high = { -INFINITY, -INFINITY };
  for (size_t i = 0; i < m->point_count; i++) {
    vs_vec3 p = m->points[i];
    low = (vs_vec2){ fmin(low.x, p.x), fmin(low.y, p.y) }, high = (vs_vec2){ fmax(high.x, p.x), fmax(high.y, p.y) };
    front = fmin(front, p.z);
  }
  if (!(low.y < ground)) return true;
  front -= far, low.x -= far, high.x += far, low.y -= far;
  const vs_vec3 corners[4] = { { low.x, low.y, front }, { high.x, low.y, front }, { high.x, ground, front },
                               { low.x, ground, front } };
  bool ok = true;
  for (int i = 0; ok && i < 4; i++) ok = vs_mesh_add_vertex(veil, corners[i], NULL);
  ok = ok && vs_mesh_add_triangle(veil, 0, 1, 2) && vs_mesh_add_triangle(veil, 0, 2, 3);
  return ok || vs_emit_no_memory(e);
}

bool vs_flat_earth(vs_emitter *e, vs_flat_view *v, const vs_earth_model *m, vs_mesh *veil, vs_sight_edges *edges) {
  const vs_look *l = &v->look;
  double ground = e->scene->ground_z;
  if (!e->scene->has_ground || m->triangle_count == 0) return true;
  bool upright = l->parallel && fabs(l->forward.z) < 1e-6;
  bool across = v->has_cut && l->parallel && fabs(vs_v3_dot(v->spec.cut_normal, l->forward)) > 1 - 1e-9;
  if (across && (upright || v->spec.cut_point.z < ground - m->slack)) return section(e, v, m, veil);
  if (upright) return v->has_cut || elevation(e, v, m, veil);
  if (l->parallel ? l->forward.z > 0 : l->eye.z <= ground) return true;
  return e->bounds.min.z >= ground - m->slack || from_above(e, v, m, veil, edges);
}
