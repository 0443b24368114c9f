/* Nests flat parts on sheets (nesting.h).
 *
 * Parts are placed one after another, each on the first sheet where it fits (nesting_places.h). The order is then
 * changed at random, and a change is kept if the last sheet is filled less far. The random numbers depend only on the
 * parts. */
#include "geometry/nets/nesting.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/nets/nesting_places.h"
#include "model/store/array.h"

enum {
  LATE = 30,  /* A new order of the parts is compared with the order this many changes before. */
  IDLE = 2000 /* number of changes without an improvement after which the search ends */
};

/* An order of the parts, with the places that follow from it and its cost. */
typedef struct {
  uint32_t *order;
  vs_nest_laid *laid;
  int wish;
  double cost, reach; /* cost: length of all sheets but the last, plus the filled length of the last; reach: length to
                       * which the endless sheet is filled, or infinity */
} memory;

typedef struct {
  vs_nest_places at;
  size_t used;     /* number of sheets on which parts lie */
  uint32_t *order; /* numbers of the parts, in the order in which they are placed */
  memory best, now;
  uint64_t most_steps;
  uint32_t chance;
  vs_long_work work;
  bool stopped;
} nest;

/* Places the parts in the order `order`, from index `from` to the end. Sets *cost to the length of all sheets but
 * the last, plus the length to which the last sheet is filled. Gives up, with an infinite cost, when the work reaches
 * `limit`. Returns false when memory is out or the caller interrupts. */
static bool place_all(nest *w, size_t from, uint64_t limit, double *cost) {
  size_t used = 0;
  *cost = INFINITY;
  for (size_t i = 0; i < from; i++)
    if (!vs_nest_lay_again(&w->at, w->order[i], &used)) return false;
  for (size_t i = from; i < w->at.parts; i++) {
    if (w->at.steps > limit) return true;
    if (!vs_nest_lay_part(&w->at, w->order[i], &used)) return false;
    double done = (double)w->at.steps / (double)w->most_steps;
    if (w->work.going && !w->work.going(w->work.context, done < 1 ? done : 1)) return !(w->stopped = true);
  }
  w->used = used;
  for (size_t i = 0; i < used; i++) /* if no sheet is endless, the least filled sheet counts as the last one */
    if (i == w->at.endless || w->at.endless >= used) *cost = fmin(*cost, vs_nest_filled(&w->at, &w->at.sheets[i]));
  *cost += (double)(used - 1) * w->at.rule->width;
  return true;
}

static uint32_t chance(nest *w, uint32_t below) {
  w->chance = w->chance * 1664525u + 1013904223u;
  return (uint32_t)(((uint64_t)(w->chance >> 8) * below) >> 24);
}

typedef struct { double key; uint32_t part; } ranked;

static int by_key(const void *a, const void *b) {
  const ranked *p = a, *q = b;
  if (p->key != q->key) return p->key > q->key ? -1 : 1;
  return p->part < q->part ? -1 : p->part > q->part;
}

/* Sorts the parts in `order` by size, the largest first. by: number of the measure of size: area, extent, or a
 * combination of the two. */
static bool rank_parts(nest *w, int by) {
  ranked *r = vs_fresh(w->at.parts, sizeof *r);
  for (uint32_t i = 0; r && i < w->at.parts; i++) {
    const vs_nest_kind *k = &w->at.kinds[w->at.kind_of[i]];
    r[i] = (ranked){ by == 0 ? k->area : by == 1 ? k->extent : k->area * k->extent, i };
    /* the small addition keeps parts of equal shape together */
    r[i].key += 1e-9 * (double)(w->at.kind_count - w->at.kind_of[i]) * r[i].key;
  }
  if (!r) return false;
  qsort(r, w->at.parts, sizeof *r, by_key);
  for (size_t i = 0; i < w->at.parts; i++) w->order[i] = r[i].part;
  free(r);
  return true;
}

/* Stores in m the present order of the parts, their places, and the cost. */
static void remember(nest *w, memory *m, double cost) {
  m->cost = cost, m->wish = w->at.wish;
  m->reach = w->at.endless == SIZE_MAX ? INFINITY : w->at.endless < w->used ? w->at.sheets[w->at.endless].reach : 0;
  memcpy(m->laid, w->at.laid, w->at.parts * sizeof *m->laid);
  memcpy(m->order, w->order, w->at.parts * sizeof *m->order);
}

static void recall(nest *w, const memory *m) {
  w->at.wish = m->wish;
  memcpy(w->at.laid, m->laid, w->at.parts * sizeof *m->laid);
  memcpy(w->order, m->order, w->at.parts * sizeof *m->order);
}

/* Changes the order of the parts at random: exchanges two parts, or moves one. Returns the first index that has
 * changed. */
