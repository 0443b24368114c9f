/* Fuzzes visualscheme.h: the bytes are a sequence of calls, on an interpreter that is used for this input only. */
#include "tests/fuzz/fuzz.h"

static bool each_name(void *context, const char *name) { return (void)context, *name != 0; }

/* ---- the scene: handles that are valid, 0 or released; callbacks that call the library ---- */

enum { HELD = 8 };
typedef struct {
  vs_scheme *s;
  vs_handle held[HELD], posted;
  unsigned calls;
} fuzz_scene;

static bool scene_called(void *context, vs_scheme *s, const vs_handle *arguments, size_t count, vs_handle *result) {
  fuzz_scene *f = context;
  unsigned turn = f->calls++ % 8;
  if (turn == 1 && vs_update(s) != VS_OUTCOME_USAGE) abort(); /* vs_update must refuse this call, because the
                                                               * interpreter is running */
  if (turn == 2 && vs_node_root(s)) abort();
  if (turn == 3 && count) vs_post(s, f->posted, arguments[0]);
  if (turn == 4) return vs_host_fail(s, "the host fails"), false;
  if (count) *result = vs_handle_retain(s, arguments[0]);
  return true;
}
static bool scene_hit(void *context, vs_scheme *s, const vs_hit *hit) {
  (void)context;
  if (vs_handle_kind_of(s, hit->node) != VS_HANDLE_NODE || vs_handle_kind_of(s, hit->path) != VS_HANDLE_LIST) abort();
  return true;
}
static bool scene_gizmo(void *context, vs_scheme *s, const vs_gizmo *g) {
  (void)context;
  if (g->handle_count > 3 || vs_handle_kind_of(s, g->node) != VS_HANDLE_NODE) abort();
  return true;
}
/* Frees a host object. The library calls this function once for each object, while the interpreter runs or when the
 * interpreter is freed. */
static void scene_released(void *context, void *object) {
  (void)context;
  if ((*(unsigned *)object)-- != 1) abort();
  free(object);
}
static vs_handle scene_own(vs_scheme *s) {
  unsigned *object = malloc(sizeof *object);
  if (!object) return 0;
  *object = 1;
  vs_handle made = vs_handle_host(s, object, scene_released, NULL);
  if (!made) free(object); /* the library did not take over the object */
  else if (vs_handle_get_host(s, made) != object) abort();
  return made;
}
static uint64_t scene_material(void *context, const char *name) { return (void)context, (uint64_t)strlen(name); }

/* Reads all bytes of the meshes that the library returns. */
static void scene_meshes(vs_scheme *s) {
  vs_output_options coarse = vs_output_options_default();
  vs_mesh_info m;
  double sum = 0;
  coarse.segments = 6;
  vs_meshes_begin(s, &coarse);
  while (vs_mesh_next(s, &m)) {
    for (size_t i = 0; i < m.triangle_count; i++)
      for (int k = 0; k < 3; k++) sum += m.points[m.corners[i][k]][0] + m.normals[m.normal_corners[i][k]][0];
    for (size_t i = 0; i < m.place_count; i++) sum += m.places[i][2][3];
    for (size_t i = 0; i < m.part_count; i++) sum += (double)strlen(m.parts[i].material);
  }
  if (sum == 12345.6789) fprintf(stderr, "a rare sum\n");
}

