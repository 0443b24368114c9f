/* Owns the characters of UTF-8 texts whose bytes may be anything (names of files, texts of other programs): the next
 * character, and its spelling in a format. Each format calls the speller of its notation, so that it never writes
 * invalid text.
 *
 *   for (const char *at = text, *end = text + length; at < end;) put(out, spelled, vs_spell_xml(&at, end, spelled));
 *
 * A speller writes the character at *at to `out`, moves *at past it and returns the number of bytes it wrote; *at <
 * end. Bytes that are no UTF-8, and characters that the notation cannot express, become U+FFFD. */
#ifndef VS_MODEL_CHARACTERS_H
#define VS_MODEL_CHARACTERS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { VS_SPELLED_ROOM = 8 };
typedef size_t vs_speller(const char **at, const char *end, char out[VS_SPELLED_ROOM]);

/* Returns the number of bytes of the character at text, and its code point; 0 if they are no UTF-8. `left` is the
 * number of bytes there, at least 1. */
size_t vs_character_read(const char *text, size_t left, uint32_t *code);
/* Returns the number of bytes, at most `most`, that consist of whole characters. */
size_t vs_character_cut(const char *text, size_t most);
/* Returns true if the code point is a control character (tabs and line ends are), or one that Unicode assigns to no
 * character. */
bool vs_character_is_control(uint32_t code);
/* Returns true if the character ends a line, or separates words. */
bool vs_character_is_blank(uint32_t code);

/* any character of UTF-8, unchanged */
size_t vs_spell_plain(const char **at, const char *end, char out[VS_SPELLED_ROOM]);
/* the text stays on its line: tabs and line ends become blanks */
size_t vs_spell_line(const char **at, const char *end, char out[VS_SPELLED_ROOM]);
/* the text stays one word: blanks and controls become _ */
size_t vs_spell_word(const char **at, const char *end, char out[VS_SPELLED_ROOM]);
/* between tags: < > & " as entities */
size_t vs_spell_xml(const char **at, const char *end, char out[VS_SPELLED_ROOM]);
/* the same within quotes: also ' and line ends, by number */
size_t vs_spell_xml_value(const char **at, const char *end, char out[VS_SPELLED_ROOM]);
/* within quotes; controls, and characters that end a line in scripts, as \uXXXX */
size_t vs_spell_json(const char **at, const char *end, char out[VS_SPELLED_ROOM]);

#endif
