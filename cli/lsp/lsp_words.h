/* Declares texts, places and diagnostics of the language server. */
#ifndef VS_CLI_LSP_LSP_WORDS_H
#define VS_CLI_LSP_LSP_WORDS_H

#include "cli/json_data.h"
#include "cli/lsp/lsp_document.h"
#include "languages/analysis/source_tree.h"

bool lsp_ends_word(char c); /* returns true for a blank, a parenthesis or a mark of quotation */
size_t lsp_word(const char *at, const char *end); /* returns the length of the word at `at` */

void lsp_put(FILE *to, const char *text); /* writes a JSON text */
/* Writes "key":{...} with the positions at which the span begins and ends. */
void lsp_put_range(FILE *to, const char *key, const char *text, size_t length, lsp_span span);
/* A place up to which a text was counted. */
typedef struct { size_t at; lsp_position place; } lsp_counted;
/* Writes as lsp_put_range does, and counts from the place *c, if the span does not lie before it. Sets *c to the span's
 * beginning. */
void lsp_put_next_range(FILE *to, const char *key, const lsp_document *d, lsp_span span, lsp_counted *c);
void lsp_put_node_range(FILE *to, const char *key, const knowledge *k, know_index node);
void lsp_put_location(FILE *to, const knowledge *k, know_index node);
/* Returns the bytes of a range that the editor sent. */
lsp_span lsp_range_of(const cli_data_reader *json, const lsp_document *d, cli_data range);

const char *lsp_check_name(unsigned check);
lsp_span lsp_finding_span(const lsp_document *d, const know_finding *f);
/* Writes the finding as a diagnostic of the protocol. If the finding is NULL, writes the first error of a text that
 * cannot be read. c: as in lsp_put_next_range. */
void lsp_write_diagnostic(FILE *to, const lsp_document *d, const know_finding *f, lsp_counted *c);
/* Writes the findings in the document, or its first error, as a list of diagnostics. */
void lsp_write_diagnostics(FILE *to, lsp_document *d, const vs_options *interpreter);

#endif
