/* Implements `vs help WORD...`: prints the manual's text on a command, a name, a page or a topic. */
#include "cli/help_command.h"

#include <stdio.h>
#include <string.h>

#include "cli/prompt/manual.h"
#include "cli/usage/command_table.h"

/* If the word belongs to another program, as slab does, returns a sentence with its name in this language. Otherwise
 * returns "". Ignores advice that only guesses a similar name. */
static const char *foreign(vs_scheme *scheme, const char *word) {
  const char *advice = scheme ? vs_name_advice(scheme, word) : "";
  bool guess = strncmp(advice, "did you mean", 12) == 0 || strncmp(advice, "perhaps", 7) == 0;
  return guess ? "" : advice;
}

bool cli_help_word(vs_scheme *scheme, const char *word, const char *how) {
  const char *advice = cli_manual_describes(word) ? "" : foreign(scheme, word);
  if (*advice) printf("%s\n\n", advice);
  return cli_manual_print(word, how, stdout) || cli_manual_mentions(word, stdout) > 0 || *advice;
}

/* Reports that the manual does not contain a word, with a similar word that it contains. */
static void report_unknown(vs_scheme *scheme, const char *word) {
  char near[48];
  const char *advice = scheme ? vs_name_advice(scheme, word) : "";
  printf("The manual has no %s.\n", word);
  if (!cli_command_suggest(word, stdout)) {
    if (*advice) puts(advice);
    else if (cli_manual_near(word, near, sizeof near)) printf("did you mean %s? vs help %s shows it\n", near, near);
  }
  cli_manual_topics(stdout);
}

static vs_outcome help(vs_scheme *scheme, const char *word) {
  if (cli_command_help(word, stdout)) {
    putchar('\n');
    cli_manual_command(word, stdout);
    cli_manual_see_also(word, stdout);
    return VS_OUTCOME_DONE;
  }
  if (cli_help_word(scheme, word, "vs help")) return VS_OUTCOME_DONE;
  report_unknown(scheme, word);
  return VS_OUTCOME_USAGE;
}

int cli_help_command(int count, char **words) {
  char phrase[200] = "";
  size_t length = 0;
  for (int i = 0; i < count && length < sizeof phrase; i++)
    length += (size_t)snprintf(phrase + length, sizeof phrase - length, "%s%s", i ? " " : "", words[i]);
  bool several = strchr(phrase, ' ') && length < sizeof phrase;
  /* Tries the words after the first word of a phrase such as `my spiral stair`. */
  for (const char *at = several ? phrase : ""; strchr(at, ' '); at = strchr(at, ' ') + 1)
    if (cli_manual_print(at, "vs help", stdout)) return VS_OUTCOME_DONE;
  vs_options plain = vs_options_default();
  vs_scheme *scheme = vs_new(&plain);
  vs_outcome outcome = VS_OUTCOME_DONE;
  if (several)
    for (char *word = strtok(phrase, " "); word && outcome == VS_OUTCOME_DONE; word = strtok(NULL, " "))
      outcome = help(scheme, word);
  else
    for (int i = 0; i < count && outcome == VS_OUTCOME_DONE; i++) outcome = help(scheme, words[i]);
  vs_free(scheme);
  return (int)outcome;
}
