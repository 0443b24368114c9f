/* Implements visualscheme.h. Combines the interpreter, the model, the geometric procedures and the back-ends in one
 * object. */
#include "bind/back_ends.h"
#include "bind/call/precision.h"
#include "bind/measures.h"
#include "bind/objects.h"
#include "bind/origins.h"
#include "bind/solids/design_rules.h"
#include "bind/parameters.h"
#include "bind/records.h"
#include "bind/scene/node_natives.h"
#include "bind/state.h"
#include "bind/thrown.h"
#include "bind/warnings.h"
#include "session/checking.h"
#include "session/evaluation.h"
#include "session/host.h"
#include "session/own_formats.h"
#include "session/report.h"
#include "session/statistics.h"
#include "visualscheme.h"

#include <stdlib.h>
#include <string.h>

#include "session/advice.h"
#include "session/drawing/comparison.h"
#include "session/fit/scan_fit.h"
#include "session/handles.h"
#include "session/host_meshes.h"
#include "session/names.h"
#include "session/profile/call_profile.h"
#include "session/stops.h"
#include "solids/drawn_bounds.h"

#include "backends/export.h"
#include "model/store/cache.h"
#include "passes/passes.h"
#include "session/spine.h"
#include "vm/front/scan.h"
#include "vm/front/source.h"
#include "vm/machine/image.h"
#include "vm/machine/open_vm.h"
#include "vm/machine/poll.h"
#include "vm/machine/program.h"
#include "vm/numbers/number.h"
#include "vm/stepping/resume.h"
#include "vm/stepping/step.h"
#include "vm/values/heap.h"
#include "vm/values/printer.h"

extern const vs_shipped vs_shipped_library[]; /* the files of library/, which the Makefile links into the program */
extern const vs_image vs_library_image; /* image of the heap after the library was loaded, made at build time by
                                         * scripts/stage0.c */

const char *vs_version(void) { return VS_VERSION; }

/* ---- opening and closing ---- */

void vs_options_init(vs_options *o, size_t size) {
  const vs_options usual = { .size = sizeof usual };
  vs_session_give_options(o, size, &usual, sizeof usual);
}

/* Defines the next name for results at the prompt ($1, $2 ...) with the value v. */
static bool name_result(vs_session *s, vs_value v) {
  vs_scheme *vm = s->bind.vm;
  VS_ROOTS(vm, r, 3);
  char name[24];
  r[0] = v;
  snprintf(name, sizeof name, "$%u", ++s->results);
  if (!vs_intern_c(vm, name, &r[1]) || !vs_environment_define(vm, vm->at.program, r[1], &r[2])) return false;
  vs_gc_store(vm, vs_as_cell(r[2]), &vs_as_cell(r[2])->value, r[0]);
  return true;
}

/* Shows an object in one line: its expression if the expression is short, otherwise its kind; then the size of its
 * bounding box. If the exact box would take long to compute, shows an upper bound of its size. */
static bool tell_object(vs_session *s, vs_value v) {
  vs_scheme *vm = s->bind.vm;
  enum { SHORT = 60 };
  vs_text shown, t;
  VS_ROOTS(vm, r, 1);
  r[0] = v;
  vs_ref object = vs_bind_take_ref(r[0]);
  vs_text_open(vm, &shown, SHORT);
  vs_text_open(vm, &t, 0);
  bool ok = vs_print(vm, r[0], VS_PRINT_WRITE, &shown) && vs_text_end(&shown);
  vs_bind_counts parts = { 0 };
  char text[200];
  if (ok && !shown.cut) ok = vs_text_puts(&t, shown.at);
  else if (ok) {
    const char *kind = vs_kind_get(object.node->kind)->name;
    if (object.node->kind == VS_UNION && vs_bind_count(object, &parts, &(vs_error){ 0 })) snprintf(text, sizeof text,
        "#<%s of %.15g object%s>", kind, parts.all, parts.all == 1 ? "" : "s");
    else snprintf(text, sizeof text, "#<%s>", kind);
    ok = vs_text_puts(&t, text);
  }
  vs_bounds b;
  vs_error e = { 0 };
  vs_fineness facets = { .tolerance = vs_bind_tolerance(s->bind.vm) };
  vs_kernel_options options = { .job = &s->bind.job };
  size_t budget = VS_DRAWN_BOUNDS_MOST;
  vs_drawn_search search = { .facets = &facets, .options = &options, .budget = &budget };
  object = vs_bind_take_ref(r[0]);
  if (ok && vs_node_bounds(object.node, &b, &e) && !vs_bounds_is_empty(&b) &&
      isfinite(b.max.x - b.min.x + b.max.y - b.min.y + b.max.z - b.min.z) &&
      vs_drawn_bounds(&object, &search, &b, &e)) {
    vs_vec3 size = vs_v3_sub(b.max, b.min);
    if (vs_bounds_is_empty(&b)) snprintf(text, sizeof text, " ; nothing");
    else snprintf(text, sizeof text, " ; %s%.4g x %.4g x %.4g %s", search.at_most ? "at most " : "", size.x, size.y,
        size.z, s->bind.scene.units);
    ok = vs_text_puts(&t, text);
  }
  if (ok) s->options.host.value(s->options.host.context, t.at, t.count);
  vs_text_close(&shown);
  vs_text_close(&t);
  return ok;
}

