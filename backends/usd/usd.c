/* Writes .usda (Universal Scene Description, as text): shapes as USD's own, other objects as meshes and linear curves.
 * Each template is a class, which its places inherit as instances.
 *
 * A prim is a node of USD's tree. Its name is a word and unique among its siblings: the letters of a layer, or p, and a
 * running number. A material is bound to a prim by a path; a prim without a material inherits the binding of the prims
 * around it. The places of a template inherit the class instead of referencing it, because only then do paths that lead
 * out of the class remain valid. */
#include <math.h>
#include <stdio.h>

#include "backends/backend.h"
#include "backends/lower.h"
#include "backends/shade.h"
#include "geometry/shapes/unit_forms.h"

typedef struct {
  unsigned prims; /* number of prims written so far */
  size_t depth;   /* nesting of prims, for indentation */
} usd;

static void put_indent(vs_emitter *e) {
  const usd *u = e->state;
  vs_put_spaces(e->out, 4 * u->depth);
}

/* Writes a text of the user between quotes. */
static void put_text(vs_writer *w, const char *text) {
  char spelled[VS_SPELLED_ROOM];
  vs_puts(w, "\"");
  for (const char *at = text, *end = text + strlen(text); at < end && !w->failed;) {
    if (*at == '"' || *at == '\\') vs_puts(w, "\\");
    vs_put(w, spelled, vs_spell_line(&at, end, spelled));
  }
  vs_puts(w, "\"");
}

/* Writes a name that begins with the letters and digits of `text`. */
static void put_name(vs_emitter *e, const char *text) {
  usd *u = e->state;
  vs_puts(e->out, "\"");
  if (*text >= '0' && *text <= '9') vs_puts(e->out, "_");
  for (const char *c = text; *c != '\0'; c++) {
    bool plain = (*c >= 'a' && *c <= 'z') || (*c >= 'A' && *c <= 'Z') || (*c >= '0' && *c <= '9');
    vs_put(e->out, plain ? c : "_", 1);
  }
  vs_putf(e->out, "%s%u\"", *text ? "_" : "p", ++u->prims);
}

/* The metadata of a prim. shown: the name that programs display; template: number of the inherited template, or 0;
 * bound: whether the prim has a material; part: whether it is a part of the model. */
typedef struct { const char *shown; uint32_t template; bool bound, part; } prim_notes;

static void put_notes(vs_emitter *e, prim_notes notes) {
  vs_writer *w = e->out;
  if (notes.shown == NULL && notes.template == 0 && !notes.bound) return;
  vs_puts(w, " (\n");
  if (notes.shown != NULL) {
    put_indent(e);
    vs_puts(w, "    displayName = ");
    put_text(w, notes.shown);
    vs_puts(w, "\n");
  }
  if (notes.part) {
    put_indent(e);
    vs_puts(w, "    kind = \"component\"\n");
  }
  if (notes.template > 0) {
    put_indent(e);
    vs_puts(w, "    prepend inherits = </Model/T");
    vs_emit_put_template_number(e, notes.template);
    vs_puts(w, ">\n");
    put_indent(e);
    vs_puts(w, "    instanceable = true\n");
  }
  if (notes.bound) {
    put_indent(e);
    vs_puts(w, "    prepend apiSchemas = [\"MaterialBindingAPI\"]\n");
  }
  put_indent(e);
  vs_puts(w, ")");
}

/* Begins a prim: writes its text up to the opening brace. name: letters with which the prim's name begins. */
static void begin_prim(vs_emitter *e, const char *type, const char *name, prim_notes notes) {
  usd *u = e->state;
  put_indent(e);
  vs_putf(e->out, "def %s ", type);
  put_name(e, name);
  put_notes(e, notes);
  vs_puts(e->out, " {\n");
  u->depth++;
}

static void end_prim(vs_emitter *e) {
  usd *u = e->state;
  u->depth--;
  put_indent(e);
  vs_puts(e->out, "}\n");
}

static void put_binding(vs_emitter *e, const vs_material *m) {
  if (m == NULL) return;
  put_indent(e);
  vs_puts(e->out, "rel material:binding = </Model/Looks/M");
  vs_emit_put_material_number(e, m);
  vs_puts(e->out, ">\n");
}

/* Writes a placement. USD's matrices multiply row vectors, so the matrix is transposed. */
static void put_place(vs_emitter *e, const vs_affine *place) {
  vs_writer *w = e->out;
  if (vs_affine_is_identity(place)) return;
  put_indent(e);
  vs_puts(w, "matrix4d xformOp:transform = (");
  for (int column = 0; column < 4; column++) {
    vs_put_triple(w, column > 0 ? ", (" : " (", vs_affine_column(place, column), ", ", column < 3 ? ", 0)" : ", 1)");
  }
  vs_puts(w, " )\n");
  put_indent(e);
  vs_puts(w, "uniform token[] xformOpOrder = [\"xformOp:transform\"]\n");
}

