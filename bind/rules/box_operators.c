/* Implements operators that divide a scope (a box or other shape to which rules are applied): split, repeat, component,
 * extrude, prism, round corner, triangulate, subdivide. Each operator pushes the resulting scopes on the stack of
 * scopes that wait for their rules.
 *
 * If a hexahedron is cut by two planes of constant x, y or z of its own coordinates, the part between the planes is
 * again a hexahedron, since its map is linear along each axis. */
#include "bind/call/call.h"
#include "bind/call/refuse.h"
#include "bind/call/scratch.h"
#include "bind/call/take.h"
#include "bind/origins.h"
#include "bind/queries.h"
#include "bind/rules/derivation.h"
#include "bind/rules/mesh_faces.h"
#include "bind/rules/place.h"
#include "bind/warnings.h"
#include "geometry/plane/ear_clipping.h"
#include "vm/machine/fail.h"

#include <string.h>

#define BOXES (VS_SCOPE_BIT(BOX) | VS_SCOPE_BIT(FFD))
#define LOOPS (VS_SCOPE_BIT(POLYGON) | VS_SCOPE_BIT(TRIANGLE) | VS_SCOPE_BIT(CURVE))

static vs_vec3 between(vs_vec3 a, vs_vec3 b, double t) { return vs_v3_add(a, vs_v3_scale(vs_v3_sub(b, a), t)); }

/* A part of a scope along an axis. whole: length of the scope; from: start of the part; size: length of the part, all
 * along this axis. The part becomes child `index` of `count` children. */
typedef struct { int axis; double whole, from, size; uint32_t index, count; } slice;

static vs_scope *part_of(vs_derivation *d, vs_scope *s, const char *op, const slice *p) {
  vs_scope *c = vs_rules_child(d, s, (vs_scope_class)s->class_, op, p->index, p->count);
  if (!c) return NULL;
  int a = p->axis;
  double from = p->from, size = p->size, whole = p->whole;
  vs_scope_become(c, s);
  if (s->class_ == VS_SCOPE_FFD) {
    double t0 = whole > 0 ? from / whole : 0, t1 = whole > 0 ? (from + size) / whole : 1;
    for (int i = 0; i < 8; i++) {
      vs_vec3 low = s->as.corner[i & ~(1 << a)], high = s->as.corner[i | 1 << a];
      c->as.corner[i] = between(low, high, i >> a & 1 ? t1 : t0);
    }
    return c;
  }
  for (int r = 0; r < 3; r++) c->as.box.frame.m[r][3] += c->as.box.frame.m[r][a] * from;
  (&c->as.box.size.x)[a] = size;
  return c;
}

static double size_along(const vs_scope *s, int axis) {
  vs_vec3 size = vs_scope_size(s);
  return axis == 0 ? size.x : axis == 1 ? size.y : size.z;
}

/* ---- the operator split ---- */

typedef struct {
  double size, weight;
  vs_value rule;
} part;

/* Reads a part of a split from v: (absolute n rule), (relative n rule) and (rest rule) are vectors #(kind number rule).
 * whole: length of the scope along the axis. */
static bool read_part(vs_args *f, vs_value v, double whole, part *out) {
  const vs_vector *p = vs_is_vector(v) && vs_as_vector(v)->length == 3 ? vs_as_vector(v) : NULL;
  double n;
  if (!p || !vs_is_symbol(p->at[0]) || !vs_bind_take_number(f->vm, p->at[1], &n) || !vs_is_rule(p->at[2]))
    return vs_bind_refuse(f, "part", "(absolute n rule), (relative f rule) or (rest [weight] rule)", v);
  const char *kind = vs_as_symbol(p->at[0])->name;
  *out = (part){ 0, 0, p->at[2] };
  if (!strcmp(kind, "rest"))
    out->weight = n;
  else
    out->size = strcmp(kind, "relative") ? n : n * whole;
  return true;
}

