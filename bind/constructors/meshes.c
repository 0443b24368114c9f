/* Creates objects from faces, which the program lists or reads from a file. Checks the faces, and repairs them if the
 * program requests it. */
#include "bind/build.h"
#include "bind/call/call.h"
#include "bind/call/raise.h"
#include "bind/call/refuse.h"
#include "bind/call/scratch.h"
#include "bind/constructors/files.h"
#include "bind/constructors/meshes.h"

#include <stdio.h>
#include <stdlib.h>

#include "bind/call/context.h"
#include "bind/warnings.h"
#include "geometry/files/polyface.h"
#include "geometry/files/repair.h"
#include "geometry/primitives/solid_triangles.h"
#include "kernel/mesh/inspect.h"
#include "model/job.h"
#include "model/store/array.h"
#include "model/store/cache.h"
#include "solids/solid_meshes.h"

#define POINT(i) (f->arg[i].point)

/* ---- checking faces ---- */

/* Returns true if every corner lies on or below the plane of every face. The mesh, a single closed surface, is then
 * convex. Returns false for large meshes without testing them, since the time grows with the product of corners and
 * faces. */
static bool is_convex(const vs_mesh *m) {
  if (m->triangle_count != 2 * m->vertex_count - 4 || m->triangle_count * m->vertex_count > 4096) return false;
  vs_bounds b = vs_mesh_bounds(m);
  double size = vs_bounds_diagonal(&b), slack = 1e-13 * size * size * size;
  for (size_t t = 0; t < m->triangle_count; t++) {
    vs_vec3 o = m->vertices[m->triangles[t][0]], n = vs_v3_cross(vs_v3_sub(m->vertices[m->triangles[t][1]], o),
                                                                 vs_v3_sub(m->vertices[m->triangles[t][2]], o));
    for (size_t i = 0; i < m->vertex_count; i++)
      if (vs_v3_dot(n, vs_v3_sub(m->vertices[i], o)) > slack) return false;
  }
  return true;
}

static void place_text(char text[112], vs_vec3 p) {
  char x[32], y[32], z[32];
  snprintf(x, sizeof x, "%.6g", p.x), snprintf(y, sizeof y, "%.6g", p.y), snprintf(z, sizeof z, "%.6g", p.z);
  snprintf(text, 112, "(xyz %s %s %s)", x, y, z);
}

/* Checks a polyface mesh for faults. mesh: its triangles, tagged by face; if it is empty, the function computes them.
 * Sets *flawless to true if no faces overlap. */
static vs_status inspect(vs_args *f, vs_node *n, vs_mesh *mesh, vs_mesh_flaws *flaws, bool *flawless) {
  const struct vs_polyface_mesh *d = VS_AS(polyface_mesh, n);
  vs_kernel_counts counts = { 0 };
  vs_kernel_options options = { .job = vs_bind_job(f->vm), .counts = &counts };
  vs_kernel_error why;
  if (!mesh->tags && (!(mesh->tags = vs_fresh(1, sizeof *mesh->tags)) || !vs_solid_polyface(mesh, d->points, d->faces)))
    return vs_fail_memory(f->vm);
  *flaws = (vs_mesh_flaws){ .most = 1 };
  *flawless = true;
  if (is_convex(mesh)) return VS_OK;
  vs_cache *cache = vs_store_cache(f->store);
  const vs_cache_key key = { VS_CACHED_CHECK, n, NULL, 0, 0 };
  const vs_cached *held = vs_cache_find(cache, &key);
  vs_cache_let_go(cache, held);
  if (held) return VS_OK;
  vs_work_phase was = vs_tally_enter(vs_store_tally(f->store), VS_WORK_MESH);
  bool looked = vs_kernel_inspect(mesh, &options, flaws, &why);
  vs_tally_enter(vs_store_tally(f->store), was);
  vs_solid_tally_steps(f->store, &counts);
  if (!looked) {
    if (why.status == VS_KERNEL_INTERRUPTED) return VS_ERROR; /* the interrupt has already set the error */
    return why.status == VS_KERNEL_OUT_OF_MEMORY ? vs_fail_memory(f->vm)
                                                 : vs_fail(f->vm, f->vm->sym.range, "%s", why.message);
  }
  *flawless = vs_mesh_flawless(flaws);
  if (*flawless) vs_cache_let_go(cache, vs_cache_keep(cache, &key, NULL, 0));
  return VS_OK;
}

