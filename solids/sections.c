/* Computes sections and shadows of closed meshes, as chains of directed edges in the plane.
 *
 * Section. The plane is moved slightly up, then slightly down, so that no vertex lies in it. A triangle with vertices
 * on both sides gives one edge. The edge leads from the point where the triangle's border goes down through the plane
 * to the point where it comes up. Seen against the normal, the solid is on the left. The crossing of a mesh edge is
 * computed once for both its triangles, so the edges form closed chains. A vertex within 1e-7 of the mesh's size counts
 * as on the plane (the kernel's grid is finer), and is itself the crossing. The section is the union of the cuts by
 * both planes: each face in the original plane belongs to one of them.
 *
 * Shadow. The projections of the triangles that face along the normal wind around each point as often as they cover it.
 * The same holds for the edges that only one of these triangles has, the outlines against the light. */
#include "solids/sections.h"

#include <stdlib.h>

#include "geometry/frame.h"
#include "geometry/plane/plane.h"
#include "geometry/plane/areas.h"
#include "model/store/array.h"

typedef struct { vs_vec2 (*at)[2]; size_t count, room; } chain;

static bool chain_add(chain *c, vs_vec2 p, vs_vec2 q) {
  if (p.x == q.x && p.y == q.y) return true;
  if (!VS_GROW(c->at, c->room, c->count + 1)) return false;
  c->at[c->count][0] = p;
  c->at[c->count++][1] = q;
  return true;
}

/* Returns a frame whose XY plane is the plane through `point` with the given normal. geometry/ makes outlines in its
 * coordinates. */
static vs_affine plane_frame(vs_vec3 point, vs_vec3 normal) {
  vs_vec3 up = vs_plane_up(normal);
  return vs_frame_on_axis(vs_v3_scale(up, vs_v3_dot(up, point)), up);
}

/* Returns the vertices of m in the coordinates of the frame, where z is the height above the plane. Returns NULL if
 * memory is out. */
static vs_vec3 *in_frame(const vs_mesh *m, const vs_affine *frame) {
  vs_vec3 x = { frame->m[0][0], frame->m[1][0], frame->m[2][0] },
          y = { frame->m[0][1], frame->m[1][1], frame->m[2][1] },
          z = { frame->m[0][2], frame->m[1][2], frame->m[2][2] };
  vs_vec3 o = { frame->m[0][3], frame->m[1][3], frame->m[2][3] };
  vs_vec3 *at = vs_fresh(m->vertex_count + 1, sizeof *at);
  for (size_t i = 0; at && i < m->vertex_count; i++) {
    vs_vec3 d = vs_v3_sub(m->vertices[i], o);
    at[i] = vs_v3(vs_v3_dot(d, x), vs_v3_dot(d, y), vs_v3_dot(d, z));
  }
  return at;
}

static vs_vec2 crossing(const vs_vec3 *at, uint32_t a, uint32_t b) {
  if (b < a) { /* orders the two ends of the edge, so that both triangles at the edge compute the same crossing */
    uint32_t swap = a;
    a = b;
    b = swap;
  }
  vs_vec3 p = at[a], q = at[b];
  if (p.z == 0) return (vs_vec2){ p.x, p.y };
  if (q.z == 0) return (vs_vec2){ q.x, q.y };
  double t = p.z / (p.z - q.z);
  return (vs_vec2){ p.x + t * (q.x - p.x), p.y + t * (q.y - p.y) };
}

static bool cut(const vs_mesh *m, const vs_vec3 *at, bool above, chain *c) {
  bool ok = true;
  for (size_t i = 0; ok && i < m->triangle_count; i++) {
    const uint32_t *t = m->triangles[i];
    bool up[3];
    for (int k = 0; k < 3; k++) up[k] = above ? at[t[k]].z > 0 : at[t[k]].z >= 0;
    if (up[0] == up[1] && up[1] == up[2]) continue;
    vs_vec2 from = { 0, 0 }, to = { 0, 0 };
    for (int k = 0; k < 3; k++) {
      int n = (k + 1) % 3;
      if (up[k] && !up[n]) from = crossing(at, t[k], t[n]);
      if (!up[k] && up[n]) to = crossing(at, t[k], t[n]);
    }
    ok = chain_add(c, from, to);
  }
  return ok;
}

bool vs_mesh_section(const vs_mesh *m, vs_vec3 point, vs_vec3 normal, vs_outline *o, vs_error *e) {
  vs_affine frame = plane_frame(point, normal);
  vs_vec3 *at = in_frame(m, &frame);
  vs_area parts[2] = { { 0 }, { 0 } }, all = { 0 };
  vs_bounds b = vs_mesh_bounds(m);
  double slack = 1e-7 * vs_bounds_diagonal(&b);
  bool ok = at || vs_error_memory(e, NULL), on = false;
  for (size_t i = 0; ok && i < m->vertex_count; i++)
    if (fabs(at[i].z) <= slack) {
      at[i].z = 0;
      on = true;
    }
  for (int k = 0; ok && k < (on ? 2 : 1); k++) { /* If no vertex lies in the plane, the cuts just above and just below
                                                  * the plane are equal, so one suffices. */
    chain c = { 0 };
    ok = cut(m, at, k == 0, &c) || vs_error_memory(e, NULL);
    ok = ok && vs_area_of_chain((const vs_vec2 (*)[2])c.at, c.count, "do-section", &parts[k], e);
    free(c.at);
  }
  ok = ok && vs_area_combine(VS_AREA_UNION, parts, 2, "do-section", &all, e) &&
       (vs_area_outline(&all, &frame, o) || vs_error_memory(e, NULL));
  for (int k = 0; k < 2; k++) vs_area_free(&parts[k]);
  vs_area_free(&all);
  free(at);
  return ok;
}

