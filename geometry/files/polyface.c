/* Checks whether faces over points close, orients them, and makes a node of them.
 *
 * The edges of all faces are sorted by their two ends. If an edge has exactly two faces, they are neighbours. The faces
 * of a component are turned to agree with its first face, breadth first. A component closes if each of its edges occurs
 * twice, once in each direction. The time is linear, unless many edges share a point. */
#include "geometry/files/polyface.h"

#include <stdlib.h>
#include <string.h>

#include "geometry/primitives/solid_triangles.h"
#include "model/store/array.h"
#include "model/store/disjoint.h"

/* ---- equal points ---- */

static uint64_t polyface_place_hash(vs_vec3 p) {
  double c[3] = { p.x + 0.0, p.y + 0.0, p.z + 0.0 };
  uint64_t h = 0, v;
  for (int i = 0; i < 3; i++) {
    memcpy(&v, &c[i], sizeof v);
    h = (h ^ v) * UINT64_C(0x9E3779B97F4A7C15);
    h ^= h >> 29;
  }
  return h;
}

bool vs_polyface_merge(const vs_vec3 *points, size_t count, uint32_t *place) {
  size_t room = 16;
  while (room < count * 2) room *= 2;
  uint32_t *slots = vs_fresh(room, sizeof *slots);
  if (!slots) return false;
  memset(slots, 0xFF, room * sizeof *slots);
  for (size_t i = 0; i < count; i++) {
    size_t at = (size_t)polyface_place_hash(points[i]) & (room - 1);
    while (slots[at] != UINT32_MAX && !vs_v3_equal(points[slots[at]], points[i])) at = (at + 1) & (room - 1);
    if (slots[at] == UINT32_MAX) slots[at] = (uint32_t)i;
    place[i] = slots[at];
  }
  free(slots);
  return true;
}

/* ---- orientation of neighbouring faces ---- */

typedef struct { uint32_t low, high, face; bool forward; } vs_side; /* low, high: points at the ends of the side;
                                                                     * forward: true if the face runs along the side
                                                                     * from low to high */

static int side_compare(const void *a, const void *b) { /* compares two sides with equal low ends by their high ends,
                                                         * for qsort */
  const vs_side *p = a, *q = b;
  if (p->high != q->high) return p->high < q->high ? -1 : 1;
  if (p->face != q->face) return p->face < q->face ? -1 : 1;
  return p->forward - q->forward;
}

/* Sorts the sides of faces by their end with the lower point number, and then those with equal low ends by the other
 * end. Returns false when memory is out or the run is interrupted. */
static bool sides_sort(vs_store *s, vs_side *sides, const vs_polygons *faces, vs_error *e) {
  const uint32_t *starts = faces->starts, *corners = faces->corners;
  size_t points = faces->point_count;
  uint32_t *at = vs_zeros(points + 2, sizeof *at);
  if (!at) return vs_error_memory(e, NULL);
  for (int pass = 0; pass < 2; pass++) {
    for (uint32_t f = 0; f < faces->face_count; f++)
      for (uint32_t c = starts[f]; c < starts[f + 1]; c++) {
        uint32_t a = corners[c], b = corners[c + 1 == starts[f + 1] ? starts[f] : c + 1];
        if (pass) sides[at[(a < b ? a : b) + 1]++] = (vs_side){ a < b ? a : b, a < b ? b : a, f, a < b };
        else at[(a < b ? a : b) + 2]++;
      }
    for (size_t i = 2; !pass && i < points + 2; i++) at[i] += at[i - 1];
  }
  bool ok = true;
  for (size_t p = 0; ok && p < points; p++) { /* the loop above has advanced at[p + 1] to the end of point p's sides;
                                               * therefore at[p] is the index of the first of them */
    uint32_t low = at[p], count = at[p + 1] - low;
    enum { FEW = 16 };
    if (count > FEW) qsort(sides + low, count, sizeof *sides, side_compare);
    for (uint32_t i = 1; count <= FEW && i < count; i++) {
      vs_side x = sides[low + i];
      uint32_t j = low + i;
      for (; j > low && side_compare(&sides[j - 1], &x) > 0; j--) sides[j] = sides[j - 1];
      sides[j] = x;
    }
    ok = vs_store_going(s, 16, e);
  }
  free(at);
  return ok;
}

