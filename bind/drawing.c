/* Implements the objects that the program shows, their materials, and the camera. */
#include "bind/build.h"
#include "bind/call/call.h"
#include "bind/call/refuse.h"
#include "bind/call/scratch.h"
#include "bind/constructors/files.h"

#include <stdio.h>
#include <stdlib.h>

#include "bind/objects.h"
#include "bind/origins.h"
#include "bind/state.h"
#include "bind/warnings.h"
#include "bind/workshop/sunlight.h"
#include "geometry/sky_light.h"
#include "geometry/sun_position.h"
#include "vm/front/source.h"
#include "vm/library/port.h"

/* ---- drawing and erasing ---- */

/* Returns true if the node is among the 16 objects that were drawn last. This happens if a procedure draws an object
 * and returns it, and the program draws the returned object again. */
static bool drawn_just_now(const vs_bind *b, size_t before, const vs_node *node) {
  enum { MOST = 16 };
  for (size_t i = before; i-- > 0 && before - i <= MOST;)
    if (b->scene.drawn[i].node == node) return true;
  return false;
}

static void warn_drawn_twice(vs_bind *b, size_t before, const vs_ref *ref, size_t n) {
  enum { MOST = 16 };
  bool twice = false;
  for (size_t i = 0; i < n && i < MOST && before; i++) {
    const vs_node *node = ref[i].node;
    twice = twice || node == b->drawn_last || drawn_just_now(b, before, node);
    for (uint32_t k = 0; node->kind == VS_UNION && k < node->child_count && k < MOST; k++) twice = twice ||
        drawn_just_now(b, before, node->children[k].node);
  }
  if (twice)
    vs_bind_warn(b, "drawn twice",
                 "this object was drawn already, and is now in the drawing twice; remove this draw if a procedure has "
                 "drawn the object");
}

vs_status vs_p_draw(vs_args *f, vs_value *out) {
  vs_bind *b = f->bind;
  size_t n = f->arg[0].refs.count;
  vs_ref *ref = f->arg[0].refs.at;
  const vs_origin *here = vs_bind_origin(b);
  b->drew = b->drew || (!b->handing && !b->away);
  for (size_t i = 0; i < n; i++)
    if (ref[i].node->flags & VS_NODE_ENDLESS) return vs_fail(f->vm, f->vm->sym.range, VS_ENDLESS_MESSAGE);
  if (!b->handing) warn_drawn_twice(b, b->scene.drawn_count, ref, n);
  for (size_t i = 0; i < n && !b->handing; i++)
    if (!vs_scene_draw(&b->scene, (vs_ref){ ref[i].node, ref[i].origin ? ref[i].origin : here }))
      return vs_fail_memory(f->vm);
  if (n == 0) return vs_bind_empty(f, NULL, out);
  vs_status status = n == 1 ? vs_bind_give_node(f, vs_node_retain(ref[0].node), out)
                            : vs_bind_make(f, VS_UNION, &(struct vs_union){ 0 }, ref, n, out);
  if (status == VS_OK && !b->handing) b->drawn_last = vs_bind_take_ref(*out).node;
  return status;
}

/* Removes the given objects, and objects equal to them, from the drawing. If the drawing does not contain one of them,
 * sets an error. */
vs_status vs_p_erase(vs_args *f, vs_value *out) {
  (void)out;
  vs_scene *scene = &f->bind->scene;
  for (size_t i = 0; i < f->arg[0].refs.count && !f->bind->handing; i++) {
    const vs_node *node = f->arg[0].refs.at[i].node;
    size_t kept = 0, count = scene->drawn_count;
    if (!vs_poll(f->vm, count)) return VS_ERROR;
    for (size_t k = 0; k < count; k++) {
      bool same = scene->drawn[k].node == node || (scene->drawn[k].node->hash == node->hash &&
          vs_node_equal(scene->drawn[k].node, node, NULL));
      if (same) vs_node_release(scene->drawn[k].node); /* releases the drawing's reference; the call's argument has
                                                        * another one, so the node is not freed */
      else scene->drawn[kept++] = scene->drawn[k];
    }
    scene->drawn_count = kept;
    if (kept == count) return vs_fail(f->vm, f->vm->sym.range,
        "this object is not in the drawing; (erase-all) empties the whole drawing");
  }
  return VS_OK;
}

