/* Owns the interface of stats.c: the output of --stats. */
#ifndef VS_CLI_STATS_H
#define VS_CLI_STATS_H

#include "visualscheme.h"

void cli_report_statistics(vs_scheme *s, bool json); /* statistics.c */

#endif
