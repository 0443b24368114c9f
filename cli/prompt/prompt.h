/* Declares the state of the prompt, which its loop (repl.c), its commands (prompt_commands.c) and its pictures (show.c)
 * share. */
#ifndef VS_CLI_PROMPT_PROMPT_H
#define VS_CLI_PROMPT_PROMPT_H

#include "cli/command.h"
#include "live/live.h"

/* A typed text that was evaluated without error. ,undo removes the last entry, and ,save writes all. */
typedef struct {
  char *text;
  unsigned first_line;
  unsigned result, results; /* its `results` values have the names $result, $(result + 1) ... */
} cli_entry;

typedef struct {
  bool going;
  unsigned line;          /* number of the next typed line */
  cli_entry *entries;
  size_t count, room;     /* count: number of entries that are not undone */
  size_t known;           /* entries[count..known) are undone and can be redone */
  unsigned results;       /* number of values that had names when cli_prompt_results was last called */
  char *loaded;           /* the file that ,load loaded last */
  cli_entry *stopped;     /* entries whose evaluation is paused (vs_stop_depth of them, the last one most recent); text
                           * is NULL for a file */
  size_t stopped_count, stopped_room;
  int again;              /* 1 + the vs_resume_way that an empty line repeats, or 0 */
  cli_session *session;   /* the session whose drawing the live view shows, after ,view */
  live_asked asked;       /* request that was sent by a window of the live view */
  bool told_stops;        /* whether the ways to continue were already printed */
} cli_prompt;

#endif
