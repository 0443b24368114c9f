/* Writes the lines of IFC (STEP's text, ISO 10303-21), and finds the IFC classes for layers. */
#include <ctype.h>
#include <string.h>

#include "backends/ifc/ifc_text.h"
#include "backends/number_spelling.h"
#include "model/store/hashes.h"

bool vs_ifc_add(vs_emitter *e, vs_ifc_list *l, unsigned line) {
  if (!vs_emit_grow(e, &l->at, &l->room, l->count + 1, sizeof *l->at)) return false;
  l->at[l->count++] = line;
  return true;
}

void vs_ifc_list_free(vs_emitter *e, vs_ifc_list *l) {
  vs_emit_release(e, l->at, l->room, sizeof *l->at);
  *l = (vs_ifc_list){ NULL, 0, 0 };
}

void vs_ifc_begin(vs_writer *w, unsigned number, const char *name) { vs_putf(w, "#%u=%s(", number, name); }
void vs_ifc_end(vs_writer *w) { vs_puts(w, ");\n"); }

void vs_ifc_real(vs_writer *w, double x) {
  char text[VS_NUMBER_ROOM];
  size_t count = vs_number_text(x, text), power = strcspn(text, "eE");
  vs_put(w, text, power);
  if (memchr(text, '.', power) == NULL) vs_puts(w, ".");
  if (power < count) {
    vs_puts(w, "E");
    vs_put(w, text + power + 1, count - power - 1);
  }
}

void vs_ifc_text(vs_writer *w, const char *text) {
  vs_puts(w, "'");
  for (const char *at = text, *end = text + strlen(text); at < end && !w->failed;) {
    char spelled[VS_SPELLED_ROOM];
    uint32_t code = 0xFFFD;
    size_t count = vs_spell_line(&at, end, spelled);
    vs_character_read(spelled, count, &code);
    if (code == '\'') vs_puts(w, "''");
    else if (code == '\\') vs_puts(w, "\\\\");
    else if (code < 0x7F) vs_put(w, spelled, count);
    else vs_putf(w, code < 0x10000 ? "\\X2\\%04X\\X0\\" : "\\X4\\%08X\\X0\\", (unsigned)code);
  }
  vs_puts(w, "'");
}

void vs_ifc_reference(vs_writer *w, unsigned number) { vs_putf(w, "#%u", number); }

void vs_ifc_references(vs_writer *w, const vs_ifc_list *l) {
  for (size_t i = 0; i < l->count && !w->failed; i++)
    vs_putf(w, i == 0 ? "(#%u" : i % 16 ? ",#%u" : ",\n#%u", l->at[i]);
  vs_puts(w, l->count > 0 ? ")" : "()");
}

void vs_ifc_triple(vs_writer *w, vs_vec3 v) {
  vs_puts(w, "(");
  vs_ifc_real(w, v.x);
  vs_puts(w, ",");
  vs_ifc_real(w, v.y);
  vs_puts(w, ",");
  vs_ifc_real(w, v.z);
  vs_puts(w, ")");
}

/* A global id has 128 bits: two bits in the first of its 22 characters, six bits in each other character. */
void vs_ifc_id(vs_writer *w, const char *title, unsigned number) {
  static const char signs[] = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_$";
  uint64_t part[2] = { vs_hash_mix(vs_hash_bytes(1, title, strlen(title)), number), 0 };
  char id[24];
  part[1] = vs_hash_mix(part[0], UINT64_C(0x1FC4));
  id[0] = '\'', id[23] = '\'';
  for (int i = 22; i > 0; i--) {
    id[i] = signs[i > 1 ? part[1] & 63 : part[1] & 3];
    part[1] = part[1] >> 6 | part[0] << 58;
    part[0] >>= 6;
  }
  vs_put(w, id, sizeof id);
}

/* Returns true if a word in `name` begins with one of the words in `words`. */
static bool has_word(const char *name, const char *words) {
  while (*words != '\0') {
    size_t length = strcspn(words, " ");
    for (const char *at = name; *at != '\0'; at++) {
      size_t same = 0;
      if (at > name && isalpha((unsigned char)at[-1])) continue;
      while (same < length && tolower((unsigned char)at[same]) == words[same]) same++;
      if (same == length) return true;
    }
    words += length + (words[length] == ' ');
  }
  return false;
}

vs_ifc_class vs_ifc_class_of(const char *layer) {
  static const struct { vs_ifc_class class_; const char *words; } rows[] = {
#define IFC_CLASS(name, attributes, words) { { name, attributes }, words },
#include "backends/ifc/classes.def"
  };
  for (size_t i = 0; layer != NULL && i < sizeof rows / sizeof *rows; i++)
    if (has_word(layer, rows[i].words)) return rows[i].class_;
  return (vs_ifc_class){ "IFCBUILDINGELEMENTPROXY", "$" };
}

bool vs_ifc_is_opening(vs_ifc_class c) { return strcmp(c.name, "IFCOPENINGELEMENT") == 0; }
bool vs_ifc_fills(vs_ifc_class c) { return strcmp(c.name, "IFCWINDOW") == 0 || strcmp(c.name, "IFCDOOR") == 0; }
