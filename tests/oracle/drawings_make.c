/* Makes random drawings: see drawings.h. */
#include <stdlib.h>
#include <string.h>

#include "tests/oracle/drawings.h"

#include "backends/export.h"
#include "geometry/files/polyface.h"
#include "model/looks/ready_materials.h"

typedef struct {
  vs_store *s;
  uint64_t state;
  uint32_t line;
  vs_affine frame; /* frame (coordinate system) in which leaves are written; their coordinates are rounded as a
                    * program's would be */
  bool turned;     /* whether the frame is more than a translation, for example a rotation */
  double nudge;    /* added to each length, so that a part becomes nearly a copy of another part */
  bool more;       /* whether round parts get an additional facet */
} maker;

static uint32_t any(maker *m, uint32_t n) { /* returns a random integer of 0 .. n-1 */
  m->state ^= m->state << 13;
  m->state ^= m->state >> 7;
  m->state ^= m->state << 17;
  return (uint32_t)((m->state >> 20) % n);
}
static double real(maker *m) { return (double)any(m, 33) / 8 - 2; }      /* returns a random number of -2 .. 2 */
static double length(maker *m) { return 0.25 + (double)any(m, 17) / 8 + m->nudge; } /* returns a random length of 0.25
                                                                                     * .. 2.25 */
static vs_vec3 vector(maker *m) {
  double x = real(m), y = real(m), z = real(m);
  return vs_v3(x, y, z);
}
static vs_vec3 sizes(maker *m) {
  double x = length(m), y = length(m), z = length(m);
  return vs_v3(x, y, z);
}

static void *sure(void *p) {
  if (!p) abort();
  return p;
}
static const vs_origin *origin(maker *m) { return sure((void *)(uintptr_t)vs_store_origin(m->s, "random.vs", ++m->line, 1, NULL)); }

/* Makes a node of the kind. Takes over the caller's references to the children. */
static vs_ref node(maker *m, vs_kind kind, const void *data, const vs_ref *kids, size_t count) {
  static const unsigned char nothing[256];
  vs_ref made = { sure(vs_node_new(m->s, kind, data ? data : nothing, kids, count)), origin(m) };
  for (size_t i = 0; i < count; i++) vs_node_release(kids[i].node);
  return made;
}
static vs_ref over(maker *m, vs_kind kind, const void *data, vs_ref kid) { return node(m, kind, data, &kid, 1); }
static vs_ref again(maker *m, vs_ref r) { return (vs_ref){ vs_node_retain(r.node), origin(m) }; }
static vs_ref placed(maker *m, vs_affine a, vs_ref kid) { return over(m, VS_TRANSFORM, &(struct vs_transform){ .matrix = a }, kid); }
static vs_vec3 put(const maker *m, vs_vec3 p) { return vs_affine_point(&m->frame, p); }
/* Places a node whose kind is always parallel to the axes in the current frame. */
static vs_ref framed(maker *m, vs_ref kid) { return m->turned ? placed(m, m->frame, kid) : kid; }
static vs_vec3 still(const maker *m, vs_vec3 p) { return m->turned ? p : put(m, p); }

#define LEAF(lower, upper, ...) node(m, VS_##upper, &(struct vs_##lower){ __VA_ARGS__ }, NULL, 0)

static vs_affine any_map(maker *m) {
  switch (any(m, 9)) {
    case 0: case 1: case 2: return vs_affine_translation(vector(m));
    case 3: return vs_affine_rotation(vector(m), vs_v3(any(m, 2), any(m, 2), 1), (double)any(m, 8) * 0.78539816339744830962);
    case 4: return vs_affine_rotation(vector(m), vs_v3(real(m), real(m), 2.5), real(m));
    case 5: return vs_affine_mirror(vector(m), any(m, 2) ? vs_v3(real(m), 0.5, 2.5) : vs_v3(1, 0, 0));
    case 6: {
      double k = length(m);
      return vs_affine_scaling(vector(m), vs_v3(k, k, k));
    }
    case 7: return vs_affine_scaling(vector(m), sizes(m));
    default: {
      vs_affine shear = vs_affine_identity();
      shear.m[0][1] = real(m) / 4;
      shear.m[any(m, 2)][2] = real(m) / 4;
      return shear;
    }
  }
}