static void scene_call(fuzz_scene *f, unsigned what, unsigned with) {
  static const char *const texts[] = {
    "(make-slider (xyz 0 0 0) (xyz 9 0 0) 0 9 #:step 3 #:size 2 #:parent (node-getroot))",
    "(make-tripod (xyz 0 0 0) (vxyz 1 2 3) #:parent (node-getroot))",
    "(every-frame (lambda (t) (node-clear)))", "(on-pick (make-box (xyz 0 0 0) (xyz 1 1 1)) (lambda (n h) (car 5)))",
    "(make-trigger (xyz 0 0 0) (lambda (g) (node-removechildren (node-getroot))) #:size 3 #:parent (node-getroot))",
    "(register-node-type 'chair (lambda (n) (node-rotate n (vxyz 1 2 3))))", "(node-begin (node-create))",
    "(node-clear)"
  };
  vs_scheme *s = f->s;
  vs_handle a = f->held[with % HELD], b = f->held[with / HELD % HELD], made = 0;
  const double three[] = { (double)(with % 7) - 3, (double)(with % 5) - 2, (double)(with % 11) - 5 };
  const char *text = texts[with % (sizeof texts / sizeof *texts)];
  double v[16];
  switch (what) {
  case 0: vs_eval_text(s, "scene", 1, text, strlen(text), 0); break;
  case 1:
    made = with % 3 ? vs_node_create(s, with % 5 ? NULL : "chair", "n", with % 2 ? a : 0) : vs_node_root(s);
    break;
  case 2: made = with % 2 ? vs_lookup(s, "f") : vs_host_procedure(s, "called", scene_called, f); break;
  case 3:
    made = with % 3 == 2 ? scene_own(s) : with % 2 ? vs_handle_number(s, three[0]) : vs_handle_list(s, (vs_handle[]){ a, b }, 2);
    break;
  case 4: vs_apply(s, a, (vs_handle[]){ b }, with % 2, &made); break;
  case 5: if (with % 2) vs_node_add_child(s, a, b); else vs_node_remove_child(s, a, b); break;
  case 6:
    vs_node_place(s, a, three, with % 2 ? three : NULL, with % 3 ? NULL : three);
    vs_node_matrix(s, a, true, v);
    break;
  case 7: vs_node_set_drawing(s, a, b); break;
  case 8: if (with % 2) vs_node_begin(s, a); else vs_node_end(s); break;
  case 9: vs_property_put(s, a, "width", b), vs_property_get(s, a, "width", &made); break;
  case 10: vs_property_subscribe(s, f->posted, scene_called, f), vs_property_unsubscribe(s, f->posted, with % 4); break;
  case 11:
    vs_handle_release(s, f->posted);
    f->posted = vs_property_of(s, with % 2 ? a : vs_scene_controller(s), with % 3 ? "width" : "Node.create");
    break;
  case 12: vs_post(s, f->posted, a), vs_update(s), vs_scene_frame(s, three[0]), vs_action_apply(s, "turn", a); break;
  case 13: vs_pick(s, three, (double[]){ 0, 0, -1 }, scene_hit, NULL), vs_gizmos(s, scene_gizmo, NULL); break;
  case 14:
    vs_input(s, (vs_input_kind)(with % 6), (vs_input_button)(with % 5), with % 7 ? three : NULL,
             (double[]){ 0, 0, -1 }, "k", with % 2 ? &made : NULL);
    break;
  default: vs_material_handler(s, with % 3 ? scene_material : NULL, NULL), scene_meshes(s);
  }
  if (made || with % 16 == 0) vs_handle_release(s, f->held[with % HELD]), f->held[with % HELD] = made;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static const char *const texts[] = { "(define-parameter n 3 #:min 1 #:max 9)", "(draw (make-box (xyz 0 0 0) (xyz 1 1 1)))", "(make-sphere (xyz 0 0 0) 1)", "(car 5)", "(exit 3)", "(define x", "(let loop () (loop))",
                                       "(erase-all)", "(define (f x) (* x x)) (f 4)", "\"abc", "(draw (subtract (make-sphere (xyz 0 0 0) 1) (make-box (xyz 0 0 0) (xyz 1 1 1))))", "(gc)", "(call/cc (lambda (c) (set! k c)))", "(k 1)",
                                       "(define k #f)", "(sky #:color 'white)" };
  vs_options o = vs_options_default();
  o.untrusted = true, o.limit_steps = 2000, o.limit_memory = 32 << 20, o.limit_time = 5;
  fuzz_file none = { NULL, 0 };
  o.host = (vs_host){ .context = &none, .output = fuzz_drop, .diagnose = fuzz_told, .value = fuzz_value, .read_file = fuzz_read };
  vs_scheme *s = vs_new(&o);
  if (!s) abort();
  vs_output_options how = vs_output_options_default();
  how.segments = 6;
  fuzz_scene scene = { .s = s };
  for (size_t i = 0; i + 1 < size && i < 60; i += 2) {
    if (data[i] % 32 >= 16) {
      scene_call(&scene, data[i] % 16, data[i + 1]);
      continue;
    }
    const char *text = texts[data[i + 1] % (sizeof texts / sizeof *texts)];
    size_t formats, count;
    const vs_format_info *format = &vs_format_list(&formats)[0];
    vs_summary summary;
    vs_parameter_info p;
    vs_statistic all[80];
    vs_output_info info;
    int code;
    switch (data[i] % 16) {
    case 0: case 1: case 2: vs_eval_text(s, "fuzz", data[i + 1], text, strlen(text), data[i + 1] % 4); break;
    case 3: vs_eval_file(s, text, 0); break;
    case 4: vs_restart(s); break;
    case 5: vs_interrupt(s); break;
    case 6: vs_interrupt_clear(s); break;
    case 7: vs_read_check(s, text, strlen(text)); break;
    case 8: vs_complete(s, data[i + 1] % 2 ? "make-" : "", each_name, NULL); break;
    case 9: vs_parameter_set(s, data[i + 1] % 3 ? "n" : "a b", text); break;
    case 10:
      for (size_t k = 0; k <= vs_parameter_count(s); k++) vs_parameter_get(s, k, &p);
      vs_parameter_unused(s, data[i + 1]);
      break;
    case 11: vs_drawing_summary(s, &summary); break;
    case 12: vs_drawing_clear(s); break;
    case 13: case 14:
      format += data[i + 1] % formats;
      if (!format->worker) vs_write_drawing_to(s, format->name, &how, fuzz_drop_bytes, NULL);
      break;
    default:
      vs_exit_requested(s, &code);
      vs_statistics(s, all, data[i + 1] % 80);
      vs_output_statistics(s, data[i + 1] % 4, &info, all, 80, &count);
    }
  }
  vs_free(s);
  return 0;
}
