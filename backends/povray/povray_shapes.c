/* Writes each kind of node as POV-Ray text. Objects that POV-Ray draws incorrectly without a message (degenerate
 * shapes, operations with a single operand) do not occur here: the constructors refuse them, or the driver omits them.
 * povray_meshes.c writes triangles. */
#include "backends/povray/povray_shapes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "backends/number_spelling.h"
#include "backends/povray/povray_meshes.h"
#include "backends/povray/povray_text.h"
#include "geometry/plane/outline.h"
#include "geometry/plane/planar_evaluation.h"
#include "geometry/frame.h"
#include "geometry/profiles/revolve.h"

/* Greatest lengths in bytes of a point and a shape as text. A drawing may have a million primitives, so their text is
 * written directly into the writer's buffer. */
enum { POV_POINT_ROOM = 3 * VS_NUMBER_ROOM + 8, POV_SHAPE_ROOM = 80 + 32 + 2 * POV_POINT_ROOM + 2 * VS_NUMBER_ROOM };

static char *pov_write_point(char *to, vs_vec3 p) {
  *to++ = '<';
  to = vs_number_write(to, p.x);
  VS_WRITE(to, ", ");
  to = vs_number_write(to, p.y);
  VS_WRITE(to, ", ");
  to = vs_number_write(to, p.z);
  *to++ = '>';
  return to;
}
static char *pov_write_comma_point(char *to, vs_vec3 p) {
  VS_WRITE(to, ", ");
  return pov_write_point(to, p);
}
static char *pov_write_comma(char *to, double x) {
  VS_WRITE(to, ", ");
  return vs_number_write(to, x);
}

/* Returns room for a shape's text in the writer's buffer, after writing its indentation and keyword (of at most 32
 * letters). Returns NULL on failure. */
static char *pov_begin(vs_emitter *e, const char *word, size_t length) {
  char *to = vs_writer_room(e->out, POV_SHAPE_ROOM);
  if (to == NULL) return NULL;
  size_t indent = 2 * (e->depth < 40 ? e->depth : 40);
  memset(to, ' ', indent);
  memcpy(to + indent, word, length);
  return to + indent + length;
}
#define POV_BEGIN(e, word) pov_begin(e, word, sizeof word - 1)
static vs_emit_status pov_finish(vs_emitter *e, char *to) {
  VS_WRITE(to, " }\n");
  return vs_writer_filled(e->out, to) ? VS_EMITTED : VS_FAILED;
}

static void pov_comma_point(vs_emitter *e, vs_vec3 p) {
  vs_puts(e->out, ", ");
  pov_point(e, p);
}
static void pov_comma(vs_emitter *e, double x) {
  vs_puts(e->out, ", ");
  vs_put_number(e->out, x);
}

/* Writes a matrix. POV-Ray multiplies row vectors by matrices, so the rows of its matrix are the columns of
 * VisualScheme's. The translation of `a` is in model units. */
static void pov_matrix(vs_emitter *e, const vs_affine *a) {
  vs_puts(e->out, "matrix <");
  for (int column = 0; column < 4; column++)
    for (int row = 0; row < 3; row++) {
      if (column + row > 0) vs_puts(e->out, row == 0 ? ",  " : ", ");
      vs_put_number(e->out, column == 3 ? a->m[row][column] * e->unit : a->m[row][column]);
    }
  vs_puts(e->out, ">");
}

/* ---- primitives ---- */

vs_emit_status vs_povray_box(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  char *to = POV_BEGIN(e, "box { ");
  if (to == NULL) return VS_FAILED;
  to = pov_write_point(to, pov_at(e, VS_AS(box, ref->node)->p));
  return pov_finish(e, pov_write_comma_point(to, pov_at(e, VS_AS(box, ref->node)->q)));
}