typedef struct {
  vs_side *sides;      /* sides of all faces, sorted by their ends */
  uint32_t *mate;      /* mate[i]: side of the neighbouring face at the edge of side i, or UINT32_MAX */
  uint32_t *of_face;   /* of_face[starts[f]] to of_face[starts[f + 1] - 1]: indices of the sides of face f */
  uint32_t *starts;    /* starts[f]: index in of_face of face f's first side */
  uint32_t *queue;
  unsigned char *turned, *seen;
} vs_agreement;

static void agreement_free(vs_agreement *g) {
  free(g->sides);
  free(g->mate);
  free(g->of_face);
  free(g->starts);
  free(g->queue);
  free(g->turned);
  free(g->seen);
}

/* Sets *agreed to true if each edge has exactly two faces, which contain it in opposite directions. This test is quick;
 * if *agreed is false, the faces may still agree. Returns false when memory is out or the run is interrupted. */
static bool polyface_agreed(vs_store *s, const vs_polygons *faces, bool *agreed, vs_error *e) {
  enum { FEW = 32 };
  const uint32_t *starts = faces->starts, *corners = faces->corners;
  size_t points = faces->point_count, n = starts[faces->face_count];
  *agreed = false;
  if (n == 0 || points > UINT32_MAX / 2) return true;
  /* ends: for each side, 2 * its end with the higher number, plus 1 if the side runs from this end */
  uint32_t *at = vs_zeros(points + 2, sizeof *at), *ends = vs_fresh(n, sizeof *ends);
  bool ok = (at && ends) || vs_error_memory(e, NULL);
  for (int pass = 0; ok && pass < 2; pass++) {
    for (size_t f = 0; f < faces->face_count; f++)
      for (uint32_t c = starts[f]; c < starts[f + 1]; c++) {
        uint32_t a = corners[c], b = corners[c + 1 == starts[f + 1] ? starts[f] : c + 1];
        if (pass) ends[at[(a < b ? a : b) + 1]++] = a < b ? 2 * b : 2 * a + 1;
        else at[(a < b ? a : b) + 2]++;
      }
    for (size_t i = 2; !pass && i < points + 2; i++) at[i] += at[i - 1];
    ok = vs_store_going(s, (uint32_t)n, e);
  }
  *agreed = ok;
  for (size_t p = 0; ok && *agreed && p < points; p++) {
    uint32_t low = at[p], count = at[p + 1] - low;
    *agreed = count <= FEW && count % 2 == 0;
    for (uint32_t i = 1; *agreed && i < count; i++) {
      uint32_t x = ends[low + i], j = low + i;
      for (; j > low && ends[j - 1] > x; j--) ends[j] = ends[j - 1];
      ends[j] = x;
    }
    for (uint32_t i = 0; *agreed && i < count; i += 2)
      *agreed = ends[low + i] % 2 == 0 && ends[low + i + 1] == ends[low + i] + 1 &&
                (i == 0 || ends[low + i] != ends[low + i - 2]);
    ok = vs_store_going(s, 16, e);
  }
  free(at);
  free(ends);
  return ok;
}

/* Finds the neighbours of the faces. *closed: true if each edge has exactly two faces whose orientations agree or can
 * be made to agree. turned[f]: 1 if face f must be reversed for that. Returns false when memory is out or the run is
 * interrupted. */
