/* Declares the state of the prompt, which its loop (repl.c), its commands (prompt_commands.c) and its pictures (show.c)
 * share. */
#ifndef VS_CLI_PROMPT_PROMPT_H
#define VS_CLI_PROMPT_PROMPT_H

#include "cli/command.h"
#include "live/live.h"

/* An entry: a typed text that was evaluated without error. ,undo removes the last entry, and ,save writes all entries
 * to a file. */
typedef struct {
  char *text;
  unsigned first_line;
  unsigned result, results; /* the entry has `results` values, whose names are $result, $(result + 1) ... */
} cli_entry;

typedef struct {
  bool going;
  unsigned line;          /* number of the next typed line */
  cli_entry *entries;
  size_t count, room;     /* count: number of entries that have not been undone; room: size of the array `entries` */
  size_t known;           /* entries[count] to entries[known - 1] have been undone, and can be redone */
  unsigned results;       /* number of values that had names when cli_prompt_results was last called */
  char *loaded;           /* the file that ,load loaded last */
  cli_entry *stopped;     /* entries whose evaluation is paused, the most recent last; there are vs_stop_depth of them.
                           * text is NULL for a file */
  size_t stopped_count, stopped_room;
  int again;              /* way of continuing a paused program that an empty line repeats: 1 + vs_resume_way, or 0 */
  cli_session *session;   /* the session whose drawing the live view shows, after ,view */
  live_asked asked;       /* request that a window of the live view has sent */
  bool told_stops;        /* whether the prompt has already explained how a paused program is continued */
} cli_prompt;

#endif
