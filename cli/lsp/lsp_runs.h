/* Declares runs of programs for the language server: confined, with limits, in processes of their own, while the server
 * goes on to answer. */
#ifndef VS_CLI_LSP_LSP_RUNS_H
#define VS_CLI_LSP_LSP_RUNS_H

#include "cli/lsp/lsp_answers.h"

/* A run. The strings belong to the run, which frees them; each may be NULL. */
typedef struct lsp_run {
  /* Receives the output when the process has ended. whole: whether it ended by itself, within the time. */
  void (*done)(lsp_server *s, const struct lsp_run *r, bool whole);
  char *uri;              /* address of the text that runs */
  char *id;               /* for an answer: id of its request, as JSON */
  char *text, *range;     /* for an answer: the text to which the result is added, and its range as JSON */
  char *said; size_t count, room; /* output of the process, which ends in a zero byte */
  int process, from;      /* process, and descriptor of its output */
  double end;             /* time of the monotonic clock at which the server kills the process */
} lsp_run;

/* Runs the command of vs with these words, which end in NULL, in the folder of the text. Returns false, and frees the
 * run, if no process can start. */
bool lsp_run_start(lsp_server *s, lsp_run *r, const lsp_document *d, const char *const *words, double seconds);
/* Kills the runs of this text with this function `done`. */
void lsp_run_stop(lsp_server *s, const lsp_document *d, void (*done)(lsp_server *, const lsp_run *, bool));
/* Waits until the editor has sent something, and handles runs that end meanwhile. */
void lsp_runs_wait(lsp_server *s);
void lsp_runs_end(lsp_server *s);

#endif
