/* Declares ranges of --only, and the manifests of runs that make only a range. Several such runs may write at a time. A
 * run of all pictures reads the manifests of ranges. */
#ifndef VS_CLI_BATCH_RANGES_H
#define VS_CLI_BATCH_RANGES_H

#include <stdbool.h>
#include <stddef.h>

/* Reads "3..7" or "3" into *from and *to, and lowers *to to at most `most`. Returns false if the text is no range, or
 * *from is not between 1 and `most`. */
bool cli_range_read(const char *text, long most, long *from, long *to);

/* Writes the name of the manifest of a range: film/manifest-3..7.json for film/manifest.json. Returns false if it is
 * too long. */
bool cli_range_manifest(const char *manifest, long from, long to, char *out, size_t room);
/* Appends the texts of all manifests of ranges to *text, which the caller frees and which may be NULL. If idle is not
 * NULL, sets *idle to whether no run has locked a manifest. Returns false when memory is out. */
bool cli_range_texts(const char *manifest, char **text, bool *idle);
void cli_range_remove(const char *manifest); /* removes the manifests of ranges of this manifest */

#endif