static vs_status refuse_flaws(vs_args *f, const char *file, const vs_mesh *mesh, const vs_mesh_flaws *flaws) {
  char at[112], more[64] = "";
  const vs_mesh_flaw *first = flaws->wound_count ? &flaws->wound[0] : &flaws->open[0];
  size_t others = flaws->wound_count ? flaws->wound_count : flaws->open_count;
  place_text(at, first->at);
  if (others > 1) snprintf(more, sizeof more, " and at %zu places more", others - 1);
  return vs_fail(f->vm, f->vm->sym.range,
                 "%s%sthe faces %s: at face %u, near %s%s; #:repair #t makes one solid of them", file,
                 *file ? ": " : "",
                 !flaws->wound_count  ? "do not close"
                 : first->winding < 0 ? "are inside out in part"
                                      : "cross or overlap",
                 mesh->tags[first->triangle] + 1, at, more);
}

static vs_status refuse_open(vs_args *f, const char *file, const vs_face_list *l) {
  vs_open_edges open;
  char from[112], to[112], more[64] = "";
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  if (!vs_face_list_open(f->store, l, &open, &e)) return vs_bind_error(f->vm, &e);
  if (!open.count)
    return vs_fail(f->vm, f->vm->sym.range, "%s: the faces enclose nothing, or have one side, as a Moebius strip",
                   file);
  place_text(from, open.from), place_text(to, open.to);
  if (open.count > 1) snprintf(more, sizeof more, ", and at %zu edges more", open.count - 1);
  return vs_fail(f->vm, f->vm->sym.range,
                 "%s: the mesh is open at the edge from %s to %s of face %zu%s; #:repair #t closes it", file, from, to,
                 open.face + 1, more);
}

/* ---- repairing faces ---- */

static bool list_of_mesh(vs_face_list *l, const vs_mesh *m) {
  bool ok = true;
  vs_face_list_free(l);
  for (size_t i = 0; ok && i < m->vertex_count; i++) ok = vs_face_list_point(l, m->vertices[i]);
  for (size_t i = 0; ok && i < m->triangle_count; i++) {
    for (int k = 0; ok && k < 3; k++) ok = vs_face_list_corner(l, m->triangles[i][k]);
    ok = ok && vs_face_list_close(l);
  }
  return ok;
}

/* Appends a text such as "dropped 3 faces" (verb, count, thing) at position `at`, after a comma if the text is not
 * empty. Appends nothing if count is 0. Returns the position of the text's new end. */
static size_t note(char *text, size_t room, size_t at, size_t count, const char *verb, const char *thing) {
  if (!count) return at;
  int n = snprintf(text + at, room - at, "%s%s %zu %s%s", at ? ", " : "", verb, count, thing, count == 1 ? "" : "s");
  return n > 0 && at + (size_t)n < room ? at + (size_t)n : at;
}

vs_status vs_bind_whole_faces(vs_args *f, const char *file, vs_face_list *l, bool *flawless, vs_node **out) {
  vs_error e = { 0 };
  vs_mesh mesh = { 0 }, whole = { 0 };
  vs_mesh_flaws flaws;
  vs_polygons faces = vs_polygons_of(l);
  vs_status ok = (*out = vs_polyface_make(f->store, &faces, &e)) ? VS_OK : vs_bind_error(f->vm, &e);
  *flawless = true;
  if (ok && (*out)->class_ == VS_SOLID) ok = inspect(f, *out, &mesh, &flaws, flawless);
  if (ok && !*flawless) {
    vs_kernel_options options = { .job = vs_bind_job(f->vm) };
    vs_kernel_error why;
    if (!vs_kernel_resolve(&mesh, 0, &options, &whole, &why))
      ok = why.status == VS_KERNEL_INTERRUPTED ? VS_ERROR
           : why.status == VS_KERNEL_OUT_OF_MEMORY
               ? vs_fail_memory(f->vm)
               : vs_fail(f->vm, f->vm->sym.range, "%s%s%s", file, *file ? ": " : "", why.message);
    vs_node_release(*out);
    *out = NULL;
    if (ok && !list_of_mesh(l, &whole)) ok = vs_fail_memory(f->vm);
    faces = vs_polygons_of(l);
    if (ok && !(*out = vs_polyface_make(f->store, &faces, &e))) ok = vs_bind_error(f->vm, &e);
  }
  vs_mesh_free(&mesh);
  vs_mesh_free(&whole);
  if (!ok) vs_node_release(*out), *out = NULL;
  return ok;
}

