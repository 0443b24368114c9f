/* Declares the options and files of the command line. */
#ifndef VS_CLI_OPTIONS_H
#define VS_CLI_OPTIONS_H

#include <stdio.h>

#include "cli/batch/film.h"
#include "cli/sweep/sweep_table.h"
#include "visualscheme.h"

typedef struct {
  enum { CLI_SOURCE_FILE, CLI_SOURCE_EXPRESSION } kind;
  const char *text; /* path of a source file ("-" for standard input), or an expression to evaluate */
} cli_source;

typedef struct {
  const char *path;             /* path of the output file; "-" for standard output */
  const char *format; /* name or suffix of the format; NULL: the format is not built in, and the program may define
                       * it */
} cli_target;

/* The commands of vs; a command is the first word of the command line. */
typedef enum {
  CLI_COMMAND_NONE,
#define COMMAND(name, arguments, takes, help) CLI_COMMAND_##name,
#include "cli/commands.def"
} cli_command;
/* Flags of the column `takes` of commands.def: the arguments that a command accepts other than a single file. Only
 * commands accept --json and --xml. */
enum { CLI_TAKES_JSON = 1, CLI_TAKES_XML = 2, CLI_TAKES_TWO = 4 /* the command requires two files */,
       CLI_TAKES_OUTPUT = 8 /* the command accepts the option -o */,
       CLI_TAKES_FOLDER = 16 /* the command accepts the option -o with a folder */,
       CLI_TAKES_LANGUAGE = 32 /* the command accepts the option --to, and -o for a program in that language */,
       CLI_TAKES_PICTURE = 64 /* the files of the command are EXR pictures */,
       CLI_TAKES_POINT = 128 /* two numbers follow the file on the command line */,
       CLI_TAKES_TARGET = 256 /* the command requires the option -o exactly once */,
       CLI_TAKES_SCAN = 512 /* the command accepts a second file, which is read as points */,
       CLI_TAKES_SUN = 1024 /* the command accepts the options --place, --date and those for hours */,
       CLI_TAKES_MANY = 2048 /* the command accepts any number of files, and -o with a file or a folder */,
       CLI_TAKES_PROGRAMS = 4096 /* the command accepts any number of programs, and no -o */,
       CLI_TAKES_TEXTS = 8192 /* the command accepts any number of files, - too, and --check, but no -o */,
       CLI_TAKES_NOTHING = 16384 /* the command accepts no file, and no -o */,
       CLI_TAKES_SWEEP = 32768 /* the command accepts one file, --set, and -o with folders, patterns and a table */,
       CLI_TAKES_WORDS = 65536 /* the words of the command are no programs, and it accepts no -o */ };

/* The options of --on: the place where the parts of a batch run, and the limits of each job. A text that is not given
 * is NULL; such a number is 0. */
typedef struct {
  const char *on;               /* "local", "parallel", "slurm" or "slurm:PARTITION"; NULL without --on: the parts run
                                 * in this command */
  const char *time, *memory;    /* limits of time and memory for a job on the cluster, as Slurm reads them */
  bool pack; const char *packed; /* pack: whether --pack is given; packed: names of its additional files, separated by
                                  * commas, or NULL */
  size_t cpus, bundle;          /* cpus: processors that a job of the cluster uses; bundle: number of parts that a job
                                 * makes */
} cli_cluster;

typedef struct {
  cli_command command;
  /* The sources and outputs of the command line. The texts are words of argv. The arrays have room for argc entries and
   * belong to cli_options. */
  cli_source *sources; size_t source_count;
  cli_target *targets; size_t target_count;
  char **defines; size_t define_count; /* texts NAME=VALUE, one for each option -D */
  const char **words; size_t word_count; /* the value of (command-line): the model's name and the words after the --
                                          * that follows it */
  char *library_path;           /* folders of the options -L, then those of VS_LIBRARY_PATH, separated by ':', or NULL;
                                 * allocated */
  const char *format;
  const char *language;         /* vs translate: the language of --to; NULL: determined by the suffix of the output */
  vs_options interpreter;              /* limits and texts of the interpreter, to which main adds the callbacks */
  vs_output_options output;
  cli_frames frames;
  cli_tiles tiles;
  const char *place, *date, *from, *step; /* vs sunstudy: values of its options, NULL if an option is not given; --to is
                                           * in `language` */
  double candelas;              /* luminance in cd/m2 of the pixel value 1; 0 if not given */
  bool lux;                     /* whether the picture shows illuminance of floors instead of luminance */
  const char **held; size_t held_count; /* vs fit: names of the parameters that --hold keeps; stored after `words` */
  size_t points;                       /* vs fit: number of points by --points; 0: the default */
  /* vs render: sets: parameters by --set; passed: options that are passed on to the run of each picture; stored after
   * `held`. */
  const char **sets, **passed; size_t set_count, passed_count; /* passed: options that are passed on to the run of each
                                                                * picture */
  /* vs render: memory of the texts in `sets`, if files of --set define them with a text for each row, and the names of
   * these files */
  sweep_memory set_memory; const char **set_files; size_t set_file_count;
  /* vs render without --frames and --tiles: its parts are pairs of a model and a set of parameters. --only gives the
   * first and the last pair, from 1. */
  struct { long from, to; } pairs;
  /* vs render, vs sweep: words of the command line for a run of all parts (whole), and for a run of some parts (part),
   * elsewhere. Options about processes are not among them. */
  const char **whole, **part; size_t whole_count, part_count;
  cli_cluster cluster;                 /* the options that concern clusters */
  size_t retries;                      /* number of further runs of a part that was killed, or whose worker failed */
  bool watch;                          /* whether the command runs again when a file changes */
  bool trying;                         /* whether parts run without outputs, so that --pack learns which files they
                                        * read */
  bool join, keep_going, keep_failed;  /* vs render, vs sweep: whether these options are given */
  size_t jobs;                         /* vs render: number of processes by --jobs; 0 if not given */
  int results;                         /* vs test, vs sweep: in the process of a run, the pipe for its results */
  const char *dependencies;            /* the file of -d, or NULL */
  const char *manifest, *sheet;        /* vs render: file names given by --manifest and --sheet, or NULL */
  const char *index;                   /* vs search, vs add: the index of packages; NULL if not given */
  const char *sample, *where, *sort, *only; /* vs sweep: its options, NULL if not given */
  uint64_t seed;                       /* --seed; 0 if not given */
  long film;                           /* vs render: frames per second of the film; 0: no film */
  bool interactive, check, quiet, stats, stats_json, parameters, to_stdout, untrusted, verbose, all_views, json, xml;
  bool coverage; /* vs profile: whether to count how often each form runs */
  bool placed, near, any_pose; /* vs fit: whether the options --placed, --near and --any-pose are given */
} cli_options;

/* The result of reading the command line. */
typedef enum {
  CLI_GO,
  CLI_STOP /* nothing is left to do after --help or --version */,
  CLI_BAD_USAGE /* exit status 2; a message was printed on standard error */
} cli_verdict;

/* Returns the number of parts of vs render: frames, tiles, or models with sets. */
long cli_options_parts(const cli_options *o);
/* Writes the first and the last part of --only, or of all. */
void cli_options_range(const cli_options *o, long *from, long *to);

cli_verdict cli_options_parse(cli_options *o, int argc, char **argv);
void cli_options_free(cli_options *o);

#endif
