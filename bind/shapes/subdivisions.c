/* Implements surfaces made from an object's faces: make-subdivision with its creases, and make-crust, which thickens a
 * surface or hollows a solid. */
#include <stdlib.h>
#include <string.h>

#include "bind/build.h"
#include "bind/call/call.h"
#include "bind/call/raise.h"
#include "bind/call/refuse.h"
#include "bind/call/take.h"
#include "bind/measures.h"
#include "bind/print.h"
#include "bind/queries.h"
#include "bind/records.h"
#include "bind/shapes/taken_apart.h"
#include "geometry/files/polyface.h"
#include "geometry/profiles/thicken.h"
#include "geometry/shapes/polygons.h"
#include "geometry/shapes/subdivision.h"
#include "model/store/array.h"
#include "vm/machine/fail.h"

enum { FACES_MOST = 4000000 };

static bool add_face(void *list, const vs_vec3 *corner, uint32_t n) {
  vs_face_list *l = list;
  bool ok = true;
  for (uint32_t i = 0; ok && i < n; i++)
    ok = vs_face_list_corner(l, (uint32_t)l->point_count) && vs_face_list_point(l, corner[i]);
  return ok && vs_face_list_close(l);
}

static vs_status faces_of(vs_args *f, vs_ref object, vs_face_list *l) {
  vs_affine map = vs_affine_identity();
  vs_node *n = object.node;
  while (n->kind == VS_TRANSFORM || vs_node_is_wrapper(n)) {
    if (n->kind == VS_TRANSFORM) map = vs_affine_multiply(&map, &VS_AS(transform, n)->matrix);
    n = n->children[0].node;
  }
  vs_polygons_result own = vs_polygons_each(n, &map, add_face, l);
  if (own != VS_POLYGONS_NONE) return own == VS_POLYGONS_GIVEN ? VS_OK : vs_fail_memory(f->vm);
  vs_bend_leaves leaves;
  if (!vs_bend_take_apart(f->vm, object, "regions have no faces to subdivide: do-extrude them", &leaves))
    return VS_ERROR;
  bool ok = true;
  for (size_t i = 0; ok && i < leaves.count; i++)
    for (size_t k = 0; ok && k < leaves.at[i].mesh.triangle_count; k++) {
      const uint32_t *corner = leaves.at[i].mesh.triangles[k];
      const vs_vec3 *v = leaves.at[i].mesh.vertices, at[3] = { v[corner[0]], v[corner[1]], v[corner[2]] };
      ok = add_face(l, at, 3);
    }
  vs_bend_drop(&leaves);
  return ok ? VS_OK : vs_fail_memory(f->vm);
}

/* Merges corners with equal coordinates, and removes faces that then have fewer than three corners. */
static bool share_points(vs_face_list *l) {
  vs_face_list out = { 0 };
  uint32_t *place = NULL, *number = NULL;
  size_t place_room = 0, number_room = 0;
  bool ok = VS_GROW(place, place_room, l->point_count + 1) && VS_GROW(number, number_room, l->point_count + 1) &&
            vs_polyface_merge(l->points, l->point_count, place);
  for (size_t i = 0; ok && i < l->point_count; i++) {
    if (place[i] != i) continue;
    number[i] = (uint32_t)out.point_count;
    ok = vs_face_list_point(&out, l->points[i]);
  }
  for (size_t f = 0; ok && f < l->face_count; f++) {
    uint32_t first = UINT32_MAX, last = UINT32_MAX;
    for (uint32_t c = l->starts[f]; ok && c < l->starts[f + 1]; c++) {
      uint32_t p = number[place[l->corners[c]]];
      if (p == last || (c + 1 == l->starts[f + 1] && p == first)) continue;
      if (first == UINT32_MAX) first = p;
      last = p;
      ok = vs_face_list_corner(&out, p);
    }
    ok = ok && vs_face_list_close(&out);
  }
  free(place), free(number);
  vs_face_list_free(l);
  *l = out;
  return ok;
}

