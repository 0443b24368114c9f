/* Declares runs of other programs: sbatch, squeue, parallel, and vs itself. */
#ifndef VS_CLI_CLUSTER_JOB_PROCESS_H
#define VS_CLI_CLUSTER_JOB_PROCESS_H

#include <signal.h>
#include <stdbool.h>

enum { JOB_NO_PROGRAM = 127 };

/* The use of a run: seconds by the clock, seconds of processors, and greatest memory of a process in megabytes. */
typedef struct { double seconds, processor, memory; } job_use;

/* Runs the program with these words, whose last is NULL. When *ended is set, the program is asked to end. text: NULL,
 * or receives its standard output, which the caller frees. use: NULL, or receives its use. Returns the exit code; 127
 * if there is no such program, 137 if a signal ended it. */
int job_run(const char *const *words, const volatile sig_atomic_t *ended, char **text, job_use *use);

#endif