vs_status vs_p_scope_split(vs_args *f, vs_value *out) {
  vs_scheme *vm = f->vm;
  VS_ROOTS(vm, r, 2);
  if (!vs_rules_class(f, 0, BOXES)) return VS_ERROR;
  vs_scope *s = f->arg[0].scope;
  int axis = (int)f->arg[1].integer;
  r[0] = f->arg[2].value;
  int64_t n = vs_list_length(r[0]);
  double whole = size_along(s, axis), sum = 0, weight = 0;
  part p;
  uint32_t kept = 0;
  if (n < 1)
    return vs_fail(vm, vm->sym.arity,
                   "takes (scope-split s axis part ...), and each part is (absolute n rule), (relative f rule) or "
                   "(rest [weight] rule)");
  for (vs_value l = r[0]; l != VS_NIL; l = vs_cdr(l)) {
    if (!read_part(f, vs_car(l), whole, &p)) return VS_ERROR;
    sum += p.size, weight += p.weight;
  }
  double slack = 1e-9 * fmax(whole, sum), left = whole - sum;
  if (left < -slack)
    return vs_fail(vm, vm->sym.range, "the parts sum to %.12g, but the scope is %.12g along %c", sum, whole,
                   'x' + axis);
  if (left > slack && weight == 0)
    vs_bind_warn(f->bind, "split",
                 "scope-split: the parts sum to %.12g, but the scope is %.12g along %c: the rest stays empty; write "
                 "(rest #f) if the rest is to be empty",
                 sum, whole, 'x' + axis);
  if (left <= slack) left = 0;
  vs_derivation *d = vs_rules_begin(f, &r[1]);
  vs_rule_task *t = d ? vs_task_new(d, (uint32_t)n, true) : NULL;
  if (!t) return VS_ERROR;
  double at = 0;
  uint32_t i = 0;
  for (vs_value l = r[0]; l != VS_NIL; l = vs_cdr(l), i++) {
    read_part(f, vs_car(l), whole, &p);
    double size = p.size + (weight > 0 ? left * p.weight / weight : 0), to = at + size;
    t->rules[i] = p.rule;
    if (size > 0 && p.rule != VS_FALSE) {
      t->child[i] = part_of(d, s, vs_rules_operator(f), &(slice){ axis, whole, at, size, i, (uint32_t)n });
      if (!t->child[i]) return vs_task_drop(d, t), VS_ERROR;
      kept++;
    }
    at = to;
  }
  *out = r[1];
  return vs_task_push(d, t) ? VS_OK : VS_ERROR;
}

/* ---- the operator repeat ---- */

static bool count_parts(vs_args *f, double whole, double approx, uint32_t *n) {
  double parts = floor(whole / approx + .5);
  if (parts < 1) parts = 1;
  if (parts > VS_RULES_PARTS)
    return vs_fail(f->vm, f->vm->sym.range, "%.12g by %.12g would be %.0f parts, more than %d", whole, approx, parts,
                   VS_RULES_PARTS);
  *n = (uint32_t)parts;
  return true;
}

vs_status vs_p_scope_repeat(vs_args *f, vs_value *out) {
  VS_ROOTS(f->vm, r, 2);
  uint32_t n = 0;
  if (!vs_rules_class(f, 0, BOXES)) return VS_ERROR;
  vs_scope *s = f->arg[0].scope;
  int axis = (int)f->arg[1].integer;
  r[0] = f->arg[3].value;
  double whole = size_along(s, axis);
  if (!count_parts(f, whole, f->arg[2].real, &n)) return VS_ERROR;
  vs_derivation *d = vs_rules_begin(f, &r[1]);
  vs_rule_task *t = d ? vs_task_new(d, n, false) : NULL;
  if (!t) return VS_ERROR;
  t->rules[0] = r[0];
  for (uint32_t i = 0; i < n; i++) {
    t->child[i] = part_of(d, s, vs_rules_operator(f), &(slice){ axis, whole, whole * i / n, whole / n, i, n });
    if (!t->child[i]) return vs_task_drop(d, t), VS_ERROR;
  }
  *out = r[1];
  return vs_task_push(d, t) ? VS_OK : VS_ERROR;
}