static vs_emit_status pov_sphere(vs_emitter *e, vs_vec3 center, double radius) {
  char *to = POV_BEGIN(e, "sphere { ");
  if (to == NULL) return VS_FAILED;
  to = pov_write_point(to, pov_at(e, center));
  return pov_finish(e, pov_write_comma(to, radius * e->unit));
}

/* If the model sets the number of facets, the object consists of these facets, and is written as triangles. */
vs_emit_status vs_povray_sphere(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const struct vs_sphere *s = VS_AS(sphere, ref->node);
  if (s->segments > 0) return VS_LOWER;
  return pov_sphere(e, s->center, s->radius);
}

static vs_emit_status pov_cylinder(vs_emitter *e, vs_vec3 base, vs_vec3 top, double radius) {
  char *to = POV_BEGIN(e, "cylinder { ");
  if (to == NULL) return VS_FAILED;
  to = pov_write_point(to, pov_at(e, base));
  to = pov_write_comma_point(to, pov_at(e, top));
  return pov_finish(e, pov_write_comma(to, radius * e->unit));
}

vs_emit_status vs_povray_cylinder(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const struct vs_cylinder *c = VS_AS(cylinder, ref->node);
  return c->segments > 0 ? VS_LOWER : pov_cylinder(e, c->base, c->top, c->radius);
}

static vs_emit_status pov_cone(vs_emitter *e, vs_vec3 base, double base_radius, vs_vec3 top, double top_radius) {
  /* POV-Ray's cone refuses equal radii, so a cylinder is written then. */
  if (base_radius == top_radius) return pov_cylinder(e, base, top, base_radius);
  char *to = POV_BEGIN(e, "cone { ");
  if (to == NULL) return VS_FAILED;
  to = pov_write_point(to, pov_at(e, base));
  to = pov_write_comma(to, base_radius * e->unit);
  to = pov_write_comma_point(to, pov_at(e, top));
  return pov_finish(e, pov_write_comma(to, top_radius * e->unit));
}

vs_emit_status vs_povray_cone(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const struct vs_cone *c = VS_AS(cone, ref->node);
  return c->segments > 0 ? VS_LOWER : pov_cone(e, c->base, c->radius, c->apex, 0);
}

vs_emit_status vs_povray_cut_cone(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const struct vs_cut_cone *c = VS_AS(cut_cone, ref->node);
  return c->segments > 0 ? VS_LOWER : pov_cone(e, c->base, c->base_radius, c->top, c->top_radius);
}

vs_emit_status vs_povray_e_cone(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const struct vs_e_cone *c = VS_AS(e_cone, ref->node);
  if (c->segments > 0) return VS_LOWER;
  vs_vec3 axis = vs_v3_sub(c->top, c->base);
  vs_affine place = vs_frame_on_axis(c->base, axis),
            wide = vs_affine_scaling(vs_v3(0, 0, 0), vs_v3(1, c->base_across / c->base_radius, 1));
  place = vs_affine_multiply(&place, &wide);
  bool equal = c->base_radius == c->top_radius; /* POV-Ray's cone refuses equal radii, so a cylinder is written then */
  pov_open(e, equal ? "cylinder { <0, 0, 0>" : "cone { <0, 0, 0>");
  if (!equal) pov_comma(e, c->base_radius * e->unit);
  pov_comma_point(e, vs_v3(0, 0, vs_v3_length(axis) * e->unit));
  pov_comma(e, c->top_radius * e->unit);
  vs_puts(e->out, " ");
  pov_matrix(e, &place);
  return pov_close(e, " }\n");
}

/* POV-Ray's exponents have the same meaning as the model's. For exponents outside these bounds POV-Ray's solver leaves
 * holes, so the object is written as triangles. */
