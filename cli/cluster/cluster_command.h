/* Declares `vs sweep --on` and `vs render --on`: parts on this machine, by GNU parallel, or on a cluster by Slurm. */
#ifndef VS_CLI_CLUSTER_CLUSTER_COMMAND_H
#define VS_CLI_CLUSTER_CLUSTER_COMMAND_H

#include <signal.h>

#include "cli/cluster/job_record.h"

/* Runs or submits all parts of the command. The function `here` runs the command in this process. Returns the outcome
 * of the first part that failed, or VS_OUTCOME_DONE; with Slurm, only whether the jobs were submitted. */
vs_outcome cli_cluster_command(const cli_options *o, const volatile sig_atomic_t *ended,
                               vs_outcome (*here)(const cli_options *o));

/* Joins the parts, by a process of this program. Runs parts that are missing or were killed again, while the record has
 * retries. Returns the outcome. The path r->folder must be valid from the current folder. */
vs_outcome job_join(job_record *r, const volatile sig_atomic_t *ended);
/* Submits to Slurm the parts that are missing, or were killed. Returns false after a message. */
bool job_submit_rest(job_record *r, const volatile sig_atomic_t *ended);
/* Reads the states of the record's parts. Returns false after a message. */
struct cli_part_states;
bool job_states(const job_record *r, struct cli_part_states *out);

#endif
