/* Implements the search by the library NLopt, which runs in a thread of its own (optimiser.h). */
#include "geometry/search/optimiser.h"

#include <math.h>
#include <nlopt.h>
#include <pthread.h>
#include <string.h>

#include "geometry/dynamic.h"
#include "model/store/array.h"

#define SEED 63 /* seed for methods that use random numbers, so that equal searches have equal results */

#define NLOPT_CALLS(X)                                                                                                 \
  X(nlopt_create) X(nlopt_destroy) X(nlopt_optimize) X(nlopt_set_min_objective) X(nlopt_add_inequality_constraint)     \
  X(nlopt_set_lower_bounds) X(nlopt_set_upper_bounds) X(nlopt_set_maxeval) X(nlopt_set_xtol_rel)                      \
  X(nlopt_set_ftol_rel) X(nlopt_force_stop) X(nlopt_srand)

typedef struct {
#define X(name) __typeof__(&name) name;
  NLOPT_CALLS(X)
#undef X
} nlopt_calls;

/* Data for NLopt's callback: the search, and which of its functions is to be evaluated. */
typedef struct { vs_search *search; size_t which; } asker;

typedef enum { ASKED, ANSWERED, ENDED } turn;

struct vs_search {
  nlopt_calls call;
  nlopt_opt opt;
  vs_search_problem p;
  double *numbers;  /* memory that contains the arrays x, slopes and others below */
  double *x;        /* the unknowns; after the end of the search, the best ones */
  double *slopes;   /* partial derivatives in the caller's answer */
  const double *at; /* unknowns for which NLopt asks for a value */
  asker *askers;    /* data for the callback of the function, and of each constraint */
  size_t which;
  double value;
  bool asks_slopes, stop;
  turn turn;
  nlopt_result result;
  pthread_t thread;
  bool running;
  pthread_mutex_t lock; /* protects all members that both threads use */
  pthread_cond_t changed;
};

static bool load(nlopt_calls *out, vs_error *e) {
  static const vs_dynamic_name names[] = {
#define X(name) { #name, offsetof(nlopt_calls, name) },
    NLOPT_CALLS(X)
#undef X
  };
  return vs_dynamic_load(VS_LIBRARY_NLOPT, "optimise", names, sizeof names / sizeof *names, out, e);
}

/* ---- NLopt's thread ---- */

static double ask(unsigned n, const double *x, double *slopes, void *data) {
  const asker *a = data;
  vs_search *s = a->search;
  pthread_mutex_lock(&s->lock);
  s->which = a->which, s->at = x, s->asks_slopes = slopes != NULL;
  s->turn = ASKED;
  pthread_cond_broadcast(&s->changed);
  while (s->turn == ASKED && !s->stop) pthread_cond_wait(&s->changed, &s->lock);
  double value = s->stop ? HUGE_VAL : s->value;
  if (slopes) memcpy(slopes, s->slopes, n * sizeof *slopes);
  if (s->stop) s->call.nlopt_force_stop(s->opt);
  pthread_mutex_unlock(&s->lock);
  return value;
}

static void *search(void *context) {
  vs_search *s = context;
  double value = 0;
  s->call.nlopt_srand(SEED); /* seeds the random numbers here, because NLopt keeps them separately for each thread */
  nlopt_result result = s->call.nlopt_optimize(s->opt, s->x, &value);
  pthread_mutex_lock(&s->lock);
  s->result = result, s->value = value, s->at = s->x, s->turn = ENDED;
  pthread_cond_broadcast(&s->changed);
  pthread_mutex_unlock(&s->lock);
  return NULL;
}

/* ---- the caller's thread ---- */

static nlopt_algorithm algorithm(const vs_search_problem *p) {
  switch (p->method) {
  case VS_SEARCH_GRADIENT: return p->constraints ? NLOPT_LD_SLSQP : NLOPT_LD_LBFGS;
  case VS_SEARCH_SIMPLEX: return p->constraints ? NLOPT_LN_COBYLA : NLOPT_LN_NELDERMEAD;
  case VS_SEARCH_CRS: return NLOPT_GN_CRS2_LM;
  case VS_SEARCH_ISRES: break;
  }
  return NLOPT_GN_ISRES;
}