/* ---- the operator component ---- */

/* The faces of a box. Each is described by three corners: its first corner, the next corner along the face's x, and the
 * next corner along the face's y. Seen from outside, y points up. */
enum { FRONT, BACK, LEFT, RIGHT, TOP, BOTTOM, FACES };
static const struct {
  const char *name;
  uint8_t first, along, up;
} faces[FACES] = {
  [FRONT] = { "front", 4, 5, 6 }, [BACK] = { "back", 1, 0, 3 }, [LEFT] = { "left", 0, 4, 2 },
  [RIGHT] = { "right", 5, 1, 7 }, [TOP] = { "top", 6, 7, 2 },   [BOTTOM] = { "bottom", 0, 1, 4 },
};
static const uint8_t side_order[] = { FRONT, RIGHT, BACK, LEFT }; /* the sides in order around the box */
static const uint8_t face_order[] = { FRONT, RIGHT, BACK, LEFT, TOP, BOTTOM };

/* Sets s to a box without depth. Its first corner is a; its x points towards b; its y, perpendicular to x, points
 * towards c. */
static void lay_box(vs_scope *s, vs_vec3 a, vs_vec3 b, vs_vec3 c) {
  vs_vec3 u = vs_v3_sub(b, a), v = vs_v3_sub(c, a), x = vs_v3_unit(u);
  vs_vec3 y = vs_v3_unit(vs_v3_sub(v, vs_v3_scale(x, vs_v3_dot(x, v))));
  s->as.box.frame = vs_affine_columns(x, y, vs_v3_cross(x, y), a);
  s->as.box.size = vs_v3(vs_v3_length(u), fabs(vs_v3_dot(y, v)), 0);
}

/* Sets child to a face of the box or hexahedron s. The child's axes are derived from the axes of s's frame, so that s
 * may have size 0 along one of them. */
static void lay_face(vs_scope *child, const vs_scope *s, int face) {
  const uint8_t first = faces[face].first, along = faces[face].along, up = faces[face].up;
  if (s->class_ == VS_SCOPE_FFD) { /* child becomes a hexahedron whose edges along z have length 0 */
    const uint8_t at[4] = { first, along, up, (uint8_t)(along ^ up ^ first) };
    for (int c = 0; c < 8; c++) child->as.corner[c] = s->as.corner[at[c & 3]];
    return;
  }
  static const uint8_t axis_of[8] = { 0, 0, 1, 0, 2, 0, 0, 0 }; /* axis_of[b]: axis along which two corners differ if
                                                                 * their numbers differ only in bit b */
  int ax = axis_of[first ^ along], ay = axis_of[first ^ up];
  double sx = along > first ? 1 : -1, sy = up > first ? 1 : -1;
  vs_vec3 x = vs_v3_scale(vs_affine_column(&s->as.box.frame, ax), sx),
          y = vs_v3_scale(vs_affine_column(&s->as.box.frame, ay), sy);
  const double *size = &s->as.box.size.x;
  child->as.box.frame =
      vs_affine_columns(x, y, vs_v3_cross(x, y), vs_scope_corner(s, first & 1, first >> 1 & 1, first >> 2));
  child->as.box.size = vs_v3(size[ax], size[ay], 0);
}

/* Sets child to the edge of s from corner a to corner b. The child's y is perpendicular to the edge, and as close as
 * possible to the y of s or, for an edge along y, to the x of s. */