/* Returns the number of objects in the list. Returns 0 if v is no list, or contains other values. */
static size_t objects_in_list(vs_value v) {
  size_t n = 0;
  for (; vs_is_pair(v); v = vs_cdr(v), n++)
    if (!vs_bind_take_ref(vs_car(v)).node) return 0;
  return v == VS_NIL ? n : 0;
}

/* Receives the value of a top-level expression, which the prompt shows. If the program draws nothing, the value is the
 * model. */
static bool take_value(vs_scheme *vm, vs_value v, vs_pos place) {
  vs_session *s = vs_session_of(vm);
  const vs_host *h = &s->options.host;
  VS_ROOTS(vm, r, 1); /* a root of the garbage collector, because defining a name for the value may move the value */
  r[0] = v;
  if (!vs_bind_returned(&s->bind, r[0], s->flags & VS_EVAL_PRINT)) return false;
  if (!(s->flags & VS_EVAL_PRINT)) vs_session_advise_named(s, r[0], place);
  if (!(s->flags & VS_EVAL_PRINT) || !h->value || r[0] == VS_UNSPECIFIC) return true;
  if (s->flags & VS_EVAL_NUMBER && !name_result(s, r[0])) return false;
  if (s->flags & VS_EVAL_NUMBER && vs_bind_take_ref(r[0]).node) return tell_object(s, r[0]);
  /* Greatest lengths in bytes of the texts of values at the prompt. MOST: without a name; MOST_NUMBERED: with a name
   * such as $1, by which the user can examine the value further. */
  enum { MOST = 4000, MOST_NUMBERED = 1000 };
  vs_text shown, t;
  vs_text_open(vm, &shown, s->flags & VS_EVAL_NUMBER ? MOST_NUMBERED : MOST);
  vs_text_open(vm, &t, 0);
  bool ok = vs_print(vm, r[0], VS_PRINT_WRITE, &shown);
  size_t objects = shown.cut && s->flags & VS_EVAL_NUMBER ? objects_in_list(r[0]) : 0;
  char note[60] = "";
  /* Cuts the text between words: a number that is cut in the middle would be a different number. */
  while (shown.cut && shown.count && shown.at[shown.count - 1] != ' ') shown.count--;
  if (shown.cut && shown.count) shown.count--;
  if (objects) snprintf(note, sizeof note, "#<list of %zu objects>", objects);
  else if (shown.cut && s->flags & VS_EVAL_NUMBER)
    snprintf(note, sizeof note, " ... ; (display $%u) shows all of it", s->results);
  else if (shown.cut) snprintf(note, sizeof note, " ...");
  ok = ok && (objects || vs_text_put(&t, shown.at ? shown.at : "", shown.count)) && vs_text_puts(&t, note);
  vs_bind_counts parts;
  vs_ref object = shown.cut ? vs_bind_take_ref(r[0]) : (vs_ref){ NULL, NULL };
  /* appends a comment with the number of parts, as in (unite ... ; 3000 objects */
  if (ok && object.node && vs_bind_count(object, &parts, &(vs_error){ 0 })) {
    char text[60];
    snprintf(text, sizeof text, " ; %.15g object%s", parts.all, parts.all == 1 ? "" : "s");
    ok = vs_text_puts(&t, text);
  }
  if (ok && vs_is_ratio(r[0])) { /* appends a comment with a decimal number to a ratio, as in 1/3 ; 0.333333 */
    double d;
    char text[40];
    ok = vs_number_double(vm, r[0], &d);
    snprintf(text, sizeof text, " ; %.6g", d);
    ok = ok && vs_text_puts(&t, text);
  }
  if (ok && t.count) h->value(h->context, t.at, t.count); /* shows nothing for the value of (values), which is empty */
  vs_text_close(&shown);
  vs_text_close(&t);
  return ok;
}

