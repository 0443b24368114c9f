/* Declares the record of a batch with --on: the file jobs/jobs.json in the folder of its results. */
#ifndef VS_CLI_CLUSTER_JOB_RECORD_H
#define VS_CLI_CLUSTER_JOB_RECORD_H

#include <stdio.h>

#include "cli/options.h"
#include "cli/sweep/sweep_table.h"

enum { JOB_PATH_ROOM = 4096, JOB_FOLDER_ROOM = JOB_PATH_ROOM - 128 };

/* A bundle: the parts from `from` to `to`, counted from 1, that one job makes. */
typedef struct { long from, to; } job_range;

typedef struct {
  sweep_memory memory;        /* owns all texts and arrays */
  char folder[JOB_FOLDER_ROOM]; /* path of the results from the current folder; not stored in the file */
  const char *on;             /* the value of --on */
  const char *directory;      /* folder in which the command was given */
  const char *program, *command; /* path of vs, and the name of its command: sweep or render */
  const char *host; long process; /* with --on local and parallel: the machine and the process that runs the batch */
  const char **whole, **part; size_t whole_count, part_count; /* words of the command line for all parts (whole) and for
                                                               * one range of parts (part), as in cli_options */
  job_range *bundles; size_t bundle_count; /* ranges of parts that the last submission makes, one for each job */
  const char *results;        /* path of the results from the folder `directory` */
  const char *first, *array, *join; /* Slurm's job numbers of the first part, of the array of bundles, and of the join;
                                     * "" if there is no such job */
  const char *time, *memory_limit; /* limits of time and memory for the job of one bundle, as Slurm reads them */
  size_t cpus, bundle;        /* processors that the job of one bundle uses, and number of parts in a bundle */
  double seconds;             /* measured seconds of one part, or 0 */
  size_t parts;               /* number of all parts */
  size_t attempt, retries;    /* attempt: number of the submission from 0; retries: greatest number of repeats */
  bool joined; int code;      /* whether the join of the parts has ended, and its exit code */
  bool packed;                /* --pack: whether nodes make the parts from jobs/pack */
  bool quiet;                 /* whether this process prints only errors; not stored in the file */
} job_record;

/* Makes the record of a command. Returns false after a message. */
bool job_record_make(job_record *r, const cli_options *o, const char *folder);
/* Records this process as the process that `vs jobs cancel` ends. Returns false after a message. */
bool job_record_own(job_record *r);
/* Reads the record in the folder. *found is false if there is none. Returns false after a message. */
bool job_record_read(job_record *r, const char *folder, bool *found);
/* Writes the record, whole or not at all. Returns false after a message. */
bool job_record_write(const job_record *r);
void job_record_free(job_record *r);
/* Changes to the folder in which the command was given, since the paths in its words are relative to that folder.
 * Returns false after a message. */
bool job_record_enter(job_record *r);

/* Returns true if this process runs in a node's own folder, to which the pack was copied. */
bool job_is_unpacked(void);
/* Returns true if the parts are jobs of Slurm. */
bool job_is_on_slurm(const job_record *r);

/* The file for names of nodes on which a worker or a disk has failed. */
#define JOB_NODES "failed-nodes"
/* Removes the lists of nodes that have failed or were refused. */
void job_record_forget_nodes(const job_record *r);
/* Writes the path of a file of the batch, such as bundles.sh, into path. */
void job_record_path(const job_record *r, const char *name, char path[JOB_PATH_ROOM]);
/* Writes the absolute path of a file of the batch, without symbolic links, as nodes see it. Returns false after a
 * message. */
bool job_record_real_path(const job_record *r, const char *name, char path[JOB_PATH_ROOM]);
/* Writes a file of the batch by calling `put`, whole or not at all. Returns false after a message. */
bool job_record_put(const job_record *r, const char *name, void (*put)(FILE *to, const job_record *r));
/* Locks the jobs of the folder for this process. Returns a descriptor, or -1 after a message. Closing the descriptor
 * unlocks the jobs. */
int job_record_lock(const job_record *r);
/* Returns true if a process has locked the folder's jobs. */
bool job_record_is_locked(const job_record *r);

#endif
