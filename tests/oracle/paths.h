/* Declares random programs that place and combine the samples of every kind and every constructor in
 * tests/cross/shapes.vs. Tests compare measures of the object with those of the written drawings. */
#ifndef VS_TESTS_PATHS_H
#define VS_TESTS_PATHS_H

#include "tests/oracle/models.h"

/* Reads the samples from the file and keeps them until the process ends. Returns false if it cannot read the file. */
bool path_samples_read(const char *file);
size_t path_samples(void);
const char *path_sample(size_t i); /* returns the name of sample i, or NULL after the last sample */
bool path_is_nothing(const char *name); /* returns true if the sample is infinite, or is not part of a drawing */
/* Returns the definitions that the samples need; a test evaluates them before a program. */
const char *path_definitions(void);
/* The first function returns the number of ways to place a sample, the second the number of ways to combine it. Tests
 * use these numbers for messages and counts. */
size_t path_ways(void);
size_t path_sets(void);

/* Writes the expression of the program that belongs to the seed. Seeds from 0 on use each sample in turn, then again
 * with another placement; the set operation is random. Sets *sample, *way and *set to the numbers of the sample, the
 * placement and the set operation that come first in the program. */
void path_make(uint64_t seed, char text[MODEL_ROOM], size_t *sample, size_t *way, size_t *set);

/* Writes the expression of a sample. A sample that is no solid gets the thickness, a number as text. */
void path_thin(size_t which, const char *thickness, char text[MODEL_ROOM]);

#endif
