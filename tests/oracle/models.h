/* Owns random programs over all kinds of solids, and their shrinking. */
#ifndef VS_TESTS_MODELS_H
#define VS_TESTS_MODELS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { MODEL_ROOM = 1 << 13 };

/* Writes the expression of seed's model: kinds of the table of kinds, made by the procedure of that name with arguments that its contracts name, placed and combined. Many numbers
 * are ones that a procedure refuses, or that make an object degenerate. */
void model_make(uint64_t seed, char text[MODEL_ROOM]);
/* Another class: two to four plain solids on whole numbers, flush with each other, of which some are turned by 1e-5 to
 * 1e-7 degrees, or are near copies, combined. */
void model_make_turned(uint64_t seed, char text[MODEL_ROOM]);
/* How many kinds of solids and of profiles the table has; the name of each; and the word by which a model that has it is
 * known, NULL where nothing here makes it. */
size_t model_kinds(void);
const char *model_kind(size_t i);
const char *model_kind_word(size_t i, char word[64]);

/* Does it fail? Asked again and again for smaller expressions. */
typedef bool model_fails(void *context, const char *text);
/* Makes the text shorter as long as it fails: a call becomes one of its arguments, an argument of a set goes, a number becomes a rounder one. */
void model_shrink(char text[MODEL_ROOM], model_fails *fails, void *context);

#endif
