/* Declares the submission, the list and the end of jobs of Slurm. */
#ifndef VS_CLI_CLUSTER_SLURM_H
#define VS_CLI_CLUSTER_SLURM_H

#include <signal.h>

#include "cli/cluster/job_record.h"

/* Submits the record's bundles as an array, and a join after them; sets r->array and r->join. The array waits for the
 * job r->first, unless it is "". Returns false after a message; nothing is then submitted. */
bool slurm_submit(job_record *r, const volatile sig_atomic_t *ended);
/* Submits the record's first bundle alone, which meters a film's exposure, and sets r->first. Returns false after a
 * message. */
bool slurm_submit_first(job_record *r, const volatile sig_atomic_t *ended);

/* Numbers of a batch's jobs that run or wait in Slurm. */
typedef struct { size_t running, waiting; } slurm_state;
/* Sets *out to the numbers of the batch's jobs in Slurm, without the job of this process. Returns false after a message
 * if Slurm gives no answer. */
bool slurm_ask(const job_record *r, const volatile sig_atomic_t *ended, slurm_state *out);
/* Cancels the jobs of the record. Returns false after a message. */
bool slurm_cancel(const job_record *r, const volatile sig_atomic_t *ended);

#endif