static void lay_edge(vs_scope *child, const vs_scope *s, int a, int b) {
  vs_affine frame = vs_scope_frame(s);
  vs_vec3 from = vs_scope_corner(s, a & 1, a >> 1 & 1, a >> 2), to = vs_scope_corner(s, b & 1, b >> 1 & 1, b >> 2);
  vs_scope_lay_edge(child, &frame, a ^ b ^ 2 ? 1 : 0, from, to);
}

static vs_status box_components(vs_args *f, const char *of, vs_value *out) {
  VS_ROOTS(f->vm, r, 2);
  vs_scope *s = f->arg[0].scope;
  r[0] = f->arg[1].value;
  const uint8_t *list = face_order;
  uint8_t one = FACES;
  uint32_t n = 6;
  bool edges = !strcmp(of, "edges"), vertices = !strcmp(of, "vertices"), sides = !strcmp(of, "sides");
  for (uint8_t k = 0; k < FACES; k++)
    if (!strcmp(of, faces[k].name)) one = k;
  if (edges)
    n = 12;
  else if (vertices)
    n = 8;
  else if (sides)
    n = 4, list = side_order;
  else if (one < FACES)
    n = 1, list = &one;
  else if (strcmp(of, "faces"))
    return vs_bind_refuse(f, "#:of", "one of 'faces 'sides 'edges 'vertices 'front 'back 'left 'right 'top 'bottom",
                          f->key[0].value);
  vs_derivation *d = vs_rules_begin(f, &r[1]);
  vs_rule_task *t = d ? vs_task_new(d, n, false) : NULL;
  if (!t) return VS_ERROR;
  t->rules[0] = r[0];
  bool flat = edges || vertices;
  for (uint32_t i = 0, edge = 0; i < n; i++) {
    vs_scope *c = vs_rules_child(d, s, flat ? VS_SCOPE_BOX : (vs_scope_class)s->class_, vs_rules_operator(f), i, n);
    if (!c) return vs_task_drop(d, t), VS_ERROR;
    t->child[i] = c;
    if (!flat) {
      lay_face(c, s, list[i]);
      if (list[i] < TOP) c->left = c->right = 1.5707963267948966;
    } else if (vertices) {
      c->as.box.frame = vs_scope_frame(s);
      vs_vec3 at = vs_scope_corner(s, i & 1, i >> 1 & 1, i >> 2 & 1);
      c->as.box.frame.m[0][3] = at.x, c->as.box.frame.m[1][3] = at.y, c->as.box.frame.m[2][3] = at.z;
    } else { /* the edge number i connects the i-th pair of corners whose numbers differ in one bit */
      int a = 0, bit = 0;
      for (;; edge++) {
        a = (int)edge & 7, bit = 1 << (edge >> 3);
        if (!(a & bit)) break;
      }
      edge++;
      lay_edge(c, s, a, a | bit);
    }
  }
  *out = r[1];
  return vs_task_push(d, t) ? VS_OK : VS_ERROR;
}

/* ---- sides of polygons, triangles and curves ---- */

static double outer_angle(vs_vec3 before, vs_vec3 at, vs_vec3 after, vs_vec3 normal) {
  vs_vec3 a = vs_v3_sub(at, before), b = vs_v3_sub(after, at);
  return atan2(vs_v3_dot(normal, vs_v3_cross(a, b)), vs_v3_dot(a, b));
}

typedef struct {
  vs_vec3 a, b;
  double left, right;
} side;
/* Returns side k of s, counted through all its loops in order. */
static side side_of(const vs_scope *s, uint32_t k) {
  const vs_vec3 *at = s->loops->points->at;
  uint32_t l = 0;
  while (k >= s->loops->start[l + 1]) l++;
  uint32_t from = s->loops->start[l], n = s->loops->start[l + 1] - from, i = k - from;
  vs_vec3 z = vs_affine_column(&s->as.box.frame, 2), p = at[from + (i + n - 1) % n], a = at[k],
          b = at[from + (i + 1) % n], q = at[from + (i + 2) % n];
  return (side){ a, b, outer_angle(p, a, b, z), outer_angle(a, b, q, z) };
}

