/* Owns UTF-8 in bytes that may be anything (names of files, texts of other programs): the next character, and how a
 * format spells it. Each format calls the speller of its notation, so that no text leaves it invalid.
 *
 *   for (const char *at = text, *end = text + length; at < end;) put(out, spelled, vs_spell_xml(&at, end, spelled));
 *
 * A speller writes the character at *at to `out`, moves *at behind it and returns how many bytes it wrote; *at < end.
 * Bytes that are no UTF-8, and characters that the notation has no way to hold, become U+FFFD. */
#ifndef VS_MODEL_CHARACTERS_H
#define VS_MODEL_CHARACTERS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { VS_SPELLED_ROOM = 8 };
typedef size_t vs_speller(const char **at, const char *end, char out[VS_SPELLED_ROOM]);

/* Returns the bytes of the character at text, of which `left` are there (at least 1), and its code point; 0 where they
 * are no UTF-8. */
size_t vs_character_read(const char *text, size_t left, uint32_t *code);
/* Returns how many bytes of the text, at most `most`, hold whole characters. */
size_t vs_character_cut(const char *text, size_t most);
/* Is the code point a control character (tabs and line ends are), or one that Unicode gives to no character? */
bool vs_character_is_control(uint32_t code);
/* Does it end a line, or separate words? */
bool vs_character_is_blank(uint32_t code);

/* any character of UTF-8, as it is */
size_t vs_spell_plain(const char **at, const char *end, char out[VS_SPELLED_ROOM]);
/* the text stays on its line: tabs and all that ends lines become blanks */
size_t vs_spell_line(const char **at, const char *end, char out[VS_SPELLED_ROOM]);
/* the text stays one word: blanks and controls become _ */
size_t vs_spell_word(const char **at, const char *end, char out[VS_SPELLED_ROOM]);
/* between tags: < > & " as entities */
size_t vs_spell_xml(const char **at, const char *end, char out[VS_SPELLED_ROOM]);
/* the same within quotes: ' and what ends lines by number, too */
size_t vs_spell_xml_value(const char **at, const char *end, char out[VS_SPELLED_ROOM]);
/* within quotes; controls, and what ends a line in scripts, as \uXXXX */
size_t vs_spell_json(const char **at, const char *end, char out[VS_SPELLED_ROOM]);

#endif
