/* Owns the writing of a tree of named things as JSON or as XML. Nothing is read, so a library would be more to carry
 * than these lines. */
#include "languages/analysis/notation.h"

#include <string.h>

size_t know_character(const char *text, size_t left) {
  const unsigned char *s = (const unsigned char *)text;
  if (*s < 0x80) return *s >= ' ' || *s == '\t' || *s == '\n' || *s == '\r' ? 1 : 0;
  size_t n = *s >= 0xF0 ? 4 : *s >= 0xE0 ? 3 : *s >= 0xC2 ? 2 : 0;
  if (!n || n > left || *s > 0xF4) return 0;
  for (size_t i = 1; i < n; i++)
    if ((s[i] & 0xC0) != 0x80) return 0;
  if (n == 3 && *s == 0xEF && s[1] == 0xBF && s[2] >= 0xBE) return 0; /* U+FFFE, U+FFFF */
  if (n == 3 && *s == 0xED && s[1] >= 0xA0) return 0;                 /* surrogates */
  return n;
}

void know_xml_text(FILE *to, const char *text, size_t length) {
  for (size_t i = 0; i < length;) {
    size_t n = know_character(text + i, length - i);
    if (!n) fputs("\xEF\xBF\xBD", to), n = 1;
    else if (text[i] == '<') fputs("&lt;", to);
    else if (text[i] == '>') fputs("&gt;", to);
    else if (text[i] == '&') fputs("&amp;", to);
    else if (text[i] == '"') fputs("&quot;", to);
    else fwrite(text + i, 1, n, to);
    i += n;
  }
}

static void xml_attribute(FILE *to, const char *text, size_t length) {
  /* Line ends are kept by numbers: a reader would make blanks of them. */
  for (size_t i = 0, n; i < length; i += n + 1) {
    for (n = 0; i + n < length && !strchr("\n\r\t", text[i + n]);) n++;
    know_xml_text(to, text + i, n);
    if (i + n < length) fprintf(to, "&#%d;", text[i + n]);
  }
}

void know_json_text(FILE *to, const char *text, size_t length) {
  fputc('"', to);
  for (size_t i = 0; i < length;) {
    unsigned char c = (unsigned char)text[i];
    size_t n = know_character(text + i, length - i);
    if (c == '"' || c == '\\') fprintf(to, "\\%c", c), n = 1;
    else if (c < ' ') fprintf(to, "\\u%04x", c), n = 1;
    else if (!n) fputs("\xEF\xBF\xBD", to), n = 1;
    else fwrite(text + i, 1, n, to);
    i += n;
  }
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