static bool point_number(vs_args *f, const vs_face_list *l, vs_value v, uint32_t *out) {
  if (vs_is_fixnum(v) && vs_fixnum(v) >= 1 && vs_fixnum(v) <= (int64_t)l->point_count)
    return *out = (uint32_t)vs_fixnum(v) - 1, true;
  if (!vs_is_flat(v, VS_FLAT_POINT)) return vs_bind_refuse(f, "creases", "of points of the mesh", v);
  const double *d = vs_as_flat(v)->at;
  vs_bounds b = vs_bounds_empty();
  for (size_t i = 0; i < l->point_count; i++) vs_bounds_add(&b, l->points[i]);
  double best = INFINITY;
  for (size_t i = 0; i < l->point_count; i++) {
    double away = vs_v3_length(vs_v3_sub(l->points[i], vs_v3(d[0], d[1], d[2])));
    if (away < best) best = away, *out = (uint32_t)i;
  }
  return best <= 1e-6 * vs_bounds_diagonal(&b) || vs_bind_refuse(f, "creases", "of points of the mesh", v);
}

/* Reads the creases (sharp edges) of a subdivision from argument 2. Each crease is a list of an edge's two end points,
 * or of the points' numbers from 1, followed by its sharpness if this is finite. */
static bool creases_of(vs_args *f, const vs_face_list *l, vs_crease **out, size_t *count) {
  static const char *const expected =
      "lists of three: two points of an edge, or their numbers, and the edge's sharpness";
  size_t room = 0;
  for (vs_value c = f->arg[2].value; vs_is_pair(c); c = vs_cdr(c)) {
    vs_value e = vs_car(c);
    int64_t n = vs_list_length(e);
    vs_crease made = { .sharpness = INFINITY };
    if (n != 2 && n != 3) return vs_bind_refuse(f, "creases", expected, e);
    if (!point_number(f, l, vs_car(e), &made.a) || !point_number(f, l, vs_car(vs_cdr(e)), &made.b)) return false;
    vs_value sharpness = n == 3 ? vs_car(vs_cdr(vs_cdr(e))) : VS_FALSE;
    if (n == 3 && (!vs_bind_take_number(f->vm, sharpness, &made.sharpness) || !(made.sharpness >= 0)))
      return vs_bind_refuse(f, "creases", "of a sharpness that is a number of 0 or more", sharpness);
    bool is_edge = false;
    for (size_t i = 0; !is_edge && i < l->face_count; i++)
      for (uint32_t k = l->starts[i]; !is_edge && k < l->starts[i + 1]; k++) {
        uint32_t a = l->corners[k], b = l->corners[k + 1 < l->starts[i + 1] ? k + 1 : l->starts[i]];
        is_edge = (a == made.a && b == made.b) || (a == made.b && b == made.a);
      }
    if (!is_edge) return vs_bind_refuse(f, "creases", "edges of the mesh", e);
    if (!VS_GROW(*out, room, *count + 1)) return vs_fail_memory(f->vm);
    (*out)[(*count)++] = made;
  }
  return true;
}

typedef struct {
  vs_scheme *vm;
  bool stopped;
} host;

static bool going(void *context, double done) {
  host *h = context;
  h->stopped = !vs_bind_keep_going(h->vm, done);
  return !h->stopped;
}