/* Repairs the faces in l, and sets *out to a new node of them, which may be empty. A warning lists the repairs. Sets
 * *sheet to true if the result is a surface, or if the faces enclose no volume even after holes were closed. */
static vs_status repaired(vs_args *f, const char *file, vs_face_list *l, bool *sheet, vs_node **out) {
  vs_repair_notes notes;
  vs_error e = { 0 };
  bool flawless = true;
  *out = NULL;
  if (!vs_face_list_repair(f->store, l, &notes, &e)) return vs_bind_error(f->vm, &e);
  if (!vs_bind_whole_faces(f, file, l, &flawless, out)) return VS_ERROR;
  *sheet = (*out)->class_ == VS_SURFACE || ((*out)->class_ != VS_SOLID && notes.holes > 0);
  char text[256] = "";
  size_t at = note(text, sizeof text, 0, notes.welded, "welded", "point");
  at = note(text, sizeof text, at, notes.dropped, "dropped", "face");
  at = note(text, sizeof text, at, notes.turned, "turned", "face");
  at = note(text, sizeof text, at, notes.holes, "closed", "hole");
  if (notes.holes > 1 && at < sizeof text - 40)
    at += (size_t)snprintf(text + at, sizeof text - at, " (of up to %zu edges)", notes.largest);
  if (!flawless && at < sizeof text - 60)
    at += (size_t)snprintf(text + at, sizeof text - at, "%smade one solid of overlapping parts", at ? ", " : "");
  if (at) vs_bind_warn(f->bind, "repair", "%s%srepaired: %s", file, *file ? " " : "", text);
  return VS_OK;
}

/* ---- faces that the program lists ---- */

/* Sets *out to the object of n, whose reference it takes over. sheet: whether the faces form a surface. If n is empty,
 * `sheet` determines whether *out is the empty surface or the empty solid. */
static vs_status finished(vs_args *f, vs_node *n, bool sheet, vs_value *out) {
  if (!vs_node_is_empty(n)) return vs_bind_give_node(f, n, out);
  vs_node_release(n);
  return vs_bind_empty(f, sheet ? "the faces are a surface, which encloses nothing" : "the faces have no area", out);
}

static vs_status polyface(vs_args *f, const vs_polygons *faces, vs_value *out) {
  vs_error e = { 0 };
  const vs_vec3 *at = faces->points;
  const uint32_t *starts = faces->starts, *corner = faces->corners;
  size_t count = faces->face_count;
  if (faces->point_count > UINT32_MAX || count > UINT32_MAX) return vs_fail_memory(f->vm);
  double size = 0, widest = 0;
  for (size_t i = 0; i < count; i++) {
    vs_vec3 a = at[corner[starts[i]]], sum = { 0, 0, 0 };
    for (uint32_t c = starts[i] + 1; c < starts[i + 1]; c++) {
      vs_vec3 d = vs_v3_sub(at[corner[c]], a);
      size = fmax(size, vs_v3_length(d));
      if (c + 1 < starts[i + 1]) sum = vs_v3_add(sum, vs_v3_cross(d, vs_v3_sub(at[corner[c + 1]], a)));
    }
    widest = fmax(widest, vs_v3_length(sum));
  }
  if (widest <= 1e-14 * size * size) return vs_bind_empty(f, "the faces have no area", out);
  vs_mesh mesh = { 0 };
  vs_node *n = vs_polyface_make_mesh(f->store, faces, &mesh, &e);
  if (!n) return vs_bind_error(f->vm, &e);
  if (n->class_ == VS_SOLID) {
    vs_mesh_flaws flaws;
    bool flawless = true;
    vs_status ok = inspect(f, n, &mesh, &flaws, &flawless);
    if (ok && !flawless) ok = refuse_flaws(f, "", &mesh, &flaws);
    vs_mesh_free(&mesh);
    bool nothing = flawless && flaws.most < 1;
    if (!ok || nothing) vs_node_release(n);
    if (!ok) return VS_ERROR;
    if (nothing) return vs_bind_empty(f, "the faces enclose nothing", out);
  }
  return finished(f, n, false, out);
}