/* Sets c to edge or vertex i of a sampled curve. Its y is as close as possible to the world's Z. The last vertex of an
 * open curve has the frame of the last edge. */
static void lay_sample(vs_scope *c, const vs_scope *s, uint32_t i, bool vertex) {
  const vs_points *p = s->loops->points;
  bool end = !s->closed && i + 1 == p->count;
  vs_vec3 a = p->at[end ? i - 1 : i], b = p->at[end ? i : (i + 1) % p->count], z = vs_v3(0, 0, 1);
  vs_affine upright = vs_affine_columns(vs_v3(1, 0, 0), z, vs_v3(0, -1, 0), vs_v3(0, 0, 0));
  bool along = fabs(vs_v3_unit(vs_v3_sub(b, a)).z) > 1 - 1e-9;
  vs_scope_lay_edge(c, &upright, along ? 0 : 1, a, b);
  if (!vertex) return;
  c->as.box.size.x = 0;
  for (int k = 0; end && k < 3; k++) c->as.box.frame.m[k][3] = (&b.x)[k];
}

static vs_status loop_components(vs_args *f, const char *of, vs_value *out) {
  VS_ROOTS(f->vm, r, 2);
  vs_scope *s = f->arg[0].scope;
  bool vertices = !strcmp(of, "vertices");
  r[0] = f->arg[1].value;
  if (!vertices && strcmp(of, "edges"))
    return vs_bind_refuse(f, "#:of", "'edges or 'vertices, for a polygon, a triangle or a curve", f->key[0].value);
  bool curve = s->class_ == VS_SCOPE_CURVE;
  uint32_t n = s->loops->points->count - (curve && !s->closed && !vertices);
  vs_derivation *d = vs_rules_begin(f, &r[1]);
  vs_rule_task *t = d ? vs_task_new(d, n, false) : NULL;
  if (!t) return VS_ERROR;
  t->rules[0] = r[0];
  vs_vec3 z = vs_affine_column(&s->as.box.frame, 2);
  for (uint32_t i = 0; i < n; i++) {
    vs_scope *c = vs_rules_child(d, s, VS_SCOPE_BOX, vs_rules_operator(f), i, n);
    if (!c) return vs_task_drop(d, t), VS_ERROR;
    t->child[i] = c;
    if (curve) {
      lay_sample(c, s, i, vertices);
      continue;
    }
    side e = side_of(s, i);
    lay_box(c, e.a, e.b, vs_v3_add(e.a, z));
    c->as.box.size.y = 0;
    if (vertices) c->as.box.size.x = 0;
    c->left = e.left, c->right = e.right;
  }
  *out = r[1];
  return vs_task_push(d, t) ? VS_OK : VS_ERROR;
}

vs_status vs_p_scope_component(vs_args *f, vs_value *out) {
  const char *of = f->key[0].given ? f->key[0].text.at : NULL;
  const vs_scope *s = f->arg[0].scope;
  if (!vs_rules_class(f, 0, BOXES | LOOPS | VS_SCOPE_BIT(MESH))) return VS_ERROR;
  if (s->class_ == VS_SCOPE_MESH) return vs_mesh_components(f, of ? of : "faces", out);
  if (LOOPS & 1u << s->class_) return loop_components(f, of ? of : "edges", out);
  return box_components(f, of ? of : "faces", out);
}

/* ---- the operator extrude ---- */

/* Extrudes a polygon by h, and creates a child for each part of the result. Each side becomes a box of height h without
 * depth. The last two children are the polygon at the top and the polygon at the bottom, which faces down. A box
 * without depth counts as the polygon of its corners. */