/* ---- lists ---- */

static void begin_list(vs_emitter *e, const char *head) {
  put_indent(e);
  vs_puts(e->out, head);
  vs_puts(e->out, " = [");
}

static void put_between(vs_writer *w, size_t item, size_t per_line) {
  if (item > 0) vs_puts(w, item % per_line == 0 ? ",\n" : ", ");
}

static void put_points(vs_emitter *e, const char *head, const vs_vec3 *at, size_t count) {
  begin_list(e, head);
  for (size_t i = 0; i < count && !e->out->failed; i++) {
    put_between(e->out, i, 8);
    vs_put_triple(e->out, "(", at[i], ", ", ")");
  }
  vs_puts(e->out, "]\n");
}

static void put_extent(vs_emitter *e, const vs_vec3 *at, size_t count) {
  vs_bounds b = vs_bounds_empty();
  for (size_t i = 0; i < count; i++) vs_bounds_add(&b, at[i]);
  if (count > 0) put_points(e, "float3[] extent", (const vs_vec3[2]){ b.min, b.max }, 2);
}

/* ---- meshes ---- */

static void put_triangles(vs_emitter *e, const vs_mesh *m) {
  vs_writer *w = e->out;
  begin_list(e, "int[] faceVertexCounts");
  for (size_t i = 0; i < m->triangle_count && !w->failed; i++) {
    put_between(w, i, 40);
    vs_puts(w, "3");
  }
  vs_puts(w, "]\n");
  begin_list(e, "int[] faceVertexIndices");
  for (size_t i = 0; i < m->triangle_count && !w->failed; i++) {
    put_between(w, i, 12);
    for (int k = 0; k < 3; k++) {
      if (k > 0) vs_puts(w, ", ");
      vs_put_u32(w, m->triangles[i][k]);
    }
  }
  vs_puts(w, "]\n");
}

/* Writes a normal for each corner of each triangle. */
static bool put_normals(vs_emitter *e, const vs_solid *solid) {
  vs_writer *w = e->out;
  vs_shading s;
  vs_shade_faces faces = vs_shade_mesh(&solid->mesh, vs_shade_crease(true));
  if (!vs_shading_make(e, &faces, &s)) return false;
  begin_list(e, "normal3f[] normals");
  for (size_t i = 0; i < 3 * solid->mesh.triangle_count && !w->failed; i++) {
    vs_vec3 n = s.normals[s.corners[i / 3][i % 3]];
    put_between(w, i, 6);
    vs_put_triple(w, "(", vs_v3(round(1e4 * n.x) / 1e4, round(1e4 * n.y) / 1e4, round(1e4 * n.z) / 1e4), ", ", ")");
  }
  vs_puts(w, "] ( interpolation = \"faceVarying\" )\n");
  vs_shading_free(&s);
  return !w->failed;
}

/* Writes the faces of each material as a subset of the mesh. Faces without a material have the material of the mesh. */
static bool put_subsets(vs_emitter *e, const vs_solid *solid) {
  const vs_mesh *m = &solid->mesh;
  vs_writer *w = e->out;
  for (size_t paint = 1; paint <= vs_emit_material_count(e) && m->tags != NULL && !w->failed; paint++) {
    bool open = false, found = false;
    size_t count = 0;
    for (size_t k = 0; k < solid->part_count && !found; k++)
      found = vs_emit_material_number(e, solid->parts[k].material) == paint;
    for (size_t i = 0; found && i < m->triangle_count && !w->failed; i++) {
      uint32_t tag = m->tags[i];
      if (tag >= solid->part_count || vs_emit_material_number(e, solid->parts[tag].material) != paint) continue;
      if (!open) {
        begin_prim(e, "GeomSubset", "", (prim_notes){ .bound = true });
        put_indent(e);
        vs_puts(w, "uniform token elementType = \"face\"\n");
        put_indent(e);
        vs_puts(w, "uniform token familyName = \"materialBind\"\n");
        put_binding(e, solid->parts[tag].material);
        begin_list(e, "int[] indices");
        open = true;
      }
      put_between(w, count++, 24);
      vs_put_u32(w, (uint32_t)i);
      if (!vs_emit_going(e, i)) return false;
    }
    if (open) {
      vs_puts(w, "]\n");
      end_prim(e);
    }
  }
  return !w->failed;
}