/* ---- curves and regions, all in the XY plane or parallel to it ---- */

static vs_ref line(maker *m, const vs_vec3 *at, size_t count, bool closed) {
  vs_points *points = sure(vs_points_new(m->s, at, count));
  vs_ref made = LEAF(line, LINE, .points = points, .closed = closed);
  vs_points_release(m->s, points);
  return made;
}

static vs_ref polygon(maker *m) { /* makes a star around a centre, which never crosses itself */
  vs_vec3 at[7], c = vs_v3(real(m), real(m), 0);
  size_t n = 3 + any(m, 5);
  for (size_t i = 0; i < n; i++) {
    double r = length(m), s, k;
    vs_turn_sincos((int)i, (int)n, &s, &k);
    at[i] = put(m, vs_v3(c.x + r * k, c.y + r * s, 0));
  }
  return line(m, at, n, true);
}

static vs_ref circle(maker *m, double z) {
  vs_vec3 c = vs_v3(real(m), real(m), z);
  return framed(m, LEAF(circle, CIRCLE, .center = still(m, c), .radius = length(m), .segments = any(m, 3) ? 0 : 6));
}

static vs_ref spline(maker *m, bool closed) {
  vs_vec3 at[6], c = vs_v3(real(m), real(m), 0);
  for (int i = 0; i < 6; i++) {
    double s, k, r = 0.8 + length(m) / 4;
    vs_turn_sincos(i, 7, &s, &k);
    at[i] = put(m, vs_v3(c.x + r * k, c.y + r * s, closed ? 0 : (double)i / 4));
  }
  vs_points *points = sure(vs_points_new(m->s, at, 6));
  vs_ref made = LEAF(spline, SPLINE, .points = points, .closed = closed);
  vs_points_release(m->s, points);
  return made;
}

static vs_ref region(maker *m) {
  vs_vec3 square[] = { { -3, -3, 0 }, { 3, -3, 0 }, { 3, 3, 0 }, { -3, 3, 0 } };
  vs_ref loops[2];
  for (int i = 0; i < 4; i++) square[i] = put(m, square[i]);
  switch (any(m, 4)) {
    case 0: return over(m, VS_REGION, NULL, polygon(m));
    case 1: return over(m, VS_REGION, NULL, circle(m, 0));
    case 2:
      loops[0] = line(m, square, 4, true);
      loops[1] = framed(m, LEAF(circle, CIRCLE, .center = still(m, vs_v3(0.5, 0, 0)), .radius = 0.75));
      return node(m, VS_REGION, NULL, loops, 2);
    default: return over(m, VS_OFFSET, &(struct vs_offset){ .distance = 0.25, .corners = vs_store_text(m->s, "mitre", 5) }, over(m, VS_REGION, NULL, polygon(m)));
  }
}

static vs_ref profile(maker *m) {
  vs_ref p = any(m, 5) == 0 ? region(m) : any(m, 3) == 0 ? circle(m, 0) : any(m, 4) == 0 ? spline(m, true) : polygon(m);
  if (!m->turned && any(m, 4) == 0) p = placed(m, vs_affine_translation(vs_v3(real(m), real(m), 0)), p);
  if (!m->turned && any(m, 6) == 0) p = placed(m, vs_affine_rotation(vs_v3(0, 0, 0), vs_v3(0, 0, 1), real(m)), p);
  return p;
}

static vs_ref curve(maker *m) {
  vs_vec3 at[4];
  for (int i = 0; i < 4; i++) at[i] = put(m, vector(m));
  switch (any(m, 9)) {
    case 0: return circle(m, real(m));
    case 1: return framed(m, LEAF(arc, ARC, .center = still(m, vector(m)), .radius = length(m), .start = real(m), .end = real(m) + 3));
    case 2: return spline(m, any(m, 2));
    case 3: {
      vs_ref parts[2] = { line(m, at, 2, false), line(m, at + 1, 3, false) };
      return node(m, VS_JOIN, NULL, parts, 2);
    }
    case 4: return over(m, VS_OFFSET, &(struct vs_offset){ .distance = 0.125, .corners = vs_store_text(m->s, "round", 5) }, circle(m, 0));
    case 5: return any(m, 2) ? LEAF(xline, XLINE, .p = at[0], .q = vs_v3_add(at[0], vs_v3(1, 2, 0))) : LEAF(ray, RAY, .p = at[0], .v = { 0, 1, 2 });
    case 6: return over(m, VS_EDGES, NULL, LEAF(box, BOX, .p = { 0, 0, 0 }, .q = { 1, 2, 3 }));
    default: return line(m, at, 2 + any(m, 3), any(m, 2));
  }
}

