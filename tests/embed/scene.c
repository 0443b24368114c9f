/* Tests that a host can hold a scene. The host mirrors the tree of nodes by events, moves nodes, receives changes of a
 * property without causing an endless loop, is called by the program, and picks objects. Every misuse gives an error.
 * Uses the public header alone. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <visualscheme.h>

typedef struct { char said[400], log[400]; vs_handle slider; unsigned updates, hits; double nearest; char node[40]; unsigned line; } host;

static int failures;
#define CHECK(condition) ((condition) ? (void)printf("ok embed:%s\n", #condition) : (failures++, (void)printf("not ok embed:%s (line %d)\n", #condition, __LINE__)))

static void diagnose(void *context, const vs_diagnostic *d) { snprintf(((host *)context)->said, 400, "%s", d->message); }
static vs_outcome run(vs_scheme *s, const char *text) { return vs_eval_text(s, "model", 1, text, strlen(text), 0); }

/* Handles the event that a node was created. The event's argument is the node; its name is added to the log. */
static bool created(void *context, vs_scheme *s, const vs_handle *arguments, size_t count, vs_handle *result) {
  (void)s, (void)result;
  strcat(((host *)context)->log, count == 1 && arguments[0] ? "create " : "? ");
  return true;
}
static bool added(void *context, vs_scheme *s, const vs_handle *arguments, size_t count, vs_handle *result) {
  (void)s, (void)arguments, (void)count, (void)result;
  strcat(((host *)context)->log, "addChild ");
  return true;
}
/* Writes the node's path from the root and its children's names, as a host that mirrors the tree does. */
static void describe(vs_scheme *s, vs_handle node, char *to, size_t size) {
  char path[200] = "", longer[220];
  vs_handle at = vs_handle_retain(s, node);
  while (at) {
    const char *name = vs_node_name(s, at);
    snprintf(longer, sizeof longer, "/%s%s", name ? name : "?", path);
    snprintf(path, sizeof path, "%.199s", longer);
    vs_handle above = vs_node_parent(s, at);
    vs_handle_release(s, at);
    at = above;
  }
  vs_handle children = vs_node_children(s, node);
  size_t used = (size_t)snprintf(to, size, "%s", path);
  for (size_t i = 0; i < vs_handle_count(s, children) && used < size; i++) {
    vs_handle child = vs_handle_item(s, children, i), up = vs_node_parent(s, child);
    const char *name = vs_node_name(s, child);
    used += (size_t)snprintf(to + used, size - used, "%s%s%s", i ? "," : ":", name ? name : "?", vs_handle_same(s, up, node) ? "" : "!");
    vs_handle_release(s, up);
    vs_handle_release(s, child);
  }
  vs_handle_release(s, children);
}
static bool mirrored(void *context, vs_scheme *s, const vs_handle *arguments, size_t count, vs_handle *result) {
  host *h = context;
  (void)result;
  for (size_t i = 0; i < count; i++) {
    if (vs_handle_kind_of(s, arguments[i]) != VS_HANDLE_NODE) continue;
    size_t used = strlen(h->log);
    describe(s, arguments[i], h->log + used, sizeof h->log - used - 2);
    strcat(h->log, " ");
  }
  return true;
}
/* Tests that the handler of an event may read the names, parents and children of nodes, and that every other call fails
 * there. */
