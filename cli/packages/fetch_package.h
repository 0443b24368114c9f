/* Declares the fetching of a package. */
#ifndef VS_CLI_PACKAGES_FETCH_PACKAGE_H
#define VS_CLI_PACKAGES_FETCH_PACKAGE_H

#include "cli/packages/package_lock.h"

typedef enum { FETCHED, NOT_FETCHED /* the source is at fault */, NO_GIT /* git is missing or failed */ } fetch_outcome;

bool is_git_address(const char *source); /* else it is a folder */
/* Copies the package into the new folder `to`. commit: the commit to take; "" for the name after # in the address, or
 * for the newest. It becomes the number of the commit taken. Fails with the reason in why. */
fetch_outcome package_fetch(const char *source, const char *to, char commit[80], char why[PACKAGE_WHY]);

#endif
