/* Owns the tables of what the language's names are called in the target languages. */
#ifndef VS_LANGUAGES_TRANSLATE_WORDS_H
#define VS_LANGUAGES_TRANSLATE_WORDS_H

#include "languages/translate/core_tree.h"
#include "languages/translate/target.h"

typedef struct { const char *name, *arguments, *result, *keys, *text; } tr_word;

/* The first row of the primitive behind `row` (0: from the start) that fits its arguments as far as they are known, 1
 * and more; 0: there is none. */
uint16_t tr_word_find(const translation *t, tr_index primitive, uint16_t row);
/* A row's text is the target's; NULL where the target has nothing for it. */
tr_word tr_word_row(const tr_target *target, uint16_t row);
/* The next row of the name behind `row` (0: the first), 0: no more. */
uint16_t tr_word_next(const char *name, uint16_t row);
/* How many arguments a value of that name takes, -1: it is no procedure. */
int tr_word_arguments(const tr_target *target, const char *name);
/* The kind that the row asks of its nth argument, counted from 0; 0: it takes no such argument. */
char tr_word_letter(const char *arguments, uint32_t nth);

/* Definitions in the target language that translated programs use, in the order of their table. NULL past the last. */
const char *tr_helper_name(const tr_target *target, size_t nth);
const char *tr_helper_text(const tr_target *target, size_t nth);

#endif