vs_status vs_p_erase_all(vs_args *f, vs_value *out) {
  (void)out;
  if (!f->bind->handing) vs_bind_clear_drawing(f->bind);
  return VS_OK;
}

/* ---- materials and marks: a new node of kind material or mark becomes the parent of the objects ---- */

static vs_status around(vs_args *f, vs_kind kind, const void *data, const vs_arg *objects, vs_value *out) {
  vs_ref child;
  char name[64];
  const bool pen = kind == VS_LAYER && (f->key[0].given || f->key[1].given);
  if (objects->refs.count == 0 && objects != f->arg && f->given < 2 && !pen) {
    vs_bind_own_name(f, name);
    vs_bind_warn(f->bind, "no object",
                 "%s has no object here, and does not change objects drawn elsewhere: write (%s%s object)", name, name,
                 kind == VS_MATERIAL ? strcmp(name, "color") ? " steel" : " \"red\""
                 : kind == VS_LAYER  ? " \"walls\""
                 : kind == VS_PART   ? " \"leg\""
                                     : "");
  }
  if (objects->refs.count == 0) return vs_bind_empty(f, NULL, out);
  if (objects->refs.count == 1) child = objects->refs.at[0];
  else {
    child =
        (vs_ref){ vs_node_new(f->store, VS_UNION, &(struct vs_union){ 0 }, objects->refs.at, objects->refs.count),
                  vs_bind_origin(f->bind) };
    if (!vs_bind_keep(f, child.node)) return VS_ERROR;
  }
  if (vs_node_is_empty(child.node)) return vs_bind_give_node(f, vs_node_retain(child.node), out);
  return vs_bind_make(f, kind, data, &child, 1, out);
}

vs_status vs_p_with_material(vs_args *f, vs_value *out) {
  return around(f, VS_MATERIAL, &(struct vs_material){ .material = f->arg[0].material }, &f->arg[1], out);
}

/* The argument may be the name of a material. `color` uses only the colour of this material. */
vs_status vs_p_color(vs_args *f, vs_value *out) {
  return around(f, VS_MATERIAL, &(struct vs_material){ .material = f->arg[0].material }, &f->arg[1], out);
}

vs_status vs_p_layer(vs_args *f, vs_value *out) {
  const char *name = vs_store_text(f->store, f->arg[0].text.at, f->arg[0].text.length);
  const vs_arg *color = &f->key[0], *line = &f->key[1];
  if (!name) return vs_fail_memory(f->vm);
  vs_scene_pen pen = { .layer = name, .colored = color->given, .line = line->given ? line->real : 0 };
  if (color->given)
    pen.color[0] = color->material->red, pen.color[1] = color->material->green, pen.color[2] = color->material->blue;
  if ((color->given || line->given) && !f->bind->handing && !vs_scene_add_pen(&f->bind->scene, &pen))
    return vs_fail_memory(f->vm);
  return around(f, VS_LAYER, &(struct vs_layer){ .name = name }, &f->arg[1], out);
}

vs_status vs_p_part(vs_args *f, vs_value *out) {
  if (f->arg[0].text.length == 0) return vs_bind_refuse(f, "name", "a string that is not empty", f->arg[0].value);
  const char *name = vs_store_text(f->store, f->arg[0].text.at, f->arg[0].text.length);
  if (!name) return vs_fail_memory(f->vm);
  return around(f, VS_PART, &(struct vs_part){ .name = name }, &f->arg[1], out);
}

vs_status vs_p_highlight(vs_args *f, vs_value *out) {
  return around(f, VS_HIGHLIGHT, &(struct vs_highlight){ 0 }, &f->arg[0], out);
}
vs_status vs_p_ghost(vs_args *f, vs_value *out) {
  return around(f, VS_GHOST, &(struct vs_ghost){ 0 }, &f->arg[0], out);
}
vs_status vs_p_only(vs_args *f, vs_value *out) { return around(f, VS_ONLY, &(struct vs_only){ 0 }, &f->arg[0], out); }

/* Sets the material's pattern to the picture in a file. The material's colour becomes the mean colour of the picture,
 * unless the call gave a colour. */
static vs_status picture_of(vs_args *f, const vs_arg *image, bool colored, vs_material *m) {
  const char *shown;
  double mean[3];
  if (vs_bind_picture(f, image->value, &m->pattern.picture, &shown, mean) != VS_OK) return VS_ERROR;
  m->pattern.kind = VS_PATTERN_PICTURE;
  if (!colored) m->red = mean[0], m->green = mean[1], m->blue = mean[2];
  return VS_OK;
}

