/* Declares `vs check`: it finds probable faults of a program by reading it, without running it. */
#ifndef VS_LANGUAGES_CHECKS_CHECKS_H
#define VS_LANGUAGES_CHECKS_CHECKS_H

#include "languages/analysis/analysis.h"
#include "languages/analysis/notation.h"

typedef enum {
#define KNOW_CHECK(id, name, meaning) KNOW_CHECK_##id,
#include "languages/checks/checks.def"
  KNOW_CHECKS
} know_check;

typedef struct { uint8_t check; know_place at; const char *details; } know_finding;

typedef struct {
  knowledge *k;
  know_finding *at; size_t count, room;
} know_findings;

/* Runs all checks of checks.def. The findings are in the order of the text, without those that a comment allows.
 * Returns false on failure. */
bool know_check_program(knowledge *k, know_findings *out);
void know_findings_free(know_findings *f);
void know_report_findings(const know_findings *f, FILE *to);
void know_report_findings_json(const know_findings *f, FILE *to);

/* ---- functions for the files that check ---- */
/* Returns the message, followed by the advice that a run of the program would give at the node. The text is valid as
 * long as the interpreter. */
const char *know_advised(const knowledge *k, vs_advice_kind kind, know_index node, const char *message);
void know_found(know_findings *f, know_check check, know_index node, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
/* Returns true if the node is an expression of the program's text, not of a macro, and the walk (name_walk.h) has
 * visited it. */
bool know_is_call(const knowledge *k, know_index node);

#endif
