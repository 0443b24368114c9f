/* Implements step 2 of a fit (fit_candidates.h): it fits all unknowns, starting from several places of the scan, and
 * chooses the best result. */
#include "geometry/fitting/fit_candidates.h"

#include <math.h>
#include <stdlib.h>

#define DOUBTED .16 /* If the cost of a candidate (result of a fit) is above this, it is fitted again with changed
                     * numbers. The cost is this high if about a twentieth of the points are outliers. */
#define MOVED .08   /* fraction by which one of the model's numbers is changed before the fit is repeated */

static const vs_fit_effort little = { VS_FIT_FIRST / 2, 3, 12, 1e-3 }, more = { VS_FIT_FIRST, 3, 25, 1e-4 };

/* Returns the mean of Tukey's loss over a candidate's distances, scaled to 0 to 1: about the fraction of outliers.
 * spread: unit of the distances. */
static double score(const vs_fit_candidate *c, double spread) {
  double sum = 0, slope, most = VS_TUKEY_REACH * VS_TUKEY_REACH / 3;
  for (size_t i = 0; i < c->known; i++) {
    double root = vs_loss_root(VS_LOSS_TUKEY, (double)c->distances[i] / spread, &slope, NULL);
    sum += root * root / most;
  }
  return c->known ? sum / (double)c->known : 1;
}

/* Computes the cost of each of `count` candidates (results of fits). The unit of distances is the least spread of all
 * candidates. */
static void rate(const vs_fit_search *f, vs_fit_candidate *all, size_t count) {
  double spread = INFINITY;
  for (size_t i = 0; i < count; i++) spread = fmin(spread, all[i].spread);
  spread = fmax(spread, f->tolerance);
  for (size_t i = 0; i < count; i++) all[i].cost = score(&all[i], spread);
}

/* Returns true if at least one of the model's numbers differs by more than a twentieth between candidates a and b
 * (results of fits). */
static bool apart(const vs_fit_search *f, const vs_fit_candidate *a, const vs_fit_candidate *b) {
  for (size_t j = 0; j < f->numbers; j++) {
    const vs_fit_number *n = &f->p->numbers[j];
    double x = vs_fit_number_outer(n, a->unknowns[j]), y = vs_fit_number_outer(n, b->unknowns[j]);
    if (fabs(x - y) > .05 * fmax(fabs(x), fabs(y))) return true;
  }
  return false;
}

/* Returns how far the numbers of candidate c (result of a fit) are from the start numbers, in units of their scales. */
static double from_start(const vs_fit_search *f, const vs_fit_candidate *c) {
  double sum = 0;
  for (size_t j = 0; j < f->numbers; j++) {
    const vs_fit_number *n = &f->p->numbers[j];
    double off = (vs_fit_number_outer(n, c->unknowns[j]) - n->start) / vs_fit_number_scale(n);
    sum += off * off;
  }
  return sum;
}

/* Returns true if the models of candidates a and b have different shapes: for at least one point in twenty, its
 * distances from the two models are clearly different. */
static bool unlike(const vs_fit_search *f, const vs_fit_candidate *a, const vs_fit_candidate *b) {
  double spread = fmax(fmax(a->spread, b->spread), f->tolerance);
  size_t off = 0;
  for (size_t i = 0; i < a->known; i++) off += fabs((double)a->distances[i] - (double)b->distances[i]) > 2 * spread;
  return off * 20 > a->known;
}

/* Sets *best to the candidate with the least cost, and *second to the best candidate with clearly different numbers. If
 * their costs are about equal, *best is the one whose numbers are nearer to the start numbers. */
static void choose(vs_fit_search *f, vs_fit_candidate *all, size_t count, vs_fit_candidate *best,
                   vs_fit_candidate *second) {
  rate(f, all, count);
  *best = all[0];
  for (size_t i = 1; i < count; i++)
    if (all[i].cost < best->cost) *best = all[i];
  second->cost = INFINITY;
  for (size_t i = 0; i < count; i++)
    if (all[i].cost < second->cost && apart(f, best, &all[i])) *second = all[i];
  f->out->rival = second->cost < 1.1 * best->cost + .02;
  f->out->rival_unlike = f->out->rival && unlike(f, best, second);
  if (!(second->cost < 1.02 * best->cost + .005) || from_start(f, second) >= from_start(f, best)) return;
  vs_fit_candidate held = *best;
  *best = *second, *second = held;
}

/* Fits all unknowns again, starting from those of candidate c. Returns false on failure. If the run is interrupted,
 * returns true; the candidate is then unchanged or improved. */
