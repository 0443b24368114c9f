/* Declares the fetching of a package. */
#ifndef VS_CLI_PACKAGES_FETCH_PACKAGE_H
#define VS_CLI_PACKAGES_FETCH_PACKAGE_H

#include "cli/packages/package_lock.h"

typedef enum { FETCHED, NOT_FETCHED /* the source is at fault */, NO_GIT /* git is missing or failed */ } fetch_outcome;

bool is_git_address(const char *source); /* returns false if the source is a folder */
/* Copies the package into the new folder `to`. If commit is "", takes the version after # in the address, or the
 * newest. Sets commit to the number of the commit that was taken. On failure, sets why to the reason. */
fetch_outcome package_fetch(const char *source, const char *to, char commit[80], char why[PACKAGE_WHY]);

#endif
