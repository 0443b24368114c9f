/* Writes AutoLISP programs for AutoCAD. An expression makes each object: calls of the functions of definitions.lsp,
 * nested as the operations of the drawing. A solid that AutoCAD has no command for becomes a mesh, which CONVTOSOLID
 * converts. */
#include <math.h>
#include <string.h>

#include "backends/backend.h"
#include "backends/lower.h"
#include "geometry/plane/outline.h"
#include "geometry/plane/planar_evaluation.h"

/* definitions.lsp: a function for each kind of solid. Each returns the entity that it made, or nil if nothing is left.
 * vs:color and vs:layer are parameters of the lambdas around a painted part. The scope of AutoLISP is dynamic, so the
 * innermost lambda determines the look. */
extern const char vs_asset_definitions_lsp[], vs_asset_definitions_lsp_end[];

static vs_emit_status lisp_done(vs_emitter *e) { return e->out->failed ? VS_FAILED : VS_EMITTED; }

static void lisp_open(vs_emitter *e, const char *text) {
  vs_put_spaces(e->out, 2 * (e->depth < 40 ? e->depth : 40));
  vs_puts(e->out, text);
}
static void lisp_number(vs_emitter *e, double x) {
  vs_puts(e->out, " ");
  vs_put_number(e->out, x);
}
static void lisp_point(vs_emitter *e, vs_vec3 p) { vs_put_triple(e->out, " '(", p, " ", ")"); }
static vs_emit_status lisp_close(vs_emitter *e) {
  vs_puts(e->out, ")\n");
  return lisp_done(e);
}

/* ---- primitives: a given number of facets needs a mesh ---- */

static vs_emit_status lisp_corners(vs_emitter *e, const char *open, vs_vec3 p, vs_vec3 q) {
  lisp_open(e, open);
  lisp_point(e, p);
  lisp_point(e, q);
  return lisp_close(e);
}
static vs_emit_status lisp_box(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const struct vs_box *b = VS_AS(box, ref->node);
  return lisp_corners(e, "(vs:box", b->p, b->q);
}
static vs_emit_status lisp_wedge(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const struct vs_wedge *w = VS_AS(wedge, ref->node);
  return lisp_corners(e, "(vs:wedge", w->p, w->q);
}
static vs_emit_status lisp_sphere(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const struct vs_sphere *s = VS_AS(sphere, ref->node);
  if (s->segments > 0) return VS_LOWER;
  lisp_open(e, "(vs:sphere");
  lisp_point(e, s->center);
  lisp_number(e, s->radius);
  return lisp_close(e);
}
static vs_emit_status lisp_torus(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const struct vs_torus *t = VS_AS(torus, ref->node);
  if (t->segments > 0 || t->tube_radius >= t->radius) return VS_LOWER;
  lisp_open(e, "(vs:torus");
  lisp_point(e, t->center);
  lisp_number(e, t->radius);
  lisp_number(e, t->tube_radius);
  return lisp_close(e);
}
static vs_emit_status lisp_turned(vs_emitter *e, const char *open, vs_vec3 base, double radius, vs_vec3 top) {
  lisp_open(e, open);
  lisp_point(e, base);
  lisp_number(e, radius);
  lisp_point(e, top);
  return lisp_close(e);
}
static vs_emit_status lisp_cylinder(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const struct vs_cylinder *c = VS_AS(cylinder, ref->node);
  return c->segments > 0 ? VS_LOWER : lisp_turned(e, "(vs:cylinder", c->base, c->radius, c->top);
}
static vs_emit_status lisp_cone(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const struct vs_cone *c = VS_AS(cone, ref->node);
  return c->segments > 0 ? VS_LOWER : lisp_turned(e, "(vs:cone", c->base, c->radius, c->apex);
}
static vs_emit_status lisp_cut_cone(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const struct vs_cut_cone *c = VS_AS(cut_cone, ref->node);
  if (c->segments > 0) return VS_LOWER;
  if (c->top_radius == 0) return lisp_turned(e, "(vs:cone", c->base, c->base_radius, c->top);
  if (c->base_radius == 0) return lisp_turned(e, "(vs:cone", c->top, c->top_radius, c->base);
  if (c->base_radius == c->top_radius) return lisp_turned(e, "(vs:cylinder", c->base, c->base_radius, c->top);
  lisp_open(e, "(vs:cut-cone");
  lisp_point(e, c->base);
  lisp_number(e, c->base_radius);
  lisp_number(e, c->top_radius);
  lisp_point(e, c->top);
  return lisp_close(e);
}

/* ---- meshes ---- */