vs_status vs_p_make_polyface_mesh(vs_args *f, vs_value *out) {
  size_t points = f->arg[0].points.count, count = f->arg[1].faces.count;
  const uint32_t *starts = f->arg[1].faces.starts, *corner = f->arg[1].faces.corners;
  for (size_t i = 0; i < count; i++)
    for (uint32_t c = starts[i]; c < starts[i + 1]; c++) {
      if (corner[c] >= points)
        return vs_fail(f->vm, f->vm->sym.range, "face %zu refers to point %u, but there are %zu points, counted from 1",
                       i + 1, corner[c] + 1, points);
      for (uint32_t o = starts[i]; o < c; o++)
        if (corner[o] == corner[c])
          return vs_fail(f->vm, f->vm->sym.range, "face %zu uses point %u twice", i + 1, corner[c] + 1);
    }
  if (count == 0) return vs_bind_empty(f, "there are no faces", out);
  if (f->key[0].given && f->key[0].boolean) {
    vs_face_list l = { 0 };
    vs_node *n = NULL;
    bool ok = true, sheet = false;
    for (size_t i = 0; ok && i < points; i++) ok = vs_face_list_point(&l, f->arg[0].points.at[i]);
    for (size_t i = 0; ok && i < count; i++) {
      for (uint32_t c = starts[i]; ok && c < starts[i + 1]; c++) ok = vs_face_list_corner(&l, corner[c]);
      ok = ok && vs_face_list_close(&l);
    }
    vs_status done = ok ? repaired(f, "", &l, &sheet, &n) : vs_fail_memory(f->vm);
    vs_face_list_free(&l);
    return done ? finished(f, n, sheet, out) : VS_ERROR;
  }
  return polyface(f, &(vs_polygons){ f->arg[0].points.at, points, starts, corner, count }, out);
}

vs_status vs_p_make_irregular_pyramid(vs_args *f, vs_value *out) {
  size_t n = f->arg[0].points.count;
  if (n < 3) return vs_bind_refuse(f, "points", "three or more corners of the base", f->arg[0].value);
  vs_vec3 *at = vs_bind_scratch(f, (n + 1) * sizeof *at);
  uint32_t *starts = vs_bind_scratch(f, (n + 2) * sizeof *starts), *corner = vs_bind_scratch(f, 4 * n * sizeof *corner);
  if (!at || !starts || !corner) return VS_ERROR;
  memcpy(at, f->arg[0].points.at, n * sizeof *at);
  at[n] = POINT(1);
  vs_vec3 spread = { 0, 0, 0 }; /* sum of the normals of the base's triangles; its length is twice the area of a flat
                                 * base */
  for (size_t i = 1; i + 1 < n; i++)
    spread = vs_v3_add(spread, vs_v3_cross(vs_v3_sub(at[i], at[0]), vs_v3_sub(at[i + 1], at[0])));
  /* Two greatest distances of base corners: `size` from the first corner, `off` from the base's plane. `up` is the
   * height of the apex above this plane. `widest` is twice the area of the largest triangle tried. */
  double size = 0, up = 0, off = 0, widest = 0;
  vs_vec3 normal = vs_v3_unit(spread);
  for (size_t i = 1; i < n; i++) {
    vs_vec3 d = vs_v3_sub(at[i], at[0]);
    size = fmax(size, vs_v3_length(d));
    for (size_t j = 1; j < i && j < 3; j++)
      widest = fmax(widest, vs_v3_length(vs_v3_cross(d, vs_v3_sub(at[j], at[0]))));
    off = fmax(off, fabs(vs_v3_dot(normal, d)));
  }
  if (vs_v3_length(spread) <= 1e-12 * size * size) {
    if (widest > 1e-9 * size * size)
      return vs_bind_refuse(f, "points", "corners that go round the base without crossing", f->arg[0].value);
    return vs_bind_empty(f, "the base has no area", out);
  }
  if (off > 1e-6 * size) return vs_bind_refuse(f, "points", "corners in one plane", f->arg[0].value);
  up = fabs(vs_v3_dot(normal, vs_v3_sub(at[n], at[0])));
  if (up <= 1e-12 * size) return vs_bind_empty(f, "the apex lies in the plane of the base", out);
  starts[0] = 0;
  /* The base is clockwise as seen from above, so that its face points downwards. If the apex is below the base, all
   * faces are reversed later. */
  for (size_t i = 0; i < n; i++) corner[i] = (uint32_t)(n - 1 - i);
  starts[1] = (uint32_t)n;
  for (size_t i = 0; i < n; i++) {
    uint32_t *c = corner + n + 3 * i;
    c[0] = (uint32_t)i, c[1] = (uint32_t)((i + 1) % n), c[2] = (uint32_t)n;
    starts[i + 2] = (uint32_t)(n + 3 * (i + 1));
  }
  return polyface(f, &(vs_polygons){ at, n + 1, starts, corner, n + 1 }, out);
}