static void read_in_events(host *h) {
  vs_options o = vs_options_default();
  o.host = (vs_host){ .context = h, .diagnose = diagnose };
  vs_scheme *s = vs_new(&o);
  vs_handle sees = vs_host_procedure(s, "sees", mirrored, h), five = vs_handle_number(s, 5);
  CHECK(vs_define(s, "sees", sees) && run(s, "(define events (filter (lambda (n) (string-prefix? (symbol->string n) \"Node.\")) (property-names (node-controller))))"
        "(for-each (lambda (e) (property-subscribe (property-ref (node-controller) e) sees)) events)"
        "(if (< (length events) 7) (error \"where are the events?\"))") == VS_OUTCOME_DONE);
  *h->log = 0;
  CHECK(run(s, "(define house (node-create #:name \"house\")) (define roof (node-create #:name \"roof\")) (define plain (node-create))"
               "(node-addchild house roof) (node-addchild house plain) (node-addchild (node-getroot) house) (node-begin roof) (node-end)"
               "(node-removechild house roof) (node-removechildren house)") == VS_OUTCOME_DONE);
  CHECK(strcmp(h->log, "/house /roof /? /house/roof /house/? /root/house:roof,? /root/house/roof /root/house/roof /roof /root/house ") == 0);
  /* outside of an event, the same calls succeed for a node and fail for a value that is not a node */
  vs_handle house = vs_lookup(s, "house");
  *h->said = 0;
  CHECK(!vs_node_name(s, five) && *h->said && (*h->said = 0, !vs_node_parent(s, five)) && *h->said && (*h->said = 0, !vs_node_children(s, five)) && *h->said);
  CHECK(strcmp(vs_node_name(s, house), "house") == 0 && vs_handle_count(s, vs_node_children(s, house)) == 0);
  vs_free(s);
}
/* Handles a change of the model's property: moves the host's slider to the new value at the next vs_update. */
static bool follow(void *context, vs_scheme *s, const vs_handle *arguments, size_t count, vs_handle *result) {
  host *h = context;
  (void)result;
  h->updates++;
  return count == 1 && vs_post(s, h->slider, arguments[0]);
}
static bool area(void *context, vs_scheme *s, const vs_handle *arguments, size_t count, vs_handle *result) {
  double a, b;
  (void)context;
  if (count != 2 || vs_handle_get_numbers(s, arguments[0], &a, 1) != 1 || vs_handle_get_numbers(s, arguments[1], &b, 1) != 1)
    return vs_host_fail(s, "two numbers are wanted"), false;
  *result = vs_handle_number(s, a * b);
  return *result != 0;
}
typedef struct { host *h; const char *part; } view;
static view seen[5];
static bool viewed(void *context, vs_scheme *s, const vs_handle *arguments, size_t count, vs_handle *result) {
  view *v = context;
  (void)s, (void)arguments, (void)count, (void)result;
  strcat(strcat(v->h->log, v->part), " ");
  return true;
}
static bool fit_out(void *context, vs_scheme *s, const vs_handle *arguments, size_t count, vs_handle *result) {
  (void)result;
  strcpy(((host *)context)->log, count == 1 && vs_handle_kind_of(s, arguments[0]) == VS_HANDLE_NODE ? "fitted " : "?");
  return true;
}
static bool reenter(void *context, vs_scheme *s, const vs_handle *arguments, size_t count, vs_handle *result) {
  (void)context, (void)arguments, (void)count, (void)result;
  return run(s, "(+ 1 2)") == VS_OUTCOME_USAGE && vs_node_root(s) == 0 && vs_update(s) == VS_OUTCOME_USAGE;
}
static bool take(void *context, vs_scheme *s, const vs_hit *hit) {
  host *h = context;
  if (h->hits++ == 0) {
    h->nearest = hit->distance, h->line = hit->line;
    snprintf(h->node, sizeof h->node, "%s", vs_node_name(s, hit->node) ? vs_node_name(s, hit->node) : "");
  }
  return true;
}
static unsigned gizmos;
static vs_gizmo last;
static bool gizmo(void *context, vs_scheme *s, const vs_gizmo *g) {
  (void)context;
  last = *g, gizmos++;
  last.node = vs_handle_retain(s, g->node);
  return strcmp(vs_node_name(s, g->node), "longer") != 0; /* returns false at the gizmo "longer", which ends the
                                                           * enumeration: no further gizmo is passed */
}
static bool named(void *context, vs_scheme *s, const vs_hit *hit) {
  char *file = context;
  vs_handle other = vs_handle_text(s, "another text");
  vs_handle_get_text(s, other); /* a later call that returns text must not change the texts of the ray's intersection */
  vs_handle_release(s, other);
  snprintf(file, 40, "%s:%u", hit->file, hit->line);
  return false;
}

/* Tests the data of gizmos (handles that a user drags): their places and permissions, values that the host sets, drags
 * by rays, and values that remain. */
