/* Tests the tables that list names of the language. Each procedure must have words for `vs translate`, or be listed as
 * untranslated. Each table must list only names that exist. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "visualscheme.h"

static const char *const procedures[] = { /* each string contains one or more names of a procedure, separated by
                                           * spaces */
#define PROC(id, name, ...) name,
#define PROCS(id, name, ...) name,
#include "bind/procedures.def"
#undef PROC
#undef PROCS
};

static const char *const translated[] = {
#define TR_WORD(name, ...) name,
#define TR_NONE(names)
#include "languages/translate/translated_words.def"
};

static const char *const untranslated[] = { /* each string contains one or more names of a procedure, separated by
                                             * spaces */
#define TR_WORD(name, ...)
#define TR_NONE(names) names,
#include "languages/translate/translated_words.def"
};

static const char *const plain[] = {
#define KNOW_PLAIN(name, type) name,
#include "languages/checks/plain_calls.def"
#undef KNOW_PLAIN
};

static const char *const instead[] = {
#define FOREIGN(words, name, form) name,
#define ABSENT(words, advice)
#define KEYWORD(words, advice)
#include "vm/front/foreign.def"
#undef FOREIGN
#undef ABSENT
#undef KEYWORD
};

#define COUNT(list) (sizeof list / sizeof *list)

/* Returns true if one of the space-separated names in `name` is on the list. */
static bool is_in(const char *name, const char *const *list, size_t count) {
  for (const char *at = name; *at; at += strcspn(at, " "), at += strspn(at, " ")) {
    size_t length = strcspn(at, " ");
    for (size_t i = 0; i < count; i++)
      for (const char *word = list[i]; *word; word += strcspn(word, " "), word += strspn(word, " "))
        if (strcspn(word, " ") == length && !strncmp(word, at, length)) return true;
  }
  return false;
}

static void test_words(void **state) {
  (void)state;
  int wrong = 0;
  for (size_t i = 0; i < COUNT(procedures); i++) {
    if (*procedures[i] == '%') continue;
    bool word = is_in(procedures[i], translated, COUNT(translated)), none = is_in(procedures[i], untranslated, COUNT(untranslated));
    if (word == none) print_error("%s has %s in languages/translate/translated_words.def\n", procedures[i], word ? "a word and TR_NONE" : "neither a word nor TR_NONE");
    wrong += word == none;
  }
  assert_int_equal(wrong, 0);
}

/* Returns the number of words of the list that are not defined in s, and prints these words. With `sentences`, ignores
 * rows of the table that are named by a sentence: they belong to the translator itself. The prefix js: marks a name
 * that only scripts have. */
static int unknown(vs_scheme *s, const char *table, const char *const *list, size_t count, bool sentences) {
  int wrong = 0;
  for (size_t i = 0; i < count; i++) {
    if ((sentences && strchr(list[i], ' ')) || !strncmp(list[i], "js:", 3)) continue;
    for (const char *at = list[i]; *at; at += strcspn(at, " "), at += strspn(at, " ")) {
      char name[64];
      vs_name_info info;
      snprintf(name, sizeof name, "%.*s", (int)strcspn(at, " "), at);
      if (vs_name_get(s, name, &info)) continue;
      print_error("%s: %s is no name of the language\n", table, name);
      wrong++;
    }
  }
  return wrong;
}

static void test_names(void **state) {
  (void)state;
  vs_scheme *s = vs_new(NULL);
  assert_non_null(s);
  int wrong = unknown(s, "translated_words.def", translated, COUNT(translated), true) +
              unknown(s, "translated_words.def", untranslated, COUNT(untranslated), false) +
              unknown(s, "plain_calls.def", plain, COUNT(plain), false) + unknown(s, "foreign.def", instead, COUNT(instead), true);
  vs_free(s);
  assert_int_equal(wrong, 0);
}

int main(void) {
  const struct CMUnitTest tests[] = { cmocka_unit_test(test_words), cmocka_unit_test(test_names) };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
