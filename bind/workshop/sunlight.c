/* Implements the position of the sun for programs: its direction at a moment, and the hours of sunlight at places among
 * objects. */
#include "bind/workshop/sunlight.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bind/call/call.h"
#include "bind/call/give.h"
#include "bind/call/raise.h"
#include "bind/call/refuse.h"
#include "bind/measures.h"
#include "bind/shapes/taken_apart.h"

/* Reads a time as hours of universal time: "15:00+01:00", "15:00:30Z", or "15:00", which is mean local time at the
 * longitude. */
static bool read_time(const char *text, double longitude, double *hours) {
  int h, m, s = 0, used = 0, more = 0, zh, zm;
  if (sscanf(text, "%2d:%2d%n:%2d%n", &h, &m, &used, &s, &more) < 2) return false;
  if (h < 0 || h > 24 || m < 0 || m > 59 || s < 0 || s > 59) return false;
  *hours = h + m / 60.0 + s / 3600.0;
  text += more ? more : used;
  if (!*text) return *hours -= longitude / 15, true;
  if (!strcmp(text, "Z")) return true;
  if ((*text != '+' && *text != '-') || sscanf(text + 1, "%2d:%2d", &zh, &zm) != 2 || zh > 14 || zm > 59) return false;
  *hours -= (*text == '+' ? 1 : -1) * (zh + zm / 60.0);
  return true;
}

bool vs_bind_moment(vs_args *f, const vs_arg *place, vs_sun_moment *out) {
  const vs_arg *longitude = &place[1], *time = &place[3];
  char rest;
  *out = (vs_sun_moment){ .latitude = place[0].real, .longitude = longitude->given ? longitude->real : 0 };
  if (fabs(out->latitude) > 90) return vs_bind_refuse(f, "latitude", "from -90 to 90", place[0].value);
  if (fabs(out->longitude) > 180) return vs_bind_refuse(f, "longitude", "from -180 to 180", longitude->value);
  bool read = sscanf(place[2].text.at, "%4d-%2d-%2d%c", &out->year, &out->month, &out->day, &rest) == 3;
  if (!read || !vs_sun_is_day(out->year, out->month, out->day))
    return vs_bind_refuse(f, "date", "a day such as \"2026-06-21\"", place[2].value);
  out->hours = 12 - out->longitude / 15;
  if (time->given && !read_time(time->text.at, out->longitude, &out->hours))
    return vs_bind_refuse(f, "time", "a time such as \"15:00+01:00\"", time->value);
  return true;
}

/* Returns the direction to the sun as a unit vector; Y is north, X is east. */
static vs_vec3 towards_sun(const vs_sun_moment *m) {
  vs_sun_direction d = vs_sun_position(m);
  double a = d.azimuth * (acos(-1) / 180), h = d.altitude * (acos(-1) / 180);
  return vs_v3(cos(h) * sin(a), cos(h) * cos(a), sin(h));
}

/* (sun-direction #:latitude #:longitude #:date #:time): returns the direction to the sun as a gvector. */
vs_status vs_p_sun_direction(vs_args *f, vs_value *out) {
  vs_sun_moment m;
  if (!f->key[0].given || !f->key[2].given || !f->key[3].given)
    return vs_fail(f->vm, f->vm->sym.arity, "needs #:latitude, #:date and #:time; #:longitude is optional");
  return vs_bind_moment(f, f->key, &m) && vs_bind_give_vector(f, towards_sun(&m), out);
}

/* (%sun-path hours #:latitude #:longitude #:date): returns the direction to the sun, as a gvector, at this hour of mean
 * local time. */
vs_status vs_p_sun_at(vs_args *f, vs_value *out) {
  vs_sun_moment m;
  vs_arg place[4] = { f->key[0], f->key[1], f->key[2], { .given = false } };
  if (!f->key[0].given || !f->key[2].given)
    return vs_fail(f->vm, f->vm->sym.arity, "needs #:latitude and #:date; #:longitude is optional");
  if (!vs_bind_moment(f, place, &m)) return VS_ERROR;
  m.hours += f->arg[0].real - 12;
  return vs_bind_give_vector(f, towards_sun(&m), out);
}

/* Sets *out to a list with the hours of sunlight at each place. tree: the triangles that cast shadows, or NULL if there
 * are none. */
static vs_status count_hours(vs_args *f, const vs_ray_tree *tree, double size, vs_value *out) {
  const vs_arg *at = &f->arg[0], *normals = &f->arg[1], *suns = &f->arg[2];
  VS_ROOTS(f->vm, r, 1);
  r[0] = VS_NIL;
  for (size_t i = at->points.count; i-- > 0;) {
    vs_vec3 normal = vs_v3_unit(normals->points.at[i]);
    vs_vec3 from = vs_v3_add(at->points.at[i], vs_v3_scale(normal, 1e-6 * size));
    double sum = 0, met;
    for (size_t k = 0; k < suns->points.count; k++) {
      vs_vec3 sun = suns->points.at[k];
      if (vs_v3_dot(sun, normal) <= 1e-9) continue;
      bool lit = !tree || vs_ray_tree_meet(tree, from, sun, INFINITY, true, &met) == tree->mesh->triangle_count;
      if (lit) sum += f->arg[3].real;
    }
    if (!vs_cons(f->vm, vs_flonum(sum), r[0], &r[0]) || !vs_poll(f->vm, 16 * suns->points.count)) return VS_ERROR;
  }
  *out = r[0];
  return VS_OK;
}

