/* Owns the live view as a host of the scene. See scene_host.h. The language's own (scene-needs) says what there is. */
#include "live/scene_host.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void add_numbers(vs_scheme *s, live_text *t, vs_handle h) {
  double x[3];
  size_t count = vs_handle_get_numbers(s, h, x, 3);
  live_puts(t, "[");
  for (size_t i = 0; i < count && i < 3; i++) {
    if (i > 0) live_puts(t, ",");
    live_number(t, x[i]);
  }
  live_puts(t, "]");
}

static bool flag_at(vs_scheme *s, vs_handle list, size_t index) {
  vs_handle h = vs_handle_item(s, list, index);
  bool flag = h != 0 && vs_handle_get_boolean(s, h);
  vs_handle_release(s, h);
  return flag;
}

/* (kind value size (handle ...)) */
static void add_gizmo(vs_scheme *s, live_text *t, vs_handle gizmo) {
  vs_handle kind = vs_handle_item(s, gizmo, 0), value = vs_handle_item(s, gizmo, 1), size = vs_handle_item(s, gizmo, 2),
            handles = vs_handle_item(s, gizmo, 3);
  live_puts(t, "{\"kind\":");
  live_json(t, vs_handle_get_text(s, kind));
  live_puts(t, ",\"value\":");
  add_numbers(s, t, value);
  live_puts(t, ",\"size\":");
  add_numbers(s, t, size);
  live_puts(t, ",\"handles\":[");
  for (size_t i = 0; i < vs_handle_count(s, handles); i++) {
    vs_handle at = vs_handle_item(s, handles, i);
    if (i > 0) live_puts(t, ",");
    add_numbers(s, t, at);
    vs_handle_release(s, at);
  }
  live_puts(t, "]}");
  const vs_handle all[] = { kind, value, size, handles };
  for (size_t i = 0; i < 4; i++) vs_handle_release(s, all[i]);
}

bool live_scene_needs(vs_scheme *s, live_text *t) {
  vs_handle asked = vs_lookup(s, "scene-needs"), needs = 0;
  bool ok = asked != 0 && vs_apply(s, asked, NULL, 0, &needs) == VS_OUTCOME_DONE, frames = ok && flag_at(s, needs, 0);
  live_putf(t, "{\"frames\":%s,\"input\":%s,\"gizmos\":[", frames ? "true" : "false",
            ok && flag_at(s, needs, 1) ? "true" : "false");
  vs_handle gizmos = ok ? vs_handle_item(s, needs, 2) : 0;
  for (size_t i = 0; gizmos != 0 && i < vs_handle_count(s, gizmos); i++) {
    vs_handle gizmo = vs_handle_item(s, gizmos, i);
    if (i > 0) live_puts(t, ",");
    add_gizmo(s, t, gizmo);
    vs_handle_release(s, gizmo);
  }
  live_puts(t, "]}");
  vs_handle_release(s, gizmos);
  vs_handle_release(s, needs);
  vs_handle_release(s, asked);
  return frames;
}

vs_outcome live_scene_input(vs_scheme *s, const char *kind, const char *text) {
  static const char *const kinds[] = { "press", "drag", "release", "move" }; /* as vs_input_kind counts */
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
