/* Chooses the views of a drawing: the view of the option --view, or the view with whose name the file's name ends, or
 * the views that every model has. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "backends/drawing/choose_views.h"
#include "model/standard_views.h"

double vs_drawing_unit(const vs_scene *scene) { return 1000 * vs_scene_metres(scene); }

static bool add(vs_emitter *e, vs_flat_view **out, size_t *count, size_t *room, vs_scene_view view) {
  if (!vs_emit_grow(e, out, room, *count + 1, sizeof **out)) return false;
  if (view.view == VS_VIEW_PANORAMA)
    return vs_error_set(e->error, VS_ERROR_MODEL, NULL, "the view \"%.100s\" is a panorama, which only pictures show",
                        view.name);
  if (view.cut == VS_CUT_OWN) vs_standard_cut_plan(e->scene, &e->bounds, &view);
  (*out)[(*count)++] = (vs_flat_view){ .spec = view, .has_cut = view.cut == VS_CUT_PLANE };
  return true;
}

/* Sets *out to the model's view with this name, or else to the view of this name that every model has. Returns false if
 * there is neither. */
static bool find(const vs_emitter *e, const char *name, vs_scene_view *out) {
  const vs_scene_view *v = vs_scene_find_view(e->scene, name);
  if (v) return *out = *v, true;
  const vs_standard_view *own;
  for (size_t i = 0; (own = vs_standard_view_at(i)) != NULL; i++)
    if (strcmp(own->name, name) == 0) return *out = vs_standard_view_for(own, &e->bounds), true;
  return false;
}

/* Copies the file's name, without folders and suffix, to `out`. */
static void stem(const char *path, char *out, size_t room) {
  const char *slash = path ? strrchr(path, '/') : NULL, *base = slash ? slash + 1 : path ? path : "";
  const char *dot = strrchr(base, '.');
  size_t length = dot ? (size_t)(dot - base) : strlen(base);
  snprintf(out, room, "%.*s", (int)(length < room ? length : room - 1), base);
}

/* Sets *out to the view with whose name the file's name ends, after a blank, a hyphen, an underscore or a dot, as in
 * "house-section A". Returns false if there is none. */
static bool find_at_end(const vs_emitter *e, const char *base, vs_scene_view *out) {
  for (const char *at = base; *at; at++)
    if (strchr("-_. ", *at) && at[1] && find(e, at + 1, out)) return true;
  return false;
}

/* Returns true if the model has a view for drawings: one with a cut, a scale or a sheet. */
static bool has_drawing_view(const vs_scene *scene) {
  for (size_t i = 0; i < scene->view_count; i++) {
    const vs_scene_view *v = &scene->views[i];
    if (v->cut != VS_CUT_NONE || v->scale > 0 || v->sheet) return true;
  }
  return false;
}

/* Warns if the end of the file's name is the name of a view in other models, but this model has no such view. If the
 * model has views for drawings, and none is the plan, warns of every name that names none. */
static void warn_of_name(const vs_emitter *e, const char *base) {
  static const char *const words[] = { "north", "south", "east", "west", "roof", "floor", "ground", "side", "rear",
                                       "perspective", "axonometry", "elevations", "sections", "views" };
  const char *last = base;
  char message[300];
  for (const char *at = base; *at; at++)
    if (strchr("-_. ", *at) && at[1]) last = at + 1;
  bool view = last > base && e->scene->view_count > 0;
  view = view || (has_drawing_view(e->scene) && !vs_scene_find_view(e->scene, "plan"));
  for (size_t i = 0; i < sizeof words / sizeof *words; i++) view = view || strcmp(last, words[i]) == 0;
  if (!view) return;
  snprintf(message, sizeof message,
           "%s \"%.80s\", and the model has no view of that name: the drawing is the plan",
           last > base ? "the file's name ends in" : "the file's name is", last);
  vs_job_warn(e->job, NULL, message);
}

static bool unknown(vs_emitter *e, const char *name) {
  char message[420];
  int used = snprintf(message, sizeof message, "the model has no view \"%.80s\"; there are", name);
  for (size_t i = 0; i < e->scene->view_count && used < 300; i++)
    used += snprintf(message + used, sizeof message - (size_t)used, " \"%.40s\",", e->scene->views[i].name);
  const vs_standard_view *own;
  for (size_t i = 0; (own = vs_standard_view_at(i)) != NULL && used < 400; i++)
    used += snprintf(message + used, sizeof message - (size_t)used, "%s %s", i > 0 ? "," : "", own->name);
  return vs_error_set(e->error, VS_ERROR_FILE, NULL, "%s", message);
}

bool vs_drawing_choose(vs_emitter *e, vs_flat_view **out, size_t *count, size_t *room) {
  const char *name = e->options->view;
  char base[128];
  vs_scene_view v;
  stem(e->path, base, sizeof base);
  bool all = name && strcmp(name, "*") == 0, named = name && !all;
  if (named && !find(e, name, &v)) return unknown(e, name);
  if (!named && !all && !find(e, base, &v) && !find_at_end(e, base, &v)) {
    all = strcmp(base, "sheet") == 0;
    if (!all) warn_of_name(e, base);
    if (!all && !find(e, "plan", &v)) return unknown(e, "plan");
  }
  if (!all) return add(e, out, count, room, v);
  bool ok = true;
  for (size_t i = 0; ok && i < e->scene->view_count; i++)
    ok = e->scene->views[i].view == VS_VIEW_PANORAMA || add(e, out, count, room, e->scene->views[i]);
  const vs_standard_view *own;
  for (size_t i = 0, named_views = *count; ok && named_views == 0 && (own = vs_standard_view_at(i)) != NULL; i++)
    if (own->whole) ok = add(e, out, count, room, vs_standard_view_for(own, &e->bounds));
  return ok;
}