static vs_ref region_tree(maker *m) {
  if (any(m, 8) == 0) {
    struct vs_letters t = { .p = still(m, vector(m)), .size = length(m), .string = vs_store_text(m->s, "Ag", 2), .font = vs_store_text(m->s, "", 0), .spacing = 1 };
    t.align = vs_store_text(m->s, "left", 4);
    t.valign = vs_store_text(m->s, "baseline", 8);
    return framed(m, node(m, VS_TEXT, &t, NULL, 0));
  }
  if (any(m, 6) == 0) return over(m, any(m, 2) ? VS_SECTION : VS_PROJECT, &(struct vs_section){ .point = { 0, 0, 0.5 }, .normal = { 0, 0, 1 } }, LEAF(box, BOX, .p = { -1, 0, 0 }, .q = { 1, 2, 3 }));
  if (any(m, 2)) return region(m);
  vs_ref parts[2] = { region(m), region(m) };
  static const vs_kind sets[] = { VS_UNION, VS_INTERSECTION, VS_DIFFERENCE };
  return node(m, sets[any(m, 3)], NULL, parts, 2);
}

/* ---- surfaces and solids ---- */

static vs_ref polyface(maker *m, bool closed) {
  static const uint32_t starts[] = { 0, 3, 6, 9, 12 }, corners[] = { 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3 };
  vs_vec3 c = vector(m), at[4] = { c, { c.x + length(m), c.y, c.z }, { c.x, c.y + length(m), c.z }, { c.x, c.y, c.z + length(m) } };
  for (int i = 0; i < 4; i++) at[i] = put(m, at[i]);
  vs_error e = { 0 };
  return (vs_ref){ sure(vs_polyface_make(m->s, &(vs_polygons){ at, 4, starts, corners, closed ? 4 : 2 }, &e)), origin(m) };
}

static vs_ref grid(maker *m, vs_kind kind) {
  vs_vec3 at[9], c = vector(m);
  for (int i = 0; i < 9; i++) at[i] = put(m, vs_v3(c.x + i % 3, c.y + i / 3, c.z + length(m) / 3));
  vs_points *points = sure(vs_points_new(m->s, at, 9));
  struct vs_height_field h = { .points = points, .columns = 3, .low = c.z - 1 };
  struct vs_grid_mesh g = { .points = points, .columns = 3 };
  vs_ref made = node(m, kind, kind == VS_HEIGHT_FIELD ? (void *)&h : (void *)&g, NULL, 0);
  vs_points_release(m->s, points);
  return made;
}

static vs_ref surface(maker *m) {
  vs_ref made = any(m, 2) ? polyface(m, false) : grid(m, any(m, 2) ? VS_GRID_MESH : VS_GRID_SURFACE);
  return any(m, 5) ? made : over(m, VS_SLICE, &(struct vs_slice){ .point = put(m, vs_v3(0, 0, 0)), .normal = { 1, 0, 0 } }, made);
}

static vs_ref hull(maker *m) {
  vs_vec3 at[6];
  for (int i = 0; i < 6; i++) at[i] = vs_v3((i % 2 ? 1 : -1) * length(m), (i % 3 - 1) * length(m), i / 2 * length(m) / 2);
  vs_points *points = sure(vs_points_new(m->s, at, any(m, 2) ? 6 : 0));
  vs_ref kids[] = { LEAF(box, BOX, .p = { 0, 0, 0 }, .q = { 1, 1, 1 }), LEAF(wedge, WEDGE, .p = { 1, 1, 1 }, .q = { 2, 2, 3 }) };
  vs_ref made = node(m, VS_HULL, &(struct vs_hull){ .points = points, .dimension = 3 }, kids, 2);
  vs_points_release(m->s, points);
  return made;
}

