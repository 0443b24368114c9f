/* Implements dlopen and dlsym for the libraries that are linked into the playground's program.
 *
 * WebAssembly has no shared libraries. geometry/dynamic.c calls dlopen with a library's file name, and dlsym with a
 * function's name. Here these functions search the table linked.def. The build generates the table from the names in
 * the sources that the linked archives define. A library that is not linked counts as not installed. */
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

/* Table of the linked functions, sorted by name in the order of strcmp. */
static const linked functions[] = {
#define LINKED(name) { #name, (function *)(name) },
#include <linked.def>
#undef LINKED
};

/* Beginnings of the file names of the libraries that dlopen accepts. */
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
