/* Declares the answer with the meaning of each word, by which an editor colours a text. */
#ifndef VS_CLI_LSP_LSP_COLOURS_H
#define VS_CLI_LSP_LSP_COLOURS_H

#include "cli/lsp/lsp_answers.h"

/* The protocol's names of meanings and of marks. The first of each list is the protocol's, and not used. */
#define LSP_MEANINGS(M) \
  M(comment) M(string) M(number) M(keyword) M(macro) M(function) M(variable) M(parameter) M(property) M(enumMember)
#define LSP_MARKS(M) M(declaration) M(modification) M(defaultLibrary)

#define LSP_QUOTED(name) ",\"" #name "\""
#define LSP_COLOURS_CAPABILITY                                                            \
  "\"semanticTokensProvider\":{\"full\":true,\"legend\":{\"tokenTypes\":[\"namespace\"" LSP_MEANINGS(LSP_QUOTED) \
  "],\"tokenModifiers\":[\"definition\"" LSP_MARKS(LSP_QUOTED) "]}}"

void lsp_colours(lsp_server *s, cli_data parameters); /* answers a request for the meanings of words; its type is
                                                       * lsp_answer */

#endif