static vs_ref swept(maker *m) {
  vs_vec3 path[] = { { 0, 0, 0 }, { 0, 0, 2 }, { 1, 0, 4 } };
  for (int i = 0; i < 3; i++) path[i] = put(m, path[i]);
  vs_vec3 up = vs_affine_vector(&m->frame, vs_v3(real(m) / 4, 0, length(m)));
  vs_ref two[2];
  if (!m->turned)
    switch (any(m, 5)) {
      case 0: {
        vs_ref bar = over(m, VS_THICKEN, &(struct vs_thicken){ .width = 0.25 }, line(m, path, 3, false));
        return bar;
      }
      case 1: {
        vs_vec3 at[] = { { 1, 0, 0 }, { 2.5, 0, 0 }, { 2, 0, 1.5 } };
        for (int i = 0; i < 3; i++) at[i] = put(m, at[i]);
        return over(m, VS_REVOLVE, &(struct vs_revolve){ .at = put(m, vs_v3(0, 0, 0)), .direction = { 0, 0, 1 }, .end = any(m, 2) ? 6.283185307179586 : 2 }, line(m, at, 3, true));
      }
      case 2:
        two[0] = LEAF(circle, CIRCLE, .center = still(m, vs_v3(0, 0, 0)), .radius = 1);
        two[1] = LEAF(circle, CIRCLE, .center = still(m, vs_v3(0, 0.5, 2)), .radius = length(m));
        return node(m, any(m, 2) ? VS_RULED_LOFT : VS_LOFT, NULL, two, 2);
      case 3:
        two[0] = LEAF(circle, CIRCLE, .center = { 0, 0, 0 }, .radius = 0.5, .segments = any(m, 2) ? 0 : 5);
        two[1] = line(m, path, 3, false);
        return node(m, VS_SWEEP, &(struct vs_sweep){ .scale = 1, .twist = any(m, 2) ? 1 : 0 }, two, 2);
      default: break;
    }
  struct vs_extrude e = { .along = up, .scale = any(m, 4) ? 1 : 0.5, .twist = any(m, 4) || m->turned ? 0 : 1, .taper = 0 };
  if (e.scale == 1 && e.twist == 0 && any(m, 4) == 0) e.along = vs_affine_vector(&m->frame, vs_v3(0, 0, 1)), e.center = true;
  return over(m, VS_EXTRUDE, &e, profile(m));
}

static vs_ref solid_leaf(maker *m) {
  vs_vec3 p = vector(m), d = sizes(m), q = vs_v3_add(p, d);
  int segments = any(m, 3) ? 0 : m->more ? 6 : 5;
  switch (any(m, 18)) {
    case 0: case 1: return framed(m, LEAF(box, BOX, .p = still(m, p), .q = still(m, q)));
    case 2: return framed(m, LEAF(wedge, WEDGE, .p = still(m, p), .q = still(m, q)));
    case 3: case 4: return LEAF(sphere, SPHERE, .center = put(m, p), .radius = d.x, .segments = m->turned ? 0 : segments);
    case 5: case 6: return LEAF(cylinder, CYLINDER, .base = put(m, p), .top = put(m, q), .radius = d.x / 2, .segments = m->turned ? 0 : segments);
    case 7: return LEAF(cone, CONE, .base = put(m, p), .apex = put(m, q), .radius = d.x, .segments = m->turned ? 0 : segments);
    case 8: return LEAF(cut_cone, CUT_CONE, .base = put(m, p), .top = put(m, q), .base_radius = d.x, .top_radius = d.y / 2);
    case 9: return framed(m, LEAF(e_cone, E_CONE, .base = still(m, p), .top = still(m, any(m, 2) ? q : vs_v3(p.x, p.y, q.z)), .base_radius = d.x, .base_across = d.y, .top_radius = d.z / 2));
    case 10: return framed(m, LEAF(pyramid, PYRAMID, .base = still(m, p), .base_radius = d.x, .sides = 3 + (int)any(m, 4) + m->more, .top = still(m, q), .top_radius = any(m, 2) ? 0 : d.y));
    case 11: return framed(m, LEAF(torus, TORUS, .center = still(m, p), .radius = d.x + d.y / 3, .tube_radius = d.y / 3, .segments = segments));
    case 12: return framed(m, LEAF(superellipsoid, SUPERELLIPSOID, .e = 0.5 + d.x / 4, .n = 0.5 + d.y / 4, .size = d.z));
    case 13: return m->turned ? framed(m, hull(m)) : grid(m, VS_HEIGHT_FIELD);
    case 14: return polyface(m, true);
    case 15: return any(m, 3) ? swept(m) : framed(m, hull(m));
    case 16: return swept(m);
    default: return any(m, 4) ? polyface(m, true) : node(m, VS_EMPTY, NULL, NULL, 0);
  }
}

