/* Writes the contents of an X3D scene: the model rotated to Y up, view, light, background and materials. Also contains
 * the two formats that consist of the scene alone.
 *
 * Coordinates of triangle sets are rounded to a decimal step near 1e-7 of the drawing, normals to 1e-3. Viewers store
 * them as 32-bit numbers, and a page half the size opens twice as fast. */
#include "backends/x3d/x3d_scene.h"

#include <math.h>
#include <stdio.h>

#include "backends/view.h"
#include "backends/x3d/bake.h"
#include "backends/x3d/x3d_collect.h"
#include "backends/x3d/x3d_notation.h"

static const double half_turn = 3.14159265358979323846;

/* ---- small conversions ---- */

static vs_vec3 scene_up_y(vs_vec3 v) { return vs_v3(v.x, v.z, -v.y); }

static double scene_axis(const double q[4], vs_vec3 *axis) {
  double sine = sqrt(q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (sine < 1e-12 * fabs(q[0])) {
    *axis = vs_v3(0, 0, 1);
    return 0;
  }
  *axis = vs_v3_scale(vs_v3(q[1], q[2], q[3]), 1 / sine);
  double angle = 2 * atan2(sine, q[0]);
  return angle > half_turn ? angle - 2 * half_turn : angle;
}

/* ---- materials ----
 *
 * Uses Material, not X3D 4's PhysicalMaterial, whose light comes from the pictures of an EnvironmentLight. Without such
 * pictures, X_ITE shows metal in black, and all other materials at half their brightness. */

static void scene_picture(vs_emitter *e, const vs_picture *p) {
  vs_x3d_node(e, "texture", "ImageTexture", NULL);
  vs_x3d_field(e, "url", true);
  vs_puts(e->out, "\"data:image/");
  vs_puts(e->out, p->format);
  vs_puts(e->out, ";base64,");
  vs_put_base64(e->out, p->bytes, p->size);
  vs_puts(e->out, "\"");
  vs_x3d_field_end(e, true);
  vs_x3d_end(e, "ImageTexture", false);
}

static void scene_appearance(vs_emitter *e, size_t number, bool *said, bool line) {
  char name[32];
  snprintf(name, sizeof name, "%s%zu", line ? "L" : "M", number);
  if (*said) {
    vs_x3d_use(e, "appearance", "Appearance", name);
    return;
  }
  *said = true;
  const vs_material *m = number > 0 ? vs_emit_material_at(e, number) : NULL;
  vs_vec3 color = m != NULL ? vs_v3(m->red, m->green, m->blue)
                  : line    ? vs_v3(0.15, 0.18, 0.22)
                            : vs_v3(0.86, 0.85, 0.83);
  double gloss = m != NULL ? 1 - m->roughness : 0.1;
  vs_x3d_node(e, "appearance", "Appearance", name);
  vs_x3d_node(e, "material", "Material", NULL);
  if (line) {
    vs_x3d_vector(e, "diffuseColor", vs_v3(0, 0, 0));
    vs_x3d_vector(e, "emissiveColor", color);
  } else {
    bool metal = m != NULL && m->metallic > 0.5;
    vs_x3d_vector(e, "diffuseColor", metal ? vs_v3_scale(color, 0.8) : color);
    vs_x3d_vector(e, "specularColor",
                  metal ? vs_v3_scale(color, 0.25 + 0.5 * gloss) : vs_v3_scale(vs_v3(1, 1, 1), 0.45 * gloss * gloss));
    vs_x3d_number(e, "shininess", 0.05 + 0.75 * gloss * gloss);
    vs_x3d_number(e, "ambientIntensity", 0.9);
    if (m != NULL && m->transparency > 0) vs_x3d_number(e, "transparency", 0.72 * m->transparency);
  }
  vs_x3d_end(e, "Material", false);
  if (m != NULL && m->pattern.picture != NULL && !line) scene_picture(e, m->pattern.picture);
  vs_x3d_end(e, "Appearance", false);
}

/* ---- shapes ---- */

/* Returns true if the fields of the form can express these half sizes. Otherwise the scale of the Transform expresses
 * them, and the form has unit size. */
static bool scene_fits(vs_x3d_form form, vs_vec3 size) {
  bool even = fabs(size.x - size.z) < 1e-9 * size.x;
  return form == VS_X3D_BOX || (even && (form != VS_X3D_SPHERE || fabs(size.x - size.y) < 1e-9 * size.x));
}

static void scene_form(vs_emitter *e, vs_x3d_form form, vs_vec3 size) {
  static const char *const words[] = {
    [VS_X3D_BOX] = "Box", [VS_X3D_SPHERE] = "Sphere", [VS_X3D_CYLINDER] = "Cylinder", [VS_X3D_CONE] = "Cone"
  };
  vs_x3d_node(e, "geometry", words[form], NULL);
  switch (form) {
  case VS_X3D_BOX: vs_x3d_vector(e, "size", vs_v3_scale(size, 2)); break;
  case VS_X3D_SPHERE: vs_x3d_number(e, "radius", size.x); break;
  case VS_X3D_CYLINDER: case VS_X3D_CONE:
    vs_x3d_number(e, form == VS_X3D_CONE ? "bottomRadius" : "radius", size.x);
    vs_x3d_number(e, "height", 2 * size.y);
    break;
  }
  vs_x3d_end(e, words[form], false);
}

/* Begins a Transform with the placement. scaled: the Transform also scales by `size`, because the form has no fields
 * for it. */
static void scene_place(vs_emitter *e, const vs_affine *place, vs_vec3 size, bool scaled) {
  vs_vec3 at, unread, axis;
  double turn[4];
  vs_affine_split(place, &at, turn, &unread);
  double angle = scene_axis(turn, &axis);
  vs_x3d_node(e, NULL, "Transform", NULL);
  vs_x3d_vector(e, "translation", at);
  if (angle != 0) vs_x3d_turn(e, "rotation", axis, angle);
  if (scaled) vs_x3d_vector(e, "scale", size);
  vs_x3d_children(e);
}

static void scene_item(vs_emitter *e, const vs_x3d_item *item, size_t number, bool *said) {
  vs_vec3 at, size, one = vs_v3(1, 1, 1);
  vs_x3d_form form;
  vs_affine place;
  double turn[4];
  if (!vs_x3d_form_of(e, item->ref.node, &form, &place)) return; /* this is true, because the item was a form when it
                                                                  * was collected */
  place = vs_affine_multiply(&item->placement, &place);
  vs_affine_split(&place, &at, turn, &size);
  size.x = fabs(size.x); /* each form is its own mirror image in x */
  bool fits = scene_fits(form, size);
  scene_place(e, &place, size, !fits);
  vs_x3d_node(e, NULL, "Shape", NULL);
  scene_appearance(e, number, said, false);
  scene_form(e, form, fits ? size : one);
  vs_x3d_end(e, "Shape", false);
  vs_x3d_end(e, "Transform", true);
}

/* ---- batches ---- */

static void scene_rounded(vs_writer *w, vs_vec3 v, double steps) {
  const double xyz[] = { v.x, v.y, v.z };
  for (int i = 0; i < 3; i++) {
    if (i > 0) vs_puts(w, " ");
    vs_put_number(w, round(xyz[i] * steps) / steps);
  }
}

static void scene_wrap(vs_writer *w, size_t item, size_t per_line) {
  if (item > 0) vs_puts(w, item % per_line == 0 ? "\n" : " ");
}

/* A node that contains points. field: the parent's field that contains the node; node: the node's name; many: the
 * node's own field for the points; steps: rounding of the points. */
typedef struct { const char *field, *node, *many; double steps; /* number of rounding steps in a unit */ } scene_cloud;

static void scene_points(vs_emitter *e, const scene_cloud *cloud, const vs_vec3 *at, size_t count) {
  vs_x3d_node(e, cloud->field, cloud->node, NULL);
  vs_x3d_field(e, cloud->many, true);
  for (size_t i = 0; i < count && !e->out->failed; i++) {
    scene_wrap(e->out, i, 8);
    scene_rounded(e->out, at[i], cloud->steps);
  }
  vs_x3d_field_end(e, true);
  vs_x3d_end(e, cloud->node, false);
}

/* Coordinates are rounded to multiples of a step. Returns the number of steps in a unit of length: a power of ten, so
 * that the rounded numbers are short. */
static double scene_steps(const vs_emitter *e) {
  double diagonal = vs_v3_length(vs_v3_sub(e->bounds.max, e->bounds.min));
  return pow(10, 7 - ceil(log10(diagonal > 0 ? diagonal : 1)));
}

static void scene_corners(vs_emitter *e, const vs_vec3 *at, size_t count) {
  scene_points(e, &(scene_cloud){ "coord", "Coordinate", "point", scene_steps(e) }, at, count);
}

/* The name of a geometry that several Shapes use. again: whether an earlier Shape has already written the geometry. */
typedef struct { char name[40]; bool again; } scene_name;

static bool scene_begin_shape(vs_emitter *e, size_t number, bool *said, bool line, const char *type,
                              const scene_name *name) {
  vs_x3d_node(e, NULL, "Shape", NULL);
  scene_appearance(e, number, said, line);
  if (name->again) vs_x3d_use(e, "geometry", type, name->name);
  else vs_x3d_node(e, "geometry", type, name->name[0] != '\0' ? name->name : NULL);
  return !name->again;
}

/* Writes triangles with a picture. Each triangle has vertices of its own, because the picture may end at its edges. The
 * picture follows the axes of the current output; in a template, these are the template's axes. */
static void scene_pictured(vs_emitter *e, const vs_material *m, const vs_x3d_batch *b) {
  static const char *const fields[][3] = {
      { "coord", "Coordinate", "point" }, { "normal", "Normal", "vector" },
      { "texCoord", "TextureCoordinate", "point" } };
  vs_writer *w = e->out;
  double metres = vs_scene_metres(e->scene), steps = scene_steps(e);
  vs_x3d_field(e, "index", true);
  for (size_t i = 0; i < 3 * b->triangle_count && !w->failed; i++) {
    scene_wrap(w, i, 36);
    vs_put_u32(w, (uint32_t)i);
  }
  vs_x3d_field_end(e, true);
  for (int what = 0; what < 3; what++) {
    vs_x3d_node(e, fields[what][0], fields[what][1], NULL);
    vs_x3d_field(e, fields[what][2], true);
    for (size_t i = 0; i < b->triangle_count && !w->failed; i++) {
      vs_vec3 at[3];
      for (int k = 0; k < 3; k++) at[k] = b->vertices[b->triangles[i][k]];
      vs_vec3 n = vs_v3_cross(vs_v3_sub(at[1], at[0]), vs_v3_sub(at[2], at[0]));
      int direction = vs_picture_direction(n.x, n.y, n.z);
      for (int k = 0; k < 3; k++) {
        const double xyz[] = { at[k].x * metres, at[k].y * metres, at[k].z * metres };
        double place[2];
        scene_wrap(w, 3 * i + (size_t)k, 9);
        if (what == 0) scene_rounded(w, at[k], steps);
        if (what == 1) scene_rounded(w, b->normals[b->triangles[i][k]], 1000);
        if (what < 2) continue;
        vs_picture_place(vs_pattern_size(&m->pattern), vs_pattern_height(&m->pattern), m->pattern.angle, direction, xyz,
                         place);
        vs_put_number(w, place[0]);
        vs_puts(w, " ");
        vs_put_number(w, place[1]);
      }
    }
    vs_x3d_field_end(e, true);
    vs_x3d_end(e, fields[what][1], false);
  }
}

static void scene_triangles(vs_emitter *e, size_t number, const vs_x3d_batch *b, bool *said, const scene_name *name) {
  const vs_material *m = number > 0 ? vs_emit_material_at(e, number) : NULL;
  if (scene_begin_shape(e, number, said, false, "IndexedTriangleSet", name)) {
    if (!vs_emit_triangles(e, b->triangle_count)) e->out->failed = true;
    vs_x3d_words(e, "solid", "false"); /* open surfaces are visible from both sides */
    if (m != NULL && m->pattern.picture != NULL) {
      scene_pictured(e, m, b);
      vs_x3d_end(e, "IndexedTriangleSet", false);
      vs_x3d_end(e, "Shape", false);
      return;
    }
    vs_x3d_field(e, "index", true);
    for (size_t i = 0; i < b->triangle_count && !e->out->failed; i++) {
      scene_wrap(e->out, i, 12);
      for (int k = 0; k < 3; k++) {
        if (k > 0) vs_puts(e->out, " ");
        vs_put_u32(e->out, b->triangles[i][k]);
      }
    }
    vs_x3d_field_end(e, true);
    scene_corners(e, b->vertices, b->vertex_count);
    scene_points(e, &(scene_cloud){ "normal", "Normal", "vector", 1000 }, b->normals, b->vertex_count);
    vs_x3d_end(e, "IndexedTriangleSet", false);
  }
  vs_x3d_end(e, "Shape", false);
}

static void scene_lines(vs_emitter *e, size_t number, const vs_x3d_batch *b, bool *said, const scene_name *name) {
  if (scene_begin_shape(e, number, said, true, "IndexedLineSet", name)) {
    vs_x3d_field(e, "coordIndex", true);
    for (size_t i = 0; i < b->line_count && !e->out->failed; i++) {
      scene_wrap(e->out, i, 24);
      if (b->lines[i] == UINT32_MAX) vs_puts(e->out, "-1");
      else vs_put_u32(e->out, b->lines[i]);
    }
    vs_x3d_field_end(e, true);
    scene_corners(e, b->points, b->point_count);
    vs_x3d_end(e, "IndexedLineSet", false);
  }
  vs_x3d_end(e, "Shape", false);
}

/* ---- groups ---- */

static void scene_template_name(char name[40], size_t group, uint32_t paint) {
  snprintf(name, 40, paint > 0 ? "T%zu_%u" : "T%zu", group, paint);
}

static void scene_use(vs_emitter *e, const vs_x3d_placed *use, uint32_t paint) {
  const vs_x3d *x = e->state;
  vs_vec3 at, size;
  double turn[4];
  char name[40];
  vs_affine_split(&use->placement, &at, turn, &size);
  scene_place(e, &use->placement, size, size.x != 1 || size.y != 1 || size.z != 1);
  scene_template_name(name, use->group, x->groups[use->group].bare ? paint : 0);
  vs_x3d_use(e, NULL, "Group", name);
  vs_x3d_end(e, "Transform", true);
}

/* Writes the children of a group. Children without a material get `paint`. variant: number of copies of the group in
 * other paints that were written before. */
static void scene_group(vs_emitter *e, size_t group, uint32_t paint, size_t variant, bool *said) {
  const vs_x3d *x = e->state;
  const vs_x3d_group *g = &x->groups[group];
  for (size_t i = 0; i < g->item_count && !e->out->failed; i++) {
    uint32_t number = g->items[i].paint > 0 ? g->items[i].paint : paint;
    scene_item(e, &g->items[i], number, &said[number]);
  }
  for (size_t i = 0; i < g->use_count && !e->out->failed; i++)
    scene_use(e, &g->uses[i], g->uses[i].paint > 0 ? g->uses[i].paint : paint);
  for (size_t i = 0; g->batches != NULL && i < x->batch_count && !e->out->failed; i++) {
    size_t number = i > 0 ? i : paint;
    scene_name name = { "", variant > 0 };
    if (g->paint_count > 1) snprintf(name.name, sizeof name.name, "G%zu_%zu", group, i);
    if (g->batches[i].triangle_count > 0) scene_triangles(e, number, &g->batches[i], &said[number], &name);
    if (g->paint_count > 1) snprintf(name.name, sizeof name.name, "E%zu_%zu", group, i);
    if (g->batches[i].point_count > 0) scene_lines(e, number, &g->batches[i], &said[x->batch_count + number], &name);
  }
}

/* Writes the templates, without showing them. Each precedes the templates that use it. */
static void scene_templates(vs_emitter *e, bool *said) {
  const vs_x3d *x = e->state;
  bool any = false;
  for (size_t k = 1; k < x->group_count; k++)
    for (size_t i = 0; i < x->groups[k].paint_count && !e->out->failed; i++) {
      char name[40];
      if (!any) {
        vs_x3d_node(e, NULL, "Switch", NULL);
        vs_x3d_words(e, "whichChoice", "-1");
        vs_x3d_children(e);
      }
      any = true;
      scene_template_name(name, k, x->groups[k].paints[i]);
      vs_x3d_node(e, NULL, "Group", name);
      vs_x3d_children(e);
      scene_group(e, k, x->groups[k].paints[i], i, said);
      vs_x3d_end(e, "Group", true);
    }
  if (any) vs_x3d_end(e, "Switch", true);
}

/* Writes the parts of the drawing, each as a Group with its name as metadata. */
static void scene_parts(vs_emitter *e, bool *said) {
  const vs_x3d *x = e->state;
  for (size_t k = 1; k < x->group_count && !e->out->failed; k++) {
    if (x->groups[k].part == NULL) continue;
    vs_x3d_node(e, NULL, "Group", NULL);
    vs_x3d_node(e, "metadata", "MetadataString", NULL);
    vs_x3d_text(e, "name", "part", false);
    vs_x3d_text(e, "value", x->groups[k].part, true);
    vs_x3d_end(e, "MetadataString", false);
    vs_x3d_children(e);
    scene_group(e, k, 0, 0, said);
    vs_x3d_end(e, "Group", true);
  }
}

/* ---- around the model ---- */

static void scene_background(vs_emitter *e) {
  if (e->scene->sky_image != NULL)
    vs_emit_warn_once(e, NULL, "only POV-Ray shows the image of a sky: in this format the sky has one colour");
  if (e->scene->lamp_count > 0)
    vs_emit_warn_once(e, NULL, "only POV-Ray shows the light of lamps: in this format lamps give no light");
  if (e->scene->sky_kind != VS_SKY_PLAIN)
    vs_emit_warn_once(e, NULL,
                      "only POV-Ray and web pages show a physical sky: in this format the sky has plain colours");
  double c[3] = { 0.62, 0.76, 0.92 };
  if (e->scene->has_sky)
    for (int i = 0; i < 3; i++) c[i] = e->scene->sky[i];
  vs_x3d_node(e, NULL, "Background", NULL);
  vs_x3d_field(e, "skyColor", true);
  vs_put_triple(e->out, "", vs_v3(c[0], c[1], c[2]), " ", " ");
  vs_put_triple(e->out, "", vs_v3(0.4 + 0.6 * c[0], 0.4 + 0.6 * c[1], 0.4 + 0.6 * c[2]), " ", " ");
  vs_puts(e->out, "0.95 0.96 0.97");
  vs_x3d_field_end(e, true);
  vs_x3d_field(e, "skyAngle", true);
  vs_puts(e->out, "1.05 1.57");
  vs_x3d_field_end(e, true);
  vs_x3d_field(e, "groundColor", true);
  vs_puts(e->out, "0.78 0.78 0.77 0.87 0.87 0.86 0.95 0.96 0.97");
  vs_x3d_field_end(e, true);
  vs_x3d_field(e, "groundAngle", true);
  vs_puts(e->out, "0.9 1.57");
  vs_x3d_field_end(e, true);
  vs_x3d_end(e, "Background", false);
}

static void scene_light(vs_emitter *e, vs_vec3 towards, double intensity, double ambient, const char *color) {
  vs_x3d_node(e, NULL, "DirectionalLight", NULL);
  vs_x3d_vector(e, "direction", scene_up_y(vs_v3_scale(towards, -1)));
  vs_x3d_number(e, "intensity", intensity);
  vs_x3d_number(e, "ambientIntensity", ambient);
  vs_x3d_words(e, "color", color);
  vs_x3d_words(e, "global", "true");
  vs_x3d_end(e, "DirectionalLight", false);
}

static void scene_view(vs_emitter *e, const vs_look *l, double aspect) {
  double across = l->angle;
  vs_vec3 eye = l->eye;
  if (l->parallel) { /* a parallel view is written as a view from far away with a long lens, which every viewer can
                      * rotate */
    across = 0.1;
    eye = vs_v3_sub(l->target, vs_v3_scale(l->forward, l->width / 2 / tan(across / 2)));
  }
  vs_vec3 axis, columns[3] = { scene_up_y(l->right), scene_up_y(l->up), scene_up_y(vs_v3_scale(l->forward, -1)) };
  double turn[4];
  vs_rotation_quaternion(columns, turn);
  double angle = scene_axis(turn, &axis);
  vs_x3d_node(e, NULL, "Viewpoint", NULL);
  vs_x3d_text(e, "description", "model", false);
  vs_x3d_vector(e, "position", scene_up_y(eye));
  vs_x3d_turn(e, "orientation", axis, angle);
  /* X3D's field of view is that of the picture's shorter side */
  vs_x3d_number(e, "fieldOfView", aspect > 1 ? 2 * atan(tan(across / 2) / aspect) : across);
  vs_x3d_vector(e, "centerOfRotation", scene_up_y(vs_v3_scale(vs_v3_add(e->bounds.min, e->bounds.max), 0.5)));
  vs_x3d_end(e, "Viewpoint", false);
}

static void scene_ground(vs_emitter *e, bool *said) {
  double diagonal = vs_v3_length(vs_v3_sub(e->bounds.max, e->bounds.min));
  vs_vec3 middle = vs_v3_scale(vs_v3_add(e->bounds.min, e->bounds.max), 0.5);
  /* Places the ground just below the model, at the least distance that depth buffers can distinguish. */
  double reach = 8 * diagonal, z = e->scene->ground_z - 2e-4 * diagonal;
  vs_vec3 corners[4] = { { middle.x - reach, middle.y - reach, z },
                         { middle.x + reach, middle.y - reach, z },
                         { middle.x + reach, middle.y + reach, z },
                         { middle.x - reach, middle.y + reach, z } };
  vs_x3d_node(e, NULL, "Shape", "ground"); /* VisualScheme's viewer recognizes the ground by this name */
  if (e->scene->ground_material != NULL) {
    scene_appearance(e, vs_emit_material_number(e, e->scene->ground_material), said, false);
  } else { /* the ground is slightly darker than the objects on it */
    vs_x3d_node(e, "appearance", "Appearance", NULL);
    vs_x3d_node(e, "material", "Material", NULL);
    vs_x3d_vector(e, "diffuseColor", vs_v3(0.7, 0.7, 0.68));
    vs_x3d_vector(e, "specularColor", vs_v3(0, 0, 0));
    vs_x3d_number(e, "ambientIntensity", 0.9);
    vs_x3d_end(e, "Material", false);
    vs_x3d_end(e, "Appearance", false);
  }
  vs_x3d_node(e, "geometry", "IndexedFaceSet", NULL);
  vs_x3d_words(e, "solid", "false");
  vs_x3d_field(e, "coordIndex", true);
  vs_puts(e->out, "0 1 2 3 -1");
  vs_x3d_field_end(e, true);
  scene_corners(e, corners, 4);
  vs_x3d_end(e, "IndexedFaceSet", false);
  vs_x3d_end(e, "Shape", false);
}

bool vs_x3d_scene(vs_emitter *e) {
  vs_x3d *x = e->state;
  if (!vs_x3d_settle(e)) return false;
  double aspect =
      e->options->width > 0 && e->options->height > 0 ? (double)e->options->width / e->options->height : 4.0 / 3;
  vs_look look = vs_look_find(e->scene, &e->framed, e->boxes, e->box_count, aspect);
  vs_vec3 sun = vs_look_sun(e->scene, &look);
  /* A material is written where it is first used: in the templates, then in the drawing, then in the ground. */
  size_t numbers = 2 * x->batch_count; /* numbers of materials: first all materials for faces, then all materials for
                                        * lines */
  bool *said = vs_store_realloc(e->scene->store, NULL, 0, numbers * sizeof *said);
  if (said == NULL) return vs_emit_no_memory(e);
  for (size_t i = 0; i < numbers; i++) said[i] = false;
  scene_background(e);
  vs_x3d_node(e, NULL, "NavigationInfo", NULL);
  vs_x3d_field(e, "type", true);
  vs_puts(e->out, "\"EXAMINE\" \"ANY\"");
  vs_x3d_field_end(e, true);
  vs_x3d_words(e, "headlight", "false");
  vs_x3d_end(e, "NavigationInfo", false);
  scene_view(e, &look, aspect);
  if (!e->scene->no_sun) scene_light(e, sun, 0.8, 0.35, "1 0.985 0.95");
  scene_light(e, vs_v3(-sun.x, -sun.y, 0.35), 0.3, 0, "0.85 0.92 1");
  scene_light(e, vs_v3_scale(look.forward, -1), 0.22, 0, "1 1 1");
  vs_x3d_node(e, NULL, "Transform", "model");
  vs_x3d_words(e, "rotation", "1 0 0 -1.57079632679");
  vs_x3d_children(e);
  scene_templates(e, said);
  scene_group(e, 0, 0, 0, said);
  scene_parts(e, said);
  if (e->scene->has_ground) scene_ground(e, &said[vs_emit_material_number(e, e->scene->ground_material)]);
  vs_x3d_end(e, "Transform", true);
  vs_emit_release(e, said, numbers, sizeof *said);
  return !e->out->failed;
}

/* ---- the two formats that consist of the scene alone ---- */

static bool scene_begin_xml(vs_emitter *e) { return vs_x3d_open(e, VS_X3D_XML); }
static bool scene_begin_classic(vs_emitter *e) { return vs_x3d_open(e, VS_X3D_CLASSIC); }

static bool scene_end_xml(vs_emitter *e) {
  vs_x3d *x = e->state;
  vs_puts(e->out, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<X3D profile='Immersive' version='4.0'>\n  <head>\n    "
                  "<meta name='title' content='");
  vs_put_xml(e->out, e->scene->title);
  vs_puts(e->out, "'/>\n    <meta name='generator' content='VisualScheme'/>\n  </head>\n  <Scene>\n");
  x->depth = 2;
  return vs_x3d_scene(e) && vs_puts(e->out, "  </Scene>\n</X3D>\n");
}

static bool scene_end_classic(vs_emitter *e) {
  vs_puts(e->out, "#X3D V4.0 utf8\nPROFILE Immersive\n");
  return vs_x3d_scene(e) && !e->out->failed;
}

const vs_backend vs_backend_x3d = { VS_X3D_BACKEND(scene_begin_xml, scene_end_xml) };
const vs_backend vs_backend_x3dv = { VS_X3D_BACKEND(scene_begin_classic, scene_end_classic) };
