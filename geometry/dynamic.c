/* Implements the loading of libraries at run time (dlopen, dlsym). */
#define _GNU_SOURCE /* needed so that dlfcn.h declares RTLD_NODELETE */
#include "geometry/dynamic.h"

#include <dlfcn.h>
#include <string.h>

static const char *const json_files[] = { "libjansson.so.4", "libjansson.4.dylib", NULL };
const vs_dynamic_library vs_json_library = { json_files, "libjansson4", "JSON" };

bool vs_dynamic_load(const vs_dynamic_library *library, const vs_dynamic_name *names, size_t count, void *functions,
                     vs_error *e) {
  void *handle = NULL;
  for (const char *const *file = library->files; !handle && *file; file++) {
    handle = dlopen(*file, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    const char *why = handle ? NULL : dlerror();
    if (why && (strstr(why, "memory") || strstr(why, "failed to map segment"))) return vs_error_memory(e, NULL);
  }
  if (!handle)
    return vs_error_set(e, VS_ERROR_WORKER, NULL, "%s: the library %s is missing; it is in the package %s",
                        library->purpose, library->files[0], library->package);
  bool ok = true;
  for (size_t i = 0; ok && i < count; i++) {
    void *found = dlsym(handle, names[i].symbol);
    /* memcpy is used because ISO C cannot cast an object pointer to a function pointer. */
    memcpy((char *)functions + names[i].offset, &found, sizeof found);
    if (!found)
      ok = vs_error_set(e, VS_ERROR_WORKER, NULL, "%s: the library %s is too old: it has no %s", library->purpose,
                        library->files[0], names[i].symbol);
  }
  dlclose(handle); /* closes only the handle: because of RTLD_NODELETE, the library stays loaded */
  return ok;
}
