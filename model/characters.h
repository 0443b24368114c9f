/* Reads the characters of UTF-8 texts whose bytes may be invalid (file names, texts of other programs), and writes them
 * in the notation of a format. Each format calls its own vs_spell_ function, and therefore never writes invalid text.
 *
 *   for (const char *at = text, *end = text + length; at < end;) put(out, spelled, vs_spell_xml(&at, end, spelled));
 *
 * A vs_spell_ function writes the character at *at to `out`, moves *at past it and returns the number of bytes written.
 * *at must be less than end. Invalid bytes, and characters that the notation cannot express, become U+FFFD. */
#ifndef VS_MODEL_CHARACTERS_H
#define VS_MODEL_CHARACTERS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { VS_SPELLED_ROOM = 8 };
typedef size_t vs_speller(const char **at, const char *end, char out[VS_SPELLED_ROOM]);

/* Returns the number of bytes of the character at `text`, or 0 if it is not valid UTF-8. Sets *code to its code point.
 * `left` is the number of bytes from `text` to the end, at least 1. */
size_t vs_character_read(const char *text, size_t left, uint32_t *code);
/* Returns the length in bytes of the longest start of `text` that has at most `most` bytes and ends between two
 * characters. */
size_t vs_character_cut(const char *text, size_t most);
/* Returns true if the code point is a control character (including tab and line end), or is not assigned in Unicode. */
bool vs_character_is_control(uint32_t code);
/* Returns true if the code point is white space between words or a line end. */
bool vs_character_is_blank(uint32_t code);

/* Writes the UTF-8 character at *at to out unchanged. */
size_t vs_spell_plain(const char **at, const char *end, char out[VS_SPELLED_ROOM]);
/* Writes the character at *at to out, for a text of one line: a blank replaces a tab or a line end. */
size_t vs_spell_line(const char **at, const char *end, char out[VS_SPELLED_ROOM]);
/* Writes the character at *at to out, for a text of one word: _ replaces a blank or a control character. */
size_t vs_spell_word(const char **at, const char *end, char out[VS_SPELLED_ROOM]);
/* Writes the character at *at to out, for XML text between tags: < > & " become entities. */
size_t vs_spell_xml(const char **at, const char *end, char out[VS_SPELLED_ROOM]);
/* Writes the character at *at to out, for a quoted XML value: < > & " become entities, ' and line ends numeric
 * entities. */
size_t vs_spell_xml_value(const char **at, const char *end, char out[VS_SPELLED_ROOM]);
/* Writes the character at *at to out, for a JSON string: control characters, and characters that end a line in
 * JavaScript, become \uXXXX. */
size_t vs_spell_json(const char **at, const char *end, char out[VS_SPELLED_ROOM]);

#endif
