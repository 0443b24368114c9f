/* Declares the file vs.lock, which records the packages in the folder .vs beside it. */
#ifndef VS_CLI_PACKAGES_PACKAGE_LOCK_H
#define VS_CLI_PACKAGES_PACKAGE_LOCK_H

#include "cli/json_data.h"
#include "cli/packages/package_files.h"

typedef struct {
  char *name, *source;      /* source: a folder, or an address of git */
  char *commit;             /* the commit's number; "" for a folder */
  char hash[PACKAGE_HASH];
  bool direct;              /* whether the user added the package; otherwise another package needs it */
} package;

typedef struct {
  package *at; size_t count, room;
  cli_data_reader json;
} package_lock;

/* Reads FOLDER/vs.lock, if there is one. Returns false, with the reason in why, if it is no such file. In any case the
 * caller calls package_lock_free. */
bool package_lock_read(package_lock *l, const char *folder, char why[PACKAGE_WHY]);
void package_lock_free(package_lock *l);
package *package_lock_find(const package_lock *l, const char *name); /* returns NULL if vs.lock has no package of this
                                                                      * name */
/* Returns the package of this name, which is new if there was none, or NULL when memory is out. */
package *package_lock_put(package_lock *l, const char *name);
bool package_lock_write(const package_lock *l, const char *folder); /* writes FOLDER/vs.lock */

/* Returns true if the folder .vs contains exactly the packages of vs.lock, unchanged since they were added. */
bool package_lock_agrees(const package_lock *l, const char *folder, char why[PACKAGE_WHY]);
bool package_is_name(const char *name); /* returns true for a name of lower-case letters, digits and hyphens that begins
                                         * with a letter and is not reserved */

/* Sets path to the folder .vs for the program at `model`; NULL means the current folder. Sets path to "" if no folder
 * around it has a vs.lock. Returns false, with the reason in why, if .vs and vs.lock differ. */
bool package_path(const char *model, char *path, size_t size, char why[PACKAGE_WHY]);

#endif
