/* Owns random programs that place and combine the samples of every kind and every constructor, which
 * tests/cross/shapes.vs lists: for comparing what is measured with what is drawn. */
#ifndef VS_TESTS_PATHS_H
#define VS_TESTS_PATHS_H

#include "tests/oracle/models.h"

/* Reads the samples; false: the file cannot be read. They live until the program ends. */
bool path_samples_read(const char *file);
size_t path_samples(void);
const char *path_sample(size_t i); /* its name; NULL past the last */
bool path_is_nothing(const char *name); /* a sample of something that is no part of a drawing, or has no end */
/* The definitions that the samples need, to be evaluated before a program. */
const char *path_definitions(void);
/* How a sample is placed, and what it is combined with: for messages, and to count what has been looked at. */
size_t path_ways(void);
size_t path_sets(void);

/* Writes the expression of seed's program: each sample in turn, in each way of placing it, on each side of each set.
 * *sample, *way, *set: what it begins with. */
void path_make(uint64_t seed, char text[MODEL_ROOM], size_t *sample, size_t *way, size_t *set);

#endif
