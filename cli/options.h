/* Owns the command line, as data. */
#ifndef VS_CLI_OPTIONS_H
#define VS_CLI_OPTIONS_H

#include <stdio.h>

#include "cli/batch/film.h"
#include "visualscheme.h"

typedef struct {
  enum { CLI_SOURCE_FILE, CLI_SOURCE_EXPRESSION } kind;
  const char *text; /* a path ("-": standard input) or an expression */
} cli_source;

typedef struct {
  const char *path;             /* "-": standard output */
  const char *format; /* its name or ending; NULL: not one of the library's, perhaps one that the program defines */
} cli_target;

/* The commands: the first word of the command line. */
typedef enum {
  CLI_COMMAND_NONE,
#define COMMAND(name, arguments, takes, help) CLI_COMMAND_##name,
#include "cli/commands.def"
} cli_command;
/* The arguments of a command besides one file: the third column of commands.def. --json and --xml are for commands
 * only. */
enum { CLI_TAKES_JSON = 1, CLI_TAKES_XML = 2, CLI_TAKES_TWO = 4 /* files */, CLI_TAKES_OUTPUT = 8 /* -o */,
       CLI_TAKES_FOLDER = 16 /* -o, of a folder */, CLI_TAKES_LANGUAGE = 32 /* --to, and -o of a program in that
                                                                             * language */,
       CLI_TAKES_PICTURE = 64 /* its files are EXR pictures */, CLI_TAKES_POINT = 128 /* two numbers after the file */,
       CLI_TAKES_TARGET = 256 /* -o, exactly once */,
       CLI_TAKES_SCAN = 512 /* a second file, which is read as points */,
       CLI_TAKES_SUN = 1024 /* --place, --date and hours */,
       CLI_TAKES_MANY = 2048 /* any number of files; -o of a file or a folder */,
       CLI_TAKES_PROGRAMS = 4096 /* any number of files, and no -o */ };

typedef struct {
  cli_command command;
  /* Texts point into argv. The arrays have room for argc entries and belong to the options. */
  cli_source *sources; size_t source_count;
  cli_target *targets; size_t target_count;
  char **defines; size_t define_count; /* NAME=VALUE; each contains a = */
  const char **words; size_t word_count; /* (command-line): the model's name and the words after the -- that follows
                                          * it */
  char *library_path;           /* allocated: the folders of -L, then those of VS_LIBRARY_PATH; NULL: none */
  const char *format;
  const char *language;         /* of vs translate; NULL: by the ending of the output */
  vs_options interpreter;              /* the limits and the texts above; main adds the host */
  vs_output_options output;
  cli_frames frames;
  const char *place, *date, *from, *step; /* of vs sunstudy, with language for --to; NULL: not given */
  double candelas;              /* cd/m2 of the number 1 in a picture; 0: not given */
  bool lux;                     /* illuminance of floors, not luminance */
  const char **held; size_t held_count; /* --hold of vs fit; stored after `words` */
  size_t points;                       /* --points; 0: the default */
  /* of vs render; the first two are stored after `held` */
  const char **sets, **passed; size_t set_count, passed_count; /* passed: the options of every picture */
  size_t jobs;                         /* 0: not given */
  int results;                         /* in a process of vs test: the pipe for its results */
  const char *manifest, *sheet;        /* NULL: not given */
  long film;                           /* frames a second; 0: no film */
  bool interactive, check, quiet, stats, stats_json, parameters, to_stdout, untrusted, verbose, all_views, json, xml;
  bool placed, near, any_pose; /* of vs fit */
} cli_options;

/* The job that the command line asks for. */
typedef enum {
  CLI_GO,
  CLI_STOP /* all done: --help, --version */,
  CLI_BAD_USAGE /* exit 2, after a message on standard error */
} cli_verdict;

cli_verdict cli_options_parse(cli_options *o, int argc, char **argv);
/* Finds, among the formats that the program defines, those of the targets that the library lacks. Returns false after a
 * message on standard error. */
bool cli_options_late(cli_options *o, const vs_scheme *scheme);
void cli_options_free(cli_options *o);
/* Prints a line about the command of that name, and how to call it. Returns false if there is none. */
bool cli_command_help(const char *name, FILE *to);
/* Prints the command that a word without a file probably means. Returns false if there is none. */
bool cli_command_suggest(const char *word, FILE *to);

#endif
