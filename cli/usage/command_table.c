/* Contains the table of commands and prints the help on one command. */
#include "cli/usage/command_table.h"

#include <string.h>

#include "cli/nearby.h"
#include "cli/options.h"

const cli_command_row cli_command_rows[CLI_COMMANDS] = {
#define COMMAND(name, arguments, takes, help) { #name, arguments, takes, help },
#include "cli/commands.def"
};

bool cli_command_is(const char *word, const char *name) {
  if (*word == '-') return false;
  for (; *word; word++)
    if (*word != '-' && *word != *name++) return false;
  return !*name;
}

bool cli_command_help(const char *name, FILE *to) {
  for (const cli_command_row *r = cli_command_rows; r < cli_command_rows + CLI_COMMANDS; r++)
    if (!strcmp(r->name, name))
      return fprintf(to, "vs %s%s%s: %s\n", name, *r->arguments ? " " : "", r->arguments, r->help) > 0;
  return false;
}

bool cli_command_suggest(const char *word, FILE *to) {
  if (strpbrk(word, "./")) return false;
  cli_nearby near = cli_nearby_start(word);
  for (size_t i = 0; i < CLI_COMMANDS; i++) cli_nearby_offer(&near, cli_command_rows[i].name);
  if (near.best)
    fprintf(to, "vs: %s is neither a command nor a file; perhaps vs %s %s\n", word, near.best,
            strcmp(near.best, "help") ? "FILE" : "WORD");
  return near.best != NULL;
}