vs_emit_status vs_povray_superellipsoid(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const struct vs_superellipsoid *s = VS_AS(superellipsoid, ref->node);
  const double least = 0.1, most = 2;
  if (s->segments > 0 || s->e < least || s->n < least || s->e > most || s->n > most) return VS_LOWER;
  pov_open(e, "superellipsoid { <");
  vs_put_number(e->out, s->e);
  pov_comma(e, s->n);
  vs_puts(e->out, "> scale ");
  vs_put_number(e->out, s->size * e->unit);
  return pov_close(e, " }\n");
}

vs_emit_status vs_povray_torus(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const struct vs_torus *t = VS_AS(torus, ref->node);
  if (t->segments > 0) return VS_LOWER;
  pov_open(e, "torus { ");
  vs_put_number(e->out, t->radius * e->unit);
  pov_comma(e, t->tube_radius * e->unit);
  vs_puts(e->out, " rotate 90*x translate ");
  pov_point(e, pov_at(e, t->center));
  return pov_close(e, " }\n");
}

/* The inside of POV-Ray's plane is the side opposite to its normal. */
vs_emit_status vs_povray_half_space(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const struct vs_half_space *h = VS_AS(half_space, ref->node);
  vs_vec3 out = vs_v3_scale(vs_v3_unit(h->normal), -1);
  pov_open(e, "plane { ");
  pov_point(e, out);
  pov_comma(e, vs_v3_dot(out, h->point) * e->unit);
  return pov_close(e, " }\n");
}

/* ---- curves and regions ---- */

/* Returns the radius of a curve at the point p. Inside a template, whose places are not known here, it is the radius at
 * the far end of the drawing. */
static double pov_pen_radius(const vs_emitter *e, vs_vec3 p) {
  double depth = vs_v3_dot(vs_v3_sub(vs_affine_point(&e->placement, p), e->pen.eye), e->pen.forward);
  double size = cbrt(fabs(vs_affine_determinant(&e->placement)));
  if (e->body != NULL) {
    vs_vec3 middle = vs_v3_scale(vs_v3_add(e->bounds.min, e->bounds.max), 0.5);
    depth = vs_v3_dot(vs_v3_sub(middle, e->pen.eye), e->pen.forward) + vs_bounds_diagonal(&e->bounds) / 2;
  }
  return fmax(e->pen.share * depth, e->pen.least) / (size > 0 ? size : 1);
}

vs_emit_status vs_povray_line(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const struct vs_line *l = VS_AS(line, ref->node);
  uint32_t count = l->points->count, pieces = l->closed ? count : count - 1;
  if (count == 0 || !(vs_bounds_diagonal(&e->bounds) > 0)) return VS_EMITTED;
  pov_open(e, "union {\n");
  e->depth++;
  double first = pov_pen_radius(e, l->points->at[0]), here = first;
  for (uint32_t i = 0; i < count; i++) {
    vs_vec3 a = l->points->at[i], b = l->points->at[(i + 1) % count];
    double next = i + 1 < count ? pov_pen_radius(e, b) : first;
    pov_sphere(e, a, here);
    if (i < pieces && vs_v3_length(vs_v3_sub(b, a)) > 1e-6 * here) pov_cone(e, a, here, b, next);
    here = next;
  }
  if (count == 1) pov_sphere(e, l->points->at[0], first); /* POV-Ray warns about a union of a single object */
  e->depth--;
  pov_open(e, "}\n");
  return pov_close(e, "");
}

/* Returns the number of points that describe the loops of an outline, in which each loop repeats its first point at its
 * end. */
static size_t pov_loop_points(const vs_outline *o) {
  size_t count = 0;
  for (size_t i = 0; i < o->count; i++) count += o->loops[i].count + 1;
  return count;
}

static void pov_loops(vs_emitter *e, const vs_outline *o, const vs_affine *back) {
  for (size_t i = 0; i < o->count; i++) {
    vs_puts(e->out, ",\n");
    pov_open(e, "  ");
    for (size_t k = 0; k <= o->loops[i].count; k++) {
      vs_vec3 p = vs_affine_point(back, o->loops[i].at[k % o->loops[i].count]);
      vs_puts(e->out, k == 0 ? "<" : ", <");
      vs_put_number(e->out, p.x * e->unit);
      pov_comma(e, p.y * e->unit);
      vs_puts(e->out, ">");
    }
  }
  vs_puts(e->out, "\n");
}

