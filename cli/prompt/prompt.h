/* Owns the state of the prompt, which its loop (repl.c), its commands (prompt_commands.c) and the pictures (show.c)
 * share. */
#ifndef VS_CLI_PROMPT_PROMPT_H
#define VS_CLI_PROMPT_PROMPT_H

#include "cli/command.h"
#include "live/live.h"

/* The entries that succeeded, in order: ,undo removes them and ,save writes them. */
typedef struct {
  char *text;
  unsigned first_line;
  unsigned result, results; /* its values are $result and the next ones, `results` of them */
} cli_entry;

typedef struct {
  bool going;
  unsigned line;          /* number of the next typed line */
  cli_entry *entries;
  size_t count, room;     /* entries[0..count) are in force; ,undo lowers count */
  size_t known;           /* entries[count..known) can be redone */
  unsigned results;       /* the number of numbered values at the last query (cli_prompt_results) */
  char *loaded;           /* the last file of ,load */
  cli_entry *stopped;     /* the paused entries, vs_stop_depth of them, the latest on top; text NULL: a file that was
                           * run */
  size_t stopped_count, stopped_room;
  int again;              /* 1 + the vs_resume_way that an empty line repeats; 0: none */
  cli_session *session;   /* the session whose drawing the view shows, after ,view */
  live_asked asked;       /* the request of a window */
  bool told_stops;        /* the ways to continue have been printed */
} cli_prompt;

#endif
