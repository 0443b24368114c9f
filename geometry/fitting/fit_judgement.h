/* Declares, for use in fitting/ alone, the judgement of a fit's result. */
#ifndef VS_GEOMETRY_FITTING_FIT_JUDGEMENT_H
#define VS_GEOMETRY_FITTING_FIT_JUDGEMENT_H

#include "geometry/fitting/fit_unknowns.h"

/* Sets error, interval and verdict of each number from the derivatives at the unknowns. Returns false on failure. */
bool vs_fit_judge(vs_fit_search *f, const double *unknowns);
/* Sets spread, outliers, and the correlation of neighbours from the distances of all points. Returns false when memory
 * is out. */
bool vs_fit_summarise(vs_fit_search *f);
/* Returns the reason for which the result cannot be trusted. */
vs_fit_doubt vs_fit_doubt_of(const vs_fit_search *f);

/* Returns the two-sided quantile of Student's distribution. The confidence is between 0 and 1. */
double vs_student_quantile(double confidence, double freedom);

#endif