static void hold_gizmos(vs_scheme *s, host *h) {
  CHECK(vs_gizmos(s, gizmo, NULL) == VS_OUTCOME_DONE && gizmos == 0);
  CHECK(run(s, "(define rig (node-create #:parent (node-getroot) #:translate (vxyz 0 0 40)))"
               "(define s (make-slider origin (xyz 10 0 0) 0 20 #:value 8 #:step 2 #:size .5 #:name \"slider\" #:parent rig))"
               "(define width 0) (property-subscribe (property-ref s 'value) (lambda (v) (set! width v)))") == VS_OUTCOME_DONE);
  CHECK(vs_gizmos(s, gizmo, NULL) == VS_OUTCOME_DONE && gizmos == 1 && last.kind == VS_GIZMO_SLIDER);
  CHECK(last.value_count == 1 && last.value[0] == 8 && last.low[0] == 0 && last.high[0] == 20 && last.step == 2);
  CHECK(last.at[2] == 40 && last.size == 0.5 && last.handle_count == 1 && last.handles[0][0] == 4 && last.axes[0][0] == 10);
  vs_handle slider = last.node, good = vs_handle_integer(s, 14), odd = vs_handle_integer(s, 15), far = vs_handle_integer(s, 22);
  CHECK(vs_property_put(s, slider, "value", good) == VS_OUTCOME_DONE && run(s, "(if (not (= width 14)) (car 5))") == VS_OUTCOME_DONE);
  CHECK(vs_property_put(s, slider, "value", odd) == VS_OUTCOME_MODEL && vs_property_put(s, slider, "value", far) == VS_OUTCOME_MODEL);
  vs_handle kept, keep = vs_lookup(s, "gizmo-values"), back = vs_lookup(s, "gizmo-values!");
  CHECK(vs_apply(s, keep, NULL, 0, &kept) == VS_OUTCOME_DONE);
  const double down[] = { 0, 0, -1 };
  vs_handle met;
  CHECK(vs_input(s, VS_INPUT_PRESS, VS_BUTTON_LEFT, (double[]){ 7, 0, 60 }, down, NULL, &met) == VS_OUTCOME_DONE && vs_handle_same(s, met, slider));
  CHECK(vs_input(s, VS_INPUT_DRAG, VS_BUTTON_LEFT, (double[]){ 8.6, 0, 60 }, down, NULL, NULL) == VS_OUTCOME_DONE);
  CHECK(run(s, "(if (not (= width 18)) (car 5))") == VS_OUTCOME_DONE); /* the width of 17.2 is rounded to a multiple of
                                                                        * 2, which gives 18 */
  CHECK(vs_input(s, VS_INPUT_RELEASE, VS_BUTTON_LEFT, (double[]){ 8.6, 0, 60 }, down, NULL, NULL) == VS_OUTCOME_DONE);
  CHECK(vs_apply(s, back, &kept, 1, NULL) == VS_OUTCOME_DONE && run(s, "(if (not (= width 14)) (car 5))") == VS_OUTCOME_DONE);
  CHECK(vs_input(s, VS_INPUT_MOVE, VS_BUTTON_NONE, NULL, NULL, NULL, &met) == VS_OUTCOME_DONE && met == 0);
  CHECK(run(s, "(define pressed #f) (node-on (node-getroot) 'key (lambda (n k) (set! pressed k)))") == VS_OUTCOME_DONE);
  CHECK(vs_input(s, VS_INPUT_KEY, VS_BUTTON_NONE, NULL, NULL, "g", &met) == VS_OUTCOME_DONE && met != 0);
  CHECK(run(s, "(if (not (equal? pressed \"g\")) (car 5))") == VS_OUTCOME_DONE);
  CHECK(vs_input(s, VS_INPUT_PRESS, VS_BUTTON_LEFT, NULL, NULL, NULL, NULL) == VS_OUTCOME_MODEL && strstr(h->said, "from must be a point"));
  CHECK(vs_input(s, (vs_input_kind)9, VS_BUTTON_LEFT, NULL, NULL, NULL, NULL) == VS_OUTCOME_MODEL && strstr(h->said, "kind must be one of"));

  gizmos = 0;
  CHECK(run(s, "(node-scale rig 2) (make-arrow (xyz 0 9 0) uy -1 3 #:value 1 #:name \"longer\" #:parent rig)"
               "(define last-one (make-tripod (xyz 0 0 9) (vxyz 1 0 2) #:name \"mover\" #:parent (node-getroot)))") == VS_OUTCOME_DONE);
  /* the callback ended the enumeration at this gizmo */
  CHECK(vs_gizmos(s, gizmo, NULL) == VS_OUTCOME_DONE && gizmos == 2 && last.kind == VS_GIZMO_ARROW);
  CHECK(last.handles[0][1] == 22 && last.axes[0][1] == 2 && last.low[0] == -1 && last.high[0] == 3 && last.value[0] == 1);
  CHECK(run(s, "(node-removechild (node-getroot) rig)") == VS_OUTCOME_DONE && vs_gizmos(s, gizmo, NULL) == VS_OUTCOME_DONE);
  CHECK(last.kind == VS_GIZMO_TRIPOD && last.handle_count == 2 && last.value_count == 3 && last.low[2] == -2 && last.high[2] == 2);
  CHECK(last.axes[0][0] == 1 && last.axes[1][2] == 1 && last.handles[1][2] == 10);
}

