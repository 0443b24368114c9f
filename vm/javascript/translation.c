/* Writes the items (parts of Scheme data) to which a script is translated. */
#include "vm/javascript/translation.h"

#include <stdio.h>

bool vs_translate_item(vs_translation *t, vs_item item) {
  if (!vs_script_room(t->s, &t->items, &t->room, t->count + 1, sizeof *t->items)) return false;
  item.line = t->line + t->at.line, item.column = t->at.column;
  t->items[t->count++] = item;
  return true;
}

bool vs_translate_open(vs_translation *t) { return vs_translate_item(t, (vs_item){ .kind = VS_ITEM_OPEN }); }
bool vs_translate_close(vs_translation *t) { return vs_translate_item(t, (vs_item){ .kind = VS_ITEM_CLOSE }); }
bool vs_translate_word(vs_translation *t, const char *word) {
  return vs_translate_item(t, (vs_item){ .kind = VS_ITEM_WORD, .word = word });
}
bool vs_translate_call(vs_translation *t, const char *word) {
  return vs_translate_open(t) && vs_translate_word(t, word);
}
bool vs_translate_name(vs_translation *t, uint32_t name) {
  return vs_translate_item(t, (vs_item){ .kind = VS_ITEM_NAME, .a = name });
}
bool vs_translate_direct(vs_translation *t, uint32_t name) {
  return vs_translate_item(t, (vs_item){ .kind = VS_ITEM_DIRECT, .a = name });
}

bool vs_translate_made(vs_translation *t, const char *word, uint32_t number) {
  return vs_translate_item(t, (vs_item){ .kind = VS_ITEM_MADE, .word = word, .a = number });
}

bool vs_translate_text(vs_translation *t, uint32_t name) {
  return vs_translate_item(
      t, (vs_item){ .kind = VS_ITEM_STRING, .a = t->s->names[name].text, .b = t->s->names[name].length });
}

bool vs_translate_key(vs_translation *t, uint32_t i) {
  const vs_script_node *n = vs_script_at(t->s, i);
  uint32_t text = n->text, length = n->length;
  if (n->kind == VS_SCRIPT_NUMBER)
    return vs_translate_call(t, "js:key") &&
           vs_translate_item(t, (vs_item){ .kind = VS_ITEM_NUMBER, .number = n->number }) && vs_translate_close(t);
  if (n->kind == VS_SCRIPT_NAME) text = t->s->names[n->name].text, length = t->s->names[n->name].length;
  return vs_translate_call(t, "js:quote") &&
         vs_translate_item(t, (vs_item){ .kind = VS_ITEM_KEY, .a = text, .b = length }) && vs_translate_close(t);
}

const char *vs_translate_parameter_word(const vs_translation *t, uint32_t name) {
  static const struct {
    const char *name, *word;
  } words[] = { { "gui_number", "js:gui-number" }, { "gui_choice", "js:gui-choice" }, { "gui_text", "js:gui-text" } };
  for (size_t i = 0; i < sizeof words / sizeof *words; i++)
    if (vs_script_is(t->s, name, words[i].name)) return words[i].word;
  return NULL;
}