vs_emit_status vs_povray_region(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  vs_outline o = { .count = 0 };
  if (!vs_region_outline(ref->node, &e->facets, &o, e->error)) return VS_FAILED;
  vs_affine plane = vs_frame_on_axis(o.point, o.normal), back;
  if (o.count > 0 && vs_affine_invert(&plane, &back)) {
    pov_open(e, "polygon { ");
    vs_put_u32(e->out, (uint32_t)pov_loop_points(&o));
    pov_loops(e, &o, &back);
    pov_open(e, "  ");
    pov_matrix(e, &plane);
    vs_puts(e->out, " }\n");
  }
  vs_outline_free(&o);
  return pov_close(e, "");
}

/* Returns true if every loop of the profile consists of straight lines. The solid is then a prism, whose walls are
 * planes. Solids with round walls look better as shaded triangles. */
static bool pov_is_straight(const vs_node *profile) {
  while (profile->kind == VS_TRANSFORM || vs_node_is_wrapper(profile)) profile = profile->children[0].node;
  if (profile->kind == VS_LINE) return true;
  if (profile->kind != VS_REGION || profile->child_count == 0) return false;
  for (size_t i = 0; i < profile->child_count; i++)
    if (profile->children[i].node->kind != VS_LINE) return false;
  return true;
}

/* Returns the circle of the profile if the profile is a circle in the XY plane, or a region with such a circle as its
 * only curve. Otherwise returns NULL. */
static const struct vs_circle *pov_circle(const vs_node *profile) {
  if (profile->kind == VS_REGION && profile->child_count == 1) profile = profile->children[0].node;
  return profile->kind == VS_CIRCLE && VS_AS(circle, profile)->segments == 0 ? VS_AS(circle, profile) : NULL;
}

vs_emit_status vs_povray_extrude(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const vs_node *n = ref->node;
  const struct vs_extrude *x = VS_AS(extrude, n);
  if (n->class_ != VS_SOLID || n->child_count != 1 || x->taper != 0 || x->twist != 0 || x->scale != 1) return VS_LOWER;
  vs_vec3 start = x->center ? vs_v3_scale(x->along, -0.5) : vs_v3(0, 0, 0);
  const struct vs_circle *circle = pov_circle(n->children[0].node);
  if (circle != NULL && x->along.x == 0 && x->along.y == 0) {
    vs_vec3 base = vs_v3_add(circle->center, start);
    return pov_cylinder(e, base, vs_v3_add(base, x->along), circle->radius);
  }
  if (!pov_is_straight(n->children[0].node)) return VS_LOWER;
  vs_outline o = { .count = 0 };
  if (!vs_region_outline(n->children[0].node, &e->facets, &o, e->error)) return VS_FAILED;
  vs_affine plane = vs_frame_on_axis(o.point, o.normal), back;
  if (o.count > 0 && vs_affine_invert(&plane, &back)) {
    /* POV-Ray's prism has its profile in x and z, and rises along y. Therefore this placement maps x to the plane's
     * first axis, y to the direction of the extrusion, and z to the plane's second axis. */
    vs_affine place = plane;
    const double along[] = { x->along.x, x->along.y, x->along.z }, from[] = { start.x, start.y, start.z };
    for (int row = 0; row < 3; row++) {
      place.m[row][1] = along[row] * e->unit;
      place.m[row][2] = plane.m[row][1];
      place.m[row][3] += from[row];
    }
    pov_open(e, "prism { linear_sweep linear_spline 0, 1, ");
    vs_put_u32(e->out, (uint32_t)pov_loop_points(&o));
    pov_loops(e, &o, &back);
    pov_open(e, "  ");
    pov_matrix(e, &place);
    vs_puts(e->out, " }\n");
  }
  vs_outline_free(&o);
  return pov_close(e, "");
}

