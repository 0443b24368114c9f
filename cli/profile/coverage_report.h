/* Declares the report on how often each line of a program ran. */
#ifndef VS_CLI_PROFILE_COVERAGE_REPORT_H
#define VS_CLI_PROFILE_COVERAGE_REPORT_H

#include <stdio.h>

#include "visualscheme.h"

/* A form of the program. count: number of times that it ran; order: number of forms that were compiled before it. */
typedef struct { const char *file; uint32_t line, column; uint64_t count; size_t order; } coverage_form;

/* The forms of a run, sorted by place; each place occurs once. ran: number of forms that ran at least once. */
typedef struct { coverage_form *forms; size_t count, room, ran; } coverage;

/* Reads the counts of the interpreter. Returns false when memory is out. coverage_free frees the forms. */
bool coverage_read(coverage *c, vs_scheme *scheme);
void coverage_free(coverage *c);
/* Prints the lines of each file with their counts, then the places of lines that did not run, then the sums. whole:
 * whether the run went to the end of the program. */
void coverage_print(const coverage *c, bool whole, FILE *to);
/* Prints the forms as a list of JSON. */
void coverage_print_json(const coverage *c, FILE *to);

#endif