vs_status vs_p_scope_extrude(vs_args *f, vs_value *out) {
  vs_scheme *vm = f->vm;
  VS_ROOTS(vm, r, 4);
  if (!vs_rules_class(f, 0, VS_SCOPE_BIT(POLYGON) | VS_SCOPE_BIT(TRIANGLE))) return VS_ERROR;
  vs_scope *s = f->arg[0].scope;
  double h = f->arg[1].real;
  for (int i = 0; i < 3; i++) r[i] = f->key[i].given ? f->key[i].value : VS_FALSE;
  if (!(h > 0)) return vs_bind_refuse(f, "h", "positive", f->arg[1].value);
  uint32_t sides = s->loops->points->count;
  vs_derivation *d = vs_rules_begin(f, &r[3]);
  vs_rule_task *t = d ? vs_task_new(d, sides + 2, true) : NULL;
  if (!t) return VS_ERROR;
  vs_vec3 z = vs_affine_column(&s->as.box.frame, 2), up = vs_v3_scale(z, h);
  for (uint32_t i = 0; i < sides && r[0] != VS_FALSE; i++) {
    vs_scope *c = t->child[i] = vs_rules_child(d, s, VS_SCOPE_BOX, "side", i, sides);
    if (!c) return vs_task_drop(d, t), VS_ERROR;
    side e = side_of(s, i);
    lay_box(c, e.a, e.b, vs_v3_add(e.a, up));
    c->left = e.left, c->right = e.right;
    t->rules[i] = r[0];
  }
  for (uint32_t k = 0; k < 2; k++) { /* k = 0: the polygon at the top; k = 1: the polygon at the bottom */
    if (r[1 + k] == VS_FALSE) continue;
    vs_scope *c = t->child[sides + k] = vs_rules_child(d, s, (vs_scope_class)s->class_, k ? "bottom" : "top", 0, 1);
    t->rules[sides + k] = r[1 + k];
    vs_vec3 *at = c ? vs_bind_scratch(f, sides * sizeof *at) : NULL;
    if (!at) return vs_task_drop(d, t), VS_ERROR;
    const vs_vec3 *from = s->loops->points->at;
    for (uint32_t l = 0; l < s->loops->count; l++) {
      uint32_t first = s->loops->start[l], end = s->loops->start[l + 1];
      for (uint32_t i = first; i < end; i++) at[i] = k ? from[end - 1 - (i - first)] : vs_v3_add(from[i], up);
    }
    c->loops = vs_scope_loops_new(c->store, at, s->loops->start, s->loops->count);
    if (!c->loops) return vs_task_drop(d, t), vs_fail_memory(vm);
    vs_scope_frame_loops(c);
  }
  *out = r[3];
  return vs_task_push(d, t) ? VS_OK : VS_ERROR;
}

vs_status vs_p_scope_place(vs_args *f, vs_value *out) {
  VS_ROOTS(f->vm, r, 1);
  vs_scope *s = f->arg[0].scope;
  if (!vs_bind_finite(f, 1)) return VS_ERROR;
  vs_derivation *d = vs_rules_begin(f, &r[0]);
  if (!d) return VS_ERROR;
  *out = r[0];
  return vs_rules_place(d, s, f->arg[1].ref, vs_bind_origin(f->bind)) ? VS_OK : VS_ERROR;
}

/* ---- the operators prism, round corner, triangulate and subdivide ---- */

static vs_vec3 at_angle(const vs_scope *s, double x, double angle, int j) {
  double sine, cosine;
  vs_sincos(angle, &sine, &cosine);
  return vs_affine_point(&s->as.box.frame, vs_v3(x * cosine, j * s->as.box.size.y, x * sine));
}

/* Implements the operator prism: creates the wedge that fills half of a corner with this angle. It lies between the
 * front rectangle of a box and the same rectangle, rotated so that its edge at the greatest x moves along z. Creates
 * nothing if the angle is not positive. */