static char freed[60];
static void free_own(void *context, void *object) { /* the callback runs while the interpreter is running, so each call
                                                     * to it is refused */
  if (context && vs_update(context) != VS_OUTCOME_USAGE) strcat(freed, "?");
  strcat(strcat(freed, object), " ");
}
/* Tests the host's own objects as values of properties, with and without passing ownership to the library. */
static void hold_own(vs_scheme *s, host *h) {
  static char own[] = "buffer", bare[] = "window", other[] = "texture";
  vs_handle node = vs_node_create(s, NULL, "owner", vs_node_root(s)), five = vs_handle_integer(s, 5);
  vs_handle owned = vs_handle_host(s, own, free_own, s), not_owned = vs_handle_host(s, bare, NULL, NULL), again;
  CHECK(vs_handle_kind_of(s, owned) == VS_HANDLE_HOST && vs_handle_get_host(s, owned) == own && !vs_handle_get_host(s, five));
  CHECK(vs_property_put(s, node, "buffer", owned) == VS_OUTCOME_DONE && vs_property_put(s, node, "window", not_owned) == VS_OUTCOME_DONE);
  vs_handle_release(s, owned), vs_handle_release(s, not_owned);
  CHECK(vs_handle_get_host(s, owned) == NULL && strstr(h->said, "was released")); /* the handle is invalid after its
                                                                                   * release, while the property still
                                                                                   * owns the object */
  CHECK(run(s, "(gc) (define kept (property-get (node-find \"owner\") 'buffer))") == VS_OUTCOME_DONE && !*freed);
  CHECK(vs_property_get(s, node, "window", &again) == VS_OUTCOME_DONE && vs_handle_get_host(s, again) == bare);
  CHECK(vs_property_put(s, node, "buffer", five) == VS_OUTCOME_DONE && vs_property_put(s, node, "window", five) == VS_OUTCOME_DONE);
  vs_handle_release(s, again);
  CHECK(run(s, "(gc)") == VS_OUTCOME_DONE && !*freed); /* the garbage collector does not free the host's object, since
                                                        * the program still refers to it */
  CHECK(run(s, "(define kept #f) (gc)") == VS_OUTCOME_DONE && run(s, "(gc)") == VS_OUTCOME_DONE);
  CHECK(strcmp(freed, "buffer ") == 0); /* the library freed only the object "buffer", once */
  CHECK(vs_property_put(s, node, "buffer", owned = vs_handle_host(s, other, free_own, s)) == VS_OUTCOME_DONE);
  vs_handle_release(s, node);
}