/* Reports a warning of the macro expander at its place in the user's text. Ignores warnings about the library's own
 * text. */
static void warn_program(vs_scheme *vm, vs_pos place, const char *message) {
  vs_session *s = vs_session_of(vm);
  vs_span at;
  if (vs_session_span(s, place, &at))
    vs_session_report_at(s, VS_SEVERITY_WARNING, VS_OUTCOME_DONE, at, message);
}

/* Returns true if the name is that of a built-in format. Used by register-drawing-function and define-back-end. Unlike
 * vs_format_find, it accepts no paths. */
static bool is_built_in(const char *name) { return !strpbrk(name, "./") && vs_export_format_find(name) != NULL; }
static bool is_format(const vs_bind *b, const char *name) {
  return is_built_in(name) || (!strpbrk(name, "./") && vs_bind_back_end_find(b, name) != NULL);
}

static void warn_vm(vs_scheme *vm, const char *kind, const char *message) {
  if (message) vs_bind_warn(vs_bind_of(vm), kind, "%s", message);
  else vs_bind_clear(vs_bind_of(vm), kind);
}

/* The callback for phases of the VM: switches the session's phase of work, and returns the previous phase. The VM's
 * phases are the first phases of tally.def, in the same order. */
static vs_vm_phase vm_phase(void *session, vs_vm_phase phase) {
  vs_work_phase was = vs_tally_enter(&((vs_session *)session)->tally, (vs_work_phase)phase);
  return was <= VS_WORK_RUN ? (vs_vm_phase)was : VS_VM_RUN;
}
_Static_assert((int)VS_WORK_READ == VS_VM_READ && (int)VS_WORK_EXPAND == VS_VM_EXPAND &&
                   (int)VS_WORK_COMPILE == VS_VM_COMPILE && (int)VS_WORK_RUN == VS_VM_RUN,
               "tally.def");

static void *store_memory(void *session, void *old, size_t old_bytes, size_t bytes) {
  return vs_session_memory(session, old, old_bytes, bytes);
}

static void *bootstrap_memory(const vs_options *o, void *old, size_t old_bytes, size_t bytes) {
  if (o->alloc) return o->alloc(o->alloc_context, old, old_bytes, bytes);
  return bytes ? realloc(old, bytes) : (free(old), NULL);
}

static bool open_program(vs_scheme *vm) {
  vs_flat_rules rules;
  vs_bind_flat_rules(&rules);
  return vs_flat_register(vm, &rules) && vs_front_open(vm) && vs_program_new(vm, &vm->at.program);
}

/* ---- copies of the texts in the options: one block, which begins with the array of command-line arguments ---- */

static size_t text_bytes(const vs_options *o) {
  size_t bytes = o->command_line_count * sizeof(char *);
  for (size_t i = 0; i < o->command_line_count; i++) bytes += strlen(o->command_line[i]) + 1;
  return bytes + (o->library_path ? strlen(o->library_path) + 1 : 0);
}

/* Copies the texts of the options. If memory is out, returns false, and the session has no copies. */
static bool copy_texts(vs_session *s) {
  vs_options *o = &s->options;
  size_t bytes = s->text_bytes = text_bytes(o);
  s->texts = bytes ? vs_session_memory(s, NULL, 0, bytes) : NULL;
  if (bytes && !s->texts) return s->text_bytes = 0, false;
  const char **words = s->texts;
  char *at = s->texts ? (char *)(words + o->command_line_count) : NULL;
  for (size_t i = 0; i < o->command_line_count; i++) {
    size_t n = strlen(o->command_line[i]) + 1;
    words[i] = memcpy(at, o->command_line[i], n);
    at += n;
  }
  o->command_line = words;
  if (o->library_path) o->library_path = memcpy(at, o->library_path, strlen(o->library_path) + 1);
  return true;
}

static void free_texts(vs_session *s) {
  if (s->texts) vs_session_memory(s, s->texts, s->text_bytes, 0);
}

