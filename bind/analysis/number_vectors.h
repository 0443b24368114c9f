/* Declares the exchange of vectors of numbers with the programs of the library (visualscheme analysis). */
#ifndef VS_BIND_ANALYSIS_NUMBER_VECTORS_H
#define VS_BIND_ANALYSIS_NUMBER_VECTORS_H

#include "vm/machine/native.h"

typedef struct vs_args vs_args;

/* Returns the `count` numbers of the vector in this argument as an array that is freed when the call ends. If the
 * argument is no such vector, or memory is out, sets the error and returns NULL. */
double *vs_bind_numbers(vs_args *f, int argument, size_t count);
/* Returns the length of a vector, or 0 for another value. */
size_t vs_bind_vector_length(vs_value v);
/* Sets *out to a vector of the `count` numbers at `at`. When memory is out, sets the error and returns false. */
bool vs_bind_give_numbers(vs_args *f, const double *at, size_t count, vs_value *out);

#endif
