/* Implements drawings (scene.h): sets their defaults, and adds references, views, lamps and notes. */
#include "model/scene.h"

#include <math.h>
#include <string.h>

void vs_scene_init(vs_scene *scene, vs_store *store) {
  *scene = (vs_scene){
    .store = vs_store_retain(store), .title = "model", .view = VS_VIEW_EXTENTS, .lens = 35, .units = "m"
  };
}

bool vs_scene_draw(vs_scene *scene, vs_ref ref) {
  if (scene->drawn_count == scene->drawn_room) {
    size_t room = scene->drawn_room ? scene->drawn_room * 2 : 16;
    vs_ref *grown =
        vs_store_realloc(scene->store, scene->drawn, scene->drawn_room * sizeof *grown, room * sizeof *grown);
    if (!grown) return false;
    scene->drawn = grown;
    scene->drawn_room = room;
  }
  vs_node_retain(ref.node);
  scene->drawn[scene->drawn_count++] = ref;
  return true;
}

/* The units of length, and the length of each in metres. */
static const char *const unit_names[] = { "m", "mm", "cm", "in", "ft" };
static const double unit_metres[] = { 1, 0.001, 0.01, 0.0254, 0.3048 };

const char *vs_unit_at(size_t index) {
  return index < sizeof unit_names / sizeof *unit_names ? unit_names[index] : NULL;
}

double vs_unit_metres(const char *unit) {
  for (size_t i = 0; i < sizeof unit_names / sizeof *unit_names; i++)
    if (strcmp(unit, unit_names[i]) == 0) return unit_metres[i];
  return NAN;
}

double vs_scene_metres(const vs_scene *scene) { return scene->units == NULL ? 1 : vs_unit_metres(scene->units); }

static void free_cells(vs_scene *scene, vs_scene_table *t) {
  vs_store_realloc(scene->store, t->cells, t->rows * t->columns * sizeof *t->cells, 0);
}

void vs_scene_free(vs_scene *scene) {
  if (!scene->store) return;
  for (size_t i = 0; i < scene->drawn_count; i++) vs_node_release(scene->drawn[i].node);
  vs_store_realloc(scene->store, scene->drawn, scene->drawn_room * sizeof *scene->drawn, 0);
  vs_store_realloc(scene->store, scene->views, scene->view_room * sizeof *scene->views, 0);
  vs_store_realloc(scene->store, scene->pens, scene->pen_room * sizeof *scene->pens, 0);
  vs_store_realloc(scene->store, scene->notes, scene->note_room * sizeof *scene->notes, 0);
  for (size_t i = 0; i < scene->table_count; i++) free_cells(scene, &scene->tables[i]);
  vs_store_realloc(scene->store, scene->tables, scene->table_room * sizeof *scene->tables, 0);
  for (size_t i = 0; i < scene->fault_count; i++) vs_node_release(scene->faults[i].node);
  vs_store_realloc(scene->store, scene->faults, scene->fault_room * sizeof *scene->faults, 0);
  vs_store_realloc(scene->store, scene->lamps, scene->lamp_room * sizeof *scene->lamps, 0);
  vs_store_release(scene->store);
  *scene = (vs_scene){ 0 };
}

bool vs_scene_add_view(vs_scene *scene, const vs_scene_view *view) {
  for (size_t i = 0; i < scene->view_count; i++)
    if (strcmp(scene->views[i].name, view->name) == 0) return scene->views[i] = *view, true;
  if (!vs_store_grow(scene->store, &scene->views, &scene->view_room, scene->view_count + 1, sizeof *view)) return false;
  scene->views[scene->view_count++] = *view;
  return true;
}

const vs_scene_pen *vs_scene_find_pen(const vs_scene *scene, const char *layer) {
  for (size_t i = 0; i < scene->pen_count; i++)
    if (strcmp(scene->pens[i].layer, layer) == 0) return &scene->pens[i];
  return NULL;
}

bool vs_scene_add_pen(vs_scene *scene, const vs_scene_pen *pen) {
  const vs_scene_pen *same = vs_scene_find_pen(scene, pen->layer);
  if (same) return scene->pens[same - scene->pens] = *pen, true;
  if (!vs_store_grow(scene->store, &scene->pens, &scene->pen_room, scene->pen_count + 1, sizeof *pen)) return false;
  scene->pens[scene->pen_count++] = *pen;
  return true;
}

bool vs_scene_add_note(vs_scene *scene, const vs_scene_note *note) {
  if (!vs_store_grow(scene->store, &scene->notes, &scene->note_room, scene->note_count + 1, sizeof *note)) return false;
  scene->notes[scene->note_count++] = *note;
  return true;
}