vs_scheme *vs_new(const vs_options *options) {
  vs_options o = vs_options_default();
  vs_session_take_options(&o, sizeof o, VS_FIRST_OPTIONS, options);
  vs_session *s = bootstrap_memory(&o, NULL, 0, sizeof *s);
  if (!s) return NULL;
  memset(s, 0, sizeof *s);
  s->options = o;
  s->tally = (vs_tally){ .held = &s->bytes, .now = VS_WORK_NONE, .since = vs_clock() };
  s->inputs = (vs_known_files){ .memory = vs_session_memory, .context = s };
  s->job = vs_session_job(s);
  atomic_init(&s->interrupted, false);
  bool copied = copy_texts(s);
  vs_config config = {
    .memory = vs_session_memory,
    .user = s,
    .memory_limit = o.limit_memory,
    .stack_limit = o.limit_stack,
    .step_limit = o.limit_steps,
    .output_limit = o.limit_output,
    .time_limit = o.limit_time,
    .phase = vm_phase,
    .clock = vs_session_clock,
    .interrupted = vs_session_interrupted,
    .tables = vs_nodes_tables(),
    .image = &vs_library_image,
    .io = &vs_session_io,
    .keep_calls = o.keep_calls,
    .value = take_value,
    .dropped = vs_bind_dropped,
    .warn = warn_program,
    .suspect = warn_vm,
    .library_path = s->options.library_path,
    .shipped = vs_shipped_library,
    .command_line = s->options.command_line,
    .command_line_count = s->options.command_line_count,
  };
  vs_store *store = vs_store_new(store_memory, s);
  vs_scheme *vm = store && copied ? vs_open_vm(&config) : NULL;
  bool ok = vm && vs_bind_open(&s->bind, vm, store) && open_program(vm);
  if (ok) s->bind.library_files = vs_bind_file_count(vm);
  if (store) vs_store_release(store); /* releases this function's reference to the store, since s->bind has one */
  if (ok) vs_store_set_job(store, &s->job);
  if (ok && o.cache != SIZE_MAX) { /* if memory is out, the session works without a cache */
    enum { USUAL = 256 };
    vs_cache_new(store, o.cache ? o.cache : o.limit_memory ? o.limit_memory / 4 : (size_t)USUAL << 20);
  }
  s->bind.host_call = vs_session_host_call;
  s->bind.is_built_in = is_built_in;
  s->bind.is_format = is_format;
  s->bind.mesh_triangles = o.limit_triangles;
  s->bind.job.warn = vs_session_warn, s->bind.job.tally = &s->tally;
  if (ok) return vm;
  if (vm) vs_free(vm);
  else {
    free_texts(s);
    bootstrap_memory(&o, s, sizeof *s, 0);
  }
  return NULL;
}

vs_outcome vs_restart(vs_scheme *vm) {
  vs_session *s = vs_session_of(vm);
  if (vs_session_busy(s, "vs_restart")) return VS_OUTCOME_USAGE;
  vs_scheme *fresh = vs_open_vm(&vm->config);
  if (fresh) fresh->host = s;
  if (!fresh || !open_program(fresh)) {
    if (fresh) vs_close_vm(fresh);
    return vs_session_out_of_memory(s);
  }
  vs_replace_vm(vm, fresh); /* closes the old VM and releases its objects, which refer to nodes */
  vs_bind_restart(&s->bind);
  vs_session_forget_handles(s);
  for (size_t i = 0; i < s->source_count; i++) s->sources[i].before = true;
  s->exit_requested = false;
  s->results = 0;
  vs_session_forget_profile(s); /* deletes the samples, whose names belong to the old heap */
  return VS_OUTCOME_DONE;
}

void vs_free(vs_scheme *vm) {
  if (!vm) return;
  vs_session *s = vs_session_of(vm);
  vs_close_vm(vm); /* releases the VM's objects, which refer to nodes */
  if (!s) return;
  vs_session_free_own_formats(s);
  vs_session_free_handles(s);
  vs_session_free_meshes(s);
  vs_session_free_comparison(s);
  vs_session_free_fit(s);
  vs_session_forget_profile(s);
  vs_bind_close(&s->bind);
  vs_session_close_files(s);
  vs_session_free_sources(s);
  vs_known_files_free(&s->inputs);
  vs_session_free_outputs(s);
  free_texts(s);
  vs_options o = s->options;
  bootstrap_memory(&o, s, sizeof *s, 0);
}

void vs_interrupt(vs_scheme *vm) { atomic_store(&vs_session_of(vm)->interrupted, true); }
void vs_interrupt_clear(vs_scheme *vm) { atomic_store(&vs_session_of(vm)->interrupted, false); }

/* ---- running programs ---- */

/* Returns true if an interrupt came while no program ran, and reports the interrupt. */
static bool was_interrupted(vs_session *s) {
  if (!atomic_exchange(&s->interrupted, false)) return false;
  vs_session_report_at(s, VS_SEVERITY_ERROR, VS_OUTCOME_INTERRUPTED, (vs_span){ 0 }, "interrupted");
  return true;
}

