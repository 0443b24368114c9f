/* Implements the searches in binding_forms.def. */
#include "languages/analysis/form_table.h"

#include <stddef.h>
#include <string.h>

static const struct { const char *name, *shape; } rows[] = {
#define KNOW_FORM(name, shape) {name, #shape},
#include "languages/analysis/binding_forms.def"
};

static const char *const defining[] = {"DEFINE", "DEFINE_VALUES", "DEFINE_RECORD", "STRUCT", "DEFINE_SYNTAX",
                                       "DEFINE_PARAMETER", "DEFINE_PRIMITIVE", "DEFINE_RULE", "IMPORT", "LIBRARY",
                                       "LOAD", "COND_EXPAND"};

uint16_t know_form_row(const char *name) {
  for (uint16_t i = 0; i < sizeof rows / sizeof *rows; i++)
    if (!strcmp(rows[i].name, name)) return (uint16_t)(i + 1);
  return 0;
}

bool know_form_defines(uint16_t row) {
  for (size_t i = 0; i < sizeof defining / sizeof *defining; i++)
    if (!strcmp(rows[row - 1].shape, defining[i])) return true;
  return false;
}

bool know_form_splices(uint16_t row) { return !strcmp(rows[row - 1].name, "begin"); }