static void lisp_wrap(vs_emitter *e, size_t item, size_t per_line) {
  if (item > 0) vs_puts(e->out, item % per_line == 0 ? "\n " : " ");
}
static void lisp_points(vs_emitter *e, const vs_vec3 *points, size_t count) {
  lisp_open(e, "(vs:mesh '(");
  for (size_t i = 0; i < count; i++) {
    lisp_wrap(e, i, 6);
    vs_put_triple(e->out, "(", points[i], " ", ")");
  }
  vs_puts(e->out, ")\n '(");
}
static vs_emit_status lisp_polyface(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const struct vs_polyface_mesh *p = VS_AS(polyface_mesh, ref->node);
  const uint32_t *starts = vs_faces_starts(p->faces), *corners = vs_faces_corners(p->faces);
  if (!vs_emit_triangles(e, p->faces->corner_count - 2 * (size_t)p->faces->count)) return VS_FAILED;
  lisp_points(e, p->points->at, p->points->count);
  for (size_t i = 0; i < p->faces->count; i++) {
    lisp_wrap(e, i, 10);
    vs_put_u32(e->out, starts[i + 1] - starts[i]);
    for (uint32_t k = starts[i]; k < starts[i + 1]; k++) {
      vs_puts(e->out, " ");
      vs_put_u32(e->out, corners[k]);
    }
  }
  vs_puts(e->out, "))\n");
  return lisp_done(e);
}

/* Writes a straight vertical prism on one polygon as EXTRUDE writes it. */
static vs_emit_status lisp_extrude(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const vs_node *n = ref->node, *profile = n->children[0].node;
  const struct vs_extrude *x = VS_AS(extrude, n);
  if (n->child_count != 1 || x->taper != 0 || x->twist != 0 || x->scale != 1) return VS_LOWER;
  if (x->along.x != 0 || x->along.y != 0 || !(x->along.z > 0)) return VS_LOWER;
  double start = x->center ? -0.5 * x->along.z : 0;
  if (profile->kind == VS_REGION && profile->child_count == 1) profile = profile->children[0].node;
  if (profile->kind == VS_CIRCLE) {
    const struct vs_circle *c = VS_AS(circle, profile);
    if (c->segments > 0) return VS_LOWER;
    vs_vec3 base = vs_v3_add(c->center, vs_v3(0, 0, start));
    return lisp_turned(e, "(vs:cylinder", base, c->radius, vs_v3_add(base, x->along));
  }
  vs_outline o = { .count = 0 };
  if (!vs_region_outline(n->children[0].node, &e->facets, &o, e->error)) return VS_FAILED;
  bool fits = o.count == 1 && o.normal.x == 0 && o.normal.y == 0;
  if (fits) {
    lisp_open(e, "(vs:prism");
    lisp_number(e, o.point.z + start);
    lisp_number(e, x->along.z);
    vs_puts(e->out, " '(");
    for (size_t k = 0; k < o.loops[0].count; k++) {
      lisp_wrap(e, k, 8);
      vs_puts(e->out, "(");
      vs_put_number(e->out, o.loops[0].at[k].x);
      lisp_number(e, o.loops[0].at[k].y);
      vs_puts(e->out, ")");
    }
    vs_puts(e->out, "))\n");
  }
  vs_outline_free(&o);
  return fits ? lisp_done(e) : VS_LOWER;
}

/* ---- placements, looks, booleans, shared parts ---- */

/* Writes a node as one mesh: AutoCAD does not scale solids unevenly. */
static vs_emit_status lisp_whole(vs_emitter *e, const vs_ref *ref) {
  const vs_solid *s = vs_emit_mesh(e, ref);
  if (s == NULL || !vs_emit_triangles(e, s->mesh.triangle_count)) return VS_FAILED;
  if (s->mesh.triangle_count == 0) {
    lisp_open(e, "nil\n");
  } else {
    lisp_points(e, s->mesh.vertices, s->mesh.vertex_count);
    for (size_t i = 0; i < s->mesh.triangle_count; i++) {
      lisp_wrap(e, i, 10);
      vs_puts(e->out, "3");
      for (int k = 0; k < 3; k++) {
        vs_puts(e->out, " ");
        vs_put_u32(e->out, s->mesh.triangles[i][k]);
      }
    }
    vs_puts(e->out, "))\n");
  }
  return e->out->failed ? VS_FAILED : VS_WHOLE;
}

static vs_emit_status lisp_transform(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  if (phase == VS_PHASE_LEAVE) {
    lisp_open(e, ")\n");
    return lisp_done(e);
  }
  const vs_affine *a = &VS_AS(transform, ref->node)->matrix;
  double size, q[4];
  if (!vs_affine_even(a, &size)) return lisp_whole(e, ref);
  bool mirror = vs_affine_determinant(a) < 0;
  vs_vec3 columns[3];
  for (int i = 0; i < 3; i++) columns[i] = vs_v3_scale(vs_affine_column(a, i), (i == 2 && mirror ? -1 : 1) / size);
  vs_rotation_quaternion(columns, q);
  vs_vec3 axis = vs_v3(q[1], q[2], q[3]);
  double sine = vs_v3_length(axis), degrees = 2 * atan2(sine, q[0]) * (180 / 3.14159265358979323846);
  lisp_open(e, mirror ? "(vs:place t" : "(vs:place nil");
  lisp_number(e, size);
  lisp_point(e, sine > 0 ? vs_v3_scale(axis, 1 / sine) : vs_v3(0, 0, 1));
  lisp_number(e, sine > 0 ? degrees : 0);
  lisp_point(e, vs_affine_column(a, 3));
  vs_puts(e->out, "\n");
  return lisp_done(e);
}