static bool polyface_agree(vs_store *s, vs_agreement *g, const vs_polygons *faces, bool *closed, vs_error *e) {
  size_t face_count = faces->face_count, n = faces->starts[face_count];
  size_t room = n ? n : 1, face_room = face_count ? face_count : 1;
  if (!polyface_agreed(s, faces, closed, e)) return false;
  if (*closed) return (g->turned = vs_zeros(face_room, 1)) || vs_error_memory(e, NULL);
  *g = (vs_agreement){ vs_fresh(room, sizeof *g->sides),
                       vs_fresh(room, sizeof *g->mate),
                       vs_fresh(room, sizeof *g->of_face),
                       vs_zeros(face_room + 1, sizeof *g->starts),
                       vs_fresh(face_room, sizeof *g->queue),
                       vs_zeros(face_room, 1),
                       vs_zeros(face_room, 1) };
  if (!g->sides || !g->mate || !g->of_face || !g->starts || !g->queue || !g->turned || !g->seen)
    return vs_error_memory(e, NULL);
  if (!sides_sort(s, g->sides, faces, e)) return false;
  *closed = n > 0;
  for (size_t i = 0; i < n;) {
    if (!vs_store_going(s, 4, e)) return false;
    size_t end = i + 1;
    while (end < n && g->sides[end].low == g->sides[i].low && g->sides[end].high == g->sides[i].high) end++;
    for (size_t k = i; k < end; k++) g->mate[k] = end - i == 2 ? (uint32_t)(k == i ? i + 1 : i) : UINT32_MAX;
    if (end - i != 2) { /* an edge of more than two faces belongs to a closed mesh only if all faces already agree */
      size_t forward = 0;
      for (size_t k = i; k < end; k++) forward += g->sides[k].forward;
      if (forward * 2 != end - i) *closed = false;
    }
    i = end;
  }
  for (size_t i = 0; i < n; i++) g->starts[g->sides[i].face + 1]++;
  for (size_t f = 0; f < face_count; f++) g->starts[f + 1] += g->starts[f];
  /* After this loop starts[f + 1] is the index of face f's first side. */
  for (size_t i = n; i-- > 0;) g->of_face[--g->starts[g->sides[i].face + 1]] = (uint32_t)i;
  for (uint32_t first = 0; first < face_count; first++) {
    if (g->seen[first]) continue;
    size_t head = 0, tail = 0;
    g->seen[first] = 1;
    g->queue[tail++] = first;
    while (head < tail) {
      uint32_t f = g->queue[head++];
      if (!vs_store_going(s, 4, e)) return false;
      uint32_t from = g->starts[f + 1], to = f + 1 < face_count ? g->starts[f + 2] : (uint32_t)n;
      for (uint32_t k = from; k < to; k++) {
        uint32_t mate = g->mate[g->of_face[k]];
        if (mate == UINT32_MAX) continue;
        const vs_side *mine = &g->sides[g->of_face[k]], *other = &g->sides[mate];
        bool agree = (mine->forward ^ g->turned[f]) != (other->forward ^ g->turned[other->face]);
        if (g->seen[other->face]) {
          if (!agree) *closed = false; /* two neighbours can never agree: the surface has only one side, like a Moebius
                                        * strip */
          continue;
        }
        g->seen[other->face] = 1;
        if (!agree) g->turned[other->face] ^= 1;
        g->queue[tail++] = other->face;
      }
    }
  }
  return true;
}

/* Sets *flat to true if no connected part of the mesh encloses a volume above `least`, for example because it consists
 * of pairs of coincident faces. Returns false when memory is out. */
static bool mesh_is_flat(const vs_mesh *m, double least, bool *flat) {
  uint32_t n = (uint32_t)m->vertex_count, *shell = vs_fresh((size_t)n + 1, sizeof *shell);
  double *volume = vs_zeros((size_t)n + 1, sizeof *volume);
  bool ok = shell && volume;
  *flat = true;
  if (ok) vs_disjoint(shell, n);
  for (size_t t = 0; ok && t < m->triangle_count; t++)
    for (int j = 1; j < 3; j++) vs_unite(shell, m->triangles[t][0], m->triangles[t][j]);
  for (size_t t = 0; ok && t < m->triangle_count; t++) {
    const uint32_t *v = m->triangles[t];
    uint32_t root = vs_find(shell, v[0]);
    vs_vec3 o = m->vertices[root];
    volume[root] += vs_v3_dot(vs_v3_sub(m->vertices[v[0]], o),
                              vs_v3_cross(vs_v3_sub(m->vertices[v[1]], o), vs_v3_sub(m->vertices[v[2]], o))) /
                    6;
  }
  for (uint32_t v = 0; ok && v < n && *flat; v++) *flat = fabs(volume[v]) <= least;
  free(shell);
  free(volume);
  return ok;
}

bool vs_polyface_orient(vs_store *s, const vs_polygons *faces, unsigned char *turned, bool *closed, vs_error *e) {
  vs_agreement g = { 0 };
  bool ok = polyface_agree(s, &g, faces, closed, e);
  if (ok) memcpy(turned, g.turned, faces->face_count);
  agreement_free(&g);
  return ok;
}

