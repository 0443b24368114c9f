/* Implements meshes whose faces are moved (moved_faces.h). Each corner moves by the shortest vector v with n . v = d
 * for every face at the corner, where n is the face's new normal there and d its distance. Three planes determine
 * the point; further planes must pass through it. For a curved face, n is the mean normal of its triangles at the
 * corner. */
#include "geometry/measure/moved_faces.h"

#include <stdlib.h>

#include "model/store/array.h"

enum { FACES_MOST = 64 }; /* greatest number of faces at one corner */
static const double MISS = 1e-6; /* greatest deviation of a corner from a moved face that counts as 0, as a fraction of
                                  * the mesh's size */

/* A pair of a corner of the mesh and a face that contains it. */
typedef struct {
  uint32_t corner, face;
  vs_vec3 normal; /* sum of the normals of the face's triangles at the corner, weighted by their angles */
} meeting;

static int by_corner(const void *p, const void *q) {
  const meeting *a = p, *b = q;
  if (a->corner != b->corner) return a->corner < b->corner ? -1 : 1;
  if (a->face != b->face) return a->face < b->face ? -1 : 1;
  const double d[3] = { a->normal.x - b->normal.x, a->normal.y - b->normal.y, a->normal.z - b->normal.z };
  for (int k = 0; k < 3; k++)
    if (d[k] != 0) return d[k] < 0 ? -1 : 1;
  return 0;
}

/* Lists the faces at each corner, in the order of the corners. Returns NULL when memory is out. */
static meeting *meetings(const vs_mesh_edges *s, const vs_mesh_faces *faces, size_t *count) {
  meeting *m = NULL;
  size_t n = 3 * s->m->triangle_count, kept = 0;
  if (!VS_FRESH(m, n + 1)) return NULL;
  for (uint32_t i = 0; i < n; i++) {
    int k = (int)(i % 3);
    vs_vec3 p = vs_mesh_edges_place(s, i / 3, k);
    vs_vec3 u = vs_v3_unit(vs_v3_sub(vs_mesh_edges_place(s, i / 3, (k + 1) % 3), p));
    vs_vec3 w = vs_v3_unit(vs_v3_sub(vs_mesh_edges_place(s, i / 3, (k + 2) % 3), p)), c = vs_v3_cross(u, w);
    const vs_mesh_face *f = &faces->faces[faces->of[i / 3]];
    double angle = atan2(vs_v3_length(c), vs_v3_dot(u, w));
    m[i] = (meeting){ vs_mesh_edges_corner(s, i / 3, k), faces->of[i / 3],
                      f->form == VS_FACE_PLANE ? f->normal : vs_v3_scale(vs_v3_unit(c), angle) };
  }
  qsort(m, n, sizeof *m, by_corner);
  for (size_t i = 0; i < n; i++) {
    if (kept && m[kept - 1].corner == m[i].corner && m[kept - 1].face == m[i].face)
      m[kept - 1].normal = vs_v3_add(m[kept - 1].normal, m[i].normal);
    else m[kept++] = m[i];
  }
  for (size_t i = 0; i < kept; i++) m[i].normal = vs_v3_unit(m[i].normal);
  *count = kept;
  return m;
}

/* Returns the shortest vector v with n[i] . v = d[i] for all i. The first three independent normals determine v. *miss:
 * the largest deviation |n[i] . v - d[i]| for the remaining normals. */
static vs_vec3 shortest(const vs_vec3 *n, const double *d, size_t count, double *miss) {
  vs_vec3 base[3], v = { 0, 0, 0 };
  int rank = 0;
  *miss = 0;
  for (size_t i = 0; i < count; i++) {
    vs_vec3 r = n[i];
    for (int k = 0; k < rank; k++) r = vs_v3_sub(r, vs_v3_scale(base[k], vs_v3_dot(base[k], r)));
    double rest = d[i] - vs_v3_dot(n[i], v), l = vs_v3_length(r);
    if (rank < 3 && l > 1e-4) {
      base[rank++] = vs_v3_scale(r, 1 / l);
      v = vs_v3_add(v, vs_v3_scale(r, rest / (l * l)));
    } else *miss = fmax(*miss, fabs(rest));
  }
  return v;
}

/* Returns true if the move has reversed no edge between two faces and turned over no triangle of a curved face.
 * Otherwise sets *at to the place of the fault. */
static bool upright(const vs_mesh_edges *s, const vs_mesh_faces *faces, const vs_mesh *out, vs_vec3 *at) {
  const vs_vec3 *old = s->m->vertices, *new = out->vertices;
  for (size_t e = 0; e < s->edge_count; e++) {
    const vs_mesh_edge *g = &s->edges[e];
    if (faces->of[g->side[0]] == faces->of[g->side[1]]) continue;
    vs_vec3 u = vs_v3_sub(old[g->b], old[g->a]), w = vs_v3_sub(new[g->b], new[g->a]);
    if (vs_v3_dot(u, w) >= -1e-9 * vs_v3_dot(u, u)) continue;
    *at = vs_v3_scale(vs_v3_add(old[g->a], old[g->b]), .5);
    return false;
  }
  for (uint32_t t = 0; t < out->triangle_count; t++) {
    const uint32_t *c = s->m->triangles[t];
    if (faces->faces[faces->of[t]].form == VS_FACE_PLANE) continue;
    vs_vec3 n = vs_v3_cross(vs_v3_sub(old[c[1]], old[c[0]]), vs_v3_sub(old[c[2]], old[c[0]]));
    vs_vec3 m = vs_v3_cross(vs_v3_sub(new[c[1]], new[c[0]]), vs_v3_sub(new[c[2]], new[c[0]]));
    if (vs_v3_dot(n, m) >= -1e-9 * vs_v3_dot(n, n)) continue;
    *at = vs_v3_scale(vs_v3_add(old[c[0]], vs_v3_add(old[c[1]], old[c[2]])), 1 / 3.);
    return false;
  }
  return true;
}

vs_moved_outcome vs_faces_move(const vs_mesh_edges *s, const vs_mesh_faces *faces, const vs_face_move *moves,
                               vs_mesh *out, vs_vec3 *at) {
  size_t count = 0, v = 0;
  vs_bounds b = vs_mesh_bounds(s->m);
  double size = vs_bounds_diagonal(&b);
  meeting *m = meetings(s, faces, &count);
  vs_moved_outcome outcome = m ? VS_MOVED : VS_MOVED_MEMORY;
  for (size_t i = 0; outcome == VS_MOVED && i < count;) {
    vs_vec3 n[FACES_MOST], p = s->m->vertices[m[i].corner];
    double d[FACES_MOST], miss = 0;
    uint32_t corner = m[i].corner;
    size_t used = 0;
    for (; i < count && m[i].corner == corner; i++) {
      const vs_face_move *f = &moves[m[i].face];
      if (used == FACES_MOST) continue;
      n[used] = f->tilted ? f->normal : m[i].normal;
      d[used++] = f->tilted ? vs_v3_dot(f->normal, vs_v3_sub(f->at, p)) : f->distance;
    }
    out->vertices[corner] = vs_v3_add(p, shortest(n, d, used, &miss));
    if (miss > MISS * size) outcome = VS_MOVED_CORNER, *at = p;
  }
  for (; outcome == VS_MOVED && v < s->m->vertex_count; v++) out->vertices[v] = out->vertices[s->corner[v]];
  free(m);
  if (outcome == VS_MOVED && !upright(s, faces, out, at)) outcome = VS_MOVED_TURNED;
  return outcome;
}