typedef struct { uint64_t key; bool forward; uint32_t from, to; } contour;

static int contour_compare(const void *p, const void *q) {
  const contour *a = p, *b = q;
  return a->key != b->key ? (a->key < b->key ? -1 : 1) : (int)a->forward - (int)b->forward;
}

bool vs_mesh_shadow(const vs_mesh *m, vs_vec3 point, vs_vec3 normal, vs_outline *o, vs_error *e) {
  vs_affine frame = plane_frame(point, normal);
  vs_vec3 *at = in_frame(m, &frame);
  contour *edges = vs_fresh(3 * m->triangle_count + 1, sizeof *edges);
  chain c = { 0 };
  vs_area all = { 0 };
  size_t count = 0;
  bool ok = (at && edges) || vs_error_memory(e, NULL);
  for (size_t i = 0; ok && i < m->triangle_count; i++) {
    const uint32_t *t = m->triangles[i];
    vs_vec3 p = at[t[0]], q = at[t[1]], r = at[t[2]];
    vs_vec3 n = vs_v3_cross(vs_v3_sub(q, p), vs_v3_sub(r, p));
    if (!(n.z > 1e-9 * vs_v3_length(n))) continue;
    for (int k = 0; k < 3; k++) {
      uint32_t a = t[k], b = t[(k + 1) % 3];
      edges[count++] = (contour){ a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a, a < b, a, b };
    }
  }
  if (ok) qsort(edges, count, sizeof *edges, contour_compare);
  for (size_t i = 0, end; ok && i < count; i = end) {
    long over = 0;
    for (end = i; end < count && edges[end].key == edges[i].key; end++) over += edges[end].forward ? 1 : -1;
    uint32_t low = (uint32_t)(edges[i].key >> 32), high = (uint32_t)edges[i].key;
    for (; ok && over != 0; over += over > 0 ? -1 : 1) {
      uint32_t a = over > 0 ? low : high, b = over > 0 ? high : low;
      ok = chain_add(&c, (vs_vec2){ at[a].x, at[a].y }, (vs_vec2){ at[b].x, at[b].y }) || vs_error_memory(e, NULL);
    }
  }
  ok = ok && vs_area_of_chain((const vs_vec2(*)[2])c.at, c.count, "do-project", &all, e) &&
       (vs_area_outline(&all, &frame, o) || vs_error_memory(e, NULL));
  vs_area_free(&all);
  free(c.at);
  free(edges);
  free(at);
  return ok;
}

/* ---- flat surfaces ---- */

static vs_vec3 area_of(const vs_mesh *m, size_t i) { /* returns a vector along the normal of triangle i, with twice the
                                                      * triangle's area as length */
  vs_vec3 p = m->vertices[m->triangles[i][0]];
  return vs_v3_cross(vs_v3_sub(m->vertices[m->triangles[i][1]], p), vs_v3_sub(m->vertices[m->triangles[i][2]], p));
}

bool vs_mesh_flat_outline(vs_mesh *m, vs_outline *o, vs_error *e) {
  vs_vec3 most = { 0, 0, 0 };
  vs_bounds b = vs_mesh_bounds(m);
  double size = vs_bounds_diagonal(&b), off = 0;
  *o = (vs_outline){ 0 };
  for (size_t i = 0; i < m->triangle_count; i++) {
    vs_vec3 area = area_of(m, i);
    if (vs_v3_dot(area, area) > vs_v3_dot(most, most)) most = area;
  }
  if (!(vs_v3_length(most) > 1e-14 * size * size)) return true;
  vs_vec3 normal = vs_v3_unit(most), at = m->vertices[m->triangles[0][0]];
  for (size_t i = 0; i < m->triangle_count; i++) {
    for (int k = 0; k < 3; k++)
      off = fmax(off, fabs(vs_v3_dot(normal, vs_v3_sub(m->vertices[m->triangles[i][k]], at))));
    if (vs_v3_dot(area_of(m, i), normal) < 0) {
      uint32_t swap = m->triangles[i][1];
      m->triangles[i][1] = m->triangles[i][2], m->triangles[i][2] = swap;
    }
  }
  if (off > 1e-6 * size)
    return vs_error_set(e, VS_ERROR_MODEL, NULL, "the surface is not flat: it leaves a plane by %.6g", off);
  return vs_mesh_shadow(m, at, normal, o, e);
}