/* Reads the five keyword arguments of a pattern, which begin at k. Without #:pattern-color, the second colour is a
 * darker form of the first. */
static vs_status pattern_of(vs_args *f, const vs_arg *k, bool colored, vs_material *m) {
  vs_material_pattern *p = &m->pattern;
  const double darker = vs_pattern_darkening;
  if (k[4].given && (k[0].given || k[1].given))
    return vs_fail(f->vm, f->vm->sym.arity, "takes #:image or #:pattern and #:pattern-color, not both");
  if (k[4].given && picture_of(f, &k[4], colored, m) != VS_OK) return VS_ERROR;
  if (k[0].given && !vs_pattern_find(k[0].text.at, &p->kind))
    return vs_bind_refuse(f, "pattern", "one of 'none"
#define VS_PATTERN(id, name, size, shows) " '" name
#include "model/looks/patterns.def"
      , k[0].value);
  p->red = darker * m->red, p->green = darker * m->green, p->blue = darker * m->blue;
  if (k[1].given) p->red = k[1].material->red, p->green = k[1].material->green, p->blue = k[1].material->blue;
  if (k[2].given) p->size = k[2].real;
  if (k[3].given) p->angle = k[3].real;
  if (p->kind == VS_PATTERN_NONE) *p = (vs_material_pattern){ 0 };
  return VS_OK;
}

vs_status vs_p_make_material(vs_args *f, vs_value *out) {
  const vs_arg *k = f->key; /* the call's keywords in order: name, color, roughness, metallic, transparency, ior, the
                             * pattern's four keywords, image */
  vs_material m = vs_material_default;
  if (k[0].given && !(m.name = vs_store_text(f->store, k[0].text.at, k[0].text.length)))
    return vs_fail_memory(f->vm);
  if (k[1].given) m.red = k[1].material->red, m.green = k[1].material->green, m.blue = k[1].material->blue;
  if (k[2].given) m.roughness = k[2].real;
  if (k[3].given) m.metallic = k[3].real;
  if (k[4].given) m.transparency = k[4].real;
  if (k[5].given) m.ior = k[5].real;
  if (pattern_of(f, &k[6], k[1].given, &m) != VS_OK) return VS_ERROR;
  const vs_material *kept = vs_store_material(f->store, &m);
  if (!kept) return vs_fail_memory(f->vm);
  return vs_make_foreign(f->vm, &vs_paint_type, (void *)(uintptr_t)kept, 0, out);
}

vs_status vs_p_is_material(vs_args *f, vs_value *out) {
  *out = vs_bool(vs_foreign_get(f->arg[0].value, &vs_paint_type) != NULL);
  return VS_OK;
}

/* ---- the camera ---- */

vs_status vs_p_view_from(vs_args *f, vs_value *out) {
  static const struct { const char *name; vs_view view; } views[] = {
    { "top", VS_VIEW_TOP },     { "bottom", VS_VIEW_BOTTOM }, { "front", VS_VIEW_FRONT }, { "back", VS_VIEW_BACK },
    { "left", VS_VIEW_LEFT },   { "right", VS_VIEW_RIGHT },   { "iso", VS_VIEW_ISO },
  };
  (void)out;
  for (size_t i = 0; i < sizeof views / sizeof *views; i++)
    if (!strcmp(views[i].name, f->arg[0].text.at)) {
      if (!f->bind->handing) f->bind->scene.view = views[i].view, f->bind->scene.looked = true;
      return VS_OK;
    }
  return vs_bind_refuse(f, "side", "one of 'top 'bottom 'front 'back 'left 'right 'iso", f->arg[0].value);
}

vs_status vs_p_zoom_extents(vs_args *f, vs_value *out) {
  (void)out;
  if (!f->bind->handing) f->bind->scene.view = VS_VIEW_EXTENTS, f->bind->scene.looked = true;
  return VS_OK;
}

/* ---- the sun ---- */

static const double half_turn = 3.141592653589793;

/* Returns true if the angle is a multiple of pi/12 up to two turns. Such an angle was surely meant in radians, not in
 * degrees. */