static vs_emit_status lisp_material(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  if (phase != VS_PHASE_LEAVE) {
    lisp_open(e, "((lambda (vs:color)\n");
    return lisp_done(e);
  }
  const vs_material *m = VS_AS(material, ref->node)->material;
  lisp_open(e, ") \"");
  const double parts[] = { m->red, m->green, m->blue };
  for (int i = 0; i < 3; i++) vs_putf(e->out, i > 0 ? ",%d" : "%d", (int)lround(255 * fmin(1, fmax(0, parts[i]))));
  vs_puts(e->out, "\")\n");
  return lisp_done(e);
}

/* Writes a layer's name. AutoCAD refuses some ASCII characters in it; they become hyphens. */
static size_t lisp_spell(const char **at, const char *end, char out[VS_SPELLED_ROOM]) {
  char c = **at;
  if (c == '\0' || (c > 0 && (c < ' ' || c == 127 || strchr("<>/\\\":;?*|=,`", c) != NULL))) {
    out[0] = '-';
    ++*at;
    return 1;
  }
  return vs_spell_line(at, end, out);
}
static vs_emit_status lisp_layer(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  if (phase != VS_PHASE_LEAVE) {
    lisp_open(e, "((lambda (vs:layer)\n");
    return lisp_done(e);
  }
  const char *name = VS_AS(layer, ref->node)->name;
  lisp_open(e, ") (vs:new-layer \"");
  vs_put_spelled(e->out, lisp_spell, name[0] != '\0' ? name : "-");
  vs_puts(e->out, "\"))\n");
  return lisp_done(e);
}

static vs_emit_status lisp_csg(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  if (phase == VS_PHASE_LEAVE) {
    lisp_open(e, "))\n");
    return lisp_done(e);
  }
  lisp_open(e, ref->node->kind == VS_UNION          ? "(vs:union (list\n"
               : ref->node->kind == VS_INTERSECTION ? "(vs:intersect (list\n"
                                                    : "(vs:subtract (list\n");
  return lisp_done(e);
}

static bool lisp_define(vs_emitter *e, uint32_t id, const vs_ref *ref, bool open) {
  (void)ref;
  return open ? vs_putf(e->out, "(defun vs:part%lu ()\n", (unsigned long)id) : vs_puts(e->out, ")\n\n");
}
static bool lisp_use(vs_emitter *e, uint32_t id, const vs_ref *ref) {
  (void)ref;
  lisp_open(e, "(vs:part");
  vs_emit_put_template_number(e, id);
  return vs_puts(e->out, ")\n");
}
static bool lisp_begin(vs_emitter *e) {
  vs_puts(e->out, "; ");
  vs_put_spelled(e->out, vs_spell_line, e->scene->title); /* escapes line breaks, which would end the comment */
  vs_puts(e->out, ": a program for AutoCAD, made by VisualScheme\n\n");
  return vs_put(e->out, vs_asset_definitions_lsp, (size_t)(vs_asset_definitions_lsp_end - vs_asset_definitions_lsp));
}
static bool lisp_end(vs_emitter *e) {
  return vs_puts(e->out, "\n(command \"_.UCS\" \"_Previous\")\n(mapcar 'setvar vs:kept vs:before)\n(princ)\n");
}

const vs_backend vs_backend_autolisp = {
  .begin = lisp_begin, .end = lisp_end, .define = lisp_define, .use = lisp_use, .traits = VS_KEEPS_TEXT,
  .omit = { [VS_CURVE] = "AutoLISP programs hold solids: curves are omitted",
            [VS_REGION_CLASS] = "AutoLISP programs hold solids: flat regions are omitted",
            [VS_SURFACE] = "AutoLISP programs hold solids: open surfaces are omitted" },
  .emit = {
    [VS_BOX] = { lisp_box, NULL }, [VS_WEDGE] = { lisp_wedge, NULL }, [VS_SPHERE] = { lisp_sphere, NULL },
    [VS_CYLINDER] = { lisp_cylinder, NULL }, [VS_CONE] = { lisp_cone, NULL }, [VS_CUT_CONE] = { lisp_cut_cone, NULL },
    [VS_TORUS] = { lisp_torus, NULL }, [VS_POLYFACE_MESH] = { lisp_polyface, NULL },
    [VS_EXTRUDE] = { lisp_extrude, NULL }, [VS_TRANSFORM] = { lisp_transform, NULL },
    [VS_MATERIAL] = { lisp_material, NULL }, [VS_LAYER] = { lisp_layer, NULL }, [VS_UNION] = { lisp_csg, NULL },
    [VS_INTERSECTION] = { lisp_csg, NULL }, [VS_DIFFERENCE] = { lisp_csg, NULL },
  },
};