static bool put_mesh(vs_emitter *e, const vs_ref *ref, bool round_) {
  const vs_solid *m = vs_emit_mesh(e, ref);
  if (m == NULL || !vs_emit_triangles(e, m->mesh.triangle_count)) return false;
  if (m->mesh.triangle_count == 0) return true;
  begin_prim(e, "Mesh", "", (prim_notes){ .bound = e->material != NULL });
  put_indent(e);
  vs_puts(e->out, "uniform token subdivisionScheme = \"none\"\n");
  put_indent(e);
  vs_puts(e->out, "uniform bool doubleSided = 1\n");
  put_triangles(e, &m->mesh);
  put_points(e, "point3f[] points", m->mesh.vertices, m->mesh.vertex_count);
  put_extent(e, m->mesh.vertices, m->mesh.vertex_count);
  if (round_ && !put_normals(e, m)) return false;
  put_binding(e, e->material);
  put_place(e, &e->placement);
  if (!put_subsets(e, m)) return false;
  end_prim(e);
  return !e->out->failed;
}

/* ---- shapes ---- */

/* Writes a shape of USD at the placement of a unit form. Returns false if USD has no such shape. */
static bool put_shape(vs_emitter *e, const vs_node *n) {
  static const struct { const char *type, *fields; } shapes[VS_UNIT_COUNT] = {
    [VS_UNIT_BOX] = { "Cube", "double size = 2" },
    [VS_UNIT_SPHERE] = { "Sphere", "double radius = 1" },
    [VS_UNIT_CYLINDER] = { "Cylinder", "uniform token axis = \"Z\"\ndouble height = 2\ndouble radius = 1" },
    [VS_UNIT_CONE] = { "Cone", "uniform token axis = \"Z\"\ndouble height = 2\ndouble radius = 1" },
  };
  vs_unit_copy copy;
  if (!vs_unit_of(n, &e->facets, &copy) || copy.faceted || shapes[copy.unit].type == NULL) return false;
  vs_affine place = vs_affine_multiply(&e->placement, &copy.place);
  begin_prim(e, shapes[copy.unit].type, "", (prim_notes){ .bound = e->material != NULL });
  put_indent(e);
  for (const char *c = shapes[copy.unit].fields; *c != '\0'; c++) {
    vs_put(e->out, c, 1);
    if (*c == '\n') put_indent(e);
  }
  vs_puts(e->out, "\n");
  put_points(e, "float3[] extent", (const vs_vec3[2]){ { -1, -1, -1 }, { 1, 1, 1 } }, 2);
  put_binding(e, e->material);
  put_place(e, &place);
  end_prim(e);
  return true;
}

static vs_emit_status usd_leaf(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  bool ok = put_shape(e, ref->node) || put_mesh(e, ref, vs_lower_is_round(ref->node));
  return ok && !e->out->failed ? VS_EMITTED : VS_FAILED;
}

static vs_emit_status usd_boolean(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  if (phase != VS_PHASE_ENTER) return VS_EMITTED;
  return put_mesh(e, ref, true) ? VS_WHOLE : VS_FAILED;
}

static vs_emit_status usd_line(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const struct vs_line *l = VS_AS(line, ref->node);
  uint32_t count = l->points->count;
  if (count < 2) return VS_EMITTED;
  begin_prim(e, "BasisCurves", "", (prim_notes){ .bound = e->material != NULL });
  put_indent(e);
  vs_puts(e->out, "uniform token type = \"linear\"\n");
  put_indent(e);
  vs_puts(e->out, l->closed ? "uniform token wrap = \"periodic\"\n" : "uniform token wrap = \"nonperiodic\"\n");
  begin_list(e, "int[] curveVertexCounts");
  vs_put_u32(e->out, count);
  vs_puts(e->out, "]\n");
  put_points(e, "point3f[] points", l->points->at, count);
  put_extent(e, l->points->at, count);
  begin_list(e, "float[] widths");
  vs_put_number(e->out, vs_bounds_diagonal(&e->bounds) / 1000);
  vs_puts(e->out, "] ( interpolation = \"constant\" )\n");
  put_binding(e, e->material);
  put_place(e, &e->placement);
  end_prim(e);
  return e->out->failed ? VS_FAILED : VS_EMITTED;
}

/* Does nothing for placements and paint, because the emitter contains them while shapes are written. A layer or a
 * part is a prim around its objects. */
static vs_emit_status usd_through(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  bool part = ref->node->kind == VS_PART;
  if (!part && ref->node->kind != VS_LAYER) return VS_EMITTED;
  const char *name = part ? VS_AS(part, ref->node)->name : VS_AS(layer, ref->node)->name;
  if (phase == VS_PHASE_LEAVE) end_prim(e);
  else begin_prim(e, "Xform", name, (prim_notes){ .shown = name, .part = part });
  return e->out->failed ? VS_FAILED : VS_EMITTED;
}

/* ---- templates ---- */

