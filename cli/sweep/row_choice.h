/* Declares the choice of a sweep's rows for its table: those for which --where is true, in the order of --sort. */
#ifndef VS_CLI_SWEEP_ROW_CHOICE_H
#define VS_CLI_SWEEP_ROW_CHOICE_H

#include "cli/sweep/sweep_table.h"

/* Returns true if the text of --where can be read: "area<100,cost<=5", or an expression of the language such as
 * "(< area 100)". Otherwise prints a message. */
bool sweep_where_reads(const char *where);
/* Sets rows to the indices of the chosen parts, in order, and *count to their number. where and sort may be NULL. After
 * a message returns false; rows then are all finished parts in their own order. */
bool sweep_choose_rows(const sweep_table *t, const char *where, const char *sort, size_t *rows, size_t *count);

#endif