vs_status vs_p_scope_prism(vs_args *f, vs_value *out) {
  VS_ROOTS(f->vm, r, 2);
  if (!vs_rules_class(f, 0, VS_SCOPE_BIT(BOX))) return VS_ERROR;
  vs_scope *s = f->arg[0].scope;
  double angle = f->arg[1].real, half, cosine;
  r[0] = f->arg[2].value;
  if (!(angle < 3.14159)) return vs_bind_refuse(f, "angle", "under pi", f->arg[1].value);
  vs_derivation *d = vs_rules_begin(f, &r[1]);
  vs_rule_task *t = d ? vs_task_new(d, 1, false) : NULL;
  if (!t) return VS_ERROR;
  *out = r[1];
  t->rules[0] = r[0];
  if (angle <= 0 || s->as.box.size.x <= 0) return vs_task_push(d, t) ? VS_OK : VS_ERROR;
  vs_sincos(angle / 2, &half, &cosine);
  vs_scope *c = t->child[0] = vs_rules_child(d, s, VS_SCOPE_FFD, "prism", 0, 1);
  if (!c) return vs_task_drop(d, t), VS_ERROR;
  vs_vec3 size = s->as.box.size;
  for (int i = 0; i < 8; i++) {
    int x = i & 1, y = i >> 1 & 1, z = i >> 2;
    vs_vec3 p = vs_v3(x * size.x, y * size.y, x && z ? size.x * half / cosine : 0);
    c->as.corner[i] = vs_affine_point(&s->as.box.frame, p);
  }
  return vs_task_push(d, t) ? VS_OK : VS_ERROR;
}

/* Implements the operator round corner: rotates the front rectangle about its edge at x = 0, from x towards z, and
 * divides the swept sector into wedges of about the angle `approx`. */
vs_status vs_p_scope_round_corner(vs_args *f, vs_value *out) {
  VS_ROOTS(f->vm, r, 2);
  if (!vs_rules_class(f, 0, VS_SCOPE_BIT(BOX))) return VS_ERROR;
  vs_scope *s = f->arg[0].scope;
  double angle = f->arg[1].real, approx = f->arg[2].real, x = s->as.box.size.x;
  r[0] = f->arg[3].value;
  if (!(approx > 0)) return vs_bind_refuse(f, "approx", "positive", f->arg[2].value);
  if (!(angle <= 6.2831853072)) return vs_bind_refuse(f, "angle", "at most a turn", f->arg[1].value);
  double parts = fmax(1, floor(angle / approx + .5));
  if (parts > 10000)
    return vs_bind_refuse(f, "approx", "larger: there would be more than 10000 wedges", f->arg[2].value);
  uint32_t n = angle > 0 && x > 0 ? (uint32_t)parts : 0;
  vs_derivation *d = vs_rules_begin(f, &r[1]);
  vs_rule_task *t = d ? vs_task_new(d, n, false) : NULL;
  if (!t) return VS_ERROR;
  t->rules[0] = r[0];
  for (uint32_t i = 0; i < n; i++) {
    vs_scope *c = t->child[i] = vs_rules_child(d, s, VS_SCOPE_FFD, "round-corner", i, n);
    if (!c) return vs_task_drop(d, t), VS_ERROR;
    for (int k = 0; k < 8; k++)
      c->as.corner[k] = at_angle(s, k & 1 ? x : 0, angle * (i + (uint32_t)(k >> 2)) / n, k >> 1 & 1);
  }
  *out = r[1];
  return vs_task_push(d, t) ? VS_OK : VS_ERROR;
}

/* Adds a scope for a triangle, given by three points, as child i of `parent`. If it fails, sets the error and returns
 * false. */
static bool add_triangle(vs_derivation *d, vs_rule_task *t, vs_scope *parent, const char *op, uint32_t i,
                         const vs_vec3 p[3]) {
  vs_scope *c = t->child[i] = vs_rules_child(d, parent, VS_SCOPE_TRIANGLE, op, i, t->count);
  if (!c) return false;
  c->loops = vs_scope_loops_new(c->store, p, (const uint32_t[]){ 0, 3 }, 1);
  if (!c->loops) return vs_fail_memory(d->vm);
  if (!vs_scope_frame_loops(c)) vs_scope_release(c), t->child[i] = NULL;
  return true;
}

