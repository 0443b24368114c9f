/* Implements the last steps of geometric procedures: they create the resulting value, node or empty object. */
#include "bind/build.h"

#include "bind/call/call.h"
#include "bind/call/procedure.h"
#include "bind/call/scratch.h"
#include "bind/objects.h"
#include "bind/records.h"
#include "bind/warnings.h"
#include "geometry/parts.h"
#include "model/kinds.h"
#include "vm/values/heap.h"

/* Greatest permitted length in model units. The third power of a length, even after placements have scaled it, must not
 * overflow. */
static const double LARGEST = 1e60;
static bool too_large(double d) { return !(fabs(d) <= LARGEST); }

/* Returns the name of a field in the node's data that contains a number above LARGEST, or NULL. Angles are also tested:
 * no useful angle is that large. */
static const char *largest_field(vs_kind kind, const void *data) {
  const vs_kind_info *k = vs_kind_get(kind);
  if (vs_kind_within(kind, data, LARGEST)) return NULL;
  for (size_t i = 0; i < k->field_count; i++) {
    const void *at = (const char *)data + k->fields[i].offset;
    const double *numbers = at;
    size_t count = vs_field_reals[k->fields[i].type];
    if (k->fields[i].type == VS_FIELD_points) {
      const vs_points *points = *(const vs_field_points *)at;
      if (points) numbers = &points->at[0].x, count = 3 * (size_t)points->count;
    }
    for (size_t j = 0; j < count; j++)
      if (too_large(numbers[j])) return k->fields[i].argument;
  }
  return NULL;
}

static vs_status say_large(vs_args *f, const char *name) {
  return vs_fail(f->vm, f->vm->sym.range, "%s is too large: lengths must stay below 1e60", name);
}

/* Refuses a field that is too large. If the field is a matrix, the message names the call's last argument, from which
 * the matrix was computed; otherwise it names the field. */
static vs_status refuse_large(vs_args *f, const char *field) {
  const vs_bind_param *p = f->procedure->form[f->form].at;
  bool given = strcmp(field, "matrix") != 0;
  for (int i = 0; !given && p[i].mode != VS_ARG_END; i++) given = strcmp(p[i].name, field) == 0;
  if (!given && f->count > 0) field = p[f->count - 1].name;
  return say_large(f, field);
}

vs_status vs_bind_give_node(vs_args *f, vs_node *node, vs_value *out) {
  const char *large = node ? largest_field((vs_kind)node->kind, vs_node_data(node)) : NULL;
  if (large) return vs_node_release(node), refuse_large(f, large);
  return vs_bind_give_object(f->bind, node, out);
}

vs_status vs_bind_make(vs_args *f, vs_kind kind, const void *data, const vs_ref *children, size_t n, vs_value *out) {
  const char *large = data ? largest_field(kind, data) : NULL;
  if (large) return refuse_large(f, large);
  return vs_bind_give_object(f->bind, vs_node_new(f->store, kind, data, children, n), out);
}

vs_status vs_bind_each_part(vs_args *f, vs_procedure_fn *one, vs_value *out) {
  vs_ref whole = f->arg[0].ref, *parts;
  size_t count, made = 0;
  vs_status status = VS_OK;
  if (!vs_several_parts(whole, &parts, &count)) return vs_bind_give_node(f, NULL, out);
  for (; status == VS_OK && made < count; made++) { /* the result of each part gets the part's origin (the place of its
                                                     * constructor's call) */
    f->arg[0].ref = parts[made];
    status = one(f, out);
    if (status != VS_OK) break;
    vs_node_release(parts[made].node);
    parts[made].node = vs_node_retain(vs_bind_take_ref(*out).node);
  }
  f->arg[0].ref = whole;
  if (status == VS_OK) status = vs_bind_make(f, VS_UNION, &(struct vs_union){ 0 }, parts, count, out);
  vs_several_free(parts, count);
  return status;
}

/* Returns true if the argument contains a number above LARGEST. Differences and products of such numbers may be
 * infinite or not a number, so that no test can distinguish them from 0. */
