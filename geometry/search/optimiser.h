/* Declares the search for the least value of a function of several numbers, by the library NLopt.
 *
 * NLopt calls the function that it minimizes, but the caller of this search evaluates that function itself. Therefore
 * NLopt runs in a thread of its own: it asks for a value and waits for the answer. The two threads never run at the
 * same time. */
#ifndef VS_GEOMETRY_SEARCH_OPTIMISER_H
#define VS_GEOMETRY_SEARCH_OPTIMISER_H

#include <stdbool.h>
#include <stddef.h>

#include "model/model_error.h"

typedef enum {
  VS_SEARCH_GRADIENT, /* method L-BFGS; with constraints, sequential quadratic programming (SLSQP) */
  VS_SEARCH_SIMPLEX,  /* Nelder and Mead's simplex method; with constraints, Powell's COBYLA */
  VS_SEARCH_CRS,      /* controlled random search; it needs bounds, and accepts no constraints */
  VS_SEARCH_ISRES     /* evolution strategy with stochastic ranking; it needs bounds */
} vs_search_method;

typedef struct {
  vs_search_method method;
  size_t count;           /* number of unknowns, above 0 */
  const double *start;
  const double *low, *high; /* bounds of the unknowns, which may be infinite: low[i] <= start[i] <= high[i] */
  size_t constraints;     /* number of constraints: functions whose value must not be above 0 */
  size_t most;            /* greatest number of evaluations of the function, above 0 */
  double tolerance;       /* the search ends when the unknowns, or the value of the function, change by less than this
                           * fraction */
} vs_search_problem;

typedef enum {
  VS_SEARCH_ASKS,      /* the search waits for the caller's answer to a question */
  VS_SEARCH_DONE,      /* the search has ended: it has converged */
  VS_SEARCH_SPENT,     /* the search has ended after the greatest number of evaluations */
  VS_SEARCH_STUCK,     /* the search has ended because rounding errors prevent progress */
  VS_SEARCH_IMPOSSIBLE /* NLopt has refused the problem, or memory is out */
} vs_search_state;

typedef struct {
  size_t which;    /* the function that is to be evaluated: 0: the function to minimize; k: constraint k, counted
                    * from 1 */
  bool slopes;     /* true if the answer must also contain the partial derivatives */
  const double *x; /* the unknowns for which a value is asked; after the end of the search, the best ones */
  size_t count;    /* number of unknowns */
  double value;    /* after the end of the search: value of the function for the best unknowns */
} vs_search_question;

typedef struct vs_search vs_search;

/* Begins a search with a copy of the problem. Returns NULL and sets *e when memory is out, or NLopt is not installed.
 * The caller frees the search with vs_search_free. */
vs_search *vs_search_new(const vs_search_problem *p, vs_error *e);
/* Waits until the search asks for a value, or ends. *out: the question, valid until vs_search_answer; at the end, the
 * result. */
vs_search_state vs_search_next(vs_search *s, vs_search_question *out);
/* Answers the question that vs_search_next has returned. slopes: `count` partial derivatives. Returns false if the
 * question needs derivatives and their number is not that of the unknowns, or if there is no question. */
bool vs_search_answer(vs_search *s, double value, const double *slopes, size_t count);
void vs_search_free(vs_search *s); /* frees s, which may be NULL, and stops the search if it has not ended */

#endif
