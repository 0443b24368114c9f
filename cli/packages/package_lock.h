/* Declares the file vs.lock, which records the packages in the folder .vs beside it. */
#ifndef VS_CLI_PACKAGES_PACKAGE_LOCK_H
#define VS_CLI_PACKAGES_PACKAGE_LOCK_H

#include "cli/json_data.h"
#include "cli/packages/package_files.h"

typedef struct {
  char *name, *source;      /* source: a folder, or an address of git */
  char *commit;             /* the commit's number; "" for a folder */
  char hash[PACKAGE_HASH];
  bool direct;              /* whether the user added it; else another package needs it */
} package;

typedef struct {
  package *at; size_t count, room;
  cli_data_reader json;
} package_lock;

/* Reads FOLDER/vs.lock, if there is one. Returns false, with the reason in why, if it is no such file. In any case the
 * caller calls package_lock_free. */
bool package_lock_read(package_lock *l, const char *folder, char why[PACKAGE_WHY]);
void package_lock_free(package_lock *l);
package *package_lock_find(const package_lock *l, const char *name); /* returns NULL if there is none */
/* Returns the package of this name, which is new if there was none, or NULL when memory is out. */
package *package_lock_put(package_lock *l, const char *name);
bool package_lock_write(const package_lock *l, const char *folder); /* writes FOLDER/vs.lock */

/* Returns true if .vs has the packages of the lock, as they were when they were added, and no others. */
bool package_lock_agrees(const package_lock *l, const char *folder, char why[PACKAGE_WHY]);
bool package_is_name(const char *name); /* returns true for a-z, then a-z, 0-9 and hyphens; not for names of ours */

/* Sets path to the folder .vs of the program at `model` (NULL: of the present folder), or to "" if no folder around it
 * has a vs.lock. Returns false, with the reason in why, if .vs does not agree with vs.lock. */
bool package_path(const char *model, char *path, size_t size, char why[PACKAGE_WHY]);

#endif
