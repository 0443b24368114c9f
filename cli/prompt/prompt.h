/* Owns the prompt's own state, shared by its loop (repl.c), its commands (prompt_commands.c) and the pictures that
 * it shows (show.c). */
#ifndef VS_CLI_PROMPT_PROMPT_H
#define VS_CLI_PROMPT_PROMPT_H

#include "cli/command.h"
#include "live/live.h"

/* The entries that worked, in order: ,undo takes them back and ,save writes them. */
typedef struct {
  char *text;
  unsigned first_line;
  unsigned result, results; /* its values are $result and those behind it, as many as results says */
} cli_entry;

typedef struct {
  bool going;
  unsigned line;          /* number of the next line that is typed */
  cli_entry *entries;
  size_t count, room;     /* entries[0..count) hold; ,undo lowers count */
  size_t known;           /* entries[count..known) can be done again */
  unsigned results;       /* how many values had a number when it was last asked (cli_prompt_results) */
  char *loaded;           /* what ,load named last */
  cli_entry *stopped;     /* the entries that are stopped, as many as vs_stop_depth says, the last one on top;
      text NULL: a file that was run */
  size_t stopped_count, stopped_room;
  int again;              /* 1 + the vs_resume_way that an empty line repeats; 0: none */
  cli_session *session;   /* whose drawing the view shows, once ,view has opened one */
  live_asked asked;       /* what a window asks of it */
  bool told_stops;        /* how to go on has been said */
} cli_prompt;

#endif
