/* Implements the loading of libraries at run time (dlopen, dlsym). */
#define _GNU_SOURCE /* needed so that dlfcn.h declares RTLD_NODELETE */
#include "geometry/dynamic.h"

#include <dlfcn.h>
#include <stdio.h> /* needed by jpeglib.h */
#include <string.h>
#include <jpeglib.h>
#include <suitesparse/cholmod.h>

#include "model/assert.h"

/* The structures of CHOLMOD and libjpeg differ from version to version. Therefore only the library file whose version
 * matches the compiled header is loaded. */
#define TEXT_OF(x) #x
#define FILE_OF(version) "libcholmod.so." TEXT_OF(version), "libcholmod." TEXT_OF(version) ".dylib", "libcholmod.dll"
#define CHOLMOD_FILE FILE_OF(CHOLMOD_MAIN_VERSION)
#if JPEG_LIB_VERSION >= 80
#define JPEG_FILE "libjpeg.so.8"
#else
#define JPEG_FILE "libjpeg.so.62"
#endif

typedef struct {
  const char *package;  /* name of the Debian package that contains the library */
  const char *files[8]; /* file names to try in order; NULL behind the last */
} row;

static const row rows[VS_LIBRARIES] = {
#define LOADED(id, name, licence, package, uses, ...) [VS_LIBRARY_##id] = { package, { __VA_ARGS__ } },
#include "geometry/used_libraries.def"
};

bool vs_dynamic_load(vs_library library, const char *purpose, const vs_dynamic_name *names, size_t count,
                     void *functions, vs_error *e) {
  VS_ASSERT(library < VS_LIBRARIES);
  const row *r = &rows[library];
  void *handle = NULL;
  for (const char *const *file = r->files; !handle && *file; file++) {
    handle = dlopen(*file, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    const char *why = handle ? NULL : dlerror();
    if (why && (strstr(why, "memory") || strstr(why, "failed to map segment"))) return vs_error_memory(e, NULL);
  }
  if (!handle)
    return vs_error_set(e, VS_ERROR_WORKER, NULL, "%s: the library %s is missing; it is in the package %s", purpose,
                        r->files[0], r->package);
  bool ok = true;
  for (size_t i = 0; ok && i < count; i++) {
    void *found = dlsym(handle, names[i].symbol);
    /* memcpy is used because ISO C cannot cast an object pointer to a function pointer. */
    memcpy((char *)functions + names[i].offset, &found, sizeof found);
    if (!found)
      ok = vs_error_set(e, VS_ERROR_WORKER, NULL, "%s: the library %s is too old: it has no %s", purpose, r->files[0],
                        names[i].symbol);
  }
  dlclose(handle); /* closes only the handle; the library stays loaded, because it was opened with RTLD_NODELETE */
  return ok;
}