/* Returns false if an interrupt came while no program ran. The next evaluation then ends before it begins. */
static bool may_run(vs_session *s) {
  return !vs_session_interrupted(s) || vs_fail(s->bind.vm, s->bind.vm->sym.interrupt, "interrupted");
}

/* Runs the checks of a program that ended without error, unless the flags postpone them. Deletes the checks of other
 * programs. */
static vs_outcome check(vs_session *s, vs_outcome outcome, unsigned flags) {
  if (outcome == VS_OUTCOME_DONE && !s->exit_requested) return vs_session_check(s, flags);
  if (outcome != VS_OUTCOME_STOPPED) vs_session_check(s, flags | VS_EVAL_PASS);
  return outcome;
}

/* Evaluates a text for vs_eval_text and vs_eval_value. value may be NULL. who: the function's name. */
static vs_outcome evaluate(vs_session *s, const char *who, const char *name, const vs_passage *passage, unsigned flags,
                           vs_handle *value) {
  vs_scheme *vm = s->bind.vm;
  if (value) *value = 0;
  if (vs_session_busy(s, who)) return VS_OUTCOME_USAGE;
  if (was_interrupted(s)) return VS_OUTCOME_INTERRUPTED;
  vs_session_begin(s, flags);
  if (!vs_session_keep_source(s, name, passage->line, passage->at, passage->size))
    return vs_session_finish(s, vs_fail_memory(vm), false);
  VS_ROOTS(vm, r, 1);
  bool within = flags & VS_EVAL_WITHIN && vs_is_pair(vm->at.stops), ok = may_run(s);
  if (within) ok = ok && vs_session_bindings(s, &r[0]) && vs_program_within(vm, name, passage, r[0], &vm->value);
  else ok = ok && vs_program_text(vm, name, passage, !(flags & VS_EVAL_PROGRAM), &vm->value);
  r[0] = vm->value;
  vs_outcome outcome = check(s, vs_session_finish(s, ok, false), flags);
  if (outcome == VS_OUTCOME_DONE && value && !(*value = vs_session_hold(s, &r[0]))) return VS_OUTCOME_MACHINE;
  return outcome;
}
vs_outcome vs_eval_text(vs_scheme *vm, const char *name, unsigned first_line, const char *text, size_t length,
                        unsigned flags) {
  const vs_passage passage = { text, length, first_line };
  return evaluate(vs_session_of(vm), "vs_eval_text", name, &passage, flags, NULL);
}
vs_outcome vs_eval_value(vs_scheme *vm, const char *name, unsigned first_line, const char *text, size_t length,
                         unsigned flags, vs_handle *value) {
  const vs_passage passage = { text, length, first_line };
  return evaluate(vs_session_of(vm), "vs_eval_value", name, &passage, flags, value);
}

vs_outcome vs_resume(vs_scheme *vm, vs_resume_way way) {
  static const vs_step_mode modes[] = { [VS_RESUME_CONTINUE] = VS_STEP_CONTINUE, [VS_RESUME_ENTER] = VS_STEP_ENTER,
    [VS_RESUME_OVER] = VS_STEP_OVER, [VS_RESUME_OUT] = VS_STEP_OUT, [VS_RESUME_SAME] = VS_STEP_SAME };
  vs_session *s = vs_session_of(vm);
  if (vs_session_busy(s, "vs_resume")) return VS_OUTCOME_USAGE;
  VS_ROOTS(vm, r, 1);
  unsigned flags;
  if (!vs_session_take_stop(s, &r[0], &flags)) return VS_OUTCOME_USAGE;
  vs_session_begin(s, flags);
  return check(s, vs_session_finish(s, vs_step_resume(vm, r[0], modes[way], &vm->value), false), flags);
}

/* Sets the title of the drawing to the file name without folder and suffix: "house" for "out/house.vs". */
static bool set_title(vs_session *s, const char *path) {
  const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path, *dot = strrchr(base, '.');
  size_t n = dot && dot > base ? (size_t)(dot - base) : strlen(base);
  const char *title = vs_store_text(s->bind.store, base, n);
  if (title) s->bind.scene.title = title;
  return title != NULL;
}

