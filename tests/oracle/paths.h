/* Owns random programs that place and combine the samples of every kind and every constructor in tests/cross/shapes.vs:
 * for comparing measures with written drawings. */
#ifndef VS_TESTS_PATHS_H
#define VS_TESTS_PATHS_H

#include "tests/oracle/models.h"

/* Reads the samples, which live until the program ends. Returns false if it cannot read the file. */
bool path_samples_read(const char *file);
size_t path_samples(void);
const char *path_sample(size_t i); /* Returns the sample's name; NULL past the last */
bool path_is_nothing(const char *name); /* true for a sample that is no part of a drawing, or is infinite */
/* Returns the definitions that the samples need; evaluate them before a program. */
const char *path_definitions(void);
/* The ways to place a sample and to combine it, for messages and for counting the tested ones. */
size_t path_ways(void);
size_t path_sets(void);

/* Writes the expression of seed's program: each sample in turn, in each way of placing it, on each side of each set.
 * *sample, *way, *set: the first ones of the program. */
void path_make(uint64_t seed, char text[MODEL_ROOM], size_t *sample, size_t *way, size_t *set);

#endif
