/* Declares the places of a name in all files of a project: where it is defined, exported, imported and used. */
#ifndef VS_CLI_LSP_LSP_PROJECT_H
#define VS_CLI_LSP_LSP_PROJECT_H

#include "cli/lsp/lsp_answers.h"

/* A place of the name. other: whether the file has the name under another spelling, by a prefix or a rename. */
typedef struct { size_t file; uint32_t from, to; bool other; } lsp_name_place;

typedef struct {
  char *path;
  lsp_document *open;        /* document of the file, or NULL */
  bool owned;                /* whether the project frees the document, which no editor has open */
  bool prefixed;             /* whether the file imports the name with a prefix */
  bool fresh;                /* whether the new name of a rename has no meaning in the file */
} lsp_project_file;

typedef struct {
  lsp_project_file *files; size_t count, room;
  lsp_name_place *places; size_t place_count, place_room; /* sorted by file and offset; each occurs once */
  bool whole;                /* whether all files of the project were searched */
  bool here;                 /* whether all places are in the text of the request */
} lsp_project;

/* Returns whether the symbol is defined at top level, or at the top level of a library. */
bool lsp_is_top(const knowledge *k, const know_symbol *y);
/* Finds the places of the symbol in the document's project: its folder, or that of the editor. new_name: the name for
 * which the files' members `fresh` are set, or NULL. Returns false if the name concerns only its own text, or if memory
 * is out. The caller calls lsp_project_free in any case. */
bool lsp_project_find(lsp_project *p, lsp_server *s, lsp_document *d, know_index symbol, const char *new_name);
void lsp_project_free(lsp_project *p);
/* Returns the text of the file of a place. */
const lsp_document *lsp_project_text(const lsp_project *p, const lsp_name_place *at);

#endif
