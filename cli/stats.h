/* Declares the output of the option --stats. */
#ifndef VS_CLI_STATS_H
#define VS_CLI_STATS_H

#include "visualscheme.h"

void cli_report_statistics(vs_scheme *s, bool json); /* Prints the statistics of the interpreter, as JSON or as
                                                      * tables. */

#endif
