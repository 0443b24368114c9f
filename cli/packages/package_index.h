/* Declares an index of packages: a JSON file that anyone can host. */
#ifndef VS_CLI_PACKAGES_PACKAGE_INDEX_H
#define VS_CLI_PACKAGES_PACKAGE_INDEX_H

#include "cli/json_data.h"
#include "cli/packages/fetch_package.h"

/* A package of the index. address: a source for vs add, allocated. description, version: "" if the index has none. */
typedef struct { const char *name, *description, *version; char *address; } package_entry;

typedef struct {
  package_entry *at; size_t count, room;
  cli_data_reader json;
  cli_data all;
} package_index;

/* Returns the index that the command line or the environment variable VS_PACKAGE_INDEX names, or NULL. */
const char *package_index_source(const char *given);
/* Reads an index: a file, or the file vs-index.json of a folder or of an address of git. Fails with the reason in why.
 * In any case the caller calls package_index_free. */
fetch_outcome package_index_read(package_index *x, const char *source, char why[PACKAGE_WHY]);
const package_entry *package_index_find(const package_index *x, const char *name); /* returns NULL if the index has no
                                                                                    * package of this name */
void package_index_free(package_index *x);

#endif