static vs_ref wrapped(maker *m, vs_ref kid) {
  static const char *const paints[] = { "red", "green", "glass", "concrete" }, *const layers[] = { "walls", "roof", "glass" };
  switch (any(m, 10)) {
    case 0: case 1: case 2: case 3: {
      struct { vs_field_material material; unsigned char end; } data = { vs_store_ready_material(m->s, paints[(any(m, 4) + m->more) % 4]), 0 };
      return over(m, VS_MATERIAL, &data, kid);
    }
    case 4: case 5: case 6: {
      const char *name = layers[any(m, 3)];
      return over(m, VS_LAYER, &(struct vs_layer){ .name = vs_store_text(m->s, name, strlen(name)) }, kid);
    }
    case 7: return over(m, VS_NATIVE, &(struct vs_native){ .target = vs_store_text(m->s, "povray", 6), .code = vs_store_text(m->s, "blob { }", 8) }, kid);
    case 8: {
      vs_ticket *t = sure(vs_ticket_new(m->s, 3));
      vs_ref made = over(m, VS_CUSTOM, &(struct vs_custom){ .name = vs_store_text(m->s, "beam", 4), .made = vs_store_text(m->s, "(make-beam)", 11), .values = t }, kid);
      vs_ticket_release(m->s, t);
      return made;
    }
    default: return over(m, any(m, 2) ? VS_HIGHLIGHT : VS_ONLY, NULL, kid);
  }
}

static vs_ref half_space(maker *m) { return LEAF(half_space, HALF_SPACE, .point = vector(m), .normal = vs_v3(real(m), real(m), 2.25)); }

static vs_ref solid_set(maker *m, vs_ref *kids, size_t n) { /* makes a set operation on the solids; takes over the
                                                             * caller's references to them */
  static const vs_kind sets[] = { VS_UNION, VS_INTERSECTION, VS_DIFFERENCE, VS_UNION };
  vs_kind kind = sets[any(m, 4)];
  if (kind != VS_UNION && n > 1 && any(m, 8) == 0) {
    vs_node_release(kids[n - 1].node);
    kids[n - 1] = any(m, 2) ? half_space(m) : placed(m, any_map(m), half_space(m));
  }
  return node(m, kind, NULL, kids, n);
}

/* Returns a group of leaves: the same leaf is written several times, at computed places. */
static vs_ref copies(maker *m) {
  vs_ref kids[4];
  size_t n = 2 + any(m, 3);
  bool turned = any(m, 2);
  size_t odd = any(m, 5); /* index of the copy that differs from the others; no copy differs if there are not so many
                           * copies */
  uint64_t same = m->state;
  for (size_t i = 0; i < n; i++) {
    vs_ref parts[5];
    m->state = same;
    size_t count = 2 + any(m, 4);
    m->frame = i == 0    ? vs_affine_identity()
               : !turned ? vs_affine_translation(vs_v3(0.3 * (double)i, 0.7, 0.1))
                         : vs_affine_rotation(vs_v3(1, 0, 0), vs_v3(0.25, any(m, 2), 1), 0.7 * (double)i);
    if (i == 3 && turned) m->frame = vs_affine_mirror(vs_v3(0, 1, 0), vs_v3(1, 0.5, 0));
    m->turned = turned;
    for (size_t k = 0; k < count; k++) {
      m->more = i == 1 && k == odd;
      m->nudge = m->more && n == 3 ? 0.0625 : 0;
      parts[k] = any(m, 6) ? solid_leaf(m) : wrapped(m, solid_leaf(m));
    }
    m->nudge = 0;
    m->more = false;
    static const vs_kind sets[] = { VS_UNION, VS_UNION, VS_DIFFERENCE };
    kids[i] = node(m, sets[any(m, 3)], NULL, parts, count);
  }
  m->frame = vs_affine_identity();
  m->turned = false;
  return node(m, VS_UNION, NULL, kids, n);
}

