/* Writes a tree of named values as JSON or as XML. Since it reads neither, a library would be larger than this file. */
#include "languages/analysis/notation.h"

#include <string.h>

#include "model/characters.h"

static void spelled(FILE *to, vs_speller *spell, const char *text, size_t length) {
  char out[VS_SPELLED_ROOM];
  for (const char *at = text, *end = text + length; at < end;) fwrite(out, 1, spell(&at, end, out), to);
}

void know_xml_text(FILE *to, const char *text, size_t length) { spelled(to, vs_spell_xml, text, length); }

static void xml_attribute(FILE *to, const char *text, size_t length) {
  /* Writes line ends as character references (&#10;), since a reader of XML would turn plain line ends into blanks. */
  for (size_t i = 0, n; i < length; i += n + 1) {
    for (n = 0; i + n < length && !strchr("\n\r\t", text[i + n]);) n++;
    know_xml_text(to, text + i, n);
    if (i + n < length) fprintf(to, "&#%d;", text[i + n]);
  }
}

void know_json_text(FILE *to, const char *text, size_t length) {
  fputc('"', to);
  spelled(to, vs_spell_json, text, length);
  fputc('"', to);
}

static void indent(const know_writer *w) { fprintf(w->to, "\n%*s", (int)(w->depth > 40 ? 40 : w->depth), ""); }

static void key_of(know_writer *w, const char *key) {
  if (w->notation == KNOW_XML) {
    fprintf(w->to, " %s=\"", key);
    return;
  }
  fputs(w->values ? ", " : "", w->to);
  know_json_text(w->to, key, strlen(key));
  fputs(": ", w->to);
  w->values = true;
}

void know_write_text(know_writer *w, const char *key, const char *text, size_t length) {
  key_of(w, key);
  if (w->notation == KNOW_JSON) know_json_text(w->to, text, length);
  else xml_attribute(w->to, text, length), fputc('"', w->to);
}
void know_write_word(know_writer *w, const char *key, const char *text) {
  if (*text) know_write_text(w, key, text, strlen(text));
}
void know_write_number(know_writer *w, const char *key, uint32_t value) {
  key_of(w, key);
  fprintf(w->to, w->notation == KNOW_JSON ? "%u" : "%u\"", value);
}
void know_write_flag(know_writer *w, const char *key, bool value) {
  if (!value) return;
  key_of(w, key);
  fputs(w->notation == KNOW_JSON ? "true" : "true\"", w->to);
}

static void close_tag(know_writer *w) {
  if (w->notation == KNOW_XML && w->begun) fputc('>', w->to);
  w->begun = false;
}

void know_write_start(know_writer *w, FILE *to, know_notation notation, const char *root) {
  *w = (know_writer){.to = to, .notation = notation};
  if (notation == KNOW_JSON) fputc('{', to);
  else fprintf(to, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<%s", root), w->begun = true;
}
void know_write_end(know_writer *w, const char *root) {
  if (w->notation == KNOW_JSON) fputs("}\n", w->to);
  else if (w->begun) fputs("/>\n", w->to);
  else fprintf(w->to, "\n</%s>\n", root);
}
void know_write_list(know_writer *w, const char *key) {
  if (w->notation == KNOW_JSON) {
    key_of(w, key);
    fputc('[', w->to);
    w->values = w->begun = false;
  } else {
    close_tag(w);
    indent(w);
    fprintf(w->to, "<%s>", key);
  }
  w->depth++;
}
void know_write_item(know_writer *w, const char *item) {
  if (w->notation == KNOW_JSON) {
    fputs(w->values ? "," : "", w->to);
    indent(w);
    fputc('{', w->to);
    w->values = false;
  } else {
    indent(w);
    fprintf(w->to, "<%s", item);
    w->begun = true;
  }
  w->depth++;
}
void know_write_item_end(know_writer *w, const char *item) {
  w->depth--;
  if (w->notation == KNOW_JSON) {
    fputc('}', w->to);
    w->values = true;
  } else if (w->begun) {
    fputs("/>", w->to);
    w->begun = false;
  } else fprintf(w->to, "</%s>", item);
}
void know_write_list_end(know_writer *w, const char *key) {
  w->depth--;
  if (w->notation == KNOW_JSON) {
    fputc(']', w->to);
    w->values = true;
  } else fprintf(w->to, "</%s>", key);
}
