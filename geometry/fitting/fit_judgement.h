/* Owns, for fitting/ alone, what a fit's result is worth. */
#ifndef VS_GEOMETRY_FITTING_FIT_JUDGEMENT_H
#define VS_GEOMETRY_FITTING_FIT_JUDGEMENT_H

#include "geometry/fitting/fit_unknowns.h"

/* Fills error, interval and verdict of each number from the derivatives at the unknowns. False: failed. */
bool vs_fit_judge(vs_fit_search *f, const double *unknowns);
/* Fills, from the distances of all points, spread, outliers, and how much neighbours agree. False: out of memory. */
bool vs_fit_summarise(vs_fit_search *f);
/* Why the result cannot be trusted. */
vs_fit_doubt vs_fit_doubt_of(const vs_fit_search *f);

/* The two-sided quantile of Student's distribution. The confidence is within 0 and 1. */
double vs_student_quantile(double confidence, double freedom);

#endif
