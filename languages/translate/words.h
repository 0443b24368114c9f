/* Declares the tables of the target languages' words for the names of the language. */
#ifndef VS_LANGUAGES_TRANSLATE_WORDS_H
#define VS_LANGUAGES_TRANSLATE_WORDS_H

#include "languages/translate/core_tree.h"
#include "languages/translate/target.h"

typedef struct { const char *name, *arguments, *result, *keys, *text; } tr_word;

/* Returns the first row of the primitive after `row` (0: from the start) that fits its known arguments. Rows count from
 * 1; 0 means that there is none. */
uint16_t tr_word_find(const translation *t, tr_index primitive, uint16_t row);
/* Returns the target's text of a row, or NULL if the target has none. */
tr_word tr_word_row(const tr_target *target, uint16_t row);
/* Returns the next row of the name after `row` (0: the first row), or 0 if there are no more. */
uint16_t tr_word_next(const char *name, uint16_t row);
/* Returns the number of arguments of the procedure with this name, or -1 if there is no such procedure. */
int tr_word_arguments(const tr_target *target, const char *name);
/* Returns the type that the row requires of its nth argument, counted from 0. Returns 0 if it has no such argument. */
char tr_word_letter(const char *arguments, uint32_t nth);

/* Returns the name of the nth helper of the target language that translated programs use, in the order of the table, or
 * NULL after the last. */
const char *tr_helper_name(const tr_target *target, size_t nth);
const char *tr_helper_text(const tr_target *target, size_t nth);

#endif