vs_outcome vs_eval_file(vs_scheme *vm, const char *path, unsigned flags) {
  vs_session *s = vs_session_of(vm);
  char *text;
  size_t length;
  const char *why;
  if (vs_session_busy(s, "vs_eval_file")) return VS_OUTCOME_USAGE;
  if (was_interrupted(s)) return VS_OUTCOME_INTERRUPTED;
  vs_session_begin(s, flags);
  if (!vs_session_read(s, path, true, &text, &length, &why)) {
    s->phase = NULL;
    vs_tally_enter(&s->tally, VS_WORK_NONE);
    return vs_session_unread(s, path, why);
  }
  bool ok = may_run(s) && (set_title(s, path) || vs_fail_memory(vm));
  const vs_passage passage = { text, length, 1 };
  vs_outcome outcome = vs_session_finish(s, ok && vs_program_text(vm, path, &passage, false, &vm->value), false);
  free(text);
  return check(s, outcome, flags);
}

const char *vs_language_of(const char *path) { return vs_source_language(path); }

bool vs_exit_requested(const vs_scheme *vm, int *code) {
  const vs_session *s = vs_session_of(vm);
  if (s->exit_requested) *code = s->exit_code;
  return s->exit_requested;
}

vs_read_status vs_read_check(vs_scheme *vm, const char *text, size_t length) {
  static const vs_read_state states[] = { [VS_TEXT_EMPTY] = VS_READ_EMPTY,
                                          [VS_TEXT_WHOLE] = VS_READ_COMPLETE,
                                          [VS_TEXT_OPEN] = VS_READ_INCOMPLETE,
                                          [VS_TEXT_BAD] = VS_READ_BAD };
  vs_text_check c = { 0 };
  vm->steps = 0, vm->started = vs_session_clock(vs_session_of(vm)); /* steps and time up to here do not count for the
                                                                     * evaluation */
  vs_refuel(vm);
  if (!vs_read_whole(vm, text, length, &c))
    return (vs_read_status){ .state = VS_READ_BAD, .line = 1, .column = 1, .message = "out of memory" };
  return (vs_read_status){ .state = states[c.state],
                           .depth = c.depth,
                           .line = c.line,
                           .column = c.col,
                           .message = c.state == VS_TEXT_BAD ? c.trouble : NULL };
}

/* ---- completing names ---- */

typedef struct {
  vs_scheme *vm;
  const char *prefix;
  size_t prefix_bytes;
  const char **names;
  size_t count, room;
  bool failed;
} name_list;

static bool collect(void *context, vs_value symbol, vs_value binding) {
  name_list *l = context;
  const vs_symbol *name = vs_as_symbol(symbol);
  (void)binding;
  if (name->length < l->prefix_bytes || memcmp(name->name, l->prefix, l->prefix_bytes)) return true;
  if (l->count == l->room) {
    size_t room = l->room ? 2 * l->room : 64;
    const char **more = vs_mem(l->vm, l->names, l->room * sizeof *more, room * sizeof *more);
    if (!more) return l->failed = true, false;
    l->names = more, l->room = room;
  }
  l->names[l->count++] = vs_store_text(vs_session_of(l->vm)->bind.store, name->name, name->length);
  return l->names[l->count - 1] != NULL || (l->failed = true, false);
}

static int by_name(const void *a, const void *b) { return strcmp(*(const char *const *)a, *(const char *const *)b); }

size_t vs_complete(vs_scheme *vm, const char *prefix, bool (*each)(void *context, const char *name), void *context) {
  name_list l = { .vm = vm, .prefix = prefix, .prefix_bytes = strlen(prefix) };
  size_t given = 0;
  vs_environment_each(vm->at.program, collect, &l);
  if (!l.failed && l.count) qsort(l.names, l.count, sizeof *l.names, by_name);
  for (size_t i = 0; !l.failed && i < l.count; i++) {
    if (i && l.names[i] == l.names[i - 1]) continue; /* skips a second entry for a name that is both defined and
                                                      * imported; interned texts have equal addresses */
    given++;
    if (!each(context, l.names[i])) break;
  }
  vs_mem(vm, l.names, l.room * sizeof *l.names, 0);
  return given;
}

/* ---- parameters ---- */

bool vs_parameter_set(vs_scheme *vm, const char *name, const char *datum) {
  vs_session *s = vs_session_of(vm);
  if (*name == 0 || strpbrk(name, " \t\n()[]\"';")) {
    vs_session_report_at(s, VS_SEVERITY_ERROR, VS_OUTCOME_USAGE, (vs_span){ 0 }, "a parameter's name is one word");
    return false;
  }
  if (vs_bind_set_parameter(&s->bind, name, datum)) return true;
  vs_session_out_of_memory(s);
  return false;
}

void vs_parameter_unset(vs_scheme *vm, const char *name) {
  vs_bind_set_parameter(&vs_session_of(vm)->bind, name, NULL);
}