vs_node *vs_polyface_make_mesh(vs_store *s, const vs_polygons *given, vs_mesh *out, vs_error *e) {
  const uint32_t *starts = given->starts, *corners = given->corners;
  size_t count = given->point_count, face_count = given->face_count, corner_count = starts[face_count];
  size_t kept_faces = 0, kept_corners = 0;
  uint32_t *place = vs_fresh(count, sizeof *place);
  uint32_t *new_starts = vs_fresh(face_count + 1, sizeof *new_starts);
  uint32_t *merged = vs_fresh(corner_count, sizeof *merged),
           *own = vs_fresh(corner_count, sizeof *own);
  vs_agreement g = { 0 };
  vs_points *at = NULL;
  vs_faces *faces = NULL;
  vs_node *node = NULL;
  vs_mesh mesh = { 0 };
  vs_error why = { VS_ERROR_NONE, NULL, "" };
  bool closed = false, turned = false,
       ok = place && new_starts && merged && own && vs_polyface_merge(given->points, count, place);
  if (!ok) {
    vs_error_memory(&why, NULL);
    goto done;
  }
  if (!vs_store_going(s, (uint32_t)corner_count, &why)) goto done;
  new_starts[0] = 0;
  for (size_t f = 0; f < face_count; f++) {
    size_t begin = kept_corners;
    for (uint32_t c = starts[f]; c < starts[f + 1]; c++) {
      if (kept_corners > begin && merged[kept_corners - 1] == place[corners[c]]) continue;
      merged[kept_corners] = place[corners[c]];
      own[kept_corners++] = corners[c];
    }
    while (kept_corners > begin + 1 && merged[kept_corners - 1] == merged[begin]) kept_corners--;
    if (kept_corners - begin < 3) kept_corners = begin;
    else new_starts[++kept_faces] = (uint32_t)kept_corners;
  }
  if (!kept_faces) {
    node = vs_node_new(s, VS_EMPTY, NULL, NULL, 0);
    goto done;
  }
  ok = polyface_agree(s, &g, &(vs_polygons){ NULL, count, new_starts, merged, kept_faces }, &closed, &why);
  if (!ok) goto done;
  for (int pass = 0; pass < 2; pass++) { /* if the solid is inside out, a second pass turns all faces */
    for (size_t f = 0; f < kept_faces; f++) {
      if (!pass && !g.turned[f]) continue;
      for (uint32_t a = new_starts[f], b = new_starts[f + 1] - 1; a < b; a++, b--) {
        uint32_t swap = own[a];
        own[a] = own[b];
        own[b] = swap;
      }
    }
    vs_faces_release(s, faces);
    faces = vs_faces_new(s, new_starts, kept_faces, own, kept_corners);
    if (!at) at = vs_points_new(s, given->points, count);
    if (!faces || !at || !vs_store_going(s, (uint32_t)kept_corners, &why)) goto done;
    turned = pass > 0;
    if (!closed || turned) break;
    if ((out && !(mesh.tags = vs_fresh(1, sizeof *mesh.tags))) || !vs_solid_polyface_merged(&mesh, at, faces, place))
      goto done;
    double volume = vs_mesh_volume(&mesh);
    if (!vs_store_going(s, (uint32_t)kept_corners, &why)) goto done;
    vs_bounds b = vs_mesh_bounds(&mesh);
    double d = vs_bounds_diagonal(&b);
    bool flat = false;
    if (fabs(volume) <= 1e-14 * d * d * d && !mesh_is_flat(&mesh, 1e-14 * d * d * d, &flat)) goto done;
    if (flat) closed = false;
    if (volume >= 0 || !closed) break;
  }
  struct vs_polyface_mesh data = { .points = at, .faces = faces, .closed = closed };
  node = vs_node_new(s, VS_POLYFACE_MESH, &data, NULL, 0);
  if (out && node && closed && !turned) *out = mesh, mesh = (vs_mesh){ 0 };
done:
  if (!node && why.kind != VS_ERROR_NONE && e) *e = why;
  else if (!node) vs_error_memory(e, NULL);
  vs_mesh_free(&mesh);
  agreement_free(&g);
  vs_points_release(s, at);
  vs_faces_release(s, faces);
  free(place);
  free(new_starts);
  free(merged);
  free(own);
  return node;
}

vs_node *vs_polyface_make(vs_store *s, const vs_polygons *faces, vs_error *e) {
  return vs_polyface_make_mesh(s, faces, NULL, e);
}
