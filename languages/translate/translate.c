/* Implements `vs translate`, which translates a program to another language. */
#include "languages/translate/translate.h"

#include <stdlib.h>

#include "languages/translate/text_plan.h"
#include "languages/targets/target_table.h"

const char *know_language(const char *name, const char *path) {
  const tr_target *target = name ? tr_target_named(name) : path ? tr_target_of_file(path) : NULL;
  return target ? target->name : NULL;
}

const char *know_languages(void) {
  return ""
#define TR_TARGET(name, ...) " " name
#include "languages/targets/translate_targets.def"
      ;
}

char *know_translate(knowledge *k, const know_translation *wanted, size_t *length) {
  translation t = {.k = k, .target = tr_target_named(wanted->language), .settings = wanted->settings,
                   .setting_count = wanted->setting_count};
  char *text = tr_write_program(&t, wanted->segments, length);
  for (size_t i = 0; i < t.complaint_count; i++)
    wanted->complain(wanted->context, &t.complaints[i].at, t.complaints[i].text);
  if (t.complaint_count && !*k->trouble) k->outcome = VS_OUTCOME_MODEL;
  free(t.nodes);
  free(t.variables);
  free(t.complaints);
  free(t.pairs);
  return text;
}
