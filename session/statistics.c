/* Computes the statistics of an interpreter: times, memory and counts of each output, the counts of its drawing, and
 * the keys under which they are listed.
 *
 * At any time exactly one phase of work is active. The phases of an output therefore add up to its time, and the times
 * of programs and outputs to the total. */
#include "session/statistics.h"

#include "session/host.h"
#include "session/session.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "passes/optimise.h"
#include "model/order.h"
#include "model/store/array.h"

enum { OUTPUTS = 64 }; /* greatest number of outputs whose times and counts are kept */

/* ---- times and counts of an output: totals of the session when the output begins, differences from these totals when
 * it ends ---- */

static void drop(vs_session *s, vs_output_record *r) { vs_session_memory(s, r->path, r->path_bytes, 0); }

bool vs_session_output_begin(vs_session *s, const char *path, const char *format) {
  vs_tally *t = &s->tally;
  if (s->output_count == s->output_room && s->output_room < OUTPUTS) {
    size_t room = s->output_room ? 2 * s->output_room : 4;
    vs_output_record *more = vs_session_memory(s, s->outputs, s->output_room * sizeof *more, room * sizeof *more);
    if (!more) return false;
    s->outputs = more, s->output_room = room;
  }
  size_t bytes = strlen(path ? path : "") + 1;
  char *copy = vs_session_memory(s, NULL, 0, bytes);
  if (!copy) return false;
  memcpy(copy, path ? path : "", bytes);
  if (s->output_count == OUTPUTS) {
    drop(s, &s->outputs[0]);
    memmove(s->outputs, s->outputs + 1, --s->output_count * sizeof *s->outputs);
  }
  vs_tally_enter(t, VS_WORK_NONE); /* adds the time since the last change of phase to the active phase */
  vs_output_record *r = &s->outputs[s->output_count++];
  *r = (vs_output_record){ .path = copy,
                           .path_bytes = bytes,
                           .format = format,
                           .tally = *t,
                           .nodes = NAN,
                           .distinct = NAN,
                           .passes = { .commands_before = NAN, .commands_after = NAN },
                           .cache = vs_cache_count(vs_store_cache(s->bind.store)) };
  for (int i = 0; i < VS_PASS_COUNT; i++) r->alone[i] = r->without[i] = NAN;
  for (int i = 0; i < VS_STAGE_COUNT; i++) r->stages[i] = NAN;
  for (int i = 0; i < VS_WORK_COUNT; i++) t->of[i].peak = 0; /* peaks of memory begin at 0 for each output; the peaks of
                                                              * the session are restored at the output's end */
  return true;
}

void vs_session_output_end(vs_session *s, bool done) {
  vs_tally *t = &s->tally;
  vs_tally_enter(t, VS_WORK_NONE);
  vs_output_record *r = &s->outputs[s->output_count - 1];
  vs_cache_stats now = vs_cache_count(vs_store_cache(s->bind.store));
  r->done = done;
  for (int i = 0; i < VS_WORK_COUNT; i++) {
    vs_phase_use before = r->tally.of[i], *all = &t->of[i];
    r->tally.of[i] = (vs_phase_use){ all->seconds - before.seconds, all->growth - before.growth, all->peak };
    if (before.peak > all->peak) all->peak = before.peak;
  }
  /* does not include the time for counting nodes, which only statistics need */
  for (int i = 0; i < VS_WORK_NONE; i++) s->write_seconds += r->tally.of[i].seconds;
  r->tally.written = t->written - r->tally.written;
  r->tally.clusters = t->clusters - r->tally.clusters;
  r->tally.combined = t->combined - r->tally.combined;
  r->tally.copied = t->copied - r->tally.copied;
  r->tally.remembered = t->remembered - r->tally.remembered;
  r->tally.triangles = t->triangles - r->tally.triangles;
  for (int i = 0; i < VS_STEP_COUNT; i++) r->tally.steps[i] = t->steps[i] - r->tally.steps[i];
  r->tally.texts = t->texts - r->tally.texts;
  r->tally.texts_found = t->texts_found - r->tally.texts_found;
  r->tally.bytes_found = t->bytes_found - r->tally.bytes_found;
  for (int i = 0; i < VS_CACHED_KINDS; i++)
    r->cache.hits[i] = now.hits[i] - r->cache.hits[i], r->cache.misses[i] = now.misses[i] - r->cache.misses[i];
}

void vs_session_free_outputs(vs_session *s) {
  for (size_t i = 0; i < s->output_count; i++) drop(s, &s->outputs[i]);
  vs_session_memory(s, s->outputs, s->output_room * sizeof *s->outputs, 0);
  s->outputs = NULL, s->output_count = s->output_room = 0;
}

/* ---- counting nodes and commands ---- */

static int by_value(const void *a, const void *b) {
  const uint64_t *x = a, *y = b;
  return *x < *y ? -1 : *x > *y;
}