static bool set_up(vs_search *s) {
  const vs_search_problem *p = &s->p;
  s->opt = s->call.nlopt_create(algorithm(p), (unsigned)p->count);
  bool ok = s->opt && s->call.nlopt_set_min_objective(s->opt, ask, &s->askers[0]) > 0 &&
            s->call.nlopt_set_lower_bounds(s->opt, p->low) > 0 && s->call.nlopt_set_upper_bounds(s->opt, p->high) > 0 &&
            s->call.nlopt_set_maxeval(s->opt, (int)p->most) > 0 &&
            s->call.nlopt_set_xtol_rel(s->opt, p->tolerance) > 0 &&
            s->call.nlopt_set_ftol_rel(s->opt, p->tolerance) > 0;
  for (size_t k = 1; ok && k <= p->constraints; k++)
    ok = s->call.nlopt_add_inequality_constraint(s->opt, ask, &s->askers[k], 1e-9) > 0;
  return ok;
}

vs_search *vs_search_new(const vs_search_problem *p, vs_error *e) {
  size_t n = p->count;
  VS_ASSERT(n > 0 && n < 1u << 20 && p->most > 0 && p->most < 1u << 30);
  vs_search *s = vs_zeros(1, sizeof *s);
  if (!s) return vs_error_memory(e, NULL), NULL;
  if (!load(&s->call, e)) return free(s), NULL;
  pthread_mutex_init(&s->lock, NULL);
  pthread_cond_init(&s->changed, NULL);
  s->p = *p;
  s->askers = vs_zeros(p->constraints + 1, sizeof *s->askers);
  bool ok = s->askers && VS_FRESH(s->numbers, 4 * n);
  if (ok) {
    double *low = s->numbers + 2 * n, *high = low + n;
    s->x = s->numbers, s->slopes = s->numbers + n;
    memcpy(s->x, p->start, n * sizeof *s->x), memset(s->slopes, 0, n * sizeof *s->slopes);
    memcpy(low, p->low, n * sizeof *low), memcpy(high, p->high, n * sizeof *high);
    s->p.low = low, s->p.high = high, s->p.start = s->x;
    for (size_t k = 0; k <= p->constraints; k++) s->askers[k] = (asker){ s, k };
    s->turn = ANSWERED;
    ok = set_up(s);
  }
  s->running = ok && pthread_create(&s->thread, NULL, search, s) == 0;
  if (s->running) return s;
  vs_search_free(s);
  vs_error_memory(e, NULL);
  return NULL;
}

vs_search_state vs_search_next(vs_search *s, vs_search_question *out) {
  pthread_mutex_lock(&s->lock);
  while (s->turn == ANSWERED) pthread_cond_wait(&s->changed, &s->lock);
  *out = (vs_search_question){ s->which, s->asks_slopes, s->at, s->p.count, s->value };
  bool asks = s->turn == ASKED;
  nlopt_result result = s->result;
  pthread_mutex_unlock(&s->lock);
  if (asks) return VS_SEARCH_ASKS;
  if (result == NLOPT_MAXEVAL_REACHED) return VS_SEARCH_SPENT;
  if (result == NLOPT_ROUNDOFF_LIMITED || result == NLOPT_FAILURE) return VS_SEARCH_STUCK;
  return result > 0 ? VS_SEARCH_DONE : VS_SEARCH_IMPOSSIBLE;
}

bool vs_search_answer(vs_search *s, double value, const double *slopes, size_t count) {
  pthread_mutex_lock(&s->lock);
  bool fits = s->turn == ASKED && (!s->asks_slopes || count == s->p.count);
  if (fits) {
    s->value = value;
    if (s->asks_slopes) memcpy(s->slopes, slopes, count * sizeof *slopes);
    s->turn = ANSWERED;
    pthread_cond_broadcast(&s->changed);
  }
  pthread_mutex_unlock(&s->lock);
  return fits;
}

void vs_search_free(vs_search *s) {
  if (!s) return;
  if (s->running) {
    pthread_mutex_lock(&s->lock);
    s->stop = true;
    pthread_cond_broadcast(&s->changed);
    pthread_mutex_unlock(&s->lock);
    pthread_join(s->thread, NULL);
  }
  if (s->opt) s->call.nlopt_destroy(s->opt);
  pthread_mutex_destroy(&s->lock);
  pthread_cond_destroy(&s->changed);
  free(s->numbers), free(s->askers), free(s);
}
