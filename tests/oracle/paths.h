/* Declares random programs that place and combine the samples of every kind and every constructor in
 * tests/cross/shapes.vs. They compare measures with written drawings. */
#ifndef VS_TESTS_PATHS_H
#define VS_TESTS_PATHS_H

#include "tests/oracle/models.h"

/* Reads the samples, which live until the program ends. Returns false if it cannot read the file. */
bool path_samples_read(const char *file);
size_t path_samples(void);
const char *path_sample(size_t i); /* returns the sample's name, or NULL after the last */
bool path_is_nothing(const char *name); /* returns true for a sample that is not part of a drawing, or is infinite */
/* Returns the definitions that the samples need; evaluate them before a program. */
const char *path_definitions(void);
/* Return the number of ways to place a sample, and of ways to combine it, for messages and for counts. */
size_t path_ways(void);
size_t path_sets(void);

/* Writes the expression of the seed's program: each sample in turn, in each way of placing it, on each side of each
 * set. *sample, *way and *set are the first of the program. */
void path_make(uint64_t seed, char text[MODEL_ROOM], size_t *sample, size_t *way, size_t *set);

#endif
