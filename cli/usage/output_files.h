/* Declares functions on the files of the option -o. */
#ifndef VS_CLI_USAGE_OUTPUT_FILES_H
#define VS_CLI_USAGE_OUTPUT_FILES_H

#include "cli/options.h"

/* Returns the ending of the path with its dot, or NULL if the path has none or is "-". */
const char *cli_ending_of(const char *path);
/* Returns c, or a hyphen if c is a control character, a slash or a character with a meaning for a shell. first: c
 * begins the name of a file. A dot or a hyphen then also becomes a hyphen. */
char cli_file_letter(char c, bool first);
enum { CLI_PATH_ROOM = 4096 };
/* Writes the path with a hyphen and a word before its ending, such as a-street.png for a.png. Returns false, after a
 * message, if the path is too long. */
bool cli_path_with(const char *path, const char *word, char name[CLI_PATH_ROOM]);
/* Returns the path without its folders. */
const char *cli_file_name(const char *path);
/* Returns true if the path ends in .png or has no suffix. A path without suffix is a folder for .png pictures. */
bool cli_is_png_or_folder(const char *path);
/* Returns true if the name of an output, without folders, begins with %, which is replaced by that of the model. */
bool cli_options_is_pattern(const char *path);
/* Finds the format of a target among the built-in formats. Another name or suffix may belong to a format that the
 * program defines (cli_options_late). Returns false after a message on standard error. */
bool cli_find_format(cli_options *o, cli_target *t);
/* For targets whose format is not built in, finds the format among those that the program defines. Returns false after
 * a message on standard error. */
bool cli_options_late(cli_options *o, const vs_scheme *scheme);
/* Returns true if the output file can probably be written. Otherwise reports it now, before long work begins. */
bool cli_output_reachable(const cli_target *t);

#endif
