/* Declares the output of `vs ast`: the facts of an analysis as data for other programs. manual/ast.md is its schema. */
#ifndef VS_LANGUAGES_ANALYSIS_TREE_REPORT_H
#define VS_LANGUAGES_ANALYSIS_TREE_REPORT_H

#include "languages/analysis/analysis.h"
#include "languages/analysis/notation.h"

/* The version of the schema. It changes when the meaning of a field changes, not when a field is added. */
enum { KNOW_SCHEMA = 1 };

/* Writes the report of the analysis as JSON or XML. Returns false if memory is out. */
bool know_report_tree(const knowledge *k, FILE *to, know_notation notation);
/* Writes the analysis for a human reader, with a line for each statement, function and variable. */
void know_report_outline(const knowledge *k, FILE *to);
/* Writes a place: file, line, column and end. */
void know_write_place(know_writer *w, const knowledge *k, const know_place *at);
/* Writes a comment without its semicolons. */
void know_write_comment(know_writer *w, const knowledge *k, know_index first, know_index end);
/* Returns the text of a comment's line without its semicolons. */
const char *know_comment_text(const knowledge *k, know_index comment, size_t *length);

#endif
