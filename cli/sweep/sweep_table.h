/* Declares a sweep: the sets of parameters of `vs sweep`, each with the results of a run of the model. */
#ifndef VS_CLI_SWEEP_SWEEP_TABLE_H
#define VS_CLI_SWEEP_SWEEP_TABLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* Memory for the texts and sets of a sweep, freed together. */
typedef struct sweep_block sweep_block;
typedef struct { sweep_block *last; } sweep_memory;
/* Returns memory that lives until sweep_memory_free, or NULL after a message when memory is out. */
void *sweep_keep(sweep_memory *m, size_t count, size_t size);
char *sweep_keep_text(sweep_memory *m, const char *text, size_t length);
void sweep_memory_free(sweep_memory *m);

/* A parameter's name and its value as typed, for -D. */
typedef struct { const char *name, *value; } sweep_setting;
typedef struct { const sweep_setting *at; size_t count; } sweep_set;

enum { SWEEP_MOST = 100000 /* greatest number of sets */ };

/* A number that the model reported. column: its index in sweep_table.numbers. */
typedef struct { size_t column; double value; } sweep_number;
/* An output of a part: the path of the file, and the hash of its bytes. */
typedef struct { const char *path; uint64_t hash; } sweep_file;

typedef enum { SWEEP_NOT_TRIED, SWEEP_MADE, SWEEP_STANDS, SWEEP_FAILED } sweep_fate;
enum { SWEEP_KILLED = 137 /* the exit code of a run that a signal ended */ };
/* A set of the sweep with its results. */
typedef struct {
  sweep_set set;
  const char *name;      /* text for the set in file names, such as house-n=1,x=0.5 */
  size_t same;           /* index of the first part with an equal set of parameters, usually this part itself */
  uint64_t key;          /* hash of everything that determines the results, without the contents of files */
  uint64_t inputs;       /* hash of the names and contents of the files that the run read; 0: unknown */
  sweep_fate fate;
  unsigned repeats;      /* number of earlier runs of the part that were killed, or whose worker failed */
  int code;              /* exit code of a failed run */
  const char *message;   /* first line of a failed run's messages, or NULL */
  double seconds;
  const sweep_number *numbers; size_t number_count;
  sweep_file *files; size_t file_count;
} sweep_part;

typedef struct {
  sweep_memory *memory;
  sweep_part *parts; size_t count;
  const char **columns; size_t column_count, column_room; /* names of the parameters that the sweep varies, in order */
  const char **numbers; size_t number_count, number_room; /* names of the numbers that the model reports, in the order
                                                           * of their first report */
} sweep_table;

/* Returns the index of the name in the table's numbers, which it adds if necessary; SIZE_MAX when memory is out. */
size_t sweep_number_column(sweep_table *t, const char *name, size_t length);
/* Returns the part's value of a parameter, or NULL if the part does not set it. */
const char *sweep_value(const sweep_part *p, const char *name);
/* Returns the number that the part reported for a column of the table; NaN if it reported none. */
double sweep_number_of(const sweep_part *p, size_t column);

bool sweep_no_memory(void); /* reports that memory is out, and returns false */

#endif