/* Sets *out to a list with `step` for each sun that shines on the first place, and 0 for each other one. */
static vs_status list_suns(vs_args *f, const vs_ray_tree *tree, double size, vs_value *out) {
  const vs_arg *suns = &f->arg[2];
  vs_vec3 normal = vs_v3_unit(f->arg[1].points.at[0]);
  vs_vec3 from = vs_v3_add(f->arg[0].points.at[0], vs_v3_scale(normal, 1e-6 * size));
  VS_ROOTS(f->vm, r, 1);
  r[0] = VS_NIL;
  for (size_t k = suns->points.count; k-- > 0;) {
    vs_vec3 sun = suns->points.at[k];
    double met;
    bool lit = sun.z > 0 && vs_v3_dot(sun, normal) > 1e-9 &&
               (!tree || vs_ray_tree_meet(tree, from, sun, INFINITY, true, &met) == tree->mesh->triangle_count);
    if (!vs_cons(f->vm, vs_flonum(lit ? f->arg[3].real : 0), r[0], &r[0]) || !vs_poll(f->vm, 16)) return VS_ERROR;
  }
  *out = r[0];
  return VS_OK;
}

/* Adds the triangles of an object that casts a shadow to the mesh `all`. */
static bool add_shade(vs_args *f, size_t argument, vs_ref ref, vs_mesh *all) {
  vs_arg first = f->arg[0];
  vs_mesh m = { 0 };
  f->arg[0].ref = ref;
  bool ok = vs_bind_resolve(f, 0);
  ref = f->arg[0].ref;
  f->arg[0] = first;
  vs_class class_ = (vs_class)ref.node->class_;
  if (!ok || class_ == VS_NOTHING) return ok;
  if ((class_ != VS_SOLID && class_ != VS_SURFACE) || ref.node->flags & VS_NODE_ENDLESS)
    return vs_bind_refuse(f, "among", "a list of finite solids and surfaces", f->arg[argument].value);
  ok = vs_bend_triangles(f->vm, ref, &m);
  uint32_t base = (uint32_t)all->vertex_count;
  for (size_t i = 0; ok && i < m.vertex_count; i++)
    ok = vs_mesh_add_vertex(all, m.vertices[i], NULL) || vs_fail_memory(f->vm);
  for (size_t i = 0; ok && i < m.triangle_count; i++) {
    const uint32_t *t = m.triangles[i];
    ok = vs_mesh_add_triangle(all, base + t[0], base + t[1], base + t[2]) || vs_fail_memory(f->vm);
  }
  vs_mesh_free(&m);
  return ok;
}

bool vs_bind_shades(vs_args *f, size_t argument, vs_shades *s) {
  vs_error e = { 0 };
  *s = (vs_shades){ .any = false };
  size_t count = f->arg[argument].refs.count;
  s->ends = vs_store_realloc(f->store, NULL, 0, (s->count = count + 1) * sizeof *s->ends);
  if (!s->ends) return vs_fail_memory(f->vm), false;
  for (size_t i = 0; i < count; i++) {
    if (!add_shade(f, argument, f->arg[argument].refs.at[i], &s->mesh)) return false;
    s->ends[i] = s->mesh.triangle_count;
  }
  if (!s->mesh.triangle_count) return true;
  vs_bounds b = vs_mesh_bounds(&s->mesh);
  s->any = vs_ray_tree_make(&s->tree, f->store, &s->mesh, &e);
  s->size = vs_bounds_diagonal(&b);
  return s->any || vs_bind_error(f->vm, &e);
}

void vs_bind_shades_free(vs_args *f, vs_shades *s) {
  if (s->ends) vs_store_realloc(f->store, s->ends, s->count * sizeof *s->ends, 0);
  if (s->any) vs_ray_tree_free(&s->tree);
  vs_mesh_free(&s->mesh);
}

/* Calls `count` with the triangles of the objects that cast shadows. */
static vs_status among_shades(vs_args *f, vs_status (*count)(vs_args *, const vs_ray_tree *, double, vs_value *),
                              vs_value *out) {
  vs_shades s;
  if (f->arg[1].points.count != f->arg[0].points.count)
    return vs_fail(f->vm, f->vm->sym.range, "normals must be one gvector or as many as points");
  bool ok = vs_bind_shades(f, 4, &s) && count(f, s.any ? &s.tree : NULL, s.size, out);
  vs_bind_shades_free(f, &s);
  return ok ? VS_OK : VS_ERROR;
}

/* (%solar-hours points normals suns step among): returns a list of the hours of sunlight at each point, among objects
 * that cast shadows. Normals and the directions to the suns are given as points. Each sun, one position of the sun,
 * shines for `step` hours. */
vs_status vs_p_solar_hours(vs_args *f, vs_value *out) { return among_shades(f, count_hours, out); }

/* (%suns-seen points normals suns step among): returns a list of `step` or 0 for each sun, for the only point. */
vs_status vs_p_suns_seen(vs_args *f, vs_value *out) { return among_shades(f, list_suns, out); }