/* Sets *all to the number of nodes of the drawing, in which a shared node counts once for each use. Sets *distinct to
 * the number of different nodes, compared by their 64-bit hashes. Leaves with a single reference are not compared; each
 * counts as distinct. */
static bool count_nodes(const vs_scene *scene, double *all, double *distinct, vs_error *e) {
  vs_order order = { .store = scene->store };
  if (!vs_order_make(&order, scene->drawn, scene->drawn_count, e)) return false;
  size_t lone = 0, count = order.count;
  for (size_t i = 0; i < order.count; i++)
    for (uint32_t k = 0; k < order.at[i].node->child_count; k++)
      lone += !vs_order_has(&order, order.at[i].node->children[k].node);
  for (size_t i = 0; i < scene->drawn_count; i++) lone += !vs_order_has(&order, scene->drawn[i].node);
  uint64_t *hashes = vs_fresh(order.count + lone + 1, sizeof *hashes);
  double *sizes = vs_fresh(order.count + 1, sizeof *sizes);
  bool ok = hashes && sizes;
  *all = *distinct = 0;
  for (size_t i = 0; ok && i < order.count; i++) {
    const vs_node *n = order.at[i].node;
    hashes[i] = n->hash;
    sizes[i] = 1;
    for (uint32_t k = 0; k < n->child_count; k++) {
      const vs_node *child = n->children[k].node;
      if (vs_order_has(&order, child)) sizes[i] += sizes[vs_order_of(child)];
      else sizes[i]++, hashes[count++] = child->hash;
    }
  }
  for (size_t i = 0; ok && i < scene->drawn_count; i++) {
    const vs_node *root = scene->drawn[i].node;
    if (vs_order_has(&order, root)) *all += sizes[vs_order_of(root)];
    else ++*all, hashes[count++] = root->hash;
  }
  if (ok && count) qsort(hashes, count, sizeof *hashes, by_value);
  for (size_t i = 0; ok && i < count; i++) *distinct += i == 0 || hashes[i] != hashes[i - 1];
  free(hashes);
  free(sizes);
  vs_order_free(&order);
  return ok || vs_error_memory(e, NULL);
}

/* Counts the commands of the scene after the passes in the bit set `passes`. The scene itself does not change. */
static bool count_commands(const vs_scene *scene, unsigned passes, double *commands, vs_error *e) {
  vs_scene copy = *scene;
  vs_pass_stats stats;
  copy.drawn = NULL, copy.drawn_count = copy.drawn_room = 0;
  bool ok = true;
  for (size_t i = 0; ok && i < scene->drawn_count; i++)
    ok = vs_scene_draw(&copy, scene->drawn[i]) || vs_error_memory(e, NULL);
  ok = ok && vs_scene_optimise(&copy, passes, &stats, NULL, e);
  if (ok) *commands = stats.commands_after;
  for (size_t i = 0; i < copy.drawn_count; i++) vs_node_release(copy.drawn[i].node);
  vs_store_realloc(copy.store, copy.drawn, copy.drawn_room * sizeof *copy.drawn, 0);
  return ok;
}

bool vs_session_output_nodes(vs_session *s, const vs_scene *scene, unsigned passes, vs_error *e) {
  vs_output_record *r = &s->outputs[s->output_count - 1];
  vs_work_phase was = vs_tally_enter(&s->tally, VS_WORK_NONE); /* the time for counting nodes counts for no phase, since
                                                                * only statistics need it */
  bool ok = count_nodes(scene, &r->nodes, &r->distinct, e);
  for (unsigned i = 0; ok && i < VS_PASS_COUNT; i++) {
    unsigned one = 1u << i;
    ok = count_commands(scene, one, &r->alone[i], e) && count_commands(scene, passes & ~one, &r->without[i], e);
  }
  vs_tally_enter(&s->tally, was);
  return ok;
}

/* ---- keys of statistics ---- */

typedef struct { vs_statistic *out; size_t room, count; } list;

static void add(list *l, const char *key, double value, const char *unit) {
  if (l->count < l->room) l->out[l->count] = (vs_statistic){ key, value, unit };
  l->count++;
}

