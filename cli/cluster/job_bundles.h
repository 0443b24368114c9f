/* Declares the bundles of a batch: ranges of parts that one job makes, one after another. */
#ifndef VS_CLI_CLUSTER_JOB_BUNDLES_H
#define VS_CLI_CLUSTER_JOB_BUNDLES_H

#include "cli/batch/part_states.h"
#include "cli/cluster/job_record.h"

/* Returns the number of parts in a bundle, so that it runs for one to ten minutes, or for a few seconds on one machine.
 * seconds: of a part; 0: unknown. */
size_t job_bundle_size(double seconds, size_t parts, bool cluster);
/* Sets the record's bundles: all parts from `first` on that are missing or were killed, or all with states NULL. A
 * bundle has at most r->bundle parts, unless that makes too many bundles. Returns false after a message. */
bool job_bundles_make(job_record *r, const cli_part_state *states, size_t first);
/* Writes jobs/bundles.sh, which makes the bundle of its argument or of Slurm's array, and jobs/join.sh. Returns false
 * after a message. */
bool job_scripts_write(const job_record *r);

/* Writes the word as a shell reads it, without a blank before it. */
void job_put_quoted(FILE *to, const char *word);
/* Writes the line by which a script of a packed batch begins: the node's own copy of the model. */
void job_put_unpack(FILE *to, const job_record *r);

/* The words of a `vs` that makes the parts of the range, for job_run; the caller frees them. */
const char **job_words_of(const job_record *r, const char *range);
/* The words of a `vs` that joins all parts, or with `again` of one that makes all parts, with this last option. */
const char **job_words_of_all(const job_record *r, const char *option, const char *value);

#endif