static bool is_large(const vs_bind_param *p, const vs_arg *a) {
  const double *numbers = NULL;
  size_t count = 0;
  if (p->contract == VS_C_REAL || p->contract == VS_C_RADIUS || p->contract == VS_C_POSITIVE)
    numbers = &a->real, count = 1;
  if (p->contract == VS_C_POINT || p->contract == VS_C_VECTOR) numbers = &a->point.x, count = 3;
  if (p->contract == VS_C_POINTS && a->points.count) numbers = &a->points.at->x, count = 3 * a->points.count;
  if (p->contract == VS_C_THINGS && a->things.point_count)
    numbers = &a->things.points->x, count = 3 * a->things.point_count;
  for (size_t i = 0; i < count; i++)
    if (too_large(numbers[i])) return true;
  return false;
}

/* Returns the name of an argument of the call that contains a number above LARGEST, or NULL. */
static const char *large_argument(const vs_args *f) {
  const vs_bind_param *p = f->procedure->form[f->form].at, *key = f->procedure->key;
  for (int i = 0; i < f->count && p[i].mode != VS_ARG_END; i++)
    if (is_large(&p[i], &f->arg[i])) return p[i].name;
  for (int i = 0; key[i].mode != VS_ARG_END; i++)
    if (f->key[i].given && is_large(&key[i], &f->key[i])) return key[i].name;
  return NULL;
}

vs_status vs_bind_empty(vs_args *f, const char *why, vs_value *out) {
  const char *large = why ? large_argument(f) : NULL;
  if (large) return say_large(f, large);
  if (why) {
    const char *name = f->names;
    if (*name == '%') name++;
    vs_bind_warn(f->bind, why, "%.*s: %s: nothing is made (the empty object)", (int)strcspn(name, " "), name, why);
  }
  return vs_bind_make(f, VS_EMPTY, &(struct vs_empty){ 0 }, NULL, 0, out);
}

/* ---- moving figures into another plane ---- */

/* Computes the axes of a figure in the plane. *u, the figure's X, is horizontal and points towards +X, or towards +Y if
 * it is perpendicular to X. *v, the figure's Y, points upwards. In a horizontal plane *u and *v are X and Y. A figure
 * in the plane 'xz therefore looks from the front as a figure in the plane XY looks from above. */
static void plane_directions(vs_vec3 normal, vs_vec3 *u, vs_vec3 *v) {
  vs_vec3 n = vs_v3_unit(normal), up = vs_v3(0, 0, 1);
  *u = vs_v3(1, 0, 0), *v = vs_v3(0, 1, 0);
  if (fabs(n.x) < 1e-12 && fabs(n.y) < 1e-12) return;
  *v = vs_v3_unit(vs_v3_sub(up, vs_v3_scale(n, n.z)));
  *u = vs_v3_unit(vs_v3_cross(up, n));
  if (u->x < -1e-12 || (u->x <= 1e-12 && u->y < 0)) *u = vs_v3_scale(*u, -1);
}

vs_status vs_bind_stand(vs_args *f, const vs_arg *plane, vs_value *out) {
  vs_ref ref = vs_bind_take_ref(*out);
  if (!ref.node || vs_node_is_empty(ref.node)) return VS_OK;
  if (!vs_bind_keep(f, vs_node_retain(ref.node))) return VS_ERROR;
  const vs_bind_param *p = f->procedure->form[f->form].at;
  vs_vec3 u, v, from = vs_v3(0, 0, 0), to = plane->line.at;
  if (p[0].contract == VS_C_POINT && p[1].contract != VS_C_POINT) from = to = f->arg[0].point;
  plane_directions(plane->line.direction, &u, &v);
  vs_vec3 w = vs_v3_cross(u, v);
  vs_affine m = { { { u.x, v.x, w.x, 0 }, { u.y, v.y, w.y, 0 }, { u.z, v.z, w.z, 0 } } };
  const vs_vec3 turned = vs_affine_point(&m, from);
  m.m[0][3] = to.x - turned.x, m.m[1][3] = to.y - turned.y, m.m[2][3] = to.z - turned.z;
  return vs_bind_make(f, VS_TRANSFORM, &(struct vs_transform){ .matrix = m }, &ref, 1, out);
}

/* (%stand object plane): moves a figure, which geometry.scm has created in the plane XY, into `plane`. */
vs_status vs_p_stand(vs_args *f, vs_value *out) {
  *out = f->arg[0].value;
  return vs_bind_stand(f, &f->arg[1], out);
}
