/* Declares the manifest of a sweep: a file with one line of JSON for each finished part.
 *
 * A line is appended when its part is finished, so a killed sweep loses no finished part. A sweep of a range (--only)
 * has a manifest of its own, so that several may run at a time. A whole sweep reads all of them, and joins them when it
 * ends. */
#ifndef VS_CLI_SWEEP_SWEEP_MANIFEST_H
#define VS_CLI_SWEEP_SWEEP_MANIFEST_H

#include <time.h>

#include "cli/sweep/sweep_table.h"
#include "visualscheme.h"

typedef struct sweep_manifest sweep_manifest;

/* Reads and locks the manifest in the folder. only: the range as "1..10", or NULL for a whole sweep. Returns NULL after
 * a message, if another sweep has locked it or it cannot be written. */
sweep_manifest *sweep_manifest_open(sweep_table *t, const char *folder, const char *only);
/* Reads the manifests in the folder, without a lock, while others may write them. The result appends nothing. */
sweep_manifest *sweep_manifest_read(sweep_table *t, const char *folder);
bool sweep_manifest_is_new(const sweep_manifest *m); /* returns true if the manifest's file was empty or missing */
/* Records in s the files that runs of earlier sweeps have read. Returns false if there were none. */
bool sweep_manifest_note_inputs(const sweep_manifest *m, vs_scheme *s);
void sweep_manifest_abandon(sweep_manifest *m); /* removes the file if it is new and empty */
/* Returns true if the manifest lists the part, and neither the files that its run read nor its outputs have changed.
 * Sets the part's results. */
bool sweep_manifest_stands(sweep_manifest *m, sweep_part *p);
/* Returns true if the manifest lists the part as done, and the files that its run read have not changed; its outputs
 * are not read. Sets the part's seconds. */
bool sweep_manifest_is_listed(sweep_manifest *m, sweep_part *p);
/* Returns true if the part's last line is a failure, and the files that its run read have not changed. Sets the part's
 * code and message. */
bool sweep_manifest_failed(sweep_manifest *m, sweep_part *p);
/* Returns the hash of the names and contents of these files, each name ending in NUL. Returns 0 if a file has changed
 * since the run began. */
uint64_t sweep_manifest_inputs(sweep_manifest *m, const char *names, size_t length, struct timespec began);
/* Appends the line of a finished part. Returns false after a message. */
bool sweep_manifest_add(sweep_manifest *m, const sweep_part *p);
/* Replaces all manifests of the folder by one without repeated and outdated lines. Returns false after a message. */
bool sweep_manifest_join(sweep_manifest *m);
/* Closes the locked files in a process of a part, which may outlive a killed sweep, so that the locks end with the
 * sweep. */
void sweep_manifest_let_go(const sweep_manifest *m);
const char *sweep_manifest_path(const sweep_manifest *m);
void sweep_manifest_close(sweep_manifest *m); /* m may be NULL */

#endif
