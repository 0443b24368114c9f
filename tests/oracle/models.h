/* Declares random programs over all kinds of solids, and their shrinking. */
#ifndef VS_TESTS_MODELS_H
#define VS_TESTS_MODELS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { MODEL_ROOM = 1 << 13 };

/* Writes the expression of the model that belongs to the seed. The solids are of the kinds in the table of kinds; they
 * are placed and combined. The arguments of each constructor satisfy its contracts. Many numbers are chosen so that a
 * procedure refuses them, or an object is degenerate. */
void model_make(uint64_t seed, char text[MODEL_ROOM]);
/* Writes a model of another class: two to four simple solids with integer coordinates, flush with each other and
 * combined. A few of the solids are rotated by 1e-5 to 1e-7 degrees, or are near copies of another solid. */
void model_make_turned(uint64_t seed, char text[MODEL_ROOM]);
/* The first function returns the number of kinds of solids and profiles in the table. The other two return the name of
 * a kind, and a word that occurs in each model of the kind (NULL if models.c makes no such model). */
size_t model_kinds(void);
const char *model_kind(size_t i);
const char *model_kind_word(size_t i, char word[64]);

/* Returns true if the expression `text` still shows the fault. model_shrink calls this function for shorter and shorter
 * expressions. */
typedef bool model_fails(void *context, const char *text);
/* Shortens the text as long as it fails. A step replaces a call by one of its arguments, removes an argument of a set
 * operation, or rounds a number. */
void model_shrink(char text[MODEL_ROOM], model_fails *fails, void *context);

#endif
