/* Declares runs of other programs: sbatch, squeue, parallel, and vs itself. */
#ifndef VS_CLI_CLUSTER_JOB_PROCESS_H
#define VS_CLI_CLUSTER_JOB_PROCESS_H

#include <signal.h>
#include <stdbool.h>

enum { JOB_NO_PROGRAM = 127 };

/* Resources that a run has used: elapsed seconds, processor seconds, and the greatest memory of a process in
 * megabytes. */
typedef struct { double seconds, processor, memory; } job_use;

/* Runs the program `words[0]`; the array ends with NULL. *text, unless text is NULL, receives the standard output,
 * which the caller frees. *use, unless use is NULL, receives the time and memory used. Returns the exit code: 127 if
 * the program is missing, 137 if a signal ended it. */
int job_run(const char *const *words, const volatile sig_atomic_t *ended, char **text, job_use *use);

#endif