/* (%make-subdivision o n creases #:scheme #:limit): creates a surface from the faces of o, subdivided n times. */
vs_status vs_p_make_subdivision(vs_args *f, vs_value *out) {
  vs_face_list l = { 0 };
  vs_crease *creases = NULL;
  size_t crease_count = 0;
  vs_error e = { 0 };
  if (!vs_bind_finite(f, 0) || !vs_bind_resolve(f, 0)) return VS_ERROR;
  bool loop = f->key[0].given && !strcmp(vs_as_symbol(f->key[0].value)->name, "loop");
  if (f->key[0].given && !loop && strcmp(vs_as_symbol(f->key[0].value)->name, "catmull-clark"))
    return vs_bind_refuse(f, "scheme", "'catmull-clark or 'loop", f->key[0].value);
  if (f->arg[0].ref.node->class_ == VS_CURVE || f->arg[0].ref.node->class_ == VS_REGION_CLASS)
    return vs_bind_refuse(f, "o", "a mesh, a solid or a surface", f->arg[0].value);
  vs_status status = faces_of(f, f->arg[0].ref, &l);
  if (status && !share_points(&l)) status = vs_fail_memory(f->vm);
  if (status && l.face_count == 0) {
    vs_face_list_free(&l);
    return vs_bind_empty(f, "the object has no faces", out);
  }
  double faces = (double)l.corner_count * pow(4, (double)f->arg[1].integer - 1);
  if (status && faces > FACES_MOST)
    status = vs_fail(f->vm, f->vm->sym.range, "%.0f faces would be made, but at most %d are", faces, FACES_MOST);
  if (status && !creases_of(f, &l, &creases, &crease_count)) status = VS_ERROR;
  vs_subdivision how = { .creases = creases,
                         .crease_count = crease_count,
                         .levels = (int)f->arg[1].integer,
                         .scheme = loop ? VS_SUBDIVIDE_LOOP : VS_SUBDIVIDE_CATMULL_CLARK,
                         .limit = !f->key[1].given || f->key[1].boolean };
  host h = { f->vm, false };
  if (status && !vs_subdivide(&l, &how, (vs_long_work){ going, &h }))
    status = h.stopped ? VS_ERROR : vs_fail_memory(f->vm);
  vs_node *node = NULL;
  if (status) {
    vs_polygons made = vs_polygons_of(&l);
    node = vs_polyface_make(f->store, &made, &e);
    if (!node) status = vs_bind_error(f->vm, &e);
  }
  vs_face_list_free(&l);
  free(creases);
  return status ? vs_bind_give_node(f, node, out) : VS_ERROR;
}

/* ---- crusts of a given thickness ---- */

/* (make-crust o thickness #:side): creates a solid of this thickness along the surface of o; #:side is 'in, 'out or
 * 'both. */
vs_status vs_p_make_crust(vs_args *f, vs_value *out) {
  double t = f->arg[1].real, outwards = 0, inwards = t;
  if (!vs_bind_finite(f, 0) || !vs_bind_resolve(f, 0)) return VS_ERROR;
  vs_node *o = f->arg[0].ref.node;
  if (vs_node_is_empty(o)) return vs_bind_empty(f, "the object is empty, and has no crust", out);
  if (o->class_ != VS_SOLID && o->class_ != VS_SURFACE)
    return vs_bind_refuse(f, "o", "a solid or a surface", f->arg[0].value);
  if (f->key[0].given) {
    const char *side = vs_as_symbol(f->key[0].value)->name;
    bool both = !strcmp(side, "both"), outside = !strcmp(side, "out");
    if (!both && !outside && strcmp(side, "in"))
      return vs_bind_refuse(f, "side", "'in, 'out or 'both", f->key[0].value);
    outwards = both ? t / 2 : outside ? t : 0, inwards = t - outwards;
  }
  vs_mesh m = { 0 }, shell = { 0 };
  vs_vec3 at;
  bool turns = false;
  vs_error e = { 0 };
  vs_status status = vs_bend_triangles(f->vm, f->arg[0].ref, &m);
  if (status && !vs_thicken_surface(&m, outwards, inwards, &shell, &at, &turns)) status = vs_fail_memory(f->vm);
  if (status && turns) {
    char x[32], y[32], z[32];
    vs_bind_number_text(x, at.x), vs_bind_number_text(y, at.y), vs_bind_number_text(z, at.z);
    status = vs_fail(f->vm, f->vm->sym.range, "the surface bends more tightly than the thickness near (xyz %s %s %s)",
                     x, y, z);
  }
  uint32_t *starts = NULL;
  size_t room = 0;
  vs_node *node = NULL;
  if (status && !VS_GROW(starts, room, shell.triangle_count + 1)) status = vs_fail_memory(f->vm);
  for (size_t i = 0; status && i <= shell.triangle_count; i++) starts[i] = (uint32_t)(3 * i);
  if (status) {
    vs_polygons faces = { shell.vertices, shell.vertex_count, starts, &shell.triangles[0][0], shell.triangle_count };
    node = vs_polyface_make(f->store, &faces, &e);
    if (!node) status = vs_bind_error(f->vm, &e);
  }
  free(starts);
  vs_mesh_free(&m), vs_mesh_free(&shell);
  return status ? vs_bind_give_node(f, node, out) : VS_ERROR;
}
