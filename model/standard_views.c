/* Makes the views that every model has. */
#include "model/standard_views.h"

static const vs_standard_view rows[] = {
  { "plan", VS_VIEW_TOP, VS_CUT_OWN, true },       { "section", VS_VIEW_ALONG, VS_CUT_PLANE, true },
  { "front", VS_VIEW_FRONT, VS_CUT_NONE, true },   { "right", VS_VIEW_RIGHT, VS_CUT_NONE, true },
  { "back", VS_VIEW_BACK, VS_CUT_NONE, true },     { "left", VS_VIEW_LEFT, VS_CUT_NONE, true },
  { "elevation", VS_VIEW_FRONT, VS_CUT_NONE, false }, { "top", VS_VIEW_TOP, VS_CUT_NONE, false },
  { "bottom", VS_VIEW_BOTTOM, VS_CUT_NONE, false }, { "isometric", VS_VIEW_ISO, VS_CUT_NONE, false },
};

const vs_standard_view *vs_standard_view_at(size_t index) {
  return index < sizeof rows / sizeof *rows ? &rows[index] : NULL;
}

void vs_standard_cut_plan(const vs_scene *scene, const vs_bounds *b, vs_scene_view *v) {
  double metre = 1 / vs_scene_metres(scene), low = b->min.z;
  if (scene->has_ground && scene->ground_z > low && scene->ground_z < b->max.z) low = scene->ground_z;
  v->cut = b->max.z > low + 1.5 * metre ? VS_CUT_PLANE : VS_CUT_NONE;
  v->cut_point = vs_v3(0, 0, low + 1.2 * metre), v->cut_normal = vs_v3(0, 0, -1);
}

/* Sets a vertical cut through the centre of the model, seen from the front. */
static void cut_section(const vs_bounds *b, vs_scene_view *v) {
  vs_vec3 middle = vs_v3_scale(vs_v3_add(b->min, b->max), 0.5);
  v->cut_point = middle, v->cut_normal = vs_v3(0, 1, 0);
  v->eye = middle, v->target = vs_v3_add(middle, v->cut_normal);
}

vs_scene_view vs_standard_view_for(const vs_standard_view *row, const vs_bounds *b) {
  vs_scene_view v = { .name = row->name, .view = row->view, .cut = row->cut, .lens = 35 };
  if (v.cut == VS_CUT_PLANE) cut_section(b, &v);
  return v;
}
