/* Declares the tables of words: for each name of the language, its equivalent in each target language. */
#ifndef VS_LANGUAGES_TRANSLATE_WORDS_H
#define VS_LANGUAGES_TRANSLATE_WORDS_H

#include "languages/translate/core_tree.h"
#include "languages/translate/target.h"

typedef struct { const char *name, *arguments, *result, *keys, *text; } tr_word;

/* Returns the first row of the primitive after `row` (0: from the first row) whose argument types fit those of its
 * known arguments. Rows count from 1; 0 means that there is none. */
uint16_t tr_word_find(const translation *t, tr_index primitive, uint16_t row);
/* Returns the target's text in this row, or NULL if the target has no equivalent. */
tr_word tr_word_row(const tr_target *target, uint16_t row);
/* Returns the next row for the name after `row` (0: the first row), or 0 if there are no more. */
uint16_t tr_word_next(const char *name, uint16_t row);
/* Returns the number of arguments of the language's procedure `name` by the name's first row for the target, or -1 if
 * there is no such row. */
int tr_word_arguments(const tr_target *target, const char *name);
/* Returns the letter of the type that a row requires of its nth argument, counted from 0. Returns 0 if it has no such
 * argument. */
char tr_word_letter(const char *arguments, uint32_t nth);

/* Returns the name of the target language's nth helper function for translated programs, in the order of the table, or
 * NULL after the last. */
const char *tr_helper_name(const tr_target *target, size_t nth);
const char *tr_helper_text(const tr_target *target, size_t nth);

#endif
