/* Implements the live view's part as a host of the program's scene. See scene_host.h. The procedure (scene-needs)
 * returns whether the scene changes with time; vs_gizmos lists the gizmos (handles to drag). */
#include "live/scene_host.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void add_numbers(live_text *t, const double *x, size_t count) {
  live_puts(t, "[");
  for (size_t i = 0; i < count; i++) {
    if (i > 0) live_puts(t, ",");
    live_number(t, x[i]);
  }
  live_puts(t, "]");
}

typedef struct { live_text *text; size_t count; } gizmos_told;

static bool add_gizmo(void *context, vs_scheme *s, const vs_gizmo *g) {
  static const char *const kinds[] = { "trigger", "slider", "arrow", "tripod" }; /* kinds[k]: name of gizmos of
                                                                                  * vs_gizmo_kind k */
  gizmos_told *to = context;
  live_text *t = to->text;
  const char *name = vs_node_name(s, g->node);
  live_putf(t, "%s{\"kind\":\"%s\",\"name\":", to->count++ > 0 ? "," : "", kinds[g->kind]);
  live_json(t, name ? name : "");
  live_puts(t, ",\"value\":");
  add_numbers(t, g->value, g->value_count);
  live_puts(t, ",\"size\":");
  add_numbers(t, &g->size, 1);
  live_puts(t, ",\"handles\":[");
  for (size_t i = 0; i < g->handle_count; i++) {
    if (i > 0) live_puts(t, ",");
    add_numbers(t, g->handles[i], 3);
  }
  live_puts(t, "]}");
  return true;
}

static bool flag_at(vs_scheme *s, vs_handle list, size_t index) {
  vs_handle h = vs_handle_item(s, list, index);
  bool flag = h != 0 && vs_handle_get_boolean(s, h);
  vs_handle_release(s, h);
  return flag;
}

bool live_scene_needs(vs_scheme *s, live_text *t) {
  vs_handle asked = vs_lookup(s, "scene-needs"), needs = 0;
  bool ok = asked != 0 && vs_apply(s, asked, NULL, 0, &needs) == VS_OUTCOME_DONE, frames = ok && flag_at(s, needs, 0);
  live_putf(t, "{\"frames\":%s,\"input\":%s,\"gizmos\":[", frames ? "true" : "false",
            ok && flag_at(s, needs, 1) ? "true" : "false");
  if (ok) vs_gizmos(s, add_gizmo, &(gizmos_told){ .text = t });
  live_puts(t, "]}");
  vs_handle_release(s, needs);
  vs_handle_release(s, asked);
  return frames;
}

vs_outcome live_scene_input(vs_scheme *s, const char *kind, const char *text) {
  static const char *const kinds[] = { "press", "drag", "release", "move" }; /* kinds[k]: name of inputs of
                                                                              * vs_input_kind k */
  static const char *const buttons[] = { "left", "middle", "right", "none" };
  enum { COUNT = 4 };
  char word[8];
  double r[6];
  int which = 0, button = 0;
  bool ok = sscanf(text, "%7[a-z] %lf %lf %lf %lf %lf %lf", word, &r[0], &r[1], &r[2], &r[3], &r[4], &r[5]) == 7;
  while (which < COUNT && strcmp(kind, kinds[which]) != 0) which++;
  while (ok && button < COUNT && strcmp(word, buttons[button]) != 0) button++;
  for (size_t i = 0; ok && i < 6; i++) ok = isfinite(r[i]);
  if (!ok || which == COUNT || button == COUNT || (r[3] == 0 && r[4] == 0 && r[5] == 0)) return VS_OUTCOME_USAGE;
  return vs_input(s, (vs_input_kind)which, (vs_input_button)button, r, r + 3, NULL, NULL);
}
