/* Declares facts about names that a text imports from libraries in other files. */
#ifndef VS_CLI_LSP_LSP_LIBRARIES_H
#define VS_CLI_LSP_LSP_LIBRARIES_H

#include "cli/lsp/lsp_answers.h"

/* Returns whether a library in a file defines the symbol's name as a procedure. Sets *info, which is valid until the
 * next call. */
bool lsp_is_imported(const knowledge *k, know_index symbol, vs_name_info *info);
/* Writes the place of the definition as a location, or null if its file cannot be read. */
void lsp_put_imported(FILE *to, knowledge *k, const char *name, const vs_span *at);
/* Writes the comment lines above the definition. */
void lsp_add_imported_comment(FILE *to, knowledge *k, const char *name, const vs_span *at);

#endif
