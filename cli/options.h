/* Owns what the command line says, as data. */
#ifndef VS_CLI_OPTIONS_H
#define VS_CLI_OPTIONS_H

#include <stdio.h>

#include "cli/batch/film_frames.h"
#include "visualscheme.h"

typedef struct {
  enum { CLI_SOURCE_FILE, CLI_SOURCE_EXPRESSION } kind;
  const char *text; /* a path ("-": standard input) or an expression */
} cli_source;

typedef struct {
  const char *path;             /* "-": standard output */
  const char *format; /* its name or ending; NULL: not one of the library, perhaps one that the program brings */
} cli_target;

/* `vs COMMAND ...`: what the first word says. */
typedef enum {
  CLI_COMMAND_NONE,
#define COMMAND(name, arguments, takes, help) CLI_COMMAND_##name,
#include "cli/commands.def"
} cli_command;
/* The arguments of a command besides one file: the third column of commands.def. --json and --xml are for commands
 * alone. */
enum { CLI_TAKES_JSON = 1, CLI_TAKES_XML = 2, CLI_TAKES_TWO = 4 /* files */, CLI_TAKES_OUTPUT = 8 /* -o */,
       CLI_TAKES_FOLDER = 16 /* -o, of a folder */, CLI_TAKES_LANGUAGE = 32 /* --to, and -o of a program in it */,
       CLI_TAKES_PICTURE = 64 /* its files are EXR pictures */, CLI_TAKES_POINT = 128 /* two numbers behind the file */,
       CLI_TAKES_TARGET = 256 /* -o, once and always */,
       CLI_TAKES_SCAN = 512 /* a second file, that is read as points */,
       CLI_TAKES_SUN = 1024 /* --place, --date and hours */,
       CLI_TAKES_MANY = 2048 /* any number of files; -o of a file or a folder */,
       CLI_TAKES_PROGRAMS = 4096 /* any number of files, and no -o */ };

typedef struct {
  cli_command command;
  /* Texts point into argv. The arrays have room for argc entries and belong to the options. */
  cli_source *sources; size_t source_count;
  cli_target *targets; size_t target_count;
  char **defines; size_t define_count; /* NAME=VALUE; checked to hold a = */
  const char **words; size_t word_count; /* (command-line): the model's name and what stands behind -- after it */
  char *library_path;           /* allocated: the folders of -L, then those of VS_LIBRARY_PATH; NULL: none */
  const char *format;
  const char *language;         /* of vs translate; NULL: the ending of the output says which */
  vs_options interpreter;              /* the limits, the texts above; main adds the host */
  vs_output_options output;
  cli_frames frames;
  const char *place, *date, *from, *step; /* of vs sunstudy, with language for --to; NULL: not given */
  double candelas;              /* cd/m2 of the number 1 in a picture; 0: not said */
  bool lux;                     /* illuminance of floors, not luminance */
  const char **held; size_t held_count; /* --hold, of vs fit; behind `words` */
  size_t points;                       /* --points; 0: the usual */
  /* of vs render; the first two behind `held` */
  const char **sets, **passed; size_t set_count, passed_count; /* passed: the options that are every picture's */
  size_t jobs;                         /* 0: not said */
  int results;                         /* of a process of vs test: the pipe that it tells results into */
  const char *manifest, *sheet;        /* NULL: not said */
  long film;                           /* frames a second; 0: none is wanted */
  bool interactive, check, quiet, stats, stats_json, parameters, to_stdout, untrusted, verbose, all_views, json, xml;
  bool placed, near, any_pose; /* of vs fit */
} cli_options;

/* The job that the command line asks for. */
typedef enum {
  CLI_GO,
  CLI_STOP /* all done: --help, --version */,
  CLI_BAD_USAGE /* said on standard error: exit 2 */
} cli_verdict;

cli_verdict cli_options_parse(cli_options *o, int argc, char **argv);
/* Finds the formats of the targets that none of the library's own serves, among those that the program has brought.
 * False: said on standard error. */
bool cli_options_late(cli_options *o, const vs_scheme *scheme);
void cli_options_free(cli_options *o);
/* A line about the command of that name, and how it is called. False: there is none. */
bool cli_command_help(const char *name, FILE *to);
/* Says which command may have been meant by a word that names no file. False: none comes to mind. */
bool cli_command_suggest(const char *word, FILE *to);

#endif
