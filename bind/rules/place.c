/* Places objects in scopes: maps the bounding box of the object to the box of the scope. The object's X becomes the
 * scope's x, its Z (up) the scope's y, and its front, which faces -Y, the outer side of the scope's face. In a scope
 * outside of any rule, the object therefore keeps its directions. */
#include "bind/rules/place.h"

#include "bind/measures.h"
#include "bind/queries.h"

#include "geometry/measure/node_measures.h"
#include "solids/deformed.h"

/* Sets *b to the bounds of an object. d keeps the bounds of the last object for the next call. */
static bool bounds_of(vs_derivation *d, vs_ref object, vs_bounds *b) {
  vs_error e = { 0 };
  if (d->fitted == object.node) return *b = d->fitted_bounds, true;
  if (!vs_bind_bounds(d->vm, object, b, &e))
    return vs_fail(d->vm, d->vm->sym.error, "%s", e.message);
  vs_node_release(d->fitted);
  d->fitted = vs_node_retain(object.node), d->fitted_bounds = *b;
  return true;
}

/* Returns the factor by which an extent is scaled to a size; 1 if the extent or the size is 0. */
static double factor(double size, double extent) { return size > 0 && extent > 0 ? size / extent : 1; }

/* Returns the map from the bounds b of an object to a box with this frame and size. */
static vs_affine fit(const vs_affine *frame, vs_vec3 size, const vs_bounds *b) {
  vs_vec3 x = vs_v3_scale(vs_affine_column(frame, 0), factor(size.x, b->max.x - b->min.x));
  vs_vec3 y = vs_v3_scale(vs_affine_column(frame, 1), factor(size.y, b->max.z - b->min.z));
  vs_vec3 z = vs_v3_scale(vs_affine_column(frame, 2), factor(size.z, b->max.y - b->min.y));
  vs_affine m = vs_affine_columns(x, vs_v3_scale(z, -1), y, vs_v3(0, 0, 0));
  vs_vec3 at = vs_v3_sub(vs_affine_column(frame, 3), vs_affine_vector(&m, vs_v3(b->min.x, b->max.y, b->min.z)));
  m.m[0][3] = at.x, m.m[1][3] = at.y, m.m[2][3] = at.z;
  return m;
}

/* Returns the corner of a hexahedron to which corner c of an object's bounds is mapped. The bits of c are X, Y and
 * Z. */
static vs_vec3 object_corner(const vs_vec3 corner[8], int c) {
  int i = c & 1, j = c >> 2 & 1, k = 1 - (c >> 1 & 1);
  return corner[i + 2 * j + 4 * k];
}

bool vs_rules_place(vs_derivation *d, const vs_scope *s, vs_ref object, const vs_origin *origin) {
  vs_store *store = d->store;
  vs_bounds b;
  if (object.node->kind == VS_EMPTY) return true;
  if (!bounds_of(d, object, &b)) return false;
  if (vs_bounds_is_empty(&b)) return true;
  /* The placed object has the place of the rule's call as its origin, even after passes have merged the placement with
   * the object's own. */
  vs_ref placed = { object.node, origin };
  vs_node *n;
  if (s->class_ == VS_SCOPE_FFD) {
    vs_vec3 at[8];
    vs_affine m;
    for (int c = 0; c < 8; c++) at[c] = object_corner(s->as.corner, c);
    struct vs_deform deform = { .c000 = at[0], .c100 = at[1], .c010 = at[2], .c110 = at[3],
                                .c001 = at[4], .c101 = at[5], .c011 = at[6], .c111 = at[7] };
    if (object.node->class_ == VS_REGION_CLASS)
      return vs_fail(d->vm, d->vm->sym.error,
                     "a hexahedron deforms solids, surfaces and curves, not regions: do-extrude them");
    if (vs_deform_is_affine(&deform, &b, &m))
      n = vs_node_new(store, VS_TRANSFORM, &(struct vs_transform){ .matrix = m }, &placed, 1);
    else
      n = vs_node_new(store, VS_DEFORM, &deform, &placed, 1);
  } else {
    vs_affine frame = vs_scope_frame(s);
    vs_vec3 size = vs_scope_size(s);
    if (s->class_ == VS_SCOPE_TURTLE) { /* the origin of a turtle's cross-section is its centre, not a corner */
      vs_vec3 at = vs_scope_corner(s, 0, 0, 1);
      frame.m[0][3] = at.x, frame.m[1][3] = at.y, frame.m[2][3] = at.z;
    }
    vs_affine m = fit(&frame, size, &b);
    n = vs_node_new(store, VS_TRANSFORM, &(struct vs_transform){ .matrix = m }, &placed, 1);
  }
  if (!n) return vs_fail_memory(d->vm);
  bool ok = vs_rules_gather(d, (vs_ref){ n, origin }, s->flags);
  vs_node_release(n);
  return ok;
}