static bool is_radians(double angle) {
  double parts = angle * 12 / half_turn;
  return parts > 0.5 && parts < 24.5 && fabs(parts - round(parts)) < 1e-9;
}

vs_status vs_p_sun(vs_args *f, vs_value *out) {
  const vs_arg *k = f->key; /* the call's keywords in order: azimuth, altitude, latitude, longitude, date, time */
  vs_scene *s = &f->bind->scene;
  double azimuth, altitude;
  bool off = f->arg[0].given && !f->arg[0].boolean;
  (void)out;
  for (size_t i = 0; off && i < 6; i++)
    if (k[i].given) return vs_fail(f->vm, f->vm->sym.arity, "takes #f alone, which turns the sun off");
  if (off) {
    if (!f->bind->handing) s->has_sun = false, s->no_sun = true;
    return VS_OK;
  }
  if (k[2].given || k[3].given || k[4].given || k[5].given) {
    vs_sun_moment m;
    if (!k[2].given || !k[4].given || !k[5].given || k[0].given || k[1].given)
      return vs_fail(f->vm, f->vm->sym.arity,
                     "takes #:azimuth and #:altitude, or #:latitude, #:date and #:time, with #:longitude (0)");
    if (!vs_bind_moment(f, k + 2, &m)) return VS_ERROR;
    vs_sun_direction at = vs_sun_position(&m);
    azimuth = at.azimuth, altitude = at.altitude;
    if (altitude < 0)
      vs_bind_warn(f->bind, "night", "sun: at that time it is %.0f degrees below the horizon", -altitude);
  } else {
    azimuth = k[0].given ? k[0].real : 135, altitude = k[1].given ? k[1].real : 45;
    if (fabs(altitude) > 90) return vs_bind_refuse(f, "altitude", "from -90 to 90", k[1].value);
    double radians = k[0].given && is_radians(azimuth) ? azimuth : k[1].given && is_radians(altitude) ? altitude : 0;
    if (radians > 0)
      vs_bind_warn(f->bind, "radians",
                   "sun: its angles are degrees, and %.4g is a part of pi; (radians->degrees x), or %.4g", radians,
                   radians * 180 / half_turn);
  }
  if (f->bind->handing) return VS_OK;
  s->has_sun = true, s->no_sun = false, s->sun_azimuth = azimuth, s->sun_altitude = altitude;
  return VS_OK;
}

/* Sets the scene's sky to the kind of sky that the first argument names. */
static vs_status named_sky(vs_args *f) {
  static const struct { const char *name; vs_sky_kind kind; } skies[] = {
    { "plain", VS_SKY_PLAIN }, { "overcast", VS_SKY_OVERCAST }, { "night", VS_SKY_NIGHT },
  };
  vs_scene *s = &f->bind->scene;
  if (f->key[0].given || f->key[1].given || f->key[2].given)
    return vs_fail(f->vm, f->vm->sym.arity, "takes the name of a sky alone, or #:color, #:image or #:turbidity");
  for (size_t i = 0; i < sizeof skies / sizeof *skies; i++)
    if (!strcmp(skies[i].name, f->arg[0].text.at)) {
      if (f->bind->handing) return VS_OK;
      s->sky_image = s->sky_sunless = NULL, s->has_sky = false, s->turbidity = 0, s->sky_kind = skies[i].kind;
      s->sky_given = true;
      return VS_OK;
    }
  return vs_bind_refuse(f, "kind", "one of 'plain 'overcast 'night", f->arg[0].value);
}

vs_status vs_p_sky(vs_args *f, vs_value *out) {
  vs_scene *s = &f->bind->scene;
  (void)out;
  const vs_arg *turbidity = &f->key[2];
  if (f->arg[0].given) return named_sky(f);
  if (turbidity->given ? f->key[0].given || f->key[1].given : !f->key[0].given && !f->key[1].given)
    return vs_fail(f->vm, f->vm->sym.arity,
                   "takes the name of a sky, or #:color, #:image or both, or #:turbidity alone");
  if (turbidity->given && !(turbidity->real >= VS_TURBIDITY_LEAST && turbidity->real <= VS_TURBIDITY_MOST))
    return vs_bind_refuse(f, "turbidity", "from 2 (very clear) to 10 (haze)", turbidity->value);
  const vs_picture *image = NULL;
  vs_panorama_sun sun = { { 0, 0, 1 }, { 0, 0, 0 } };
  const vs_picture *sunless = NULL;
  if (f->key[1].given && vs_bind_sky_picture(f, f->key[1].value, &image, &sunless, &sun) != VS_OK) return VS_ERROR;
  if (f->bind->handing) return VS_OK;
  s->sky_given = true;
  s->sky_image = image, s->sky_sunless = sunless;
  s->picture_sun = sun.direction, s->picture_sun_light = sun.light;
  s->turbidity = turbidity->given ? turbidity->real : 0;
  s->sky_kind = turbidity->given ? VS_SKY_CLEAR : VS_SKY_PLAIN;
  if (!f->key[0].given) return VS_OK;
  const vs_material *m = f->key[0].material;
  s->has_sky = true, s->sky[0] = m->red, s->sky[1] = m->green, s->sky[2] = m->blue;
  return VS_OK;
}

