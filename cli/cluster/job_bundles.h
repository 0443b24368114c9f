/* Declares the bundles of a batch: ranges of parts that one job makes, one after another. */
#ifndef VS_CLI_CLUSTER_JOB_BUNDLES_H
#define VS_CLI_CLUSTER_JOB_BUNDLES_H

#include "cli/batch/part_states.h"
#include "cli/cluster/job_record.h"

/* Returns the number of parts in a bundle. A bundle should run for one to ten minutes on a cluster, or a few seconds on
 * one machine. seconds: duration of a part, or 0 if unknown. */
size_t job_bundle_size(double seconds, size_t parts, bool cluster);
/* Divides into bundles all parts, beginning with `first`, that are missing or were killed. With states NULL, takes
 * parts in any state. Returns false after a message. */
bool job_bundles_make(job_record *r, const cli_part_state *states, size_t first);
/* Writes jobs/bundles.sh, which makes the bundle whose number is its argument, and jobs/join.sh, which joins the parts.
 * Returns false after a message. */
bool job_scripts_write(const job_record *r);

/* Writes the line with which a script of a packed batch begins; the line makes the node's own copy of the model. */
void job_put_unpack(FILE *to, const job_record *r);

/* Returns the command line of a `vs` that makes the parts of the range. job_run runs it; the caller frees the array. */
const char **job_words_of(const job_record *r, const char *range);
/* Returns the command line of a `vs` that joins or makes all parts. `option`, with `value` unless it is NULL, is its
 * first option. The caller frees the array. */
const char **job_words_of_all(const job_record *r, const char *option, const char *value);

#endif