/* Writes a full revolution of a single loop of straight edges as a lathe. The profile of POV-Ray's lathe is in x and y
 * and rotates about y. Solids with round profiles look better as shaded triangles. */
vs_emit_status vs_povray_revolve(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const vs_node *n = ref->node;
  vs_revolve r;
  if (n->class_ != VS_SOLID || VS_AS(revolve, n)->segments > 0 || !pov_is_straight(n->children[0].node))
    return VS_LOWER;
  if (!vs_revolve_plan(n, &e->facets, &r, e->error)) return VS_FAILED;
  bool fits = r.full && r.loop_count == 1;
  if (fits) {
    pov_open(e, "lathe { linear_spline ");
    vs_put_u32(e->out, (uint32_t)r.count + 1);
    vs_puts(e->out, ",\n");
    pov_open(e, "  ");
    for (size_t i = 0; i <= r.count; i++) {
      vs_puts(e->out, i ? ", <" : "<");
      vs_put_number(e->out, r.profile[i % r.count].x * e->unit);
      pov_comma(e, r.profile[i % r.count].y * e->unit);
      vs_puts(e->out, ">");
    }
    vs_affine place = { { { r.out.x, r.axis.x, -r.side.x, r.at.x },
                          { r.out.y, r.axis.y, -r.side.y, r.at.y },
                          { r.out.z, r.axis.z, -r.side.z, r.at.z } } };
    vs_puts(e->out, "\n");
    pov_open(e, "  ");
    pov_matrix(e, &place);
    vs_puts(e->out, " }\n");
  }
  vs_revolve_free(&r);
  return fits ? pov_close(e, "") : VS_LOWER;
}

/* ---- operations ---- */

vs_emit_status vs_povray_transform(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  const vs_affine *a = &VS_AS(transform, ref->node)->matrix;
  if (phase == VS_PHASE_ENTER) {
    pov_open(e, "object {\n");
    return pov_close(e, "");
  }
  pov_open(e, "  ");
  if (vs_affine_is_translation(a)) {
    vs_puts(e->out, "translate ");
    pov_point(e, pov_at(e, vs_v3(a->m[0][3], a->m[1][3], a->m[2][3])));
  } else {
    pov_matrix(e, a);
  }
  vs_puts(e->out, "\n");
  pov_open(e, "}\n");
  return pov_close(e, "");
}

/* A material of a compound object applies only to parts without a material. POV-Ray gives it to the parts that have
 * none, but in a part that has one, it puts the second material on top of the first. */
vs_emit_status vs_povray_material(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  if (phase == VS_PHASE_ENTER) {
    pov_open(e, "object {\n");
    return pov_close(e, "");
  }
  if (vs_emit_is_bare(e, ref->node->children[0].node)) {
    pov_open(e, "  ");
    vs_povray_paint(e, VS_AS(material, ref->node)->material);
    vs_puts(e->out, "\n");
  }
  pov_open(e, "}\n");
  return pov_close(e, "");
}

vs_emit_status vs_povray_layer(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)ref;
  pov_open(e, phase == VS_PHASE_ENTER ? "object {\n" : "}\n");
  return pov_close(e, "");
}

/* Returns true if the text begins with a keyword of the appearance, such as texture: the text then applies to the
 * node's child. Any other text is an object that replaces the child. */
static bool pov_is_look(const char *text) {
  static const char *const words[] = { "texture",  "pigment", "normal",    "finish", "interior",
                                       "material", "photons", "no_shadow", "hollow" };
  while (*text == ' ' || *text == '\n' || *text == '\t' || *text == '\r') text++;
  for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
    size_t length = strlen(words[i]);
    char next = strncmp(text, words[i], length) == 0 ? text[length] : 'a';
    if (!((next >= 'a' && next <= 'z') || (next >= '0' && next <= '9') || next == '_')) return true;
  }
  return false;
}

