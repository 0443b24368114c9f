/* Declares the record of a batch with --on: the file jobs/jobs.json in the folder of its results. */
#ifndef VS_CLI_CLUSTER_JOB_RECORD_H
#define VS_CLI_CLUSTER_JOB_RECORD_H

#include <stdio.h>

#include "cli/options.h"
#include "cli/sweep/sweep_table.h"

enum { JOB_PATH_ROOM = 4096, JOB_FOLDER_ROOM = JOB_PATH_ROOM - 128 };

/* The parts of a bundle, from `from` to `to`, counted from 1. */
typedef struct { long from, to; } job_range;

typedef struct {
  sweep_memory memory;        /* owns all texts and arrays */
  char folder[JOB_FOLDER_ROOM]; /* path of the results, seen from the present folder; not in the file */
  const char *on;             /* the value of --on */
  const char *directory;      /* folder in which the command was given */
  const char *program, *command; /* path of vs, and the name of its command: sweep or render */
  const char *host; long process; /* machine and process of --on local and parallel */
  const char **whole, **part; size_t whole_count, part_count; /* words as in cli_options */
  job_range *bundles; size_t bundle_count; /* the bundles of the last submission */
  const char *results;        /* path of the results, seen from `directory` */
  const char *first, *array, *join; /* numbers of Slurm's jobs: a first part that the bundles need, the bundles, and the
                                     * join after them; "" if there is none */
  const char *time, *memory_limit; /* limits of a bundle as Slurm reads them */
  size_t cpus, bundle;        /* processors of a bundle, and number of parts in it */
  double seconds;             /* measured seconds of a part, or 0 */
  size_t parts;               /* number of all parts */
  size_t attempt, retries;    /* attempt: number of the submission from 0; retries: greatest number of repeats */
  bool joined; int code;      /* joined: whether the join has ended, with this exit code */
  bool packed;                /* --pack: whether nodes make the parts from jobs/pack */
  bool quiet;                 /* whether this process prints errors alone; not in the file */
} job_record;

/* Makes the record of a command. Returns false after a message. */
bool job_record_make(job_record *r, const cli_options *o, const char *folder);
/* Makes this process the one that vs jobs cancel ends. Returns false after a message. */
bool job_record_own(job_record *r);
/* Reads the record in the folder. *found is false if there is none. Returns false after a message. */
bool job_record_read(job_record *r, const char *folder, bool *found);
/* Writes the record, whole or not at all. Returns false after a message. */
bool job_record_write(const job_record *r);
void job_record_free(job_record *r);
/* Moves to the folder in which the command was given, from which the paths of its words are seen. Returns false after a
 * message. */
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
/* Writes its path as nodes see it, from the root and without symbolic links, or returns false after a message. */
bool job_record_real_path(const job_record *r, const char *name, char path[JOB_PATH_ROOM]);
/* Writes a file of the batch by calling `put`, whole or not at all. Returns false after a message. */
bool job_record_put(const job_record *r, const char *name, void (*put)(FILE *to, const job_record *r));
/* Locks the folder's jobs for this process. Returns a descriptor, whose end unlocks them; -1 after a message. */
int job_record_lock(const job_record *r);
/* Returns true if a process has locked the folder's jobs. */
bool job_record_is_locked(const job_record *r);

#endif