/* Returns a tree without shared nodes. */
static vs_ref fresh(maker *m, int depth) {
  vs_ref kids[3];
  size_t n = 1 + any(m, 3);
  if (depth == 1 && any(m, 4) == 0) return copies(m);
  if (depth == 0) return any(m, 3) ? solid_leaf(m) : placed(m, any_map(m), solid_leaf(m));
  for (size_t i = 0; i < n; i++) {
    kids[i] = fresh(m, depth - 1);
    if (any(m, 3) == 0) kids[i] = wrapped(m, kids[i]);
    if (any(m, 3) == 0) kids[i] = placed(m, any_map(m), kids[i]);
  }
  return solid_set(m, kids, n);
}

static vs_ref solid_tree(maker *m) {
  enum { LEAVES = 6, ALL = 13 };
  vs_ref stock[ALL];
  for (int i = 0; i < LEAVES; i++) stock[i] = solid_leaf(m);
  for (int i = 0; i < 2; i++)
    if (any(m, 2)) {
      vs_node_release(stock[i].node);
      stock[i] = copies(m);
    }
  for (uint32_t i = LEAVES; i < ALL; i++) {
    vs_ref kids[5];
    size_t n = 1 + any(m, 4);
    for (size_t k = 0; k < n; k++) {
      kids[k] = any(m, 3) ? again(m, stock[any(m, i)]) : fresh(m, (int)any(m, 3));
      if (any(m, 3) == 0) kids[k] = wrapped(m, kids[k]);
      if (any(m, 3) == 0) kids[k] = placed(m, any_map(m), kids[k]);
    }
    stock[i] = solid_set(m, kids, n);
    if (any(m, 3) == 0) stock[i] = placed(m, any_map(m), stock[i]);
    if (any(m, 4) == 0) stock[i] = wrapped(m, stock[i]);
    if (any(m, 3) == 0) stock[i] = placed(m, any_map(m), stock[i]);
  }
  vs_ref top = again(m, stock[ALL - 1]);
  for (int i = 0; i < ALL; i++) vs_node_release(stock[i].node);
  return top;
}

static vs_ref beside(maker *m) {
  vs_ref r = any(m, 3) == 0 ? region_tree(m) : any(m, 2) ? curve(m) : surface(m);
  if (any(m, 2)) r = placed(m, any_map(m), r);
  if (any(m, 2)) r = wrapped(m, r);
  return any(m, 2) ? placed(m, any_map(m), r) : r;
}

drawing drawing_make(vs_store *s, uint64_t seed) {
  maker made = { s, seed * 0x9e3779b97f4a7c15u + 0x2545f4914f6cdd1du, 0, vs_affine_identity(), false, 0, false }, *m = &made;
  drawing d = { .count = 1 + any(m, DRAWN_MOST) };
  for (int i = 0; i < 8; i++) any(m, 2);
  for (size_t i = 0; i < d.count; i++) {
    vs_ref kids[4] = { i == 0 ? solid_tree(m) : beside(m) };
    size_t n = 1;
    if (i == 0 && any(m, 3) == 0) kids[n++] = solid_tree(m);
    while (n < 4 && any(m, 3) == 0) kids[n++] = beside(m);
    if (n < 4 && any(m, 4) == 0) kids[n++] = over(m, VS_GHOST, NULL, solid_leaf(m));
    d.at[i] = n == 1 ? kids[0] : node(m, VS_UNION, NULL, kids, n);
    if (any(m, 4) == 0) d.at[i] = placed(m, any_map(m), d.at[i]);
  }
  return d;
}

drawing drawing_retain(const drawing *d) {
  for (size_t i = 0; i < d->count; i++) vs_node_retain(d->at[i].node);
  return *d;
}
void drawing_release(drawing *d) {
  for (size_t i = 0; i < d->count; i++) vs_node_release(d->at[i].node);
  d->count = 0;
}

static bool to_file(void *context, const void *bytes, size_t count) { return fwrite(bytes, 1, count, context) == count; }