vs_emit_status vs_povray_native(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  const char *code = VS_AS(native, ref->node)->code;
  bool look = pov_is_look(code);
  if (phase == VS_PHASE_ENTER) {
    if (look && e->child_count == 0) return VS_WHOLE; /* the child draws nothing, so the text for its appearance is
                                                       * omitted */
    pov_open(e, "object {\n");
    if (look) return pov_close(e, "");
  }
  vs_puts(e->out, code);
  vs_puts(e->out, "\n");
  if (!look && e->unit != 1) {
    pov_open(e, "scale ");
    vs_put_number(e->out, e->unit);
    vs_puts(e->out, "\n");
  }
  pov_open(e, "}\n");
  vs_emit_status done = pov_close(e, "");
  return phase == VS_PHASE_ENTER && done == VS_EMITTED ? VS_WHOLE : done;
}

vs_emit_status vs_povray_csg(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  const vs_node *n = ref->node;
  if (phase == VS_PHASE_LEAVE) {
    /* If a cutter without paint cuts a painted solid, the cut face has the solid's paint. The keyword cutaway_textures
     * does this in POV-Ray, but it makes unpainted parts black, so it is written only if every part of the solid has
     * paint. */
    bool whole = n->kind != VS_DIFFERENCE || !vs_emit_is_bare(e, n->children[0].node);
    if (n->kind != VS_UNION && whole && vs_emit_is_painted(e, n) && vs_emit_is_bare(e, n))
      pov_open(e, "  cutaway_textures\n");
    /* For every ray, POV-Ray tests all parts of a difference, unless the text contains their bounds. An intersection
     * with a box lies inside the box, so the box is also written as bounds. */
    if (n->kind == VS_INTERSECTION && e->in_boolean && n->children[0].node->kind == VS_BOX) {
      const struct vs_box *b = VS_AS(box, n->children[0].node);
      vs_vec3 more = vs_v3_scale(vs_v3_sub(b->q, b->p), 1e-4);
      pov_open(e, "  bounded_by { box { ");
      pov_point(e, pov_at(e, vs_v3_sub(b->p, more)));
      pov_comma_point(e, pov_at(e, vs_v3_add(b->q, more)));
      vs_puts(e->out, " } }\n");
    }
    pov_open(e, "}\n");
    return pov_close(e, "");
  }
  vs_emit_status solid = n->kind == VS_UNION ? VS_LOWER : vs_povray_solid(e, ref);
  if (solid != VS_LOWER) return solid;
  bool clear = e->material != NULL && e->material->transparency > 0 && n->class_ == VS_SOLID && e->child_count <= 200;
  pov_open(e, n->kind == VS_INTERSECTION ? "intersection {\n"
              : n->kind == VS_DIFFERENCE ? "difference {\n"
              : clear                    ? "merge {\n"
                                         : "union {\n");
  return pov_close(e, "");
}

bool vs_povray_define(vs_emitter *e, uint32_t id, const vs_ref *ref, bool open) {
  (void)ref;
  return open ? vs_putf(e->out, "#declare T%lu =\n", (unsigned long)id) : vs_puts(e->out, "\n");
}

bool vs_povray_use(vs_emitter *e, uint32_t id, const vs_ref *ref) {
  (void)ref;
  pov_indent(e);
  bool placed = e->parent != NULL && e->parent->kind == VS_TRANSFORM; /* whether a placement around this node has
                                                                       * already begun the object */
  return vs_puts(e->out, placed ? "T" : "object { T") && vs_emit_put_template_number(e, id) &&
         vs_puts(e->out, placed ? "\n" : " }\n");
}

bool vs_povray_item(vs_emitter *e, size_t index, bool end) {
  (void)index, (void)end;
  return !e->out->failed;
}