static bool advance(vs_fit_search *f, vs_fit_candidate *c, const vs_fit_effort *effort) {
  bool refused;
  f->motion = c->motion;
  vs_fit_take_points(f, c->core);
  bool ok = !f->out->stopped && vs_fit_improve(f, effort, c->unknowns);
  if (f->failed) return false;
  vs_fit_take_points(f, false);
  f->count = f->p->count < VS_FIT_FIRST / 2 ? f->p->count : VS_FIT_FIRST / 2;
  f->known = false;
  if (ok && vs_fit_evaluate(f, c->unknowns, &refused)) {
    c->known = f->count, c->spread = vs_fit_spread(f);
    for (size_t i = 0; i < c->known; i++) c->distances[i] = (float)f->distances[i];
  }
  vs_fit_settle(f, c->unknowns);
  c->motion = f->motion;
  return !f->failed;
}

static int compare_candidates(const void *p, const void *q) {
  double a = ((const vs_fit_candidate *)p)->cost, b = ((const vs_fit_candidate *)q)->cost;
  return a < b ? -1 : a > b;
}

/* Returns true if candidates a and b have equal numbers, and each point has equal distances from the two models. */
static bool same_candidate(const vs_fit_search *f, const vs_fit_candidate *a, const vs_fit_candidate *b) {
  size_t count = f->p->count < VS_FIT_FIRST / 2 ? f->p->count : VS_FIT_FIRST / 2;
  double off = 0;
  for (size_t i = 0; i < count; i++) off += fabs((double)a->distances[i] - (double)b->distances[i]);
  return !apart(f, a, b) && off < .1 * (double)count * fmax(fmin(a->spread, b->spread), f->tolerance);
}

/* Changes each of the best candidate's numbers up and down, and fits again from there. A number may be in a local
 * minimum: one row of windows may have been fitted to the next row. Returns false on failure. */
static bool from_numbers(vs_fit_search *f, vs_fit_candidate *best, vs_fit_candidate *second) {
  enum { NUMBERS_MOVED = 12 };
  vs_fit_candidate pair[2];
  bool better = false;
  for (size_t j = 0; j < f->numbers && j < NUMBERS_MOVED; j++)
    for (int side = -1; side <= 1 && !f->out->stopped; side += 2) {
      const vs_fit_number *n = &f->p->numbers[j];
      double x = vs_fit_number_outer(n, best->unknowns[j]);
      pair[0] = pair[1] = *best;
      double moved = x + side * MOVED * fmax(fabs(x), .1 * vs_fit_number_scale(n));
      pair[1].unknowns[j] = vs_fit_number_inner(n, fmin(fmax(moved, n->low), n->high));
      if (!advance(f, &pair[1], &little)) return false;
      rate(f, pair, 2);
      if (pair[1].cost < .95 * pair[0].cost) *best = pair[1], better = true;
    }
  if (better) {
    pair[0] = *best, pair[1] = *second;
    choose(f, pair, second->cost < INFINITY ? 2 : 1, best, second);
  }
  return true;
}

bool vs_fit_from_places(vs_fit_search *f, const vs_fit_place *places, size_t count, vs_fit_candidate *best,
                        vs_fit_candidate *second) {
  size_t starts = count < VS_FIT_STARTS_MOST ? count : VS_FIT_STARTS_MOST;
  vs_fit_candidate all[VS_FIT_STARTS_MOST];
  for (size_t i = 0; i < starts; i++) {
    all[i] = (vs_fit_candidate){ .motion = places[i].motion, .core = places[i].core };
    all[i].cost = all[i].spread = INFINITY;
    for (size_t j = 0; j < f->numbers; j++)
      all[i].unknowns[j] = vs_fit_number_inner(&f->p->numbers[j], f->begin[places[i].scaled][j]);
    if (!advance(f, &all[i], &little)) return false;
  }
  rate(f, all, starts);
  qsort(all, starts, sizeof *all, compare_candidates);
  size_t kept = 0;
  for (size_t i = 0; i < starts; i++) {
    bool known = false;
    for (size_t k = 0; k < kept && !known; k++) known = same_candidate(f, &all[k], &all[i]);
    if (!known && kept++ < i) all[kept - 1] = all[i];
  }
  starts = kept > 2 ? (kept + 1) / 2 : kept;
  for (size_t i = 0; i < starts; i++)
    if (all[i].core = false, !advance(f, &all[i], &more)) return false;
  choose(f, all, starts, best, second);
  return f->out->stopped || best->cost < DOUBTED || from_numbers(f, best, second);
}