void drawing_print(const drawing *d, FILE *out) {
  vs_scene scene;
  vs_error e = { 0 };
  vs_export_options options;
  vs_scene_init(&scene, d->at[0].node->store);
  vs_export_options_init(&options);
  for (size_t i = 0; i < d->count; i++) vs_scene_draw(&scene, d->at[i]);
  if (!vs_export_to(&scene, vs_export_format_find("tree"), to_file, out, &options, &e)) fprintf(out, "(cannot be printed: %s)\n", e.message);
  vs_scene_free(&scene);
}

/* ---- shrinking ---- */

static bool goes_in(const vs_node *n) { return vs_kind_get((vs_kind)n->kind)->level >= VS_LEVEL_OPERATION && n->kind != VS_HULL; }

/* Returns n with `target` replaced by `with` everywhere. If `with` is NULL, removes child number `drop` of `target`
 * instead. The caller owns the result. */
static vs_node *replaced(const vs_node *n, const vs_node *target, vs_node *with, uint32_t drop) {
  if (n == target && with) return vs_node_retain(with);
  if (!goes_in(n) && n != target) return vs_node_retain((vs_node *)(uintptr_t)n);
  vs_ref *kids = sure(malloc((n->child_count + (size_t)1) * sizeof *kids));
  size_t count = 0;
  bool same = true;
  for (uint32_t i = 0; i < n->child_count; i++) {
    if (n == target && i == drop) continue;
    kids[count] = (vs_ref){ replaced(n->children[i].node, target, with, drop), n->children[i].origin };
    same = same && kids[count].node == n->children[i].node;
    count++;
  }
  vs_node *made = same && count == n->child_count ? vs_node_retain((vs_node *)(uintptr_t)n) : sure(vs_node_new(n->store, (vs_kind)n->kind, vs_node_data(n), kids, count));
  for (size_t i = 0; i < count; i++) vs_node_release(kids[i].node);
  free(kids);
  return made;
}

static bool smaller(drawing *d, const vs_node *target, vs_node *with, uint32_t drop, drawing_fails *fails, void *context) {
  drawing tried = { .count = d->count };
  bool changed = false;
  for (size_t i = 0; i < d->count; i++) {
    tried.at[i] = (vs_ref){ replaced(d->at[i].node, target, with, drop), d->at[i].origin };
    changed = changed || tried.at[i].node != d->at[i].node;
  }
  if (changed && fails(context, &tried)) {
    drawing_release(d);
    *d = tried;
    return true;
  }
  drawing_release(&tried);
  return false;
}

static bool shrink_below(drawing *d, const vs_node *n, drawing_fails *fails, void *context) {
  if (!goes_in(n)) {
    struct vs_box unit = { .q = { 1, 1, 1 } };
    if (n->class_ != VS_SOLID || n->kind == VS_BOX || n->flags & VS_NODE_ENDLESS) return false;
    vs_node *box = sure(vs_node_new(n->store, VS_BOX, &unit, NULL, 0));
    bool done = smaller(d, n, box, 0, fails, context);
    vs_node_release(box);
    return done;
  }
  for (uint32_t i = 0; i < n->child_count; i++)
    if (n->children[i].node->class_ == n->class_ && smaller(d, n, n->children[i].node, 0, fails, context)) return true;
  for (uint32_t i = 0; n->child_count > 1 && i < n->child_count; i++)
    if (!(n->child_count == 2 && n->children[1 - i].node->flags & VS_NODE_ENDLESS) && smaller(d, n, NULL, i, fails, context)) return true;
  for (uint32_t i = 0; i < n->child_count; i++)
    if (shrink_below(d, n->children[i].node, fails, context)) return true;
  return false;
}

void drawing_shrink(drawing *d, drawing_fails *fails, void *context) {
  for (int rounds = 0; rounds < 400; rounds++) {
    bool less = false;
    for (size_t i = 0; !less && d->count > 1 && i < d->count; i++) {
      drawing tried = { .count = 0 };
      for (size_t k = 0; k < d->count; k++)
        if (k != i) tried.at[tried.count++] = (vs_ref){ vs_node_retain(d->at[k].node), d->at[k].origin };
      less = fails(context, &tried);
      if (less) {
        drawing_release(d);
        *d = tried;
      } else drawing_release(&tried);
    }
    for (size_t i = 0; !less && i < d->count; i++) less = shrink_below(d, d->at[i].node, fails, context);
    if (!less) return;
  }
}