const char *vs_view_name(const vs_scheme *vm, size_t index) {
  const vs_scene *scene = &vs_session_of(vm)->bind.scene;
  return index < scene->view_count ? scene->views[index].name : NULL;
}

size_t vs_parameter_count(const vs_scheme *vm) { return vs_session_of(vm)->bind.parameter_count; }

bool vs_parameter_get(vs_scheme *vm, size_t index, vs_parameter_info *out) {
  static const vs_parameter_type types[] = { [VS_P_BOOLEAN] = VS_PARAMETER_BOOLEAN,
                                             [VS_P_INTEGER] = VS_PARAMETER_INTEGER,
                                             [VS_P_REAL] = VS_PARAMETER_REAL,
                                             [VS_P_STRING] = VS_PARAMETER_STRING,
                                             [VS_P_DATUM] = VS_PARAMETER_DATUM };
  vs_session *s = vs_session_of(vm);
  if (index >= s->bind.parameter_count) return false;
  const vs_bind_parameter *p = &s->bind.parameters[index];
  *out = (vs_parameter_info){
    .name = p->name,
    .label = p->label,
    .group = p->group,
    .type = types[p->type],
    .value = p->value,
    .default_value = p->default_value,
    .has_range = p->has_range,
    .min = p->min,
    .max = p->max,
    .step = p->step,
    .choices = p->choices,
    .choice_count = p->choice_count,
    .unit = p->unit,
    .has_min = p->least,
    .has_max = p->most,
  };
  vs_session_span(s, p->at, &out->at);
  return true;
}

const char *vs_parameter_unused(const vs_scheme *vm, size_t index) {
  const vs_bind *b = &vs_session_of(vm)->bind;
  for (size_t i = 0; i < b->setting_count; i++)
    if (!b->settings[i].used && index-- == 0) return b->settings[i].name;
  return NULL;
}

const char *vs_report_get(const vs_scheme *vm, size_t index, double *value) {
  const vs_bind *b = &vs_session_of(vm)->bind;
  if (index >= b->report_count) return NULL;
  *value = b->reports[index].value;
  return b->reports[index].name;
}

bool vs_rule_get(const vs_scheme *vm, size_t index, vs_rule_info *out) {
  const vs_bind *b = &vs_session_of(vm)->bind;
  if (index >= b->design_rule_count) return false;
  const vs_design_rule *r = &b->design_rules[index];
  *out = (vs_rule_info){ .name = r->name, .condition = r->condition, .found = r->found, .shortfall = r->shortfall };
  if (r->origin) out->at = (vs_span){ .file = r->origin->file, .line = r->origin->line, .column = r->origin->column };
  return true;
}

/* ---- the drawing ---- */

void vs_drawing_clear(vs_scheme *vm) { vs_bind_clear_drawing(&vs_session_of(vm)->bind); }

vs_outcome vs_drawing_summary(vs_scheme *vm, vs_summary *out) { return vs_session_summary(vs_session_of(vm), out); }

/* ---- formats ---- */

static const vs_format_info formats[] = {
#define VS_FORMAT(suffix, backend, name, worker, binary, doc) { name, #suffix, doc, worker, binary },
#include "backends/backends.def"
};

const vs_format_info *vs_format_list(size_t *count) {
  *count = sizeof formats / sizeof *formats;
  return formats;
}

const char *vs_format_endings(void) {
#define VS_FORMAT(suffix, backend, name, worker, binary, doc) " ." #suffix
#define VS_NOTATION(suffix, backend, name, worker, binary, doc)
  static const char all[] =
#include "backends/backends.def"
      ;
  return all + 1;
}

const vs_format_info *vs_format_find(const char *text) {
  const vs_format *f = vs_export_format_find(text);
  for (size_t i = 0; f && i < sizeof formats / sizeof *formats; i++)
    if (!strcmp(formats[i].name, f->name)) return &formats[i];
  return NULL;
}

/* Returns the format with this name or suffix, which is built in, or defined by the host or the program. *room stores a
 * format that the program defines. */
static const vs_format *format_of(const vs_session *s, const char *text, vs_format *room) {
  const vs_format *own = vs_export_format_find(text);
  if (!own) own = vs_session_own_format(s, text);
  const vs_bind_back_end *brought = own ? NULL : vs_bind_back_end_find(&s->bind, text);
  if (!brought) return own;
  *room = (vs_format){ .suffix = brought->suffix,
                       .name = brought->name,
                       .doc = brought->doc,
                       .binary = brought->binary,
                       .backend = &vs_backend_given };
  return room;
}

