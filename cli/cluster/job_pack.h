/* Declares --pack: the model with all files that it reads, and vs, for nodes that share only the folder of the results.
 *
 * jobs/pack/ has each file under the name of its SHA-256, and `list`, which sha256sum reads: "HASH  PATH". A node
 * copies them into a folder of its own, which it removes at the end of the bundle. */
#ifndef VS_CLI_CLUSTER_JOB_PACK_H
#define VS_CLI_CLUSTER_JOB_PACK_H

#include <signal.h>

#include "cli/cluster/job_process.h"
#include "cli/cluster/job_record.h"

/* The file that lists the nodes that were refused, each with the reason. */
#define JOB_REFUSED "refused-nodes"
/* The environment variable that is set in a process that runs in a node's own copy of the model. */
#define JOB_PACKED "VS_PACKED"

/* Packs vs, the files that the first part reads, and the files of --pack=FILE,.... The function `here` runs the command
 * in this process. Returns false after a message. */
bool job_pack_make(job_record *r, const cli_options *o, vs_outcome (*here)(const cli_options *o));
/* Writes jobs/unpack.sh, which the scripts of bundles and of the join begin with, and jobs/sample.sh. Returns false
 * after a message. */
bool job_pack_scripts(const job_record *r);
/* Makes one part as a sample from the pack, and keeps the hashes of its files to compare nodes. Sets *use and
 * r->seconds. Returns the exit code. */
int job_pack_sample(job_record *r, const volatile sig_atomic_t *ended, job_use *use);

#endif