bool vs_scene_add_table(vs_scene *scene, const vs_scene_table *table) {
  const size_t bytes = table->rows * table->columns * sizeof *table->cells;
  vs_scene_table copy = *table;
  if (!vs_store_grow(scene->store, &scene->tables, &scene->table_room, scene->table_count + 1, sizeof copy) ||
      !(copy.cells = vs_store_realloc(scene->store, NULL, 0, bytes))) return false;
  memcpy(copy.cells, table->cells, bytes);
  scene->tables[scene->table_count++] = copy;
  return true;
}

bool vs_scene_add_row(vs_scene *scene, const char *title, const char *const *cells) {
  size_t i = 0;
  while (!scene->tables[i].title || strcmp(scene->tables[i].title, title) != 0) i++;
  vs_scene_table *t = &scene->tables[i];
  const size_t row = t->columns * sizeof *t->cells;
  const char **grown = vs_store_realloc(scene->store, t->cells, t->rows * row, (t->rows + 1) * row);
  if (!grown) return false;
  memcpy(grown + t->rows++ * t->columns, cells, row);
  t->cells = grown;
  return true;
}

bool vs_scene_add_fault(vs_scene *scene, vs_ref ref) {
  for (size_t i = 0; i < scene->fault_count; i++) {
    const vs_node *known = scene->faults[i].node;
    if (known == ref.node || (known->hash == ref.node->hash && vs_node_equal(known, ref.node, NULL))) return true;
  }
  if (!vs_store_grow(scene->store, &scene->faults, &scene->fault_room, scene->fault_count + 1, sizeof ref))
    return false;
  vs_node_retain(ref.node);
  scene->faults[scene->fault_count++] = ref;
  return true;
}

bool vs_scene_add_lamp(vs_scene *scene, const vs_scene_lamp *lamp) {
  if (!vs_store_grow(scene->store, &scene->lamps, &scene->lamp_room, scene->lamp_count + 1, sizeof *lamp)) return false;
  scene->lamps[scene->lamp_count++] = *lamp;
  return true;
}

const vs_scene_view *vs_scene_find_view(const vs_scene *scene, const char *name) {
  for (size_t i = 0; i < scene->view_count; i++)
    if (strcmp(scene->views[i].name, name) == 0) return &scene->views[i];
  return NULL;
}

const vs_scene_view *vs_scene_own_view(const vs_scene *scene) {
  for (size_t i = 0; i < scene->view_count && !scene->looked; i++) {
    const vs_scene_view *v = &scene->views[i];
    bool section = v->view == VS_VIEW_ALONG && v->cut == VS_CUT_PLANE;
    bool eye = v->view == VS_VIEW_CAMERA || v->view == VS_VIEW_PANORAMA;
    if (!section && (eye || v->view == VS_VIEW_ALONG || v->view == VS_VIEW_ISO)) return v;
  }
  return scene->view_count > 0 && !scene->looked ? scene->views : NULL;
}

void vs_scene_look(vs_scene *scene, const vs_scene_view *view) {
  scene->looked = true;
  scene->view = view->view;
  scene->eye = view->eye, scene->target = view->target;
  scene->lens = view->lens;
  scene->upright = view->upright;
  scene->aperture = view->aperture, scene->focus = view->focus;
}

const char *vs_scene_style_name(vs_scene_style style) {
  static const char *const names[VS_STYLE_COUNT] = {
#define STYLE(upper, name) [VS_STYLE_##upper] = name,
#include "model/styles.def"
#undef STYLE
  };
  return names[style];
}

vs_scene_style vs_scene_style_find(const char *name) {
  for (int i = VS_STYLE_OWN + 1; i < VS_STYLE_COUNT; i++)
    if (strcmp(vs_scene_style_name((vs_scene_style)i), name) == 0) return (vs_scene_style)i;
  return VS_STYLE_OWN;
}

void vs_scene_set_style(vs_scene *scene, vs_scene_style style) {
  scene->style = style;
  scene->sky_image = scene->sky_sunless = NULL, scene->has_sky = false, scene->turbidity = 0;
  scene->sky_given = style == VS_STYLE_OVERCAST || style == VS_STYLE_NIGHT;
  scene->sky_kind = VS_SKY_PLAIN;
  if (style == VS_STYLE_OVERCAST) scene->sky_kind = VS_SKY_OVERCAST;
  if (style == VS_STYLE_NIGHT) scene->sky_kind = VS_SKY_NIGHT;
}