static void add_work(list *l, const vs_tally *t) {
  double total = 0;
  for (int i = 0; i < VS_WORK_NONE; i++) total += t->of[i].seconds;
#define VS_PHASE(upper, lower, doc) add(l, "time." #lower, t->of[VS_WORK_##upper].seconds, "s");
#include "model/tally.def"
  add(l, "time.total", total, "s");
#define VS_STEP(upper, lower, doc) add(l, "time.mesh." #lower, t->steps[VS_STEP_##upper], "s");
#include "model/steps.def"
#define VS_PHASE(upper, lower, doc)                                                    \
  add(l, "memory." #lower ".peak", (double)t->of[VS_WORK_##upper].peak, "bytes");       \
  add(l, "memory." #lower ".growth", t->of[VS_WORK_##upper].growth, "bytes");
#include "model/tally.def"
  add(l, "bytes", (double)t->written, "bytes");
  add(l, "clusters", (double)t->clusters, "");
  add(l, "clusters.combined", (double)t->combined, "");
  add(l, "clusters.copied", (double)t->copied, "");
  add(l, "clusters.remembered", (double)t->remembered, "");
  add(l, "triangles", (double)t->triangles, "");
  add(l, "texts", (double)t->texts, "");
  add(l, "texts.emitted", (double)(t->texts - t->texts_found), "");
  add(l, "texts.remembered", (double)t->texts_found, "");
  add(l, "texts.remembered.bytes", (double)t->bytes_found, "bytes");
}

/* Adds the keys for the drawing of the output r. If r is NULL, there was no output. */
static void add_drawing(list *l, const vs_output_record *r) {
  add(l, "nodes", r ? r->nodes : NAN, "");
  add(l, "nodes.distinct", r ? r->distinct : NAN, "");
  add(l, "commands.before", r ? r->passes.commands_before : NAN, "");
  add(l, "commands.after", r ? r->passes.commands_after : NAN, "");
#define VS_PASS(upper, lower, begin, end, doc)                                                  \
  add(l, "commands.alone." #lower, r ? r->alone[VS_PASS_##upper] : NAN, "");         \
  add(l, "commands.without." #lower, r ? r->without[VS_PASS_##upper] : NAN, "");     \
  add(l, "passes." #lower, r ? (double)r->passes.changed[VS_PASS_##upper] : NAN, "");
#include "passes/passes.def"
}

/* Adds the times of the stages of the output r. If r is NULL, adds the sums over all kept outputs. */
static void add_stages(list *l, const vs_session *s, const vs_output_record *r) {
  static const char *const keys[] = {
#define VS_STAGE(upper, lower, when, formats, doc) "time.stage." #lower,
#include "session/stages.def"
  };
  for (int k = 0; k < VS_STAGE_COUNT; k++) {
    double sum = NAN;
    for (size_t i = 0; !r && i < s->output_count; i++) {
      double one = s->outputs[i].stages[k];
      if (!isnan(one)) sum = isnan(sum) ? one : sum + one;
    }
    add(l, keys[k], r ? r->stages[k] : sum, "s");
  }
}

static void add_found(list *l, const vs_cache_stats *c) {
#define VS_CACHED(upper, lower, doc)                                              \
  add(l, "cache." #lower ".hits", (double)c->hits[VS_CACHED_##upper], "");         \
  add(l, "cache." #lower ".misses", (double)c->misses[VS_CACHED_##upper], "");
#include "model/store/cache.def"
}

size_t vs_statistics(const vs_scheme *vm, vs_statistic *out, size_t room) {
  vs_session *s = vs_session_of(vm);
  list l = { out, room, 0 };
  vs_cache_stats cache = vs_cache_count(vs_store_cache(s->bind.store));
  add(&l, "time.evaluate", s->evaluate_seconds, "s");
  add(&l, "time.write", s->write_seconds, "s");
  add_work(&l, &s->tally);
  add_stages(&l, s, NULL);
  add(&l, "memory.now", (double)s->bytes, "bytes");
  add(&l, "memory.peak", (double)vs_tally_peak(&s->tally), "bytes");
  add(&l, "memory.model", (double)vs_store_bytes(s->bind.store), "bytes");
  add(&l, "heap.collections", (double)vm->collections, "");
  add(&l, "heap.pause", vm->pause, "s");
  add(&l, "steps", (double)vm->steps, "");
  add(&l, "objects.drawn", (double)s->bind.scene.drawn_count, "");
  add(&l, "objects.returned", (double)s->bind.returned_count, "");
  add_drawing(&l, s->output_count ? &s->outputs[s->output_count - 1] : NULL);
  add_found(&l, &cache);
  add(&l, "cache.entries", (double)cache.entries, "");
  add(&l, "cache.bytes", (double)cache.bytes, "bytes");
  add(&l, "cache.peak", (double)cache.peak, "bytes");
  add(&l, "cache.evicted", (double)cache.evicted, "");
  add(&l, "cache.refused", (double)cache.refused, "");
  return l.count;
}

bool vs_output_statistics(const vs_scheme *vm, size_t index, vs_output_info *info, vs_statistic *out, size_t room,
                          size_t *count) {
  vs_session *s = vs_session_of(vm);
  if (index >= s->output_count) return false;
  const vs_output_record *r = &s->outputs[index];
  list l = { out, room, 0 };
  if (info) *info = (vs_output_info){ r->path, r->format, r->done };
  add_work(&l, &r->tally);
  add_stages(&l, s, r);
  add_drawing(&l, r);
  add_found(&l, &r->cache);
  *count = l.count;
  return true;
}
