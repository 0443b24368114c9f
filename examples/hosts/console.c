/* A host in C without a window, as the beginning of a game engine. It runs table.vs, keeps the data for a graphics
 * card, runs frames, picks objects, sets a gizmo, and runs the program again with another parameter. Usage: `console
 * table.vs`. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <visualscheme.h>

enum { MOST = 64 };
typedef struct { uint64_t id; size_t triangles, places; } gpu_mesh;
typedef struct {
  gpu_mesh meshes[MOST];
  size_t count;
  const char *const *materials; /* names of the engine's materials, by number from 1 */
} engine;

static void diagnose(void *context, const vs_diagnostic *d) {
  (void)context;
  printf("%s:%u:%u: %s\n", d->at.file ? d->at.file : "-", d->at.line, d->at.column, d->message);
}

static uint64_t material(void *context, const char *name) {
  engine *e = context;
  uint64_t number = 1;
  while (e->materials[number - 1] && strcmp(e->materials[number - 1], name) != 0) number++;
  return e->materials[number - 1] ? number : 0;
}

static gpu_mesh *find(engine *e, uint64_t id) {
  size_t i = 0;
  while (i < e->count && e->meshes[i].id != id) i++;
  if (i == MOST) exit(1);
  if (i == e->count) e->meshes[e->count++] = (gpu_mesh){ .id = id };
  return &e->meshes[i];
}

/* Receives the changes of the meshes since the last call. An engine would copy the arrays to the graphics card here. */
static void synchronise(engine *e, vs_scheme *s, const char *when) {
  unsigned changes[3] = { 0 };
  size_t triangles = 0, named = 0;
  vs_mesh_info m;
  if (vs_meshes_begin(s, NULL) == VS_OUTCOME_DONE)
    while (vs_mesh_next(s, &m)) {
      gpu_mesh *mine = find(e, m.id);
      changes[m.change]++;
      if (m.change == VS_MESH_REMOVED) {
        *mine = e->meshes[--e->count];
        continue;
      }
      if (m.change == VS_MESH_ADDED) mine->triangles = m.triangle_count;
      for (size_t i = 0; i < m.part_count; i++) named += m.parts[i].material_id != 0;
      mine->places = m.place_count;
    }
  for (size_t i = 0; i < e->count; i++) triangles += e->meshes[i].triangles * e->meshes[i].places;
  printf("%s: %u added, %u changed, %u removed, %zu parts in the engine's materials; %zu meshes, %zu triangles\n", when,
         changes[VS_MESH_ADDED], changes[VS_MESH_CHANGED], changes[VS_MESH_REMOVED], named, e->count, triangles);
}

static bool first_hit(void *context, vs_scheme *s, const vs_hit *h) {
  const char *name = vs_node_name(s, h->node);
  (void)context;
  printf("hit %s at height %.2f, made at line %u\n", name ? name : "?", h->point[2], h->line);
  return false;
}

static bool slider(void *context, vs_scheme *s, const vs_gizmo *g) {
  vs_handle *found = context;
  if (g->kind != VS_GIZMO_SLIDER) return true;
  *found = vs_handle_retain(s, g->node); /* the handle is valid only in this callback, unless it is retained */
  return false;
}

/* Receives each new value of a property to which the host subscribed. */
static bool follow(void *context, vs_scheme *s, const vs_handle *arguments, size_t count, vs_handle *result) {
  double value = 0;
  (void)context, (void)result;
  if (count == 1 && vs_handle_get_numbers(s, arguments[0], &value, 1) == 1) printf("the slider is at %g\n", value);
  return true;
}

static void set_slider(vs_scheme *s, double to) {
  vs_handle node = 0, value = vs_handle_number(s, to), property;
  vs_gizmos(s, slider, &node);
  if (node && (property = vs_property_of(s, node, "value")) != 0) {
    vs_property_subscribe(s, property, follow, NULL);
    vs_property_put(s, node, "value", value);
    vs_handle_release(s, property);
  }
  vs_handle_release(s, value);
  vs_handle_release(s, node);
}

int main(int count, char **words) {
  static const char *const materials[] = { "oak", "steel", "gold", NULL };
  engine e = { .materials = materials };
  vs_options o = vs_options_default();
  o.host.diagnose = diagnose, o.limit_time = 10;
  vs_scheme *s = count == 2 ? vs_new(&o) : NULL;
  if (!s || vs_eval_file(s, words[1], VS_EVAL_PROGRAM) != VS_OUTCOME_DONE) return 1;
  vs_material_handler(s, material, &e);
  synchronise(&e, s, "at first");
  vs_scene_frame(s, 1 / 60.);
  synchronise(&e, s, "a frame later");
  vs_pick(s, (double[]){ 0.5, 0, 9 }, (double[]){ 0, 0, -1 }, first_hit, NULL);
  set_slider(s, 1.2);
  synchronise(&e, s, "higher");
  set_slider(s, 7);
  /* after a change of the program or of a parameter, run it again: equal meshes keep their ids */
  if (vs_parameter_set(s, "top-length", "3.0") && vs_restart(s) == VS_OUTCOME_DONE &&
      vs_eval_file(s, words[1], VS_EVAL_PROGRAM) == VS_OUTCOME_DONE)
    synchronise(&e, s, "longer");
  vs_free(s);
  return 0;
}