bool vs_format_of(const vs_scheme *vm, const char *text, vs_format_info *out) {
  vs_format room;
  const vs_format *f = format_of(vs_session_of(vm), text, &room);
  if (!f) return false;
  *out =
      (vs_format_info){ .name = f->name, .suffix = f->suffix, .doc = f->doc, .worker = f->worker, .binary = f->binary };
  return true;
}

/* ---- writing outputs ---- */

const char *vs_unit_name(size_t index) { return vs_unit_at(index); }

const char *const *vs_look_list(size_t *count) {
  static const char *const names[] = {
#define STYLE(upper, name) name,
#include "model/styles.def"
#undef STYLE
  };
  *count = sizeof names / sizeof *names;
  return names;
}

const char *const *vs_pass_list(size_t *count) {
  static const char *const names[] = {
#define VS_PASS(upper, lower, begin, end, doc) #lower,
#include "passes/passes.def"
  };
  *count = sizeof names / sizeof *names;
  return names;
}

/* Returns true if the crop rectangle is not empty and lies within the picture. Otherwise reports an error and returns
 * false. */
static bool crop_is_within(vs_session *s, const vs_output_options *o) {
  const int *c = o->crop;
  if (!c[0] && !c[1] && !c[2] && !c[3]) return true;
  vs_export_options size;
  vs_session_size(o, &size);
  bool ok = c[0] >= 0 && c[1] >= 0 && c[2] > 0 && c[3] > 0 && c[2] <= size.width - c[0] && c[3] <= size.height - c[1];
  char text[200];
  snprintf(text, sizeof text, "the part of %d by %d pixels at %d,%d is not within the picture of %d by %d", c[2], c[3],
           c[0], c[1], size.width, size.height);
  if (!ok) vs_session_report_at(s, VS_SEVERITY_ERROR, VS_OUTCOME_USAGE, (vs_span){ 0 }, text);
  return ok;
}

static vs_outcome write_to(vs_scheme *vm, const char *path, const char *format_name, const vs_output_options *options,
                           vs_byte_sink *to) {
  vs_session *s = vs_session_of(vm);
  if (vs_session_busy(s, "vs_write_drawing")) return VS_OUTCOME_USAGE;
  vs_output_options o = vs_output_options_default();
  vs_session_take_options(&o, sizeof o, VS_FIRST_OUTPUT_OPTIONS, options);
  const char *wanted = format_name ? format_name : path;
  vs_format room;
  const vs_format *format = wanted ? format_of(s, wanted, &room) : NULL;
  if (!format) {
    char text[400];
    snprintf(text, sizeof text, "%.200s: no format has this ending; there are %s", wanted ? wanted : "no format given",
             vs_format_endings());
    vs_session_report_at(s, VS_SEVERITY_ERROR, VS_OUTCOME_USAGE, (vs_span){ 0 }, text);
    return VS_OUTCOME_USAGE;
  }
  if (!crop_is_within(s, &o)) return VS_OUTCOME_USAGE;
  if (path && vs_known_files_read(&s->inputs, path)) {
    vs_session_report_at(s, VS_SEVERITY_ERROR, VS_OUTCOME_USAGE, (vs_span){ .file = path }, VS_INPUT_KEPT);
    return VS_OUTCOME_USAGE;
  }
  return vs_session_write(s, path, format, &o, to);
}

vs_outcome vs_part_names(vs_scheme *vm, const char **names, size_t room, size_t *count) {
  vs_session *s = vs_session_of(vm);
  *count = 0;
  return vs_session_busy(s, "vs_part_names") ? VS_OUTCOME_USAGE : vs_session_parts(s, names, room, count);
}

bool vs_is_input(const vs_scheme *vm, const char *path) {
  return vs_known_files_read(&vs_session_of(vm)->inputs, path);
}
const char *vs_input_name(const vs_scheme *vm, size_t index) {
  return vs_known_files_name(&vs_session_of(vm)->inputs, index);
}
bool vs_note_input(vs_scheme *vm, const char *path) {
  return vs_known_files_add_path(&vs_session_of(vm)->inputs, path);
}

vs_outcome vs_write_drawing(vs_scheme *vm, const char *path, const char *format, const vs_output_options *o) {
  return write_to(vm, path, format, o, NULL);
}

vs_outcome vs_write_drawing_to(vs_scheme *vm, const char *format, const vs_output_options *o,
                               bool (*write)(void *context, const void *bytes, size_t count), void *context) {
  vs_byte_sink to = { write, context };
  return write_to(vm, NULL, format, o, &to);
}
