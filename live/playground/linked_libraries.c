/* Finds the functions of the libraries that are linked into the program, by the calls that load libraries elsewhere.
 *
 * WebAssembly has no shared libraries. geometry/dynamic.c asks dlopen and dlsym for a library by its file's name. Here
 * these functions answer from the table linked.def. The build makes it: names in the sources that the linked archives
 * define. A library that is not linked is missing, as on a machine where it is not installed. */
#include <dlfcn.h>
#include <expat.h>
#include <geos_c.h>
#include <jansson.h>
#include <microhttpd.h>
#include <png.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_MODULE_H
#include FT_OUTLINE_H
#include FT_TRUETYPE_TABLES_H

typedef void function(void);
typedef struct { const char *name; function *at; } linked;

/* In the order of strcmp. */
static const linked functions[] = {
#define LINKED(name) { #name, (function *)(name) },
#include <linked.def>
#undef LINKED
};

/* The beginnings of the files' names. */
static const char *const libraries[] = { "libexpat.", "libfreetype.", "libgeos_c.", "libjansson.",
                                         "libmicrohttpd.", "libpng16.", "libz." };

void *dlopen(const char *file, int how) {
  (void)how;
  for (size_t i = 0; file != NULL && i < sizeof libraries / sizeof *libraries; i++)
    if (strncmp(file, libraries[i], strlen(libraries[i])) == 0) return (void *)(uintptr_t)libraries[i];
  return NULL;
}

static int by_name(const void *key, const void *row) { return strcmp(key, ((const linked *)row)->name); }

void *dlsym(void *restrict library, const char *restrict name) {
  (void)library;
  const linked *found = bsearch(name, functions, sizeof functions / sizeof *functions, sizeof *functions, by_name);
  void *at = NULL;
  if (found != NULL) memcpy(&at, &found->at, sizeof at);
  return at;
}

int dlclose(void *library) {
  (void)library;
  return 0;
}
