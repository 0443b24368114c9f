/* Declares work on the files of a package. */
#ifndef VS_CLI_PACKAGES_PACKAGE_FILES_H
#define VS_CLI_PACKAGES_PACKAGE_FILES_H

#include <stdbool.h>
#include <stddef.h>

enum { PACKAGE_HASH = 65, PACKAGE_WHY = 300 };

/* Copies the ordinary files of a folder into a new folder, without those of git and of vs add. Returns false, with the
 * reason in why, for a link or another special file, and for more than 20,000 files or 256 MB. */
bool package_copy(const char *from, const char *to, char why[PACKAGE_WHY]);
/* Sets hash to the SHA-256 of the names and contents of all files, in hexadecimal digits. */
bool package_hash(const char *folder, char hash[PACKAGE_HASH], char why[PACKAGE_WHY]);
/* Sets hash to the SHA-256 of the contents of one file, as sha256sum prints it. */
bool package_file_hash(const char *path, char hash[PACKAGE_HASH], char why[PACKAGE_WHY]);
bool package_remove(const char *folder); /* removes the folder with its files, if there is one */

#endif
