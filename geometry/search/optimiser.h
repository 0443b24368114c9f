/* Declares the search for the least value of a function of some numbers, by NLopt.
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
  VS_SEARCH_GRADIENT, /* L-BFGS; with constraints, sequential quadratic programming */
  VS_SEARCH_SIMPLEX,  /* Nelder and Mead's; with constraints, Powell's COBYLA */
  VS_SEARCH_CRS,      /* controlled random search; needs bounds, and takes no constraints */
  VS_SEARCH_ISRES     /* evolution with ranking; needs bounds */
} vs_search_method;

typedef struct {
  vs_search_method method;
  size_t count;           /* number of unknowns, above 0 */
  const double *start;
  const double *low, *high; /* bounds, which may be infinite; low[i] <= start[i] <= high[i] */
  size_t constraints;     /* number of functions that must not be positive */
  size_t most;            /* greatest number of evaluations, above 0 */
  double tolerance;       /* the search ends when unknowns or value change by less than this part */
} vs_search_problem;

typedef enum {
  VS_SEARCH_ASKS,      /* the search waits for an answer */
  VS_SEARCH_DONE,      /* converged */
  VS_SEARCH_SPENT,     /* as many evaluations as are allowed */
  VS_SEARCH_STUCK,     /* rounding prevents progress */
  VS_SEARCH_IMPOSSIBLE /* NLopt has refused the problem, or memory is out */
} vs_search_state;

typedef struct {
  size_t which;    /* 0: the function; k: constraint k */
  bool slopes;     /* whether the answer needs the partial derivatives */
  const double *x; /* the unknowns; after the end, the best ones */
  size_t count;    /* of unknowns */
  double value;    /* after the end: the value for the best unknowns */
} vs_search_question;

typedef struct vs_search vs_search;

/* Begins a search; copies the problem. Returns NULL and sets *e when memory is out, or NLopt is not installed. The
 * caller frees the search. */
vs_search *vs_search_new(const vs_search_problem *p, vs_error *e);
/* Waits for the next question, or the end. The question is valid until the answer. */
vs_search_state vs_search_next(vs_search *s, vs_search_question *out);
/* Answers the question that vs_search_next has returned. slopes: `count` partial derivatives; their number is that of
 * the unknowns if they were asked. Returns false if it is not, or there is no question. */
bool vs_search_answer(vs_search *s, double value, const double *slopes, size_t count);
void vs_search_free(vs_search *s); /* s may be NULL; ends a search that is under way */

#endif
