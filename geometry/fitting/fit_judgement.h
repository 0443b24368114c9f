/* Declares, for use in fitting/ alone, the judgement of a fit's result: intervals of the numbers, outliers, and reasons
 * for doubt. */
#ifndef VS_GEOMETRY_FITTING_FIT_JUDGEMENT_H
#define VS_GEOMETRY_FITTING_FIT_JUDGEMENT_H

#include "geometry/fitting/fit_unknowns.h"

/* Sets three results for each of the model's numbers: its standard error, its interval, and whether the scan determines
 * it. Computes them from the derivatives at the given unknowns. Returns false on failure. */
bool vs_fit_judge(vs_fit_search *f, const double *unknowns);
/* Sets the result's spread, its number of outliers, and the correlation of neighbouring points, from the distances of
 * all points. Returns false when memory is out. */
bool vs_fit_summarise(vs_fit_search *f);
/* Returns the reason why the result of fit f cannot be trusted, or VS_FIT_DOUBT_NONE. */
vs_fit_doubt vs_fit_doubt_of(const vs_fit_search *f);

/* Returns the quantile of Student's distribution for a two-sided interval. confidence: between 0 and 1; freedom:
 * degrees of freedom. */
double vs_student_quantile(double confidence, double freedom);

#endif
