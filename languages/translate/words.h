/* Owns the tables of the target languages' words for the language's names. */
#ifndef VS_LANGUAGES_TRANSLATE_WORDS_H
#define VS_LANGUAGES_TRANSLATE_WORDS_H

#include "languages/translate/core_tree.h"
#include "languages/translate/target.h"

typedef struct { const char *name, *arguments, *result, *keys, *text; } tr_word;

/* Returns the first row of the primitive after `row` (0: from the start) that fits its known arguments, from 1; 0:
 * none. */
uint16_t tr_word_find(const translation *t, tr_index primitive, uint16_t row);
/* Returns the target's text of a row; NULL if the target has none. */
tr_word tr_word_row(const tr_target *target, uint16_t row);
/* Returns the next row of the name after `row` (0: the first); 0: no more. */
uint16_t tr_word_next(const char *name, uint16_t row);
/* Returns the number of arguments of the procedure of that name; -1: it is no procedure. */
int tr_word_arguments(const tr_target *target, const char *name);
/* Returns the kind that the row requires of its nth argument, from 0; 0: it takes no such argument. */
char tr_word_letter(const char *arguments, uint32_t nth);

/* Returns the name of the nth helper of the target language that translated programs use, in the order of the table;
 * NULL past the last. */
const char *tr_helper_name(const tr_target *target, size_t nth);
const char *tr_helper_text(const tr_target *target, size_t nth);

#endif