vs_status vs_p_look(vs_args *f, vs_value *out) {
  vs_scene_style style = vs_scene_style_find(f->arg[0].text.at);
  (void)out;
  if (style == VS_STYLE_OWN)
    return vs_bind_refuse(f, "name", "one of 'arctic 'model 'technical 'overcast 'night", f->arg[0].value);
  if (!f->bind->handing) vs_scene_set_style(&f->bind->scene, style);
  return VS_OK;
}

vs_status vs_p_lamp(vs_args *f, vs_value *out) {
  const vs_arg *k = f->key; /* the call's keywords in order: ies, lumens, to, turn, dim, color */
  vs_scene_lamp l = { .at = f->arg[0].point, .dim = k[4].given ? k[4].real : 1, .color = { 1, 1, 1 } };
  (void)out;
  l.to = k[2].given ? k[2].point : vs_v3_add(l.at, vs_v3(0, 0, -1));
  l.turn = k[3].given ? k[3].real : 0;
  if (k[0].given == k[1].given) return vs_fail(f->vm, f->vm->sym.arity, "takes #:ies or #:lumens");
  if (vs_v3_equal(l.to, l.at)) return vs_bind_refuse(f, "to", "another point than p", k[2].value);
  l.lumens = k[1].given ? k[1].real * l.dim : 0;
  if (k[0].given && vs_bind_lamp_file(f, k[0].value, &l.ies) != VS_OK) return VS_ERROR;
  if (k[5].given) {
    const vs_material *m = k[5].material;
    const double c[] = { m->red, m->green, m->blue };
    double x[3];
    for (int i = 0; i < 3; i++) x[i] = c[i] <= 0.04045 ? c[i] / 12.92 : pow((c[i] + 0.055) / 1.055, 2.4);
    double bright = 0.2126 * x[0] + 0.7152 * x[1] + 0.0722 * x[2];
    if (!(bright > 0)) return vs_bind_refuse(f, "color", "brighter than black", k[5].value);
    l.color = vs_v3_scale(vs_v3(x[0], x[1], x[2]), 1 / bright);
  }
  return f->bind->handing || vs_scene_add_lamp(&f->bind->scene, &l) ? VS_OK : vs_fail_memory(f->vm);
}

vs_status vs_p_fog(vs_args *f, vs_value *out) {
  vs_scene *s = &f->bind->scene;
  (void)out;
  if (f->bind->handing) return VS_OK;
  s->fog_visibility = f->arg[0].real;
  s->fog_height = f->key[0].given ? f->key[0].real : INFINITY;
  s->fog_color = f->key[1].given ? f->key[1].material : NULL;
  return VS_OK;
}

vs_status vs_p_ground(vs_args *f, vs_value *out) {
  vs_scene *s = &f->bind->scene;
  (void)out;
  if (f->bind->handing) return VS_OK;
  s->has_ground = true, s->ground_z = f->arg[0].given ? f->arg[0].real : 0;
  s->ground_material = f->key[0].given ? f->key[0].material : NULL;
  return VS_OK;
}

vs_status vs_p_units(vs_args *f, vs_value *out) {
  const char *name;
  (void)out;
  for (size_t i = 0; (name = vs_unit_at(i)) != NULL; i++)
    if (!strcmp(name, f->arg[0].text.at)) {
      if (!f->bind->handing) f->bind->scene.units = name, f->bind->scene.units_set = true;
      return VS_OK;
    }
  return vs_bind_refuse(f, "unit", "one of 'm 'mm 'cm 'in 'ft", f->arg[0].value);
}
