/* Declares the table of commands, made from commands.def, and the help on one command. */
#ifndef VS_CLI_USAGE_COMMAND_TABLE_H
#define VS_CLI_USAGE_COMMAND_TABLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

typedef struct {
  const char *name, *arguments; /* arguments: those that the help prints */
  unsigned takes;               /* flags CLI_TAKES_... of options.h */
  const char *help;
} cli_command_row;

/* Number of commands. Row i belongs to the command i + 1 of the enum cli_command. */
enum {
  CLI_COMMANDS = 0
#define COMMAND(name, arguments, takes, help) +1
#include "cli/commands.def"
};
extern const cli_command_row cli_command_rows[CLI_COMMANDS];

/* Returns true if the word equals the name of a command, apart from hyphens (sun-study). */
bool cli_command_is(const char *word, const char *name);
/* Prints a line of help on the command of that name, and how to call it. Returns false if there is no such command. */
bool cli_command_help(const char *name, FILE *to);
/* Called for a word that is no file: prints the command that was probably meant. Returns false if no command is
 * similar. */
bool cli_command_suggest(const char *word, FILE *to);

#endif