int main(void) {
  static host h, other;
  vs_options o = vs_options_default();
  o.host = (vs_host){ .context = &h, .diagnose = diagnose };
  vs_scheme *s = vs_new(&o);
  o.host.context = &other;
  vs_scheme *t = vs_new(&o);
  if (!s || !t) return printf("not ok embed: no interpreter\n"), 1;

  vs_handle controller = vs_scene_controller(s), root = vs_node_root(s);
  vs_handle create = vs_property_of(s, controller, "Node.create"), add = vs_property_of(s, controller, "Node.addChild");
  CHECK(vs_property_subscribe(s, create, created, &h) && vs_property_subscribe(s, add, added, &h));
  CHECK(run(s, "(define parent (node-create)) (define child (node-create)) (node-addchild parent child) (node-addchild (node-getroot) parent)") == VS_OUTCOME_DONE);
  CHECK(strcmp(h.log, "create create addChild addChild ") == 0);

  host mirror = { 0 };
  read_in_events(&mirror);
  /* a model that is stored once and placed three times */
  CHECK(run(s, "(define engine (subtract (make-box (xyz -1 -1 0) (xyz 1 1 2)) (make-cylinder (xyz 0 0 1) 2 0.5)))") == VS_OUTCOME_DONE);
  vs_handle engine = vs_lookup(s, "engine");
  CHECK(vs_handle_kind_of(s, engine) == VS_HANDLE_OBJECT);
  const char *names[] = { "a", "b", "c" };
  for (int i = 0; i < 3; i++) {
    vs_handle node = vs_node_create(s, NULL, names[i], root);
    CHECK(vs_node_set_drawing(s, node, engine) == VS_OUTCOME_DONE);
    CHECK(vs_node_place(s, node, (double[]){ 10 * i, 0, 0 }, NULL, NULL) == VS_OUTCOME_DONE);
    vs_handle_release(s, node);
  }
  vs_summary summary;
  CHECK(vs_drawing_summary(s, &summary) == VS_OUTCOME_DONE && summary.solids == 3 && summary.max[0] == 21);
  CHECK(vs_pick(s, (double[]){ -5, 0, 0.5 }, (double[]){ 1, 0, 0 }, take, &h) == VS_OUTCOME_DONE);
  CHECK(h.hits == 3 && fabs(h.nearest - 4) < 1e-9 && strcmp(h.node, "a") == 0 && h.line == 1);
  CHECK(vs_pick(s, (double[]){ 10, 0, 9 }, (double[]){ 0, 0, -1 }, take, (h.hits = 0, &h)) == VS_OUTCOME_DONE && h.hits == 1);
  CHECK(fabs(h.nearest - 8) < 1e-9 && strcmp(h.node, "b") == 0); /* the ray passes through the bore of node b and hits
                                                                  * the floor below it */

  /* a slider and a parameter of the model follow each other; each change causes a single update */
  vs_handle group = vs_node_find(s, "a"), eight = vs_handle_integer(s, 8);
  CHECK(vs_property_put(s, group, "cylinder", eight) == VS_OUTCOME_DONE && vs_property_put(s, controller, "slider", eight) == VS_OUTCOME_DONE);
  vs_handle cylinder = vs_property_of(s, group, "cylinder");
  h.slider = vs_property_of(s, controller, "slider");
  CHECK(vs_property_subscribe(s, cylinder, follow, &h) != 0);
  CHECK(run(s, "(property-subscribe (property-ref (node-controller) 'slider) (lambda (v) (property-put! (node-find \"a\") 'cylinder v)))") == VS_OUTCOME_DONE);
  for (int i = 0; i < 1000; i++) {
    vs_handle v = vs_handle_integer(s, 9 + i);
    if (vs_post(s, h.slider, v)) vs_update(s);
    vs_handle_release(s, v);
  }
  CHECK(vs_update(s) == VS_OUTCOME_DONE && h.updates == 1000);

  /* the program calls procedures of the host; the host may not make certain calls while they run */
  vs_handle procedure = vs_host_procedure(s, "host-area", area, NULL), again = vs_host_procedure(s, "again", reenter, NULL);
  CHECK(vs_define(s, "host-area", procedure) && run(s, "(if (not (= (host-area 3 4) 12)) (car 5))") == VS_OUTCOME_DONE);
  CHECK(run(s, "(host-area 3)") == VS_OUTCOME_MODEL && strcmp(h.said, "host-area: two numbers are wanted") == 0);
  CHECK(vs_define(s, "again", again) && run(s, "(again)") == VS_OUTCOME_DONE && strstr(h.said, "the interpreter is running"));

  /* the host defines node types, and a program names procedures of the host's viewer */
  vs_handle fit = vs_host_procedure(s, "fit-out", fit_out, &h), kind = vs_handle_symbol(s, "lamp");
  vs_handle make = vs_lookup(s, "register-node-type");
  CHECK(vs_apply(s, make, (vs_handle[]){ kind, fit }, 2, NULL) == VS_OUTCOME_DONE);
  vs_handle lamp = vs_node_create(s, "lamp", "fitted", root);
  CHECK(lamp && strncmp(h.log, "fitted ", 7) == 0 && vs_node_create(s, "table", NULL, 0) == 0 && strstr(h.said, "(context lamp)"));
  static const char *const parts[] = { "show", "hide", "prepare", "draw", "finish" };
  for (size_t i = 0; i < 5; i++) {
    char name[20];
    seen[i] = (view){ &h, parts[i] };
    snprintf(name, sizeof name, "host-%s", parts[i]);
    vs_handle viewing = vs_host_procedure(s, name, viewed, &seen[i]);
    CHECK(vs_define(s, name, viewing));
    vs_handle_release(s, viewing);
  }
  CHECK(run(s, "(register-viewer 'window #:show host-show #:hide host-hide #:prepare host-prepare #:draw host-draw"
               " #:finish host-finish)") == VS_OUTCOME_DONE);
  h.log[0] = 0;
  CHECK(run(s, "(viewer-activate 'window)") == VS_OUTCOME_DONE && vs_scene_frame(s, 0.1) == VS_OUTCOME_DONE);
  CHECK(run(s, "(viewer-activate #f)") == VS_OUTCOME_DONE && vs_scene_frame(s, 0.1) == VS_OUTCOME_DONE);
  CHECK(strcmp(h.log, "show prepare draw finish hide ") == 0);

  /* evaluates a program in the environment of a node */
  vs_handle value = 0;
  double number = 0;
  CHECK(vs_node_eval(s, group, "(define height 7) (+ height 1)", &value) == VS_OUTCOME_DONE && vs_handle_get_numbers(s, value, &number, 1) == 1 && number == 8);
  CHECK(run(s, "height") == VS_OUTCOME_MODEL);

  char file[40] = "";
  CHECK(vs_pick(s, (double[]){ -5, 0, 0.5 }, (double[]){ 1, 0, 0 }, named, file) == VS_OUTCOME_DONE && strcmp(file, "model:1") == 0);
  hold_gizmos(s, &h);
  hold_own(s, &h);

  /* calls that misuse the interface give errors */
  CHECK(vs_node_add_child(s, group, group) == VS_OUTCOME_MODEL && strstr(h.said, "cannot hang below itself"));
  CHECK(vs_node_end(s) == VS_OUTCOME_MODEL && strstr(h.said, "no node was begun"));
  CHECK(vs_node_add_child(s, eight, group) == VS_OUTCOME_MODEL && strstr(h.said, "parent must be a node, got 8"));
  CHECK(vs_node_name(t, group) == NULL && strstr(other.said, "another interpreter's"));
  vs_handle_release(s, engine);
  CHECK(vs_handle_kind_of(s, engine) == VS_HANDLE_NONE && strstr(h.said, "was released"));
  CHECK(vs_node_children(s, 0) == 0 && strstr(h.said, "0 is not a handle"));
  CHECK(vs_property_put(s, group, "cylinder", 0) == VS_OUTCOME_USAGE && strstr(h.said, "vs_property_put: 0 is not a handle"));
  CHECK(vs_lookup(s, "no-such-name") == 0 && strstr(h.said, "not defined"));
  CHECK(vs_restart(s) == VS_OUTCOME_DONE && vs_node_parent(s, group) == 0 && strstr(h.said, "older than vs_restart"));
  CHECK(strcmp(freed, "buffer texture ") == 0);

  /* after a restart, messages do not mention the earlier program */
  CHECK(run(s, "(define (of-before x) x)") == VS_OUTCOME_DONE && vs_restart(s) == VS_OUTCOME_DONE);
  CHECK(vs_eval_text(s, "next", 1, "(define x 5)", 12, 0) == VS_OUTCOME_DONE && vs_meshes_begin(s, NULL) == VS_OUTCOME_MODEL);
  CHECK(strstr(h.said, "nothing is drawn") && !strstr(h.said, "of-before"));
  static char last_one[] = "last";
  vs_handle_host(s, last_one, free_own, NULL);
  vs_free(t);
  vs_free(s);
  CHECK(strcmp(freed, "buffer texture last ") == 0);
  return failures != 0;
}
