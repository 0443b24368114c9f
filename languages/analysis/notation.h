/* Declares the writing of a tree of named values as JSON or as XML, well formed for any text. */
#ifndef VS_LANGUAGES_ANALYSIS_NOTATION_H
#define VS_LANGUAGES_ANALYSIS_NOTATION_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

typedef enum { KNOW_JSON, KNOW_XML } know_notation;

/* An output of objects. Each object has values, and then lists of objects. In JSON an object is {"a": 1, "list":
 * [{...}]}, in XML <thing a="1"><list><item .../></list></thing>. */
typedef struct {
  FILE *to;
  know_notation notation;
  uint32_t depth;
  bool values;   /* whether the current object already has values */
  bool begun;    /* XML: whether the current start tag is still open. JSON: whether the current list already has
                  * elements */
} know_writer;

void know_write_start(know_writer *w, FILE *to, know_notation notation, const char *root);
void know_write_end(know_writer *w, const char *root);
void know_write_text(know_writer *w, const char *key, const char *text, size_t length);
void know_write_word(know_writer *w, const char *key, const char *text); /* writes nothing if text is "" */
void know_write_number(know_writer *w, const char *key, uint32_t value);
void know_write_flag(know_writer *w, const char *key, bool value); /* writes nothing if value is false */
/* know_write_list begins a list, know_write_item an element of a list. `item` is the element's name in XML. */
void know_write_list(know_writer *w, const char *key);
void know_write_item(know_writer *w, const char *item);
void know_write_item_end(know_writer *w, const char *item);
void know_write_list_end(know_writer *w, const char *key);

/* Writes text for XML: entities for < > & ", and U+FFFD for a character that XML cannot contain. */
void know_xml_text(FILE *to, const char *text, size_t length);
void know_json_text(FILE *to, const char *text, size_t length);

#endif
