/* Declares the answers of the language server. */
#ifndef VS_CLI_LSP_LSP_ANSWERS_H
#define VS_CLI_LSP_LSP_ANSWERS_H

#include "cli/json_data.h"
#include "cli/lsp/lsp_document.h"
#include "languages/analysis/source_tree.h"

typedef struct { char *path, address[160]; int process; } lsp_view;

struct lsp_run;

typedef struct {
  cli_data_reader json;
  const vs_options *interpreter;
  vs_scheme *language;       /* an interpreter that has run no program, which provides the names of the language */
  lsp_document **documents; size_t count, room; /* array of pointers to documents, which are separate blocks, since
                                                 * interpreters point to them */
  char why[500];             /* text of a reason that names a file */
  const char *refused;       /* reason why the last request has no result, or NULL */
  cli_data id;               /* id of the request that is being answered */
  bool later;                /* whether a run answers the last request */
  int (*run)(int argc, char **argv); /* a function that runs a command of vs, and returns its exit code */
  struct lsp_run *runs; size_t run_count, run_room;
  char *root;                /* folder of the editor's project, or NULL */
  bool runs_saved;           /* whether a text runs when it is saved */
  bool pictures;             /* whether the editor shows pictures in the text on a name */
  bool fades;                /* whether the editor shows forms as unnecessary */
  bool refreshes;            /* whether the editor asks again for hints when it is told */
  unsigned refreshed;        /* number of times that it was told */
  FILE *to;                  /* stream to which a request's result is written */
  lsp_view *views; size_t view_count, view_room; /* the live views that the server has started */
  bool shows;                /* whether the editor shows addresses that it receives */
  const char *show;          /* the address that the editor is to show after the result, or NULL */
} lsp_server;

/* The function that answers a request. It writes its result to s->to: one JSON value. If it sets s->refused, the result
 * is not sent. The rows of lsp_methods.def give the function for each method. */
typedef void lsp_answer(lsp_server *s, cli_data parameters);
void lsp_completion(lsp_server *s, cli_data parameters);
void lsp_hover(lsp_server *s, cli_data parameters);
void lsp_signature(lsp_server *s, cli_data parameters);
void lsp_definition(lsp_server *s, cli_data parameters);
void lsp_references(lsp_server *s, cli_data parameters);
void lsp_rename(lsp_server *s, cli_data parameters);
void lsp_outline(lsp_server *s, cli_data parameters);
void lsp_formatting(lsp_server *s, cli_data parameters);
void lsp_text(lsp_server *s, cli_data parameters); /* the text as the server has it, by which a test compares it with
                                                    * the editor's */

/* Returns the open document with this address, or NULL if there is none. */
lsp_document *lsp_find_uri(const lsp_server *s, const char *uri);
/* Returns the open document of the request's member textDocument, or NULL if there is none. */
lsp_document *lsp_find(const lsp_server *s, cli_data parameters);

#endif