static bool usd_define(vs_emitter *e, uint32_t id, const vs_ref *ref, bool open) {
  usd *u = e->state;
  (void)ref;
  if (!open) {
    end_prim(e);
    return !e->out->failed;
  }
  put_indent(e);
  vs_putf(e->out, "class Xform \"T%lu\" {\n", (unsigned long)id);
  u->depth++;
  return !e->out->failed;
}

static bool usd_use(vs_emitter *e, uint32_t id, const vs_ref *ref) {
  (void)ref;
  begin_prim(e, "Xform", "", (prim_notes){ .template = id, .bound = e->material != NULL });
  put_binding(e, e->material);
  put_place(e, &e->placement);
  end_prim(e);
  return !e->out->failed;
}

/* ---- the file ---- */

static void put_number_field(vs_emitter *e, const char *head, double x) {
  put_indent(e);
  vs_puts(e->out, head);
  vs_puts(e->out, " = ");
  vs_put_number(e->out, x);
  vs_puts(e->out, "\n");
}

static void put_material(vs_emitter *e, size_t number) {
  const vs_material *m = vs_emit_material_at(e, number);
  vs_writer *w = e->out;
  usd *u = e->state;
  put_indent(e);
  vs_putf(w, "def Material \"M%zu\"", number);
  put_notes(e, (prim_notes){ .shown = m->name[0] != '\0' ? m->name : NULL });
  vs_puts(w, " {\n");
  u->depth++;
  put_indent(e);
  vs_putf(w, "token outputs:surface.connect = </Model/Looks/M%zu/Shader.outputs:surface>\n", number);
  put_indent(e);
  vs_puts(w, "def Shader \"Shader\" {\n");
  u->depth++;
  put_indent(e);
  vs_puts(w, "uniform token info:id = \"UsdPreviewSurface\"\n");
  put_indent(e);
  vs_put_triple(w, "color3f inputs:diffuseColor = (", vs_linear_color(vs_v3(m->red, m->green, m->blue)), ", ", ")\n");
  put_number_field(e, "float inputs:roughness", m->roughness);
  put_number_field(e, "float inputs:metallic", m->metallic);
  put_number_field(e, "float inputs:opacity", 1 - 0.8 * m->transparency);
  put_indent(e);
  vs_puts(w, "token outputs:surface\n");
  end_prim(e);
  end_prim(e);
}

static bool has_parts(const vs_emitter *e) {
  for (size_t i = 0; i < e->scene->drawn_count; i++)
    if (e->scene->drawn[i].node->kind == VS_PART) return true;
  return false;
}

static bool usd_begin(vs_emitter *e) {
  vs_writer *w = e->out;
  usd *u = vs_store_realloc(e->scene->store, NULL, 0, sizeof *u);
  if (u == NULL) return vs_emit_no_memory(e);
  *u = (usd){ .depth = 1 };
  e->state = u;
  if (e->scene->has_ground && !vs_emit_warn_once(e, NULL, "USD: the ground is omitted")) return false;
  vs_puts(w, "#usda 1.0\n(\n    defaultPrim = \"Model\"\n    metersPerUnit = ");
  vs_put_number(w, vs_scene_metres(e->scene));
  vs_puts(w, "\n    upAxis = \"");
  vs_puts(w, e->options->up_y ? "Y" : "Z");
  vs_puts(w, "\"\n)\n\ndef Xform \"Model\" (\n    kind = \"");
  vs_puts(w, has_parts(e) ? "assembly" : "component");
  vs_puts(w, "\"\n    displayName = ");
  put_text(w, e->scene->title);
  vs_puts(w, "\n) {\n");
  put_points(e, "color3f[] primvars:displayColor", (const vs_vec3[1]){ vs_linear_color(vs_v3(0.86, 0.85, 0.83)) }, 1);
  put_indent(e);
  vs_puts(w, "def Scope \"Looks\" {\n");
  u->depth++;
  for (size_t i = 1; i <= vs_emit_material_count(e) && !w->failed; i++) {
    if (vs_emit_material_at(e, i)->pattern.picture != NULL &&
        !vs_emit_warn_once(e, NULL, "USD: pictures on surfaces are omitted"))
      return false;
    put_material(e, i);
  }
  end_prim(e);
  return !w->failed;
}

static bool usd_end(vs_emitter *e) {
  vs_puts(e->out, "}\n");
  return !e->out->failed;
}

static void usd_close(vs_emitter *e) {
  if (e->state != NULL) vs_emit_release(e, e->state, 1, sizeof(usd));
  e->state = NULL;
}

const vs_backend vs_backend_usda = { .begin = usd_begin, .end = usd_end, .close = usd_close,
                                     .define = usd_define, .use = usd_use, .traits = VS_TURNS | VS_UNITS | VS_NAMES,
                                     VS_EMIT_SHAPES(usd_leaf, usd_line, usd_through, usd_boolean) };