static size_t change_order(nest *w) {
  uint32_t n = (uint32_t)w->at.parts, i = 0, j = 0;
  const uint32_t *kind_of = w->at.kind_of;
  for (int k = 0; k < 20 && kind_of[w->order[i]] == kind_of[w->order[j]]; k++) i = chance(w, n), j = chance(w, n);
  uint32_t part = w->order[i];
  if (chance(w, 2)) {
    w->order[i] = w->order[j], w->order[j] = part;
  } else {
    if (i < j) memmove(w->order + i, w->order + i + 1, (j - i) * sizeof *w->order);
    else memmove(w->order + j + 1, w->order + j, (i - j) * sizeof *w->order);
    w->order[j] = part;
  }
  return i < j ? i : j;
}

/* Changes the order of the parts repeatedly, and keeps a change if its cost is at most the present cost or the cost
 * LATE changes before. Ends when the work reaches most_steps, or after IDLE changes without an improvement. */
static bool improve(nest *w, uint64_t most_steps) {
  double cost, late[LATE];
  recall(w, &w->best);
  remember(w, &w->now, w->best.cost);
  for (size_t i = 0; i < LATE; i++) late[i] = w->best.cost;
  double end = w->at.rule->width - w->at.rule->margin;
  for (size_t i = 0, last = 0; w->at.kind_count > 1 && w->at.steps < most_steps && !(w->best.reach <= end); i++) {
    if (i - last > IDLE) break;
    recall(w, &w->now);
    if (!chance(w, 8)) w->at.wish = (int)chance(w, 4);
    size_t from = change_order(w);
    if (!place_all(w, w->at.wish == w->now.wish ? from : 0, most_steps, &cost)) return false;
    if (cost <= fmax(w->now.cost, late[i % LATE])) remember(w, &w->now, cost);
    late[i % LATE] = w->now.cost;
    if (cost < w->best.cost) remember(w, &w->best, cost), last = i;
  }
  return true;
}

/* Finds an order of the parts. Treats the last sheet as endless at first; parts that lie beyond its real end are then
 * placed on further sheets. */
static bool search(nest *w) {
  const vs_nest_rule *r = w->at.rule;
  double cost, area = 0, whole = (r->width - 2 * r->margin) * (r->height - 2 * r->margin);
  for (size_t i = 0; i < w->at.parts; i++) area += w->at.kinds[w->at.kind_of[i]].area;
  w->at.endless = (size_t)fmax(0, ceil(area / whole * (1 - 1e-9)) - 1);
  w->best.cost = INFINITY;
  for (int k = 0; k < 12 && (k == 0 || w->at.steps < w->most_steps / 2); k++) {
    w->at.wish = k / 3;
    if (!rank_parts(w, k % 3) || !place_all(w, 0, k ? w->most_steps / 2 : UINT64_MAX, &cost)) return false;
    if (cost < w->best.cost) remember(w, &w->best, cost);
  }
  if (!improve(w, w->most_steps / 2)) return false;
  w->at.endless = SIZE_MAX;
  recall(w, &w->best);
  if (!place_all(w, 0, UINT64_MAX, &cost)) return false;
  remember(w, &w->best, cost);
  return improve(w, w->most_steps);
}

static void nest_free(nest *w) {
  vs_nest_places_free(&w->at);
  free(w->order), free(w->best.order), free(w->best.laid), free(w->now.order), free(w->now.laid);
  free(w);
}

bool vs_areas_nest(const vs_area *parts, size_t count, const vs_nest_rule *rule, vs_long_work work,
                   vs_nest_place *places, size_t *sheets, size_t *unfit, bool *stopped) {
  nest *w = vs_zeros(1, sizeof *w);
  *stopped = false, *sheets = 0, *unfit = count;
  if (!w) return false;
  w->at.rule = rule, w->at.parts = count, w->work = work, w->chance = 1;
  w->at.slack = 1e-10 * fmax(rule->width, rule->height);
  w->most_steps = (uint64_t)(rule->effort * 1.5e8) + 1;
  bool ok = VS_FRESH(w->at.kind_of, count) && VS_FRESH(w->order, count) && VS_FRESH(w->at.laid, count) &&
            VS_FRESH(w->best.order, count) && VS_FRESH(w->best.laid, count) && VS_FRESH(w->now.order, count) &&
            VS_FRESH(w->now.laid, count);
  ok = ok && vs_nest_find_kinds(&w->at, parts, unfit);
  if (ok && count && *unfit == count) {
    ok = search(w);
    for (size_t i = 0; ok && i < count; i++) {
      const vs_nest_laid *l = &w->best.laid[i];
      const vs_nest_form *f = &w->at.forms[l->form];
      double s, c;
      vs_sincos(f->angle, &s, &c);
      vs_vec2 corner = vs_nest_turned(parts[i].at[0], s, c);
      places[i] = (vs_nest_place){ l->sheet, f->angle, { l->move.x - corner.x, l->move.y - corner.y } };
      if (l->sheet >= *sheets) *sheets = l->sheet + 1;
    }
  }
  *stopped = w->stopped;
  nest_free(w);
  return ok;
}