vs_status vs_p_make_3dface(vs_args *f, vs_value *out) {
  vs_vec3 at[4];
  uint32_t n = 0, starts[3] = { 0, 3, 6 }, corner[6] = { 0, 1, 2, 0, 2, 3 };
  for (int i = 0; i < 4; i++)
    if (!(n && vs_v3_equal(at[n - 1], POINT(i))) && !(i == 3 && n && vs_v3_equal(at[0], POINT(i)))) at[n++] = POINT(i);
  double a = 0, b = 0, size = 0;
  for (uint32_t i = 1; i < n; i++) size = fmax(size, vs_v3_length(vs_v3_sub(at[i], at[0])));
  if (n >= 3) a = vs_v3_length(vs_v3_cross(vs_v3_sub(at[1], at[0]), vs_v3_sub(at[2], at[0])));
  if (n == 4) b = vs_v3_length(vs_v3_cross(vs_v3_sub(at[2], at[0]), vs_v3_sub(at[3], at[0])));
  double nothing = 1e-14 * size * size;
  if (a <= nothing && b <= nothing) return vs_bind_empty(f, "all corners are on one line", out);
  /* If the first of a quadrilateral's two triangles has no area, only the second triangle is used. */
  if (n == 4 && a <= nothing) memcpy(corner, corner + 3, sizeof corner / 2), b = 0;
  return polyface(f, &(vs_polygons){ at, n, starts, corner, n == 4 && b > nothing ? 2 : 1 }, out);
}

/* ---- reading faces from a file ---- */

static bool keep_reading(void *vm) { return vs_poll(vm, 1 << 16); } /* returns false, with the error set, on an
                                                                     * interrupt */

static vs_status read_list(vs_args *f, const char **name, vs_face_list *l) {
  vs_error e = { 0 };
  VS_ROOTS(f->vm, r, 1);
  if (!vs_bind_file(f, &f->arg[0], &r[0], name)) return VS_ERROR;
  vs_file_bytes file = { *name, vs_as_bytes(r[0])->at, (size_t)vs_as_bytes(r[0])->length };
  if (!vs_mesh_file_read(&file, (vs_poller){ keep_reading, f->vm }, l, &e))
    return e.kind == VS_ERROR_INTERRUPT ? VS_ERROR : vs_bind_error(f->vm, &e);
  return vs_face_list_compact(l) ? VS_OK : vs_fail_memory(f->vm);
}

vs_status vs_p_load_mesh(vs_args *f, vs_value *out) {
  const char *name = f->arg[0].text.at;
  vs_face_list l = { 0 };
  vs_node *n = NULL;
  vs_error e = { 0 };
  if (!vs_mesh_file_is(name))
    return vs_bind_refuse(f, "file", "a name that ends in .stl, .obj, .off or .ply", f->arg[0].value);
  vs_status ok = read_list(f, &name, &l);
  if (ok && f->key[0].given && f->key[0].boolean) {
    bool sheet = false;
    ok = repaired(f, name, &l, &sheet, &n);
    if (ok && n->class_ != VS_SOLID)
      ok = vs_fail(f->vm, f->vm->sym.range,
                   sheet ? "%s: the faces are a surface, which encloses nothing: make-polyface-mesh makes one of them"
                         : "%s: no solid remains after the repair",
                   name);
  } else if (ok) {
    vs_mesh mesh = { 0 };
    vs_mesh_flaws flaws;
    bool flawless = true;
    vs_polygons faces = vs_polygons_of(&l);
    n = vs_polyface_make_mesh(f->store, &faces, &mesh, &e);
    if (!n) ok = vs_bind_error(f->vm, &e);
    else if (n->class_ != VS_SOLID) ok = refuse_open(f, name, &l);
    else ok = inspect(f, n, &mesh, &flaws, &flawless);
    if (ok && !flawless) ok = refuse_flaws(f, name, &mesh, &flaws);
    vs_mesh_free(&mesh);
  }
  vs_face_list_free(&l);
  if (ok) return finished(f, n, false, out);
  vs_node_release(n);
  return VS_ERROR;
}