vs_status vs_p_scope_triangulate(vs_args *f, vs_value *out) {
  VS_ROOTS(f->vm, r, 2);
  if (!vs_rules_class(f, 0, VS_SCOPE_BIT(POLYGON) | VS_SCOPE_BIT(TRIANGLE))) return VS_ERROR;
  vs_scope *s = f->arg[0].scope;
  const vs_scope_loops *l = s->loops;
  vs_affine back;
  vs_mesh m = { 0 };
  r[0] = f->arg[1].value;
  vs_vec2 *flat = vs_bind_scratch(f, l->points->count * sizeof *flat);
  size_t *sizes = flat ? vs_bind_scratch(f, l->count * sizeof *sizes) : NULL;
  uint32_t *index = sizes ? vs_bind_scratch(f, l->points->count * sizeof *index) : NULL;
  if (!index) return VS_ERROR;
  vs_affine_invert(&s->as.box.frame, &back);
  for (uint32_t i = 0; i < l->points->count; i++) {
    vs_vec3 p = vs_affine_point(&back, l->points->at[i]);
    flat[i] = (vs_vec2){ p.x, p.y }, index[i] = i;
  }
  for (uint32_t i = 0; i < l->count; i++) sizes[i] = l->start[i + 1] - l->start[i];
  if (!vs_triangulate(flat, sizes, l->count, &m, index, false)) return vs_mesh_free(&m), vs_fail_memory(f->vm);
  vs_derivation *d = vs_rules_begin(f, &r[1]);
  vs_rule_task *t = d ? vs_task_new(d, (uint32_t)m.triangle_count, false) : NULL;
  if (t) t->rules[0] = r[0];
  for (uint32_t i = 0; t && i < m.triangle_count; i++) {
    vs_vec3 p[3];
    for (int k = 0; k < 3; k++) p[k] = l->points->at[m.triangles[i][k]];
    if (!add_triangle(d, t, s, "triangulate", i, p)) vs_task_drop(d, t), t = NULL;
  }
  vs_mesh_free(&m);
  *out = r[1];
  return t && vs_task_push(d, t) ? VS_OK : VS_ERROR;
}

/* Divides a triangle into four triangles at the midpoints of its edges: first the three at its corners, then the one in
 * the middle. */
vs_status vs_p_scope_subdivide(vs_args *f, vs_value *out) {
  VS_ROOTS(f->vm, r, 2);
  if (!vs_rules_class(f, 0, VS_SCOPE_BIT(TRIANGLE))) return VS_ERROR;
  vs_scope *s = f->arg[0].scope;
  const vs_vec3 *p = s->loops->points->at;
  r[0] = f->arg[1].value;
  vs_vec3 m[3];
  for (int i = 0; i < 3; i++) m[i] = vs_v3_scale(vs_v3_add(p[i], p[(i + 1) % 3]), .5);
  const vs_vec3 all[4][3] = { { p[0], m[0], m[2] }, { m[0], p[1], m[1] }, { m[2], m[1], p[2] }, { m[0], m[1], m[2] } };
  vs_derivation *d = vs_rules_begin(f, &r[1]);
  vs_rule_task *t = d ? vs_task_new(d, 4, false) : NULL;
  if (!t) return VS_ERROR;
  t->rules[0] = r[0];
  for (uint32_t i = 0; i < 4; i++)
    if (!add_triangle(d, t, s, "subdivide", i, all[i])) return vs_task_drop(d, t), VS_ERROR;
  *out = r[1];
  return vs_task_push(d, t) ? VS_OK : VS_ERROR;
}
